// Compiles the pipeline once.
#include "mspskel/extract_skeleton.h"

#include "mspskel/pipeline/detail/extract_skeleton_impl.h"
