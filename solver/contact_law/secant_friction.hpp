// Friction of penalties as iterations take it that know it by the slip before.
#pragma once

#include "solver/contact_law/contact_law.hpp"

namespace comma::solver {

/// What friction does at a slip: its status, the shear that resists (a pressure, or a force where the law has forces),
/// and what stands for it in the next linear solve.
struct SecantShear {
  ContactStatus status = ContactStatus::sliding;
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  LinearShear linear;
};

/// Coulomb's law with a penalty, at a pressure that the next solve does not change. While the point sticks its
/// stiffness is the penalty. What slides resists along the slip s by the limit L of friction; its stiffness is the
/// secant L / |s|, less this share (`relief`, from 0 to 1) of the part along the slip: L / |s| (1 - relief n n^T). With
/// 0 the solve aims at zero shear for zero slip, with 1 it takes the tangent of a limit that stays. Code_Aster 17.3
/// iterates so in the discrete formulation (COEF_MATR_FROT), to the last digits.
SecantShear secant_shear(const ContactLaw& law, double pressure, const Eigen::Vector2d& slip, double relief);

}  // namespace comma::solver
