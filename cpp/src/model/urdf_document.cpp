#include "thing_kin/model/urdf_document.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include <expat.h>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

constexpr int kDeepest = 100;          // robots have eight
constexpr std::size_t kMost = 100000;  // links, joints; robots have some hundred

// Thrown inside of Expat's callbacks nothing may pass through C, so the first refusal is kept.
class Builder {
 public:
  explicit Builder(XML_Parser parser) : parser_(parser) {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &Builder::on_start, &Builder::on_end);
    XML_SetStartDoctypeDeclHandler(parser, &Builder::on_doctype);
  }

  const std::string& refusal() const { return refusal_; }
  UrdfDocument take() { return std::move(document_); }

 private:
  static void on_start(void* self, const char* element, const char** attributes) noexcept {
    static_cast<Builder*>(self)->start(element, attributes);
  }
  static void on_end(void* self, const char* /*element*/) noexcept {
    --static_cast<Builder*>(self)->depth_;
  }
  static void on_doctype(void* self, const char* /*name*/, const char* /*system*/,
                         const char* /*public_id*/, int /*has_subset*/) noexcept {
    static_cast<Builder*>(self)->refuse("a document type declaration");
  }

  void refuse(const std::string& what) {
    if (refusal_.empty()) {
      refusal_ = what;
    }
    XML_StopParser(parser_, XML_FALSE);
  }

  void start(const std::string& element, const char** list) {
    if (++depth_ > kDeepest) {
      refuse("elements nested deeper than " + std::to_string(kDeepest));
    } else if (depth_ == 1) {
      start_root(element, list);
    } else if (depth_ == 2) {
      start_top(element, list);
    } else if (depth_ == 3 && in_joint_) {
      start_in_joint(element, attributes_of(list));
    }
  }

  void start_root(const std::string& element, const char** list) {
    document_.robot = attributes_of(list);
    if (element != "robot") {
      refuse(std::string("the element <").append(element).append("> where <robot> should be"));
    }
  }

  void start_top(const std::string& element, const char** list) {
    in_joint_ = element == "joint";
    if (std::max(document_.links.size(), document_.joints.size()) >= kMost) {
      refuse("more than " + std::to_string(kMost) + " links or joints");
    } else if (element == "link") {
      document_.links.push_back(attributes_of(list)["name"]);
    } else if (in_joint_) {
      UrdfJoint::Attributes attributes = attributes_of(list);
      document_.joints.push_back({attributes["name"], attributes["type"], "", "", {}});
    } else if (element.starts_with("xacro:")) {
      refuse("xacro, which has to be expanded first ('xacro robot.urdf.xacro > robot.urdf')");
    }
  }

  // The first of a kind counts, as in urdfdom.
  void start_in_joint(const std::string& element, UrdfJoint::Attributes attributes) {
    UrdfJoint& joint = document_.joints.back();
    static const std::set<std::string_view> kept{"origin", "axis",   "limit",
                                                 "mimic",  "parent", "child"};
    if (!kept.contains(element)) {
      return;
    }
    const bool is_first = joint.elements.emplace(element, std::move(attributes)).second;
    if (is_first && element == "parent") {
      joint.parent = joint.elements[element]["link"];
    } else if (is_first && element == "child") {
      joint.child = joint.elements[element]["link"];
    }
  }

  static UrdfJoint::Attributes attributes_of(const char** list) {
    static const std::set<std::string_view> kept{"name", "version", "type",  "link",    "xyz",
                                                 "rpy",  "lower",   "upper", "velocity"};
    UrdfJoint::Attributes attributes;
    for (; *list != nullptr; list += 2) {
      if (kept.contains(list[0])) {
        attributes.emplace(list[0], list[1]);
      }
    }
    return attributes;
  }

  XML_Parser parser_;
  UrdfDocument document_;
  std::string refusal_;
  int depth_ = 0;
  bool in_joint_ = false;
};

}  // namespace

UrdfDocument read_urdf_document(std::string_view xml, bool is_utf8) {
  if (xml.size() > kLargestUrdf) {
    throw InvalidArgument("source", std::to_string(xml.size()) + " bytes",
                          "at most " + std::to_string(kLargestUrdf));
  }
  // Before an XML declaration nothing may stand; a string literal often begins with a new line.
  const std::string_view blank = xml.substr(0, xml.find_first_not_of(" \t\r\n"));
  xml.remove_prefix(blank.size());
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(is_utf8 ? "UTF-8" : nullptr), &XML_ParserFree);
  if (!parser) {
    throw std::bad_alloc();
  }
  Builder builder(parser.get());
  const auto status = XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), XML_TRUE);
  if (!builder.refusal().empty()) {
    throw InvalidArgument("source", builder.refusal(), "a URDF");
  }
  if (status != XML_STATUS_OK) {
    const auto skipped = static_cast<unsigned long>(std::ranges::count(blank, '\n'));
    const std::string line = std::to_string(XML_GetCurrentLineNumber(parser.get()) + skipped);
    throw InvalidArgument("source",
                          std::string("XML that is not well-formed (line ")
                              .append(line)
                              .append(": ")
                              .append(XML_ErrorString(XML_GetErrorCode(parser.get())))
                              .append(")"),
                          "a URDF");
  }
  return builder.take();
}

}  // namespace thing_kin
