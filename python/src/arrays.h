// numpy arrays as views of our memory, and our memory from numpy arrays.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"

namespace mspskel::python {

namespace nb = nanobind;

template <class Value>
using View = nb::ndarray<nb::numpy, const Value>;
using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
template <class Value>
using List = nb::ndarray<const Value, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class Value>
using Rows = nb::ndarray<const Value, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

// A view that keeps `owner` alive, which the values belong to.
template <class Value>
View<Value> view(const std::vector<Value>& values, nb::handle owner) {
  return View<Value>(values.data(), {values.size()}, owner);
}
inline View<double> view(const std::vector<Vector3>& values, nb::handle owner) {
  return View<double>(reinterpret_cast<const double*>(values.data()), {values.size(), 3}, owner);
}
inline View<Index> view(const std::vector<std::array<Index, 2>>& values, nb::handle owner) {
  return View<Index>(reinterpret_cast<const Index*>(values.data()), {values.size(), 2}, owner);
}

// An array that owns the values.
template <class Element>
auto given_away(std::vector<Element> values) {
  auto kept = std::make_unique<std::vector<Element>>(std::move(values));
  const std::vector<Element>& held = *kept;
  const nb::capsule owner(kept.release(),
                          [](void* p) noexcept { delete static_cast<std::vector<Element>*>(p); });
  return view(held, owner);
}

template <class Value>
std::vector<Value> copied(const List<Value>& values) {
  return {values.data(), values.data() + values.size()};
}
inline std::vector<Vector3> copied(const Points& values) {
  std::vector<Vector3> result(values.shape(0));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values(i, 0), values(i, 1), values(i, 2)};
  return result;
}

// Puts the values of `given`, which must be as many as before, in place, since there may be views of the old
// ones. Throws UsageError that names the list.
template <class Array, class Value>
void replace(std::vector<Value>& target, const Array& given, const char* name) {
  if (given.shape(0) != target.size())
    throw UsageError(std::string(name) + ": expected " + std::to_string(target.size()) + " entries, not " +
                     std::to_string(given.shape(0)));
  const std::vector<Value> values = copied(given);
  std::copy(values.begin(), values.end(), target.begin());
}

}  // namespace mspskel::python
