#include "mspskel/graph/end_at_openings.h"

#include "mspskel/graph/detail/end_at_openings_impl.h"
