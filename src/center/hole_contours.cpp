#include "mspskel/center/hole_contours.h"

#include "mspskel/center/detail/hole_contours_impl.h"
