#include "mspskel/solid/shells.h"

#include "mspskel/solid/detail/shells_impl.h"
