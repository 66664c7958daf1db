#include "mspskel/center/spatial_coherence.h"

#include "mspskel/center/detail/spatial_coherence_impl.h"
