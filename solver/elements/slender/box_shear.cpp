#include "solver/elements/slender/box_shear.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace comma::solver {

namespace {

constexpr std::array ratios = {0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};

// By the ratio along the force, then across it.
constexpr double table[ratios.size()][ratios.size()] = {
    {1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2},
    {1.2, 1.2091, 1.22903, 1.29961, 1.41338, 1.57689, 1.80293, 2.11482, 2.56072, 3.26505, 4.71451, 6.68937},
    {1.2, 1.21234, 1.23638, 1.31674, 1.44242, 1.62077, 1.86614, 2.20702, 2.70395, 3.51953, 5.35808, 8.19368},
    {1.2, 1.21725, 1.24671, 1.3388, 1.47742, 1.67093, 1.93642, 2.30888, 2.8664, 3.82993, 6.21611, 10.2937},
    {1.2, 1.22028, 1.25225, 1.34797, 1.48853, 1.6827, 1.9487, 2.32387, 2.89403, 3.90732, 6.53601, 11.2361},
    {1.2, 1.22125, 1.25299, 1.34528, 1.47872, 1.66196, 1.91269, 2.26723, 2.81021, 3.79004, 6.40058, 11.1893},
    {1.2, 1.22011, 1.24905, 1.33181, 1.45075, 1.61403, 1.83775, 2.1543, 2.64029, 3.52423, 5.91643, 10.3749},
    {1.2, 1.21699, 1.24091, 1.30911, 1.40786, 1.54462, 1.73307, 2.00002, 2.40936, 3.15426, 5.18602, 9.01404},
    {1.2, 1.21234, 1.22963, 1.27969, 1.35418, 1.45982, 1.60759, 1.81808, 2.13953, 2.71977, 4.29975, 7.29574},
    {1.2, 1.20699, 1.21695, 1.24713, 1.29483, 1.36597, 1.46914, 1.61905, 1.84773, 2.25238, 3.33064, 5.37206},
    {1.2, 1.20223, 1.20561, 1.21707, 1.23759, 1.27159, 1.3254, 1.40907, 1.54135, 1.77105, 2.33808, 3.36741},
    {1.2, 1.20064, 1.20171, 1.20582, 1.2142, 1.22956, 1.25619, 1.30111, 1.37761, 1.51661, 1.84134, 2.37116}};

/// The interval that holds a ratio, and where in it the ratio lies.
struct Between {
  std::size_t first;
  double share;
};

Between between(double ratio) {
  const auto above = std::ranges::upper_bound(ratios.begin() + 1, ratios.end() - 1, ratio);
  return {static_cast<std::size_t>(above - ratios.begin()) - 1, (ratio - *(above - 1)) / (*above - *(above - 1))};
}

}  // namespace

std::optional<double> box_shear(double along, double across) {
  if (std::max(along, across) > ratios.back()) return std::nullopt;
  const auto [row, down] = between(along);
  const auto [column, right] = between(across);
  const auto in_row = [&, column = column, right = right](std::size_t i) {
    return (1.0 - right) * table[i][column] + right * table[i][column + 1];
  };
  return (1.0 - down) * in_row(row) + down * in_row(row + 1);
}

}  // namespace comma::solver
