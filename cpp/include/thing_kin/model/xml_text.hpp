#pragma once

#include <string>

namespace thing_kin {

/// Text as an XML attribute has it between double quotes; tabs and line ends, which XML would make
/// blanks of, are kept.
std::string xml_escaped(const std::string& text);

}  // namespace thing_kin
