// Buckling and loss of stability along a computation (R7.05.01; U4.51.03, CRIT_STAB).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solver/fields/data/field.hpp"
#include "solver/model/component.hpp"

namespace comma::solver {

/// An eigenvalue and the shape with which the body buckles.
struct CriticalMode {
  double value = 0.0;  ///< CHAR_CRIT
  NodalField shape;    ///< scaled to its largest entry
};

/// The modes of a converged step, values rising.
struct StabilityReport {
  double instant = 0.0;
  std::vector<CriticalMode> modes;
  bool unstable = false;
};

/// Which eigenvalues are asked for.
enum class ModeSelection : std::uint8_t {
  smallest,  ///< PLUS_PETITE: so many of the smallest magnitude
  band       ///< BANDE: those in an interval
};

/// Signs of load factors that count as an instability.
enum class InstabilitySign : std::uint8_t { negative, positive, either };

/// After each of the steps that it is asked for: (K + value G) x = 0, with the tangent K and the stiffness G that the
/// stresses of the step add, so that `value` times the loads are critical. Where G is part of K, the identity stands
/// for it (Code_Aster 17.3): `value` is minus an eigenvalue of K, without what excluded components could weigh.
struct StabilityAnalysis {
  ModeSelection selection = ModeSelection::smallest;
  int count = 3;       ///< NMAX_CHAR_CRIT
  double first = 0.0;  ///< the interval, CHAR_CRIT
  double last = 0.0;
  bool geometric = true;            ///< RIGI_GEOM='OUI': G apart, for small displacements
  std::vector<Component> excluded;  ///< DDL_EXCLUS: components that the identity lacks, which follow the others
  double precision = 1e-6;          ///< PREC_INSTAB
  InstabilitySign sign = InstabilitySign::either;
  std::vector<double> instants;  ///< when; empty: every `period` steps
  int period = 1;
  double instant_tolerance = 1e-6;  ///< instants this near are the same: a share of them, or s
  bool absolute_tolerance = false;
  std::function<void(const StabilityReport&)> report;
};

}  // namespace comma::solver
