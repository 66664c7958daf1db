// The page of all experiments: the thesis's tables with our figures beside its own, and the pictures.
#pragma once

#include <vector>

#include "document.h"
#include "study.h"

namespace mspskel::experiments {

Document make_page(const std::vector<Study>& studies, int threads);

}  // namespace mspskel::experiments
