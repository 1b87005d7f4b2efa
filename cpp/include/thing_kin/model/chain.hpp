#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "thing_kin/core/types.hpp"
#include "thing_kin/model/chain_description.hpp"
#include "thing_kin/model/dh.hpp"
#include "thing_kin/model/skeleton.hpp"

namespace thing_kin {

/// An immutable serial chain: what every algorithm reads, and all threads share.
///
/// Fixed segments are folded away: at run time the chain is joints about or along z, with a
/// constant transform between neighbours, and frames that hang off them.
class Chain {
 public:
  /// A joint as the kinematics sees it, from the root outwards.
  struct Joint {
    SE3 fixed;  ///< from the previous joint's moved frame (or the root) to this joint's frame
    JointType type = JointType::kRevolute;
    int index = 0;  ///< its place in q
  };

  /// A named frame: `offset` from the moved frame of joint `joints - 1` (or the root).
  struct Frame {
    std::string name;
    int joints = 0;
    SE3 offset;
  };

  /// Throws InvalidArgument: no joint, too many, equal names, limits out of order, a bad order.
  explicit Chain(ChainDescription description);

  static Chain from_dh(std::span<const DhRow> rows, std::string name = "chain");

  const std::string& name() const { return description_.name; }
  int dof() const { return static_cast<int>(joints_.size()); }
  const ChainDescription& description() const { return description_; }

  std::span<const Joint> joints() const { return joints_; }
  std::span<const Frame> frames() const { return frames_; }

  /// Joints and frames once more, as the kinematics kernels read them.
  const Skeleton& skeleton() const { return skeleton_; }
  const SkeletonFrame& skeleton_frame(int frame) const {
    return skeleton_frames_[static_cast<std::size_t>(frame)];
  }

  /// In the order of q.
  const std::vector<std::string>& joint_names() const { return joint_names_; }
  const std::vector<JointType>& joint_types() const { return joint_types_; }
  const JointVector& lower() const { return lower_; }
  const JointVector& upper() const { return upper_; }
  const JointVector& velocity_limits() const { return velocity_limits_; }
  const JointVector& acceleration_limits() const { return acceleration_limits_; }

  /// The last frame.
  int tool() const { return static_cast<int>(frames_.size()) - 1; }

  /// Index of a frame by name; throws InvalidArgument, naming `argument`, if there is none.
  int frame_index(const std::string& name, const std::string& argument = "frame") const;

  /// Places in q of x, y and theta of an omnidirectional base, if the chain stands on one.
  const std::optional<std::array<int, 3>>& base_joints() const { return base_joints_; }

  /// The same chain with a further fixed frame at its end.
  Chain with_tool(const SE3& tool, const std::string& frame = "tool") const;

  /// The same chain with other limits, one a joint in the order of q.
  Chain with_limits(std::span<const JointLimits> limits) const;
  std::vector<JointLimits> limits() const;

  bool operator==(const Chain& other) const { return description_ == other.description_; }

 private:
  void fold();
  void collect_joints();

  ChainDescription description_;
  std::vector<Joint> joints_;
  std::vector<Frame> frames_;
  Skeleton skeleton_;
  std::vector<SkeletonFrame> skeleton_frames_;
  std::vector<std::string> joint_names_;
  std::vector<JointType> joint_types_;
  JointVector lower_, upper_, velocity_limits_, acceleration_limits_;
  std::optional<std::array<int, 3>> base_joints_;
};

/// The chain as a readable table of joints, types and limits.
std::string to_table(const Chain& chain);

}  // namespace thing_kin
