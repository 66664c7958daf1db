#include "mspskel/collapse/coarse_labels.h"

#include "mspskel/collapse/detail/coarse_labels_impl.h"
