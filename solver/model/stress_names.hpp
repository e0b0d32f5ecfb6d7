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
/// Of hexahedra with one point of integration, beside the stresses of the point: the forces on their hourglass
/// patterns.
inline constexpr std::array<std::string_view, 12> hourglass_force_names = {"S1X", "S1Y", "S1Z", "S2X", "S2Y", "S2Z",
                                                                           "S3X", "S3Y", "S3Z", "S4X", "S4Y", "S4Z"};

}  // namespace comma::solver
