#include "mspskel/center/skeleton_mesh.h"

#include "mspskel/center/detail/skeleton_mesh_impl.h"
