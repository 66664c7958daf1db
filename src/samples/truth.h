// Skeletons that samples are made round.
#pragma once

#include <functional>
#include <vector>

#include "mspskel/samples/skin_graph.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

// How far below the surface an end lies, in half widths of its limb.
inline constexpr double kEndDepth = 0.25;

// Nodes by place, each once, and straight arcs between them.
class TruthGraph {
 public:
  // The node at that place, made with the radius where there is none yet; the larger radius counts.
  Index node(const Vector3& position, double radius);
  void arc(const Vector3& from, double from_radius, const Vector3& to, double to_radius);
  // From a joint to where a limb's axis leaves the solid at `tip`, ends a quarter of `half_width` before it.
  void limb(const Vector3& joint, double joint_radius, const Vector3& tip, double half_width);
  CurveSkeleton result() &&;

 private:
  CurveSkeleton skeleton_;
};

// The axis between two points of the surface, of a part with that half width.
CurveSkeleton axis_between(const Vector3& a, const Vector3& b, double half_width);
// Balls and their edges; leaves go on into their ball.
CurveSkeleton truth_of(const BallGraph& graph);
// A closed curve of `count` nodes, t in [0, 1).
CurveSkeleton closed_curve(const std::function<Vector3(double)>& curve, double radius, Index count);

void append(CurveSkeleton& skeleton, const CurveSkeleton& other);
CurveSkeleton moved(CurveSkeleton skeleton, const Eigen::Matrix3d& turn, const Vector3& shift);
// As the samples that stand on a floor.
CurveSkeleton y_upward(CurveSkeleton skeleton);

}  // namespace mspskel::detail
