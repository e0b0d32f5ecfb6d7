#include "solver/fields/integrals/plane_section.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "solver/error.hpp"
#include "solver/fields/integrals/mass_inertia.hpp"

namespace comma::solver {

PlaneSection plane_section(const Model& model, std::span<const int> cells) {
  // A plate of thickness and density 1.
  IsotropicElasticity elasticity;
  elasticity.density = 1.0;
  auto material = std::make_shared<Material>();
  material->elasticity = elasticity;
  const MaterialField materials{
      std::vector<std::shared_ptr<const Material>>(model.formulations.size(), std::move(material)), {}};
  const ElementProperties properties;
  const VariableState state;
  const MassInertia plate = mass_inertia({model, materials, properties, state}, cells);
  if (!(plate.mass > 0.0))
    throw Error("empty-section", "the cells have no area", "name cells of a plane model (D_PLAN, C_PLAN)");
  return {plate.mass, plate.centre.head<2>(), {plate.inertia(0, 0), plate.inertia(1, 1), -plate.inertia(0, 1)}};
}

PlaneSection with_image(const PlaneSection& half, bool about_first) {
  Eigen::Vector2d centre = half.centre;
  centre[about_first ? 1 : 0] = 0.0;
  const AreaMoments about = moments_about(half, centre);
  return {2.0 * half.area, centre, {2.0 * about.first, 2.0 * about.second, 0.0}};
}

AreaMoments moments_about(const PlaneSection& section, const Eigen::Vector2d& point) {
  const Eigen::Vector2d arm = section.centre - point;
  return {section.moments.first + section.area * arm[1] * arm[1],
          section.moments.second + section.area * arm[0] * arm[0],
          section.moments.product + section.area * arm[0] * arm[1]};
}

PrincipalMoments principal_moments(const AreaMoments& moments) {
  const double mean = 0.5 * (moments.first + moments.second);
  const double half = 0.5 * (moments.second - moments.first);
  const double radius = std::hypot(half, moments.product);
  double angle = radius > 0.0 ? 0.5 * std::atan2(moments.product, half) : 0.0;
  if (angle < 0.0 && half < 0.0) angle += std::numbers::pi;
  return {angle, mean - radius, mean + radius};
}

}  // namespace comma::solver
