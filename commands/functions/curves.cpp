#include "commands/functions/curves.hpp"

#include <fmt/format.h>

#include "commands/tables/fortran_format.hpp"

namespace comma::commands {

namespace {

constexpr const char* real_format = "1PE20.12";

// Grace reads texts between double quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "'" : std::string(1, c);
  return result + "\"";
}

std::string points(const Curve& curve) {
  std::string text;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    text += fmt::format("{} {}\n", format_real(curve.x[i], real_format), format_real(curve.y[i], real_format));
  return text;
}

std::string grace_axis(const Axis& axis, char name) {
  std::string text;
  if (!axis.label.empty()) text += fmt::format("@{}axis label {}\n", name, quoted(axis.label));
  if (axis.bounds)
    text += fmt::format("@world {0}min {1:g}\n@world {0}max {2:g}\n", name, (*axis.bounds)[0], (*axis.bounds)[1]);
  if (axis.logarithmic) text += fmt::format("@{}axes scale logarithmic\n", name);
  if (axis.grid) text += fmt::format("@{0}axis tick major {1:g}\n@{0}axis tick major grid on\n", name, *axis.grid);
  return text;
}

std::string grace_looks(const Curve& curve, std::size_t number) {
  std::string text = fmt::format("@s{} legend {}\n", number, quoted(curve.label));
  if (curve.colour) text += fmt::format("@s{0} line color {1}\n@s{0} symbol color {1}\n", number, *curve.colour);
  if (curve.style) text += fmt::format("@s{} line linestyle {}\n", number, *curve.style);
  if (curve.marker) text += fmt::format("@s{} symbol {}\n", number, *curve.marker);
  if (curve.marker_step) text += fmt::format("@s{} symbol skip {}\n", number, *curve.marker_step);
  return text;
}

std::string described_axis(const Axis& axis, char name) {
  std::string text = fmt::format("{}: {}{}", name, axis.label, axis.logarithmic ? ", logarithmic" : "");
  if (axis.bounds) text += fmt::format(", from {:g} to {:g}", (*axis.bounds)[0], (*axis.bounds)[1]);
  if (axis.grid) text += fmt::format(", grid {:g}", *axis.grid);
  return text + "\n";
}

}  // namespace

std::string grace_file(const Drawing& drawing) {
  std::string text = "# Grace project file\n@version 50100\n";
  if (!drawing.title.empty()) text += fmt::format("@title {}\n", quoted(drawing.title));
  if (!drawing.subtitle.empty()) text += fmt::format("@subtitle {}\n", quoted(drawing.subtitle));
  text += grace_axis(drawing.x, 'x') + grace_axis(drawing.y, 'y');
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) text += grace_looks(drawing.curves[i], i);
  for (std::size_t i = 0; i < drawing.curves.size(); ++i)
    text += fmt::format("@target G0.S{}\n@type xy\n{}&\n", i, points(drawing.curves[i]));
  return text;
}

std::string curve_columns(const Drawing& drawing) {
  std::string text;
  for (const Curve& curve : drawing.curves) text += fmt::format("# {}\n{}\n", curve.label, points(curve));
  return text;
}

std::string drawing_description(const Drawing& drawing) {
  std::string text = drawing.title + "\n";
  if (!drawing.subtitle.empty()) text += drawing.subtitle + "\n";
  text += described_axis(drawing.x, 'X') + described_axis(drawing.y, 'Y');
  for (std::size_t i = 0; i < drawing.curves.size(); ++i)
    text += fmt::format("curve {}: {}\n", i + 1, drawing.curves[i].label);
  return text;
}

}  // namespace comma::commands
