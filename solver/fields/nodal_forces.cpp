#include "solver/fields/nodal_forces.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

Eigen::VectorXd internal_forces(const Assembler& assembler, const Eigen::VectorXd& u, const ElementField* stresses) {
  return stresses != nullptr ? assembler.forces_of_stresses(u, *stresses) : assembler.internal_forces(u);
}

}  // namespace

Eigen::VectorXd to_dofs(const NodalField& field, const DofMap& dofs) {
  std::array<int, component_count> columns;
  for (int c = 0; c < component_count; ++c) columns[c] = field.component(name_of(static_cast<Component>(c)));
  Eigen::VectorXd values(dofs.size());
  for (int dof = 0; dof < dofs.size(); ++dof) {
    const int column = columns[static_cast<std::size_t>(dofs.component_of(dof))];
    const double value = column < 0 ? absent : field.at(dofs.node_of(dof), column);
    if (std::isnan(value)) {
      throw Error("incompatible-field",
                  fmt::format("the displacement field has no {} at a node of the model that needs it",
                              name_of(dofs.component_of(dof))));
    }
    values[dof] = value;
  }
  return values;
}

NodalField nodal_forces(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement,
                        std::span<const AppliedLoad> loads, double time, const ElementField* stresses) {
  const Eigen::VectorXd internal = internal_forces(assembler, to_dofs(displacement, dofs), stresses);
  return to_field(internal - assembler.initial_strain_forces(loads, time), dofs, "DEPL_R");
}

NodalField nodal_reactions(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement,
                           std::span<const AppliedLoad> loads, const FollowerForces& followers, double time,
                           const ElementField* stresses) {
  const Eigen::VectorXd u = to_dofs(displacement, dofs);
  return to_field(internal_forces(assembler, u, stresses) - assembler.external_forces(loads, time) - followers.at(u),
                  dofs, "DEPL_R");
}

}  // namespace comma::solver
