#include "mspskel/graph/check_skeleton.h"

#include "mspskel/graph/detail/check_skeleton_impl.h"
