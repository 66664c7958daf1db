// A tree of joints and how a surface follows it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

struct RigJoint {
  std::string name;                    // unique
  Index parent = kNone;                // a joint before this one; kNone only at joint 0, the root
  Vector3 position = Vector3::Zero();  // model coordinates, at rest
  Index node = kNone;                  // of the skeleton
  Index twin = kNone;                  // the joint on the other side of the mirror plane; kNone: none
};

// How much a vertex follows a joint.
struct Influence {
  Index joint = 0;
  double weight = 0.0;  // 0: nothing, and then joint is 0
};

struct Rig {
  std::vector<RigJoint> joints;  // parents before their children
  // Per vertex, the strongest first; they sum to 1. An isolated vertex follows the root.
  std::vector<std::array<Influence, 4>> influences;
  std::vector<std::array<Index, 2>> cut;  // edges of the skeleton left out, one for each of its cycles
};

// Turns the joint, and what hangs on it, by `angle` degrees round `axis` (model axes, any length but 0).
struct JointTurn {
  Index joint = kNone;
  Vector3 axis = Vector3::UnitZ();
  double angle = 0.0;
};

// Where each joint is and how it is turned.
struct JointPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // in model axes
  Vector3 position = Vector3::Zero();
};

// Throws UsageError for a joint that is not there or an axis of length 0. O(joints + turns).
std::vector<JointPose> pose_joints(const Rig& rig, const std::vector<JointTurn>& turns);

// Linear blend skinning. One point a vertex, model coordinates. Throws UsageError if there are not as many
// points as the rig has vertices. O(vertices).
std::vector<Vector3> bend(const Rig& rig, const std::vector<Vector3>& points,
                          const std::vector<JointTurn>& turns);

// "NAME=AXIS,ANGLE", where AXIS is x, y, z or three numbers with commas and ANGLE is in degrees. Throws
// UsageError that says what is wrong; the nearest is listed where there is no such joint.
JointTurn parse_joint_turn(const Rig& rig, const std::string& text);

}  // namespace mspskel
