#include "thing_kin/model/urdf.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/urdf_excerpt.hpp"
#include "thing_kin/model/urdf_tree.hpp"

namespace thing_kin {

namespace {

constexpr std::size_t kLongestPath = 1000;  // urdfdom frees its tree by recursion
constexpr double kFarthest = 1e50;          // m; beyond, products of a few overflow

[[noreturn]] void refuse(const std::string& joint, const std::string& what,
                         const std::string& expected) {
  throw InvalidArgument("source", std::string("joint ").append(quoted(joint)).append(what),
                        expected);
}

// --- What urdfdom has to say goes into the exception, not to stderr. ---

// console_bridge has one handler for the whole process. Ours takes what is said in a thread that
// is in parse() and passes on the rest; it is never destroyed, for somebody may have kept it.
class Listener final : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char* file,
           int line) override {
    if (heard == nullptr) {
      if (console_bridge::OutputHandler* const other = previous) {
        other->log(text, level, file, line);
      }
    } else if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      heard->append(heard->empty() ? "" : "; ").append(shortened(text, 1000));
    }
  }

  std::atomic<console_bridge::OutputHandler*> previous = nullptr;
  static thread_local std::string* heard;
};

thread_local std::string* Listener::heard = nullptr;

class Listening {
 public:
  explicit Listening(std::string& heard) : lock_(mutex()) {
    Listener::heard = &heard;
    console_bridge::OutputHandler* const current = console_bridge::getOutputHandler();
    if (current != &listener()) {
      listener().previous = current;
    }
    console_bridge::useOutputHandler(&listener());
  }
  ~Listening() {
    if (console_bridge::getOutputHandler() == &listener()) {
      console_bridge::useOutputHandler(listener().previous);
    }
    Listener::heard = nullptr;
  }
  Listening(const Listening&) = delete;
  Listening(Listening&&) = delete;
  Listening& operator=(const Listening&) = delete;
  Listening& operator=(Listening&&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static Listener& listener() {
    static auto* const listener = new Listener;
    return *listener;
  }

  std::scoped_lock<std::mutex> lock_;
};

urdf::ModelInterfaceSharedPtr parse(const std::string& text) {
  std::string heard;
  urdf::ModelInterfaceSharedPtr model;
  {
    const Listening listening(heard);
    model = urdf::parseURDF(text);
  }
  if (!model) {
    throw InvalidArgument("source", "what urdfdom refuses: " + heard, "a URDF");
  }
  return model;
}

// --- From urdfdom's joints to segments ---

// Rounding of a right angle's sine and cosine off.
Eigen::Matrix3d with_exact_right_angles(const Eigen::Matrix3d& R) {
  return R.unaryExpr([](double x) {
    const double whole = std::round(x);
    return std::abs(x - whole) <= kRightAngleTolerance ? whole + 0.0 : x;
  });
}

SE3 origin_of(const urdf::Joint& joint) {
  const urdf::Pose& pose = joint.parent_to_joint_origin_transform;
  const Eigen::Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const Eigen::Vector4d wxyz(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  if (!wxyz.allFinite() || !p.allFinite() || p.cwiseAbs().maxCoeff() > kFarthest) {
    refuse(joint.name, " with an origin that is too far or not finite", "numbers up to 1e50");
  }
  return {with_exact_right_angles(rotation_from_quaternion(wxyz)), p};
}

Eigen::Vector3d axis_of(const urdf::Joint& joint) {
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  const double largest = axis.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) {
    refuse(joint.name, " with a zero axis", "an axis with a direction");
  }
  return (axis / largest).normalized();
}

// A rotation whose third column is the axis, right-angled for axes along x, y or z: Duff et al.,
// Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& axis) {
  const double sign = std::copysign(1.0, axis.z());
  const double a = -1.0 / (sign + axis.z());
  const double b = axis.x() * axis.y() * a;
  Eigen::Matrix3d R;
  R.col(0) << 1.0 + sign * axis.x() * axis.x() * a, sign * b, -sign * axis.x();
  R.col(1) << b, sign + axis.y() * axis.y() * a, -axis.y();
  R.col(2) = axis;
  return with_exact_right_angles(R);
}

JointType type_of(const urdf::Joint& joint) {
  constexpr const char* kExpected = "revolute, continuous, prismatic or fixed joints on the chain";
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    case urdf::Joint::FIXED:
      return JointType::kFixed;
    case urdf::Joint::PLANAR:
      refuse(joint.name, ", which is planar", kExpected);
    case urdf::Joint::FLOATING:
      refuse(joint.name, ", which is floating", kExpected);
    default:
      refuse(joint.name, " of unknown type", kExpected);
  }
}

double or_infinity(double limit) {
  const bool largest = std::abs(limit) == std::numeric_limits<double>::max();
  return largest ? std::copysign(HUGE_VAL, limit) : limit;
}

JointLimits limits_of(const urdf::Joint& joint, JointType type) {
  JointLimits limits;
  if (!joint.limits) {
    return limits;
  }
  if (joint.limits->velocity > 0.0) {
    limits.velocity = or_infinity(joint.limits->velocity);
  }
  if (type != JointType::kContinuous) {
    limits.lower = or_infinity(joint.limits->lower);
    limits.upper = or_infinity(joint.limits->upper);
    if (limits.lower > limits.upper) {
      refuse(joint.name,
             " with lower = " + text(limits.lower) + " and upper = " + text(limits.upper),
             "lower <= upper");
    }
  }
  return limits;
}

// Downwards T(q) = origin Rz'(q), where z' is the axis; upwards the inverse, which is a joint about
// the opposite axis and then the origin's inverse.
Segment segment_of(const urdf::Joint& joint, const UrdfStep& step) {
  const SE3 origin = origin_of(joint);
  Segment segment;
  segment.frame = step.upwards ? step.joint->parent : step.joint->child;
  segment.type = type_of(joint);
  if (segment.type == JointType::kFixed) {
    segment.after = step.upwards ? origin.inverse() : origin;
    return segment;
  }
  const Eigen::Vector3d axis = axis_of(joint);
  const SE3 to_z{frame_along(step.upwards ? -axis : axis), Eigen::Vector3d::Zero()};
  segment.joint = joint.name;
  segment.limits = limits_of(joint, segment.type);
  segment.before = step.upwards ? to_z : origin * to_z;
  segment.after = step.upwards ? to_z.inverse() * origin.inverse() : to_z.inverse();
  segment.before.rotation = with_exact_right_angles(segment.before.rotation);
  segment.after.rotation = with_exact_right_angles(segment.after.rotation);
  return segment;
}

void check_path(const UrdfPath& path) {
  if (path.steps.size() > kLongestPath) {
    throw InvalidArgument("source", std::to_string(path.steps.size()) + " joints in a row",
                          "at most " + std::to_string(kLongestPath));
  }
  for (const UrdfStep& step : path.steps) {
    if (step.joint->elements.contains("mimic")) {
      refuse(step.joint->name, ", which mimics another", "joints that move by themselves");
    }
  }
}

// How many joints of the chain move, if that is a number that a chain may have.
std::size_t count_joints(const ChainDescription& description, const UrdfPath& path) {
  const auto joints = std::ranges::count_if(description.segments, [](const Segment& segment) {
    return segment.type != JointType::kFixed;
  });
  if (joints == 0 || joints > kMaxDof) {
    throw InvalidArgument("source",
                          std::to_string(joints)
                              .append(" moving joints between ")
                              .append(quoted(path.base))
                              .append(" and ")
                              .append(quoted(path.tip)),
                          "1 to " + std::to_string(kMaxDof));
  }
  return static_cast<std::size_t>(joints);
}

}  // namespace

Chain from_urdf(std::string_view text, const UrdfOptions& options) {
  const UrdfDocument document = read_urdf_document(text, options.is_utf8);
  const UrdfPath path = find_urdf_path(document, options.base, options.tip);
  check_path(path);
  ChainDescription description;
  description.root = path.base;
  if (!path.steps.empty()) {
    std::vector<const UrdfJoint*> joints;
    joints.reserve(path.steps.size());
    for (const UrdfStep& step : path.steps) {
      joints.push_back(step.joint);
    }
    const urdf::ModelInterfaceSharedPtr model = parse(write_urdf_excerpt(document, joints));
    description.name = options.name.empty() ? model->getName() : options.name;
    for (const UrdfStep& step : path.steps) {
      description.segments.push_back(segment_of(*model->getJoint(step.joint->name), step));
    }
  }
  description.order.resize(count_joints(description, path));
  std::iota(description.order.begin(), description.order.end(), 0);
  return Chain(std::move(description));
}

Chain from_urdf_file(const std::string& path, const UrdfOptions& options,
                     const PackageFolders& packages) {
  return from_urdf(read_urdf_file(resolve_urdf_path(path, packages)), options);
}

}  // namespace thing_kin
