#include "solver/fields/traction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

template <std::size_t Size>
std::array<int, Size> indices_of(const NodalField& field, const std::array<const char*, Size>& names) {
  std::array<int, Size> columns{};
  std::ranges::transform(names, columns.begin(), [&](const char* name) { return field.component(name); });
  return columns;
}

/// 0 for what is not there; whether anything is.
template <std::size_t Size>
bool read_row(const NodalField& field, int row, const std::array<int, Size>& columns,
              std::array<double, Size>& values) {
  bool carried = false;
  for (std::size_t i = 0; i < Size; ++i) {
    const double value = columns[i] < 0 ? absent : field.at(row, columns[i]);
    carried |= !std::isnan(value);
    values[i] = std::isnan(value) ? 0.0 : value;
  }
  return carried;
}

NodalField empty_rows(const NodalField& like, const std::string& quantity, std::vector<std::string> components) {
  NodalField result{quantity, std::move(components), {}};
  result.values.assign(like.values.size() / like.components.size() * result.components.size(), absent);
  return result;
}

}  // namespace

NodalField tractions(const NodalField& stresses, std::span<const int> rows, const RowDirection& direction,
                     const std::string& name) {
  const auto columns = indices_of<6>(stresses, {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"});
  if (columns[0] < 0)
    throw Error("incompatible-field", "tractions are those of stresses, and the field has no SIXX",
                "take a field such as SIEF_NOEU or SIGM_NOEU");
  NodalField result = empty_rows(stresses, "SIEF_R", {name + "_1", name + "_2", name + "_3"});
  std::array<double, 6> s{};
  for (const int row : rows) {
    if (!read_row(stresses, row, columns, s)) continue;
    Eigen::Matrix3d tensor;
    tensor << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    const Eigen::Vector3d traction = tensor * direction(row);
    std::copy(traction.begin(), traction.end(), result.values.begin() + 3 * static_cast<std::ptrdiff_t>(row));
  }
  return result;
}

NodalField part_along(const NodalField& vectors, std::span<const int> rows, const RowDirection& direction,
                      const std::string& name) {
  const auto columns = indices_of<3>(vectors, {"DX", "DY", "DZ"});
  if (columns[0] < 0) throw Error("incompatible-field", "the field has no vector DX, DY, DZ");
  NodalField result = empty_rows(vectors, vectors.quantity, {name});
  std::array<double, 3> v{};
  for (const int row : rows)
    if (read_row(vectors, row, columns, v))
      result.values[static_cast<std::size_t>(row)] = Eigen::Vector3d(v.data()).dot(direction(row));
  return result;
}

}  // namespace comma::solver
