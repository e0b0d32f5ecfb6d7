#include "commands/fortran_format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <regex>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

struct Descriptor {
  char kind;
  int width;
  int digits;
};

std::optional<Descriptor> parse(std::string_view format) {
  static const std::regex shape(R"(\s*(?:1P)?([EDFG])[SN]?(\d+)\.(\d+)(?:E\d+)?\s*)", std::regex::icase);
  std::cmatch match;
  if (!std::regex_match(format.data(), format.data() + format.size(), match, shape)) return std::nullopt;
  const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(*match[1].first)));
  return Descriptor{kind, std::stoi(match[2]), std::stoi(match[3])};
}

}  // namespace

bool is_real_format(std::string_view format) { return parse(format).has_value(); }

RealFormat::RealFormat(std::string_view format) {
  const auto descriptor = parse(format);
  if (!descriptor) {
    throw interpreter::DiagnosticError("bad-format", "\"" + std::string(format) + "\" is no format of a real number", {},
                                       "write E12.5, 1PE13.6 or F10.3");
  }
  kind_ = descriptor->kind;
  width_ = descriptor->width;
  digits_ = descriptor->digits;
}

std::string RealFormat::operator()(double value) const {
  if (kind_ == 'F') return fmt::format("{:{}.{}f}", value, width_, digits_);
  if (kind_ == 'G') return fmt::format("{:{}.{}G}", value, width_, digits_);
  return fmt::format("{:{}.{}E}", value, width_, digits_);
}

std::string format_real(double value, std::string_view format) {
  // The common case of every printed table; a regular expression a cell would cost more than the solution.
  if (format == "E12.5") return fmt::format("{:12.5E}", value);
  return RealFormat(format)(value);
}

}  // namespace comma::commands
