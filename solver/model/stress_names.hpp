// The components of stresses and of the forces in beams, by their usual names.
#pragma once

#include <array>
#include <string_view>

namespace comma::solver {

inline constexpr std::array<std::string_view, 4> plane_stress_names = {"SIXX", "SIYY", "SIZZ", "SIXY"};
/// Of plates: forces and moments per length.
inline constexpr std::array<std::string_view, 8> plate_force_names = {"NXX", "NYY", "NXY", "MXX",
                                                                      "MYY", "MXY", "QX",  "QY"};
inline constexpr std::array<std::string_view, 6> solid_stress_names = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"};
inline constexpr std::array<std::string_view, 6> beam_force_names = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};
/// Of hexahedra with one point of integration, beside the stresses of the point: the stress that varies over the cell
/// (hourglass.hpp).
inline constexpr std::array<std::string_view, 72> hourglass_stress_names = {
    "FSTAB1",  "FSTAB2",  "FSTAB3",  "FSTAB4",  "FSTAB5",  "FSTAB6",  "FSTAB7",  "FSTAB8",  "FSTAB9",
    "FSTAB10", "FSTAB11", "FSTAB12", "FSTAB13", "FSTAB14", "FSTAB15", "FSTAB16", "FSTAB17", "FSTAB18",
    "FSTAB19", "FSTAB20", "FSTAB21", "FSTAB22", "FSTAB23", "FSTAB24", "FSTAB25", "FSTAB26", "FSTAB27",
    "FSTAB28", "FSTAB29", "FSTAB30", "FSTAB31", "FSTAB32", "FSTAB33", "FSTAB34", "FSTAB35", "FSTAB36",
    "FSTAB37", "FSTAB38", "FSTAB39", "FSTAB40", "FSTAB41", "FSTAB42", "FSTAB43", "FSTAB44", "FSTAB45",
    "FSTAB46", "FSTAB47", "FSTAB48", "FSTAB49", "FSTAB50", "FSTAB51", "FSTAB52", "FSTAB53", "FSTAB54",
    "FSTAB55", "FSTAB56", "FSTAB57", "FSTAB58", "FSTAB59", "FSTAB60", "FSTAB61", "FSTAB62", "FSTAB63",
    "FSTAB64", "FSTAB65", "FSTAB66", "FSTAB67", "FSTAB68", "FSTAB69", "FSTAB70", "FSTAB71", "FSTAB72"};

}  // namespace comma::solver
