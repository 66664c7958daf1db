#include "mspskel/skeleton/useless_pieces.h"

#include "mspskel/skeleton/detail/useless_pieces_impl.h"
