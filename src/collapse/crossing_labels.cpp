#include "mspskel/collapse/crossing_labels.h"

#include "mspskel/collapse/detail/crossing_labels_impl.h"
