#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// What a number of a calibration belongs to.
enum class CalibrationPart : std::uint8_t {
  kBase,    ///< T_world_root = base E: moves and turns in the root's own axes
  kTool,    ///< T_last_tool = E tool: moves and turns in the last frame's axes
  kOffset,  ///< added to the joint's reading
  kScale,   ///< of the joint's reading, less one
  kSag,     ///< compliance of a joint: what gravity turns it by, for each unit of torque
  kD,
  kTheta,
  kA,
  kAlpha,
  kBeta,    ///< Hayati and Mirmirani 1985: Ry(beta) after the row, where the next axis is parallel
  kOrigin,  ///< E before the joint: a URDF origin's xyz, then a rotation vector
  kPoint,   ///< a measured point in the tool
};

/// One number that is estimated: a difference from its nominal value.
struct CalibrationParameter {
  std::string name;  ///< "joint_offsets[2]", "dh[1].alpha", "base.x", ...
  CalibrationPart part = CalibrationPart::kOffset;
  int place = 0;  ///< index of the segment, or of the point
  int joint = 0;  ///< its joint's place in q
  int axis = 0;   ///< of kBase, kTool, kOrigin and kPoint: x, y, z, then turns about them
  bool is_angle = false;
  bool has_prior = false;   ///< the caller's: `deviation` is knowledge
  double deviation = 1e-2;  ///< standard deviation before: the caller's, or a plausible one
};

/// The numbers a, d, theta and alpha of [M17] (3.7) that make up a constant transform, if it is
/// of that form.
struct DhForm {
  double d = 0.0, theta = 0.0, a = 0.0, alpha = 0.0;
};
std::optional<DhForm> dh_form(const Segment& segment);

struct CalibrationRequest {
  std::vector<std::string> parameters;   ///< names or groups: "base", "dh[1]", "dh[1].a"
  std::map<std::string, double> priors;  ///< deviations by the same kind of names; 0: held
  int points = 0;                        ///< how many points of the tool are measured
  std::vector<int> sagging;              ///< joints, in the order of q
};

/// The numbers to be estimated, in the order base, tool, joint_offsets, joint_scales, sag, dh,
/// mount, origins, points. "links" means "dh" where the chain was made of Denavit-Hartenberg rows,
/// else "origins". Joints of an omnidirectional base have none; "mount" is the place of the arm on
/// it. A joint's offset and its row's own theta (or d, where it slides) are one number: the second
/// is left out. Throws InvalidArgument for a name that is none.
std::vector<CalibrationParameter> calibration_parameters(const Chain& chain,
                                                         const CalibrationRequest& request);

}  // namespace thing_kin
