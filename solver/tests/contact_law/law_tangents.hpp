// Derivatives of a law of contact against finite differences.
#pragma once

#include <catch2/catch.hpp>

#include "solver/contact_law/contact_law.hpp"

namespace comma::solver {

/// `law`: (multiplier, jump) -> ContactLawValue, at places where it is smooth.
template <typename Law>
void check_tangents(const Law& law) {
  const Eigen::Vector3d multiplier(120.0, 25.0, -14.0), jump(-0.03, 0.02, 0.05);
  const ContactLawValue value = law(multiplier, jump);
  const auto check = [](const auto& at, double size, const Eigen::Matrix3d& of_traction,
                        const Eigen::Matrix3d& of_residual) {
    const double step = 1e-6 * size;
    Eigen::Matrix3d traction, residual;
    for (int k = 0; k < 3; ++k) {
      const ContactLawValue after = at(step * Eigen::Vector3d::Unit(k)), before = at(-step * Eigen::Vector3d::Unit(k));
      traction.col(k) = (after.traction - before.traction) / (2.0 * step);
      residual.col(k) = (after.residual - before.residual) / (2.0 * step);
    }
    // Central differences of steps of 1e-6 lose their fourth digits before the sixth.
    CHECK((traction - of_traction).norm() < 1e-6 * (1.0 + of_traction.norm()));
    CHECK((residual - of_residual).norm() < 1e-6 * (1.0 + of_residual.norm()));
  };
  check([&](const Eigen::Vector3d& shift) -> ContactLawValue { return law(multiplier + shift, jump); },
        multiplier.norm(), value.traction_by_multiplier, value.residual_by_multiplier);
  check([&](const Eigen::Vector3d& shift) -> ContactLawValue { return law(multiplier, jump + shift); }, jump.norm(),
        value.traction_by_jump, value.residual_by_jump);
}

}  // namespace comma::solver
