// Fields made of another, point by point: criteria and norms of its components, formulas (CALC_CHAMP, CHAM_UTIL,
// U4.81.04; POST_ELEM, NORME, U4.81.22).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "solver/fields/data/field_algebra.hpp"

namespace comma::solver {

/// A value out of all components at a point, NaN where it carries none of them, infinite where it is no number
/// (made_number).
using RowFunction = std::function<double(std::span<const double>)>;

enum class TensorCriterion : std::uint8_t {
  von_mises,         ///< sqrt(3/2 d:d) with the deviator d
  tresca,            ///< largest difference of principal values
  second_invariant,  ///< sqrt(2/3 d:d)
  trace
};

/// Of the stresses SIXX ... or the strains EPXX ... among the components; what a point lacks of these is 0. Throws
/// Error `incompatible-field` for a field without them.
RowFunction criterion(const std::vector<std::string>& components, TensorCriterion which);

/// The sum of squares, each times its weight (1 without weights), and its root.
RowFunction sum_of_squares(std::vector<double> weights = {});
RowFunction euclidean_norm(std::vector<double> weights = {});

/// The weights with which euclidean_norm() is the norm of Frobenius: 2 for xy, xz, yz of stresses and strains, which
/// stand in a tensor twice, 1 for all others.
std::vector<double> frobenius_weights(const std::vector<std::string>& components);

/// Where a parameter is absent so is the value. Throws Error `unknown-component` naming a parameter that is no
/// component.
RowFunction formula(const std::vector<std::string>& components, const ValueFunction& function);

/// One component X1, X2 ... a function, where the field has points.
Field made_of_rows(const Field& field, std::span<const RowFunction> functions);

}  // namespace comma::solver
