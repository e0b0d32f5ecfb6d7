// Curves for plotting programs: what IMPR_FONCTION and IMPR_TABLE write.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace comma::commands {

struct Curve {
  std::string label;
  std::vector<double> x, y;
  /// Numbers of colour, symbol and line style, where they are given; a symbol on every so many points.
  std::optional<int> colour, marker, style, marker_step;
};

/// One axis of a drawing; what is not given is left to the plotting program.
struct Axis {
  std::string label;
  std::optional<std::array<double, 2>> bounds;
  std::optional<double> grid;  ///< distance of the grid lines
  bool logarithmic = false;
};

struct Drawing {
  std::string title, subtitle;
  Axis x, y;
  std::vector<Curve> curves;
};

/// A project file of Grace (its user's guide, "Grace command interpreter").
std::string grace_file(const Drawing& drawing);

/// The curves one after the other as two columns of numbers, each behind its label as a comment.
std::string curve_columns(const Drawing& drawing);

/// Title, axes and the labels of the curves, a line each.
std::string drawing_description(const Drawing& drawing);

}  // namespace comma::commands
