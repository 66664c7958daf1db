#include "mspskel/rig/rig.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

double number(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw UsageError("pose " + whole + ": '" + text + "' is not a number; NAME=AXIS,ANGLE is wanted");
  return value;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> words{""};
  for (const char c : text)
    if (c == at)
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

}  // namespace

std::vector<JointPose> pose_joints(const Rig& rig, const std::vector<JointTurn>& turns) {
  std::vector<Eigen::Matrix3d> own(rig.joints.size(), Eigen::Matrix3d::Identity());
  for (const JointTurn& turn : turns) {
    if (turn.joint < 0 || turn.joint >= static_cast<Index>(rig.joints.size()))
      throw UsageError("pose: there is no joint " + std::to_string(turn.joint));
    if (!(turn.axis.norm() > 0)) throw UsageError("pose: an axis has no length");
    own[turn.joint] = Eigen::AngleAxisd(turn.angle * kPi / 180, turn.axis.normalized()).toRotationMatrix() *
                      own[turn.joint];
  }
  std::vector<JointPose> poses;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const RigJoint& joint = rig.joints[j];
    JointPose pose{own[j], joint.position};
    if (joint.parent != kNone) {
      const JointPose& above = poses[joint.parent];
      pose.rotation = above.rotation * own[j];
      pose.position = above.position + above.rotation * (joint.position - rig.joints[joint.parent].position);
    }
    poses.push_back(pose);
  }
  return poses;
}

std::vector<Vector3> bend(const Rig& rig, const std::vector<Vector3>& points,
                          const std::vector<JointTurn>& turns) {
  if (points.size() != rig.influences.size())
    throw UsageError("the rig has " + std::to_string(rig.influences.size()) + " vertices, the surface " +
                     std::to_string(points.size()));
  const std::vector<JointPose> poses = pose_joints(rig, turns);
  std::vector<Vector3> bent(points.size(), Vector3::Zero());
  for (std::size_t v = 0; v < points.size(); ++v)
    for (const auto& [joint, weight] : rig.influences[v])
      if (weight > 0)
        bent[v] += weight *
                   (poses[joint].position + poses[joint].rotation * (points[v] - rig.joints[joint].position));
  return bent;
}

JointTurn parse_joint_turn(const Rig& rig, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw UsageError("pose " + text + ": NAME=AXIS,ANGLE is wanted");
  const std::string name = text.substr(0, equals);
  JointTurn turn;
  for (std::size_t j = 0; j < rig.joints.size(); ++j)
    if (rig.joints[j].name == name) turn.joint = static_cast<Index>(j);
  if (turn.joint == kNone) {
    std::string known;
    for (const RigJoint& joint : rig.joints) known += ' ' + joint.name;
    throw UsageError("pose " + text + ": there is no joint " + name + "; there are" + known);
  }
  const std::vector<std::string> words = split(text.substr(equals + 1), ',');
  if (words.size() == 2 && (words[0] == "x" || words[0] == "y" || words[0] == "z"))
    turn.axis = Vector3::Unit(words[0][0] - 'x');
  else if (words.size() == 4)
    turn.axis = {number(words[0], text), number(words[1], text), number(words[2], text)};
  else
    throw UsageError("pose " + text + ": the axis is x, y, z or three numbers, then comes the angle");
  if (!(turn.axis.norm() > 0)) throw UsageError("pose " + text + ": the axis has no length");
  turn.angle = number(words.back(), text);
  return turn;
}

}  // namespace mspskel
