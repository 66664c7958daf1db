// Compiles the half-edge snapshot for the default mesh type once.
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
template SurfaceSnapshot make_snapshot<DefaultMesh>(const DefaultMesh&);
}
