#include "solver/elements/slender/section_shapes.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "solver/elements/slender/box_shear.hpp"
#include "solver/elements/slender/shear_coefficient.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

using std::numbers::pi;

[[noreturn]] void refuse(const std::string& what, const std::string& hint) {
  throw Error("invalid-section", what, hint);
}

bool is_solid(const Rectangle& r) {
  return (r.thickness_y == 0.0 && r.thickness_z == 0.0) ||
         (2 * r.thickness_y == r.height_y && 2 * r.thickness_z == r.height_z);
}

void check(const Rectangle& r) {
  if (!(r.height_y > 0.0 && r.height_z > 0.0))
    refuse("a rectangular section needs positive sides", "give HY and HZ, or H");
  if (is_solid(r)) return;
  const auto fits = [](double thickness, double height) { return thickness > 0.0 && 2 * thickness < height; };
  if (fits(r.thickness_y, r.height_y) && fits(r.thickness_z, r.height_z)) return;
  refuse(fmt::format("walls of {:g} and {:g} leave no hole in a rectangle of {:g} by {:g}", r.thickness_y,
                     r.thickness_z, r.height_y, r.height_z),
         "walls are thinner than half of the side; without walls the rectangle is solid");
}

/// Torsion constant and reach of a solid rectangle with half sides a >= b.
void add_solid_torsion(BeamSection& section, double a, double b) {
  const double ratio = b / a;
  section.torsion = a * b * b * b * (16.0 / 3.0 - 3.36 * ratio * (1.0 - ratio * ratio * ratio * ratio / 12.0));
  section.torsion_reach = section.torsion * (3.0 * a + 1.8 * b) / (8.0 * a * a * b * b);
}

/// Bredt: the shear flow goes round the middle line of the walls.
void add_hollow_torsion(BeamSection& section, const Rectangle& r) {
  const double y = r.height_y - r.thickness_y;
  const double z = r.height_z - r.thickness_z;
  section.torsion = 2.0 * y * y * z * z / (y / r.thickness_z + z / r.thickness_y);
  // Code_Aster 17.3 has the wall across z, which need not be the thinner one, and the area of the hole.
  const double hole = (r.height_y - 2.0 * r.thickness_y) * (r.height_z - 2.0 * r.thickness_z);
  section.torsion_reach = section.torsion / (2.0 * r.thickness_z * hole);
}

/// For a force along the first side: outer and inner size of both sides.
double hollow_shear(double along, double inner_along, double across, double inner_across) {
  if (const auto known = box_shear(inner_along / along, inner_across / across)) return *known;
  return shear_coefficient_along_z({across / 2.0, along / 2.0, inner_across / 2.0, inner_along / 2.0});
}

/// Cowper's factor of a tube without lateral contraction, by the ratio of its radii. Code_Aster 17.3 interpolates it
/// between these places, where it has five digits.
double tube_shear(double ratio) {
  constexpr std::array<std::pair<double, double>, 14> table = {{{0.0, 1.16667},
                                                                {0.05, 1.17442},
                                                                {0.1, 1.19877},
                                                                {0.2, 1.28947},
                                                                {0.3, 1.41882},
                                                                {0.4, 1.56277},
                                                                {0.5, 1.69984},
                                                                {0.6, 1.81536},
                                                                {0.7, 1.90233},
                                                                {0.8, 1.95983},
                                                                {0.9, 1.99081},
                                                                {0.95, 1.99781},
                                                                {0.99, 1.99992},
                                                                {1.0, 2.0}}};
  const auto above =
      std::ranges::upper_bound(table.begin() + 1, table.end() - 1, ratio, {}, &std::pair<double, double>::first);
  const auto [x, y] = *(above - 1);
  return y + (ratio - x) / (above->first - x) * (above->second - y);
}

}  // namespace

BeamSection rectangular_section(const Rectangle& r) {
  check(r);
  const bool solid = is_solid(r);
  const double inner_y = solid ? 0.0 : r.height_y - 2 * r.thickness_y;
  const double inner_z = solid ? 0.0 : r.height_z - 2 * r.thickness_z;
  BeamSection section;
  section.area = r.height_y * r.height_z - inner_y * inner_z;
  section.inertia_y =
      (r.height_y * r.height_z * r.height_z * r.height_z - inner_y * inner_z * inner_z * inner_z) / 12.0;
  section.inertia_z =
      (r.height_z * r.height_y * r.height_y * r.height_y - inner_z * inner_y * inner_y * inner_y) / 12.0;
  section.shape = SectionShape::rectangle;
  section.reach_y = r.height_y / 2.0;
  section.reach_z = r.height_z / 2.0;
  section.shear_y = section.shear_z = 1.2;
  if (solid) {
    add_solid_torsion(section, std::max(section.reach_y, section.reach_z), std::min(section.reach_y, section.reach_z));
  } else {
    add_hollow_torsion(section, r);
    section.shear_y = hollow_shear(r.height_y, inner_y, r.height_z, inner_z);
    section.shear_z = hollow_shear(r.height_z, inner_z, r.height_y, inner_y);
  }
  return section;
}

BeamSection circular_section(double radius, double thickness) {
  if (!(radius > 0.0 && thickness > 0.0 && thickness <= radius)) {
    refuse(fmt::format("a circular section of radius {:g} cannot have a wall of {:g}", radius, thickness),
           "the radius R is positive, the wall EP at most the radius; without EP the section is solid");
  }
  const double inner = radius - thickness;
  const double outer_2 = radius * radius;
  const double inner_2 = inner * inner;
  BeamSection section;
  section.area = pi * (outer_2 - inner_2);
  section.inertia_y = section.inertia_z = pi * (outer_2 * outer_2 - inner_2 * inner_2) / 4.0;
  section.torsion = 2.0 * section.inertia_y;
  section.shape = SectionShape::circle;
  section.reach_y = section.reach_z = section.torsion_reach = radius;
  section.shear_y = section.shear_z = tube_shear(inner / radius);
  return section;
}

BeamSection varying_section(BeamSection first, const BeamSection& last, const VariationPowers& powers) {
  if (first.centre_y != last.centre_y || first.centre_z != last.centre_z) {
    refuse("the centre of torsion of a section that varies is not the same at both ends",
           "give EY and EZ the same values at both ends");
  }
  first.end = std::make_shared<const BeamSection>(last);
  first.powers = powers;
  return first;
}

BeamSection softened(BeamSection section, double factor_xy, double factor_xz) {
  if (!(factor_xy > 0.0 && factor_xz > 0.0))
    refuse("a factor of flexibility must be positive", "1 leaves the section as it is");
  section.inertia_z /= factor_xy;
  section.inertia_y /= factor_xz;
  if (section.end) section.end = std::make_shared<const BeamSection>(softened(*section.end, factor_xy, factor_xz));
  return section;
}

}  // namespace comma::solver
