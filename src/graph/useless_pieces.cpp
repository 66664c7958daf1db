#include "mspskel/graph/useless_pieces.h"

#include "mspskel/graph/detail/useless_pieces_impl.h"
