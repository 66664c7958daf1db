// In which order the components of a surface are extracted, and which of them at the same time.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

// What the components that are side by side report, as one.
inline constexpr const char* kSideBySideStage = "components side by side";

// How far they are together: half of the work of each counts when it is begun, the other half when it is
// over. Whichever of them tells it, and whichever ends first, it never falls. Safe on several threads.
class SideBySideShare {
 public:
  explicit SideBySideShare(double work) : work_(work) {}  // of all of them
  void begin(double work) { add(work / 2); }
  void end(double work) { add(work / 2); }
  double share() const { return work_ > 0 ? std::min(1.0, done_.load() / work_) : 1; }

 private:
  void add(double work) {
    double done = done_.load();
    while (!done_.compare_exchange_weak(done, done + work)) {
    }
  }

  double work_;
  std::atomic<double> done_{0};
};

struct ComponentOrder {
  std::vector<Index> components;  // the largest first
  std::size_t alone = 0;          // so many of them one after the other, then the others side by side
};

// Faces of the surface that the stages walk on, at most.
inline double most_working_faces(bool coarsen, Index vertices) {
  return coarsen ? 2.0 * vertices : std::numeric_limits<double>::infinity();
}

// What a component takes, roughly, in faces of a surface that the stages walk on, which has at most
// `working_faces`. A finer one is coarsened to it, at so much less a face.
inline double component_work(std::size_t faces, double working_faces) {
  constexpr double kCoarsening = 1.0 / 16;
  const auto count = static_cast<double>(faces);
  return count <= working_faces ? count : working_faces + kCoarsening * count;
}

// `faces`: those of each component. A component shares out its own work among the threads, but not all of it:
// it is alone only where it is more than one thread's share of what is left. The others have a thread each,
// which leaves none without work.
inline ComponentOrder order_components(const std::vector<std::size_t>& faces, double working_faces,
                                       int threads) {
  ComponentOrder order;
  order.components.resize(faces.size());
  std::iota(order.components.begin(), order.components.end(), 0);
  std::stable_sort(order.components.begin(), order.components.end(),
                   [&](Index a, Index b) { return faces[a] > faces[b]; });
  double left = 0;
  for (const std::size_t count : faces) left += component_work(count, working_faces);
  for (const Index c : order.components) {
    const double work = component_work(faces[c], working_faces);
    if (threads > 1 && threads * work <= left) break;
    left -= work;
    ++order.alone;
  }
  return order;
}

}  // namespace mspskel
