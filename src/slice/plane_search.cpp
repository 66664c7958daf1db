#include "mspskel/slice/plane_search.h"

#include "mspskel/slice/detail/plane_search_impl.h"
