// Numbers in Fortran's edit descriptors, which FORMAT_R and its like carry in command files ("E12.5", "1PE13.6").
#pragma once

#include <string>
#include <string_view>

namespace comma::commands {

/// A descriptor of a real number, taken apart once for many numbers.
class RealFormat {
 public:
  /// Throws DiagnosticError `bad-format` on one that is not known.
  explicit RealFormat(std::string_view format);

  std::string operator()(double value) const;
  int width() const { return width_; }

 private:
  char kind_;
  int width_;
  int digits_;
};

/// A number by a descriptor: E, D, F or G, with a scale factor 1P or not. Throws DiagnosticError `bad-format` on one
/// that is not known.
std::string format_real(double value, std::string_view format);

}  // namespace comma::commands
