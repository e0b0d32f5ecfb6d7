#include "solver/fields/stresses/traction.hpp"

#include <algorithm>
#include <array>

#include "solver/error.hpp"
#include "solver/fields/data/component_group.hpp"

namespace comma::solver {

namespace {

constexpr std::array<const char*, 6> stress_group = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"};
constexpr std::array<const char*, 3> vector_group = {"DX", "DY", "DZ"};

NodalField empty_rows(const NodalField& like, const std::string& quantity, std::vector<std::string> components) {
  NodalField result{quantity, std::move(components), {}};
  result.values.assign(like.values.size() / like.components.size() * result.components.size(), absent);
  return result;
}

}  // namespace

NodalField tractions(const NodalField& stresses, std::span<const int> rows, const RowDirection& direction,
                     const std::string& name) {
  const auto columns = columns_of(stresses, stress_group);
  if (columns[0] < 0)
    throw Error("incompatible-field", "tractions are those of stresses, and the field has no SIXX",
                "take a field such as SIEF_NOEU or SIGM_NOEU");
  NodalField result = empty_rows(stresses, "SIEF_R", {name + "_1", name + "_2", name + "_3"});
  std::array<double, 6> s{};
  for (const int row : rows) {
    if (!gather(stresses, row, columns, s)) continue;
    const Eigen::Vector3d traction = tensor_of(s) * direction(row);
    std::copy(traction.begin(), traction.end(), result.values.begin() + 3 * static_cast<std::ptrdiff_t>(row));
  }
  return result;
}

NodalField part_along(const NodalField& vectors, std::span<const int> rows, const RowDirection& direction,
                      const std::string& name) {
  const auto columns = columns_of(vectors, vector_group);
  if (columns[0] < 0) throw Error("incompatible-field", "the field has no vector DX, DY, DZ");
  NodalField result = empty_rows(vectors, vectors.quantity, {name});
  std::array<double, 3> v{};
  for (const int row : rows)
    if (gather(vectors, row, columns, v))
      result.values[static_cast<std::size_t>(row)] = Eigen::Vector3d(v.data()).dot(direction(row));
  return result;
}

}  // namespace comma::solver
