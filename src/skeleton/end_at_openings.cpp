#include "mspskel/skeleton/end_at_openings.h"

#include "mspskel/skeleton/detail/end_at_openings_impl.h"
