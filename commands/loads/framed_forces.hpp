// Forces on beams and plates, in the axes of the mesh or in those of the cell (FORCE_POUTRE, FORCE_COQUE).
//
// Both frames share six places, and a later occurrence fills those that it names; all that stands there afterwards
// counts in one frame, as in Code_Aster 17.3 (docs/conformance/loads.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "commands/loads/load_building.hpp"

namespace comma::commands {

enum class ForceFrame : std::uint8_t { global, own, pressure };

/// What stands in one of the six places, and the frame of the occurrence that put it there.
struct FramedAmount {
  Amount amount;
  ForceFrame frame = ForceFrame::global;
};

struct FramedForce {
  ForceFrame frame = ForceFrame::global;  ///< that of the last occurrence that was not in the axes of the mesh
  solver::PlateLevel level = solver::PlateLevel::mesh;  ///< that of the last occurrence
  /// FX FY FZ MX MY MZ, or N VY VZ MT MFY MFZ of beams, F1 F2 F3 (PRES) MF1 MF2 of plates.
  std::array<std::optional<FramedAmount>, 6> amounts;

  /// Whether something counts in another frame than it was given in.
  bool is_mixed() const;
};

/// What the occurrences of FORCE_POUTRE or FORCE_COQUE (`keyword`) put on each cell. Throws DiagnosticError
/// `no-element` where one names no beam, or no plate.
std::map<int, FramedForce> framed_forces(const interpreter::Keywords& call, const std::string& keyword,
                                         const LoadedModel& target);

/// The place of a component in FORCE_POUTRE or FORCE_COQUE: FX for N as for F1, FZ for PRES. Any other name is its own.
std::string place_of_force(const std::string& keyword, const std::string& component);

}  // namespace comma::commands
