#pragma once

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>

namespace thing_kin {

/// Misuse of a constructor or a border: names the argument, what came and what was expected.
/// Python sees it as a ValueError. Numerical failure is never an exception.
class InvalidArgument : public std::invalid_argument {
 public:
  InvalidArgument(const std::string& argument, const std::string& got, const std::string& expected)
      : std::invalid_argument(argument + ": got " + got + ", expected " + expected) {}
};

/// 'name', for messages.
inline std::string quoted(const std::string& name) {
  std::string text(1, '\'');
  return text.append(name).append("'");
}

/// The first `most` bytes, but no part of a UTF-8 character, for messages.
inline std::string shortened(std::string text, std::size_t most) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  text.resize(std::min(text.size(), most));
  std::size_t lead = text.size();
  while (lead > 0 && (byte(lead - 1) & 0xC0U) == 0x80U) {
    --lead;
  }
  if (lead > 0 && byte(lead - 1) >= 0xC0U) {
    const std::size_t length = byte(lead - 1) >= 0xF0U ? 4 : byte(lead - 1) >= 0xE0U ? 3 : 2;
    text.resize(lead - 1 + length == text.size() ? text.size() : lead - 1);
  }
  return text;
}

/// A number with the digits that matter, for messages.
inline std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace thing_kin
