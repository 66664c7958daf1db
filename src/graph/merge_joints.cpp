#include "mspskel/graph/merge_joints.h"

#include "mspskel/graph/detail/merge_joints_impl.h"
