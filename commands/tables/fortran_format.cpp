#include "commands/tables/fortran_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

struct Descriptor {
  char kind;
  int width;
  int digits;
};

/// Reads a text from its beginning.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }
  /// The next letter if it is one of these, in capitals; 0 otherwise.
  char one_of(std::string_view letters) {
    const char next = rest_.empty() ? '\0' : static_cast<char>(std::toupper(static_cast<unsigned char>(rest_.front())));
    if (next == '\0' || letters.find(next) == std::string_view::npos) return '\0';
    rest_.remove_prefix(1);
    return next;
  }
  /// A number of digits alone, nothing where there is none or it is larger than any field is wide.
  std::optional<int> number() {
    constexpr int widest = 200;
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || rest_.front() == '-' || value > widest) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

 private:
  std::string_view rest_;
};

// A scale factor 1P, the kind, S or N, width and digits, the digits of the exponent.
std::optional<Descriptor> parse(std::string_view format) {
  Scanner scanner(format);
  scanner.skip_blanks();
  if (scanner.one_of("1") && !scanner.one_of("P")) return std::nullopt;
  const char kind = scanner.one_of("EDFG");
  if (kind == '\0') return std::nullopt;
  scanner.one_of("SN");
  const auto width = scanner.number();
  if (!width || !scanner.one_of(".")) return std::nullopt;
  const auto digits = scanner.number();
  if (!digits || (scanner.one_of("E") && !scanner.number())) return std::nullopt;
  scanner.skip_blanks();
  if (!scanner.at_end()) return std::nullopt;
  return Descriptor{kind, *width, *digits};
}

}  // namespace

RealFormat::RealFormat(std::string_view format) {
  const auto descriptor = parse(format);
  if (!descriptor) {
    constexpr std::size_t most_shown = 40;
    const std::string shown =
        format.size() > most_shown ? std::string(format.substr(0, most_shown)) + "..." : std::string(format);
    throw interpreter::DiagnosticError("bad-format", "\"" + shown + "\" is no format of a real number", {},
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
  // The common case of every printed table; a format is not taken apart for each cell.
  if (format == "E12.5") return fmt::format("{:12.5E}", value);
  return RealFormat(format)(value);
}

}  // namespace comma::commands
