#include "mspskel/collapse/piece_components.h"

#include "mspskel/collapse/detail/piece_components_impl.h"
