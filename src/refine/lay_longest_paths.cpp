#include "mspskel/refine/lay_longest_paths.h"

#include "mspskel/refine/detail/lay_longest_paths_impl.h"
