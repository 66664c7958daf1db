// A triangle by its corners.
#pragma once

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

struct Triangle {
  Vector3 a, b, c;
};

}  // namespace detail
}  // namespace mspskel
