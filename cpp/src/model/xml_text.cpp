#include "thing_kin/model/xml_text.hpp"

namespace thing_kin {

namespace {

const char* entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '"':
      return "&quot;";
    case '\t':
      return "&#x9;";
    case '\n':
      return "&#xA;";
    case '\r':
      return "&#xD;";
    default:
      return nullptr;
  }
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (const char* entity = entity_of(c)) {
      escaped.append(entity);
    } else {
      escaped.push_back(c);
    }
  }
  return escaped;
}

}  // namespace thing_kin
