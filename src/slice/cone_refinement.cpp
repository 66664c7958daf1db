#include "mspskel/slice/cone_refinement.h"

#include "mspskel/slice/detail/cone_refinement_impl.h"
