#include "thing_kin/model/chain.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>
#include <sstream>

#include "make_skeleton.hpp"
#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

void check_unique(const std::vector<std::string>& names, const char* argument) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (name.empty() || !seen.insert(name).second) {
      throw InvalidArgument(argument, quoted(name).append(name.empty() ? "" : " twice"),
                            "unique names");
    }
  }
}

bool is_permutation_of_indices(std::vector<int> order, std::size_t n) {
  std::ranges::sort(order);
  std::vector<int> indices(n);
  std::iota(indices.begin(), indices.end(), 0);
  return order == indices;
}

// `name`, or name2, name3, ... if it is taken.
std::string free_frame_name(const std::vector<Chain::Frame>& frames, const std::string& name) {
  std::string candidate = name;
  const auto is_candidate = [&](const Chain::Frame& frame) { return frame.name == candidate; };
  for (int i = 2; std::ranges::any_of(frames, is_candidate); ++i) {
    candidate = std::string(name).append(std::to_string(i));
  }
  return candidate;
}

// Where a joint's own name or frame is not given, they are numbered: q0, q1, ... and frame1, ...
std::vector<Segment> segments_of(std::span<const DhRow> rows) {
  std::vector<Segment> segments;
  int joint = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check(rows[i]);
    Segment segment = to_segment(rows[i]);
    if (segment.type != JointType::kFixed) {
      const std::string numbered = std::string("q").append(std::to_string(joint++));
      segment.joint = segment.joint.empty() ? numbered : segment.joint;
    }
    if (segment.frame.empty()) {
      segment.frame = i + 1 == rows.size() ? std::string("tool")
                                           : std::string("frame").append(std::to_string(i + 1));
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

}  // namespace

Chain Chain::from_dh(std::span<const DhRow> rows, std::string name) {
  if (rows.empty()) {
    throw InvalidArgument("rows", "no row", "at least one Denavit-Hartenberg row");
  }
  ChainDescription description;
  description.name = std::move(name);
  description.segments = segments_of(rows);
  const auto joints = std::count_if(description.segments.begin(), description.segments.end(),
                                    [](const Segment& s) { return s.type != JointType::kFixed; });
  description.order.resize(static_cast<std::size_t>(joints));
  std::iota(description.order.begin(), description.order.end(), 0);
  return Chain(std::move(description));
}

Chain::Chain(ChainDescription description) : description_(std::move(description)) {
  fold();
  if (joints_.empty() || joints_.size() > static_cast<std::size_t>(kMaxDof)) {
    throw InvalidArgument("rows", std::to_string(joints_.size()) + " joints",
                          "1 to " + std::to_string(kMaxDof) + " joints");
  }
  if (!is_permutation_of_indices(description_.order, joints_.size())) {
    throw InvalidArgument("order", std::to_string(description_.order.size()) + " indices",
                          "each of 0 ... n - 1 once");
  }
  collect_joints();
  skeleton_ = make_skeleton(joints_);
  for (const Frame& frame : frames_) {
    skeleton_frames_.push_back(make_skeleton_frame(joints_, frame));
  }
}

void Chain::fold() {
  frames_.push_back({description_.root, 0, SE3{}});
  SE3 since_joint;
  for (const Segment& segment : description_.segments) {
    if (segment.type != JointType::kFixed) {
      joints_.push_back({since_joint * segment.before, segment.type, 0});
      since_joint = segment.after;
    } else {
      since_joint = since_joint * segment.before * segment.after;
    }
    frames_.push_back({segment.frame, static_cast<int>(joints_.size()), since_joint});
  }
}

void Chain::collect_joints() {
  const std::size_t n = joints_.size();
  joint_names_.resize(n);
  joint_types_.resize(n);
  for (JointVector* limit : {&lower_, &upper_, &velocity_limits_, &acceleration_limits_}) {
    limit->resize(static_cast<Eigen::Index>(n));
  }
  std::size_t i = 0;
  for (const Segment& segment : description_.segments) {
    if (segment.type == JointType::kFixed) {
      continue;
    }
    check(segment.type, segment.limits);
    const int index = description_.order[i];
    joints_[i].index = index;
    joint_names_[static_cast<std::size_t>(index)] = segment.joint;
    joint_types_[static_cast<std::size_t>(index)] = segment.type;
    lower_[index] = segment.limits.lower;
    upper_[index] = segment.limits.upper;
    velocity_limits_[index] = segment.limits.velocity;
    acceleration_limits_[index] = segment.limits.acceleration;
    ++i;
  }
  check_unique(joint_names_, "joint names");
  std::vector<std::string> frame_names;
  frame_names.reserve(frames_.size());
  for (const Frame& frame : frames_) {
    frame_names.push_back(frame.name);
  }
  check_unique(frame_names, "frame names");
  if (description_.has_omni_base) {
    base_joints_ = {joints_[0].index, joints_[1].index, joints_[2].index};
  }
}

int Chain::frame_index(const std::string& name, const std::string& argument) const {
  const auto found = std::ranges::find(frames_, name, &Frame::name);
  if (found != frames_.end()) {
    return static_cast<int>(found - frames_.begin());
  }
  std::string known;
  for (const auto& frame : frames_) {
    known.append(known.empty() ? "" : ", ").append(quoted(frame.name));
  }
  throw InvalidArgument(argument, quoted(name), "one of " + known);
}

Chain Chain::with_tool(const SE3& tool, const std::string& frame) const {
  ChainDescription description = description_;
  Segment& last = description.segments.back();
  if (last.frame == frame) {  // the name moves on to the new end of the chain
    last.frame = free_frame_name(frames_, "flange");
  }
  description.segments.push_back({frame, "", JointType::kFixed, SE3{}, tool, {}});
  return Chain(std::move(description));
}

std::vector<JointLimits> Chain::limits() const {
  std::vector<JointLimits> limits;
  limits.reserve(joints_.size());
  for (int i = 0; i < dof(); ++i) {
    limits.push_back({lower_[i], upper_[i], velocity_limits_[i], acceleration_limits_[i]});
  }
  return limits;
}

Chain Chain::with_limits(std::span<const JointLimits> limits) const {
  ChainDescription description = description_;
  std::size_t i = 0;
  for (Segment& segment : description.segments) {
    if (segment.type != JointType::kFixed) {
      segment.limits = limits[static_cast<std::size_t>(description.order[i++])];
    }
  }
  return Chain(std::move(description));
}

std::string to_table(const Chain& chain) {
  std::ostringstream out;
  char line[128];
  out << chain.name() << ": " << chain.dof() << " joints, " << chain.frames().size() << " frames ("
      << chain.frames().front().name << " ... " << chain.frames().back().name << ")\n";
  std::snprintf(line, sizeof line, "%3s  %-20s %-10s %10s %10s %10s %13s  %s\n", "", "joint",
                "type", "lower", "upper", "velocity", "acceleration", "unit");
  out << line;
  for (int i = 0; i < chain.dof(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const JointType type = chain.joint_types()[k];
    std::snprintf(line, sizeof line, "%3d  %-20.40s %-10s %10.4g %10.4g %10.4g %13.4g  %s\n", i,
                  chain.joint_names()[k].c_str(), to_string(type), chain.lower()[i],
                  chain.upper()[i], chain.velocity_limits()[i], chain.acceleration_limits()[i],
                  is_rotary(type) ? "rad" : "m");
    out << line;
  }
  std::string table = out.str();
  table.pop_back();  // the last end of line
  return table;
}

}  // namespace thing_kin
