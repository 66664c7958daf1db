#include "mspskel/graph/lay_longest_paths.h"

#include "mspskel/graph/detail/lay_longest_paths_impl.h"
