// Numbers that depend on time and place: load multipliers, prescribed values, material laws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// How a table goes on past its ends.
enum class Extension : std::uint8_t { excluded, constant, linear };
/// How it goes between two of its points; `log` needs positive values.
enum class Scale : std::uint8_t { linear, logarithmic };

/// y(x) by a table (U4.31.02). x rises strictly. Throws Error `out-of-function` outside the table where it is excluded.
struct TabulatedFunction {
  std::string parameter = "INST";
  std::string result = "TOUTRESU";
  std::vector<double> x;
  std::vector<double> y;
  Scale x_scale = Scale::linear;
  Scale y_scale = Scale::linear;
  Extension left = Extension::excluded;
  Extension right = Extension::excluded;
  std::string name{};  ///< by which messages call it; empty: by its result

  double operator()(double at) const;
  /// Puts the points in the order of x; those that share one stay as they stand.
  void sort_points();
};

/// f(t).
using TimeFunction = std::function<double(double time)>;
/// f(node; t).
using NodalFunction = std::function<double(int node, double time)>;
/// f(x, y, z; t).
using FieldFunction = std::function<double(const Point& at, double time)>;

}  // namespace comma::solver
