#include "mspskel/center/skeletal_point.h"

#include "mspskel/center/detail/skeletal_point_impl.h"
