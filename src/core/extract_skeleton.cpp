// Compiles the whole pipeline for the default mesh type once.
#include "mspskel/extract_skeleton.h"

namespace mspskel {
template ExtractResult extract_skeleton<DefaultMesh>(const DefaultMesh&, const ExtractOptions&);
}
