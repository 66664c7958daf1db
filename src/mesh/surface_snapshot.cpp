#include "mspskel/mesh/surface_snapshot.h"

#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/detail/surface_snapshot_impl.h"

namespace mspskel {
template SurfaceSnapshot make_snapshot<DefaultMesh>(const DefaultMesh&);
}
