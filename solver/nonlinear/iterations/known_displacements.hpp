// Displacements that fields and results hold, as unknowns of a computation.
#pragma once

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Writes into u (one a degree of freedom) what the field knows of it; the rest stays.
void take_displacements(const NodalField& field, const DofMap& dofs, Eigen::VectorXd& u);

/// The displacements (DEPL) of a result at a time, linear between its steps and constant beyond; `rest` where it has
/// none. Throws Error `missing-field` where no step has any.
Eigen::VectorXd displacements_at(double time, const Result& result, const DofMap& dofs, const Eigen::VectorXd& rest);

}  // namespace comma::solver
