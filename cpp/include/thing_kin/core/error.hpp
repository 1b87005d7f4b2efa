#pragma once

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

/// A number with the digits that matter, for messages.
inline std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace thing_kin
