#include "thing_kin/estimation/calibration_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

using Part = CalibrationPart;

// What an arm may be off by: where the data say less, the nominal value is kept.
constexpr double kPlausibleLength = 0.02;      // m
constexpr double kPlausibleAngle = 0.05;       // rad
constexpr double kPlausibleScale = 0.05;       // of the reading
constexpr double kPlausibleCompliance = 1e-3;  // rad for each N m, m for each N
constexpr double kAnywhere = 10.0;             // m, rad: base, tool and points stand anywhere
constexpr double kParallel = 0.1;              // sine of alpha: the next axis is nearly parallel

constexpr std::array<const char*, 6> kAxes{"x", "y", "z", "rx", "ry", "rz"};
constexpr std::array<const char*, 9> kGroups{
    "base", "tool", "joint_offsets", "joint_scales", "sag", "dh", "mount", "origins", "points"};

std::string indexed(const char* group, int i) {
  return std::string(group).append("[").append(std::to_string(i)).append("]");
}

// Whether `name` is `request` or a part of what it names.
bool is_part_of(const std::string& name, const std::string& request) {
  return name.starts_with(request) && (name.size() == request.size() ||
                                       name[request.size()] == '.' || name[request.size()] == '[');
}

class Candidates {
 public:
  Candidates(const Chain& chain, const CalibrationRequest& request) {
    pose("base", Part::kBase, {}, kAnywhere);
    pose("tool", Part::kTool, {}, kAnywhere);
    collect_joints(chain);
    for (const Joint& joint : joints_) {
      number(indexed("joint_offsets", joint.index), Part::kOffset, joint,
             joint.is_rotary ? kPlausibleAngle : kPlausibleLength);
    }
    for (const Joint& joint : joints_) {
      number(indexed("joint_scales", joint.index), Part::kScale, joint, kPlausibleScale);
    }
    for (const Joint& joint : joints_) {
      if (std::ranges::find(request.sagging, joint.index) != request.sagging.end()) {
        number(indexed("sag", joint.index), Part::kSag, joint, kPlausibleCompliance);
      }
    }
    collect_rows(chain);
    if (chain.base_joints() && !joints_.empty()) {
      pose("mount", Part::kOrigin, joints_.front(), kPlausibleLength);
    }
    for (const Joint& joint : joints_) {
      pose(indexed("origins", joint.index), Part::kOrigin, joint, kPlausibleLength);
    }
    for (int i = 0; i < request.points; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        all.push_back(
            {indexed("points", i).append(".").append(kAxes[static_cast<std::size_t>(axis)]),
             Part::kPoint, i, 0, axis, false, false, kAnywhere});
      }
    }
  }

  std::vector<CalibrationParameter> all;
  bool has_rows = false;

 private:
  struct Joint {
    int segment = 0;
    int index = 0;
    bool is_rotary = true;
  };

  void collect_joints(const Chain& chain) {
    const ChainDescription& description = chain.description();
    std::size_t number = 0;
    for (std::size_t s = 0; s < description.segments.size(); ++s) {
      const Segment& segment = description.segments[s];
      if (segment.type == JointType::kFixed) {
        continue;
      }
      if (!chain.base_joints() || number >= 3) {
        joints_.push_back(
            {static_cast<int>(s), description.order[number], is_rotary(segment.type)});
      }
      ++number;
    }
  }

  void collect_rows(const Chain& chain) {
    has_rows = std::ranges::all_of(joints_, [&](const Joint& joint) {
      return dh_form(chain.description().segments[static_cast<std::size_t>(joint.segment)])
          .has_value();
    });
    if (!has_rows) {
      return;
    }
    for (const Joint& joint : joints_) {
      const std::string row = indexed("dh", joint.index);
      number(row + ".d", Part::kD, joint, kPlausibleLength);
      number(row + ".theta", Part::kTheta, joint, kPlausibleAngle);
      number(row + ".a", Part::kA, joint, kPlausibleLength);
      number(row + ".alpha", Part::kAlpha, joint, kPlausibleAngle);
      const auto& segment = chain.description().segments[static_cast<std::size_t>(joint.segment)];
      const bool is_last = joint.segment == joints_.back().segment;
      if (!is_last && std::abs(std::sin(dh_form(segment)->alpha)) < kParallel) {
        number(row + ".beta", Part::kBeta, joint, kPlausibleAngle);
      }
    }
  }

  void number(const std::string& name, Part part, const Joint& joint, double deviation) {
    const bool is_angle = part == Part::kTheta || part == Part::kAlpha || part == Part::kBeta ||
                          (part == Part::kOffset && joint.is_rotary);
    all.push_back({name, part, joint.segment, joint.index, 0, is_angle, false, deviation});
  }

  void pose(const std::string& name, Part part, const Joint& joint, double deviation) {
    for (int axis = 0; axis < 6; ++axis) {
      const double turn = deviation == kPlausibleLength ? kPlausibleAngle : deviation;
      all.push_back({std::string(name).append(".").append(kAxes[static_cast<std::size_t>(axis)]),
                     part, joint.segment, joint.index, axis, axis >= 3, false,
                     axis < 3 ? deviation : turn});
    }
  }

  std::vector<Joint> joints_;
};

std::string meant(const std::string& name, bool has_rows) {
  return name == "links" ? std::string(has_rows ? "dh" : "origins") : name;
}

// Which candidates a list of names asks for.
std::vector<bool> chosen_of(const Candidates& candidates, const std::vector<std::string>& names) {
  std::vector<bool> chosen(candidates.all.size(), false);
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (is_part_of(candidates.all[i].name, meant(name, candidates.has_rows))) {
        chosen[i] = true;
        found = true;
      }
    }
    if (!found) {
      std::string known("a parameter of this chain or one of the groups 'links'");
      for (const char* group : kGroups) {
        known.append(", ").append(quoted(group));
      }
      throw InvalidArgument("parameters", quoted(shortened(name, 60)), known);
    }
  }
  return chosen;
}

void read_priors(Candidates& candidates, const std::map<std::string, double>& priors) {
  for (const auto& [name, deviation] : priors) {
    bool found = false;
    if (!(deviation >= 0.0)) {
      throw InvalidArgument("priors", std::string(name).append(": ").append(text(deviation)),
                            "standard deviations >= 0");
    }
    for (CalibrationParameter& parameter : candidates.all) {
      if (is_part_of(parameter.name, meant(name, candidates.has_rows))) {
        found = true;
        parameter.has_prior = std::isfinite(deviation);
        parameter.deviation = parameter.has_prior ? deviation : parameter.deviation;
      }
    }
    if (!found) {
      throw InvalidArgument("priors", quoted(shortened(name, 60)), "names of parameters or groups");
    }
  }
}

// A joint's offset and its row's own theta or d, and the mount and the first joint's origin.
bool is_same_number(const Chain& chain, const CalibrationParameter& a,
                    const CalibrationParameter& b) {
  if (a.part == Part::kOffset && (b.part == Part::kTheta || b.part == Part::kD)) {
    const bool turns = is_rotary(chain.joint_types()[static_cast<std::size_t>(b.joint)]);
    return a.joint == b.joint && b.part == (turns ? Part::kTheta : Part::kD);
  }
  return a.part == Part::kOrigin && b.part == Part::kOrigin && a.place == b.place &&
         a.axis == b.axis;
}

}  // namespace

std::optional<DhForm> dh_form(const Segment& segment) {
  constexpr double kRounding = 1e-12;
  const Eigen::Matrix3d& R = segment.after.rotation;
  const Eigen::Vector3d& t = segment.after.translation;
  if (!(segment.before == SE3{}) || std::abs(R(2, 0)) > kRounding ||
      std::abs(R(0, 0) * t.y() - R(1, 0) * t.x()) > kRounding) {
    return std::nullopt;
  }
  return DhForm{t.z(), std::atan2(R(1, 0), R(0, 0)), R(0, 0) * t.x() + R(1, 0) * t.y(),
                std::atan2(R(2, 1), R(2, 2))};
}

std::vector<CalibrationParameter> calibration_parameters(const Chain& chain,
                                                         const CalibrationRequest& request) {
  Candidates candidates(chain, request);
  read_priors(candidates, request.priors);
  const std::vector<bool> chosen = chosen_of(candidates, request.parameters);
  std::vector<CalibrationParameter> parameters;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const CalibrationParameter& parameter = candidates.all[i];
    if (!chosen[i] || parameter.deviation == 0.0) {
      continue;
    }
    const bool is_told = std::ranges::any_of(parameters, [&](const CalibrationParameter& other) {
      return is_same_number(chain, other, parameter);
    });
    if (!is_told) {
      parameters.push_back(parameter);
    }
  }
  return parameters;
}

}  // namespace thing_kin
