// What a field has along directions: the traction of stresses on a plane, a part of a vector (POST_RELEVE_T, TRAC_NOR
// and TRAC_DIR; U4.81.21).
#pragma once

#include <functional>
#include <span>
#include <string>

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The direction at a row of a nodal field; its length counts.
using RowDirection = std::function<Eigen::Vector3d(int row)>;

/// Stress times direction in the rows, absent elsewhere and where there is no stress: components name_1, name_2, name_3
/// along the axes of the field. Components of stress that are not there count as 0. Throws Error `incompatible-field`
/// for a field without stresses.
NodalField tractions(const NodalField& stresses, std::span<const int> rows, const RowDirection& direction,
                     const std::string& name);

/// The product of DX, DY, DZ with the direction, one component of that name. Throws Error `incompatible-field`.
NodalField part_along(const NodalField& vectors, std::span<const int> rows, const RowDirection& direction,
                      const std::string& name);

}  // namespace comma::solver
