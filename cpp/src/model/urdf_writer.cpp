#include "thing_kin/model/urdf_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/tolerance.hpp"
#include "thing_kin/lie/so3.hpp"
#include "thing_kin/model/xml_text.hpp"

namespace thing_kin {

namespace {

// Shortest decimals that give the double back, whatever the locale.
std::string number(double value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  char digits[32];
  const double finite = std::clamp(value, -kLargest, kLargest) + 0.0;  // and no -0
  const auto result = std::to_chars(digits, digits + sizeof digits, finite);
  return {digits, result.ptr};
}

std::string numbers(const Eigen::Vector3d& v) {
  return number(v.x()).append(" ").append(number(v.y())).append(" ").append(number(v.z()));
}

// Control characters, and U+FFFE and U+FFFF, have no place in XML, not even escaped.
bool is_xml_text(const std::string& name) {
  const auto is_bad = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
  };
  return std::ranges::none_of(name, is_bad) && name.find("\xEF\xBF\xBE") == std::string::npos &&
         name.find("\xEF\xBF\xBF") == std::string::npos;
}

// An attribute's value, quotes included.
std::string attribute(const std::string& value) {
  if (!is_xml_text(value)) {
    throw InvalidArgument("chain", "a name with characters that XML has not", "names without them");
  }
  return std::string(1, '"').append(xml_escaped(value)).append("\"");
}

class Writer {
 public:
  Writer(const Chain& chain, const std::string& name) : parent_(chain.description().root) {
    for (const Chain::Frame& frame : chain.frames()) {
      links_.insert(frame.name);
    }
    joints_.insert(chain.joint_names().begin(), chain.joint_names().end());
    text_.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=");
    text_.append(attribute(name)).append(">\n");
    link(parent_);
    for (const Segment& segment : chain.description().segments) {
      write(segment);
    }
    text_.append("</robot>\n");
  }

  const std::string& text() const { return text_; }

 private:
  // parent * before * joint(q) * after. Where after's origin is on the joint's axis, it changes
  // places with the joint, whose axis is then z as the new frame sees it.
  void write(const Segment& segment) {
    if (segment.type == JointType::kFixed) {
      fixed(segment.frame, segment.before * segment.after);
      return;
    }
    const Eigen::Vector3d& offset = segment.after.translation;
    const bool on_axis = offset.x() == 0.0 && offset.y() == 0.0;
    if (on_axis || segment.type == JointType::kPrismatic) {
      const Eigen::Vector3d axis = segment.after.rotation.row(2);
      moving(segment, segment.frame, segment.before * segment.after, axis);
      return;
    }
    moving(segment, unused(links_, segment.frame + "_joint"), segment.before,
           Eigen::Vector3d::UnitZ());
    fixed(segment.frame, segment.after);
  }

  void moving(const Segment& segment, const std::string& child, const SE3& origin,
              const Eigen::Vector3d& axis) {
    const JointLimits& limits = segment.limits;
    const bool limited = std::isfinite(limits.lower) || std::isfinite(limits.upper);
    const bool continuous = is_rotary(segment.type) && !limited;
    open_joint(segment.joint, continuous ? "continuous" : to_string(segment.type), child, origin);
    text_.append("    <axis xyz=\"").append(numbers(axis)).append("\"/>\n    <limit");
    if (!continuous) {
      text_.append(" lower=\"").append(number(limits.lower));
      text_.append("\" upper=\"").append(number(limits.upper)).append("\"");
    }
    text_.append(" velocity=\"").append(number(limits.velocity)).append("\" effort=\"");
    text_.append(number(std::numeric_limits<double>::infinity())).append("\"/>\n  </joint>\n");
  }

  void fixed(const std::string& child, const SE3& origin) {
    open_joint(unused(joints_, child + "_fixed"), "fixed", child, origin);
    text_.append("  </joint>\n");
  }

  void open_joint(const std::string& name, const char* type, const std::string& child,
                  const SE3& origin) {
    link(child);
    text_.append("  <joint name=").append(attribute(name));
    text_.append(" type=\"").append(type).append("\">\n    <parent link=");
    text_.append(attribute(parent_)).append("/>\n    <child link=").append(attribute(child));
    text_.append("/>\n    <origin xyz=\"").append(numbers(origin.translation));
    text_.append("\" rpy=\"").append(numbers(rpy_from_rotation(origin.rotation)));
    text_.append("\"/>\n");
    parent_ = child;
  }

  void link(const std::string& name) {
    text_.append("  <link name=").append(attribute(name)).append("/>\n");
  }

  // `name`, or name2, name3, ... if it is taken; it is taken then.
  static std::string unused(std::set<std::string>& names, const std::string& name) {
    std::string candidate = name;
    for (int i = 2; !names.insert(candidate).second; ++i) {
      candidate = name + std::to_string(i);
    }
    return candidate;
  }

  std::string text_;
  std::string parent_;
  std::set<std::string> links_;
  std::set<std::string> joints_;
};

}  // namespace

std::string to_urdf(const Chain& chain, const std::string& name) {
  return Writer(chain, name.empty() ? chain.name() : name).text();
}

}  // namespace thing_kin
