#include "thing_kin/model/urdf_excerpt.hpp"

#include <set>

#include "thing_kin/core/error.hpp"
#include "thing_kin/model/xml_text.hpp"

namespace thing_kin {

namespace {

// One number, or numbers between blanks, by its characters alone. What is a number in the end
// urdfdom decides; but what it refuses it prints as a printf format, so a % must not reach it.
std::string number_text(const std::string& value, const UrdfJoint& joint,
                        const std::string& where) {
  constexpr std::size_t kLongest = 200;
  constexpr const char* kDigits = "0123456789+-.eE";
  std::string text;
  for (const char c : value) {
    const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (blank && !text.empty() && text.back() != ' ') {
      text.push_back(' ');
    } else if (!blank) {
      text.push_back(c);
    }
  }
  while (text.ends_with(' ')) {
    text.pop_back();
  }
  if (text.empty() || text.size() > kLongest ||
      text.find_first_not_of(std::string(kDigits).append(" ")) != std::string::npos) {
    throw InvalidArgument("source",
                          std::string("joint ")
                              .append(quoted(joint.name))
                              .append(" with ")
                              .append(where)
                              .append(" ")
                              .append(quoted(shortened(value, 60))),
                          "finite numbers");
  }
  return text;
}

std::string attribute(const std::string& name, const std::string& value) {
  return std::string(" ").append(name).append("=\"").append(xml_escaped(value)).append("\"");
}

std::string link(const std::string& name) {
  return std::string("<link").append(attribute("name", name)).append("/>\n");
}

struct Numbers {
  const char* element;
  std::vector<const char*> attributes;
};

// Of a limit urdfdom requires effort and velocity, which many files leave out.
std::string write_numbers(const UrdfJoint& joint, const Numbers& numbers) {
  const auto found = joint.elements.find(numbers.element);
  if (found == joint.elements.end()) {
    return "";
  }
  std::string text = std::string("<").append(numbers.element);
  for (const char* name : numbers.attributes) {
    const auto value = found->second.find(name);
    if (value != found->second.end()) {
      const std::string where = std::string(numbers.element).append(" ").append(name);
      text.append(attribute(name, number_text(value->second, joint, where)));
    } else if (std::string(name) == "velocity") {
      text.append(attribute(name, "0"));
    }
  }
  const bool is_limit = std::string(numbers.element) == "limit";
  return text.append(is_limit ? " effort=\"0\"/>" : "/>");
}

std::string write_joint(const UrdfJoint& joint) {
  std::string text = std::string("<joint").append(attribute("name", joint.name));
  text.append(attribute("type", joint.type))
      .append("><parent")
      .append(attribute("link", joint.parent));
  text.append("/><child").append(attribute("link", joint.child)).append("/>");
  text.append(write_numbers(joint, {"origin", {"xyz", "rpy"}}));
  text.append(write_numbers(joint, {"axis", {"xyz"}}));
  text.append(write_numbers(joint, {"limit", {"lower", "upper", "velocity"}}));
  return text.append("</joint>\n");
}

}  // namespace

std::string write_urdf_excerpt(const UrdfDocument& document,
                               const std::vector<const UrdfJoint*>& joints) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot";
  for (const char* name : {"name", "version"}) {
    const auto found = document.robot.find(name);
    if (found != document.robot.end()) {
      text.append(attribute(name, found->second));
    }
  }
  text.append(">\n");
  std::set<std::string> links;
  for (const UrdfJoint* joint : joints) {
    for (const std::string& name : {joint->parent, joint->child}) {
      text.append(links.insert(name).second ? link(name) : "");
    }
    text.append(write_joint(*joint));
  }
  return text.append("</robot>\n");
}

}  // namespace thing_kin
