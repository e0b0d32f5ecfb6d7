// What the mixed formulation adds to results: multipliers, CONT_NOEU, CONT_ELEM.
#pragma once

#include <optional>

#include "solver/contact/contact_field.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// Of the mixed formulation alone: adds LAGS_C (minus the pressure) to a field of displacements, zero where contact is
/// open, absent but at slave nodes (under local average contact at those inside patches); with friction LAGS_F1,
/// LAGS_F2 too: the shear that resists slip, as a share of the limit of friction.
void add_multipliers(const SolvedContact& contact, NodalField& displacements);

/// CONT_NOEU (see contact_field.hpp); nothing where no point lies at a node. `positions`: where the nodes are;
/// `paired_at`: where they were when surfaces were last paired, for zones that the discrete formulation watches;
/// `duration`: of the step.
std::optional<NodalField> contact_state(const SolvedContact& contact, Positions positions, Positions paired_at,
                                        double instant, double duration);

/// CONT_ELEM (see patch_field.hpp); nothing without zones of local average contact.
std::optional<ElementField> patch_state(const SolvedContact& contact);

}  // namespace comma::solver
