#include "mspskel/arcs/merge_joints.h"

#include "mspskel/arcs/detail/merge_joints_impl.h"
