#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/fields/integrals/mass_inertia.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

std::shared_ptr<const Material> dense(double density) {
  Material material;
  IsotropicElasticity elasticity{1.0, 0.0};
  elasticity.density = density;
  material.elasticity = elasticity;
  return std::make_shared<const Material>(material);
}

MassInertia of(const Body& body) {
  return mass_inertia({body.model, body.materials, body.properties, body.assembler->state()});
}

/// A brick a x b x c with its first corner at `corner`, as one cell of a quadratic type.
std::shared_ptr<Mesh> brick(const Point& corner, double a, double b, double c) {
  auto mesh = std::make_shared<Mesh>();
  std::vector<int> nodes;
  for (const auto& at : reference_nodes(CellType::hexa20)) {
    nodes.push_back(mesh->node_count());
    mesh->nodes.push_back(
        {corner[0] + a * (at[0] + 1) / 2, corner[1] + b * (at[1] + 1) / 2, corner[2] + c * (at[2] + 1) / 2});
  }
  mesh->add_cell(CellType::hexa20, nodes);
  return mesh;
}

}  // namespace

TEST_CASE("a brick: mass, centre and m (b^2 + c^2) / 12", "[fields]") {
  const MassInertia result = of(Body(brick({1, 2, 3}, 2, 4, 6), Formulation::solid, dense(10)));
  CHECK(result.mass == exactly(480));
  CHECK((result.centre - Eigen::Vector3d(2, 4, 6)).norm() < 1e-13);
  CHECK(result.inertia(0, 0) == exactly(480 * (16 + 36) / 12.0));
  CHECK(result.inertia(2, 2) == exactly(480 * (4 + 16) / 12.0));
  CHECK(result.inertia(0, 1) == Approx(0).margin(1e-10));
}

TEST_CASE("a hollow cylinder by its axisymmetric section", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{1, 0, 0}, {2, 0, 0}, {2, 3, 0}, {1, 3, 0}, {1.5, 0, 0}, {2, 1.5, 0}, {1.5, 3, 0}, {1, 1.5, 0}};
  mesh->add_cell(CellType::quad8, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  const MassInertia result = of(Body(mesh, Formulation::axisymmetric, dense(7)));
  const double mass = 7 * std::numbers::pi * (4 - 1) * 3;
  CHECK(result.mass == exactly(mass));
  CHECK((result.centre - Eigen::Vector3d(0, 0, 1.5)).norm() < 1e-13);  // the axis is Z
  CHECK(result.inertia(2, 2) == exactly(mass * (1 + 4) / 2));
  CHECK(result.inertia(0, 0) == exactly(mass * (3 * (1 + 4) + 9) / 12));
}

TEST_CASE("a slanted rod: m L^2 / 12 across it, its section along it", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {3, 4, 0}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  BeamSection section;
  section.area = 0.5;
  section.inertia_y = 0.02;
  section.inertia_z = 0.03;
  section.torsion = 0.04;
  properties.sections[0] = section;
  const MassInertia result = of(Body(mesh, std::vector{Formulation::euler_beam}, dense(8), properties));
  CHECK(result.mass == exactly(20));
  const Eigen::Vector3d along(0.6, 0.8, 0);
  CHECK(along.dot(result.inertia * along) == exactly(8 * 5 * (0.02 + 0.03)));
  CHECK(result.inertia(2, 2) == exactly(20 * 25 / 12.0 + 8 * 5 * 0.03));
  // As a bar all of it is in the middle.
  const MassInertia bar = of(Body(mesh, std::vector{Formulation::bar}, dense(8), properties));
  CHECK(bar.mass == exactly(20));
  CHECK(bar.inertia.norm() < 1e-12 * 20 * 25);
}

TEST_CASE("inertia about a corner, and principal moments of a turned brick", "[fields]") {
  const MassInertia brick_mass = of(Body(brick({0, 0, 0}, 2, 4, 6), Formulation::solid, dense(10)));
  // m (b^2 + c^2) / 3 about an edge, -m a b / 4 for the product.
  const Eigen::Matrix3d corner = inertia_about(brick_mass, Eigen::Vector3d::Zero());
  CHECK(corner(0, 0) == exactly(480 * (16 + 36) / 3.0));
  CHECK(corner(0, 1) == exactly(-480 * 2 * 4 / 4.0));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d moments = principal_inertia(turn * brick_mass.inertia * turn.transpose()).moments;
  CHECK(moments[0] == exactly(480 * (4 + 16) / 12.0));
  CHECK(moments[2] == exactly(480 * (16 + 36) / 12.0));
}

TEST_CASE("a slanted plate with an offset: a slab about the surface of the mesh", "[fields]") {
  for (const bool quad : {false, true}) {
    auto mesh = std::make_shared<Mesh>();
    // A 4 x 5 rectangle, or the half of it, whose second side is (0, 3, 4).
    mesh->nodes = {{0, 0, 0}, {4, 0, 0}, {4, 3, 4}, {0, 3, 4}};
    if (quad) mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
    if (!quad) mesh->add_cell(CellType::tria3, std::array{0, 1, 2});
    ElementProperties properties;
    properties.plates[0] = {.thickness = 0.1, .offset = 0.5};
    const MassInertia result = of(Body(mesh, std::vector{Formulation::thin_plate}, dense(7), properties));
    const double mass = (quad ? 1.0 : 0.5) * 7 * 0.1 * 20;
    CHECK(result.mass == exactly(mass));
    // The normal is (0, -0.8, 0.6).
    const Eigen::Vector3d middle = quad ? Eigen::Vector3d(2, 1.5, 2) : Eigen::Vector3d(8.0 / 3, 1, 4.0 / 3);
    CHECK((result.centre - middle).norm() < 1e-13);
    const double share = quad ? 1.0 / 12 : 1.0 / 18;
    CHECK(result.inertia(0, 0) == exactly(mass * (25 * share + 0.1 * 0.1 / 12)));
    const Eigen::Vector3d normal(0, -0.8, 0.6);
    CHECK(normal.dot(result.inertia * normal) == exactly(mass * (16 + 25) * share));
  }
}

TEST_CASE("discrete masses: a point with an offset and a tensor, a segment with one at each end, a point in the plane",
          "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{1, 2, 3}, {0, 0, 0}, {4, 0, 0}, {0, 5, 0}};
  mesh->add_cell(CellType::poi1, std::array{0});
  mesh->add_cell(CellType::seg2, std::array{1, 2});
  mesh->add_cell(CellType::poi1, std::array{3});
  const std::vector kinds = {Formulation::spring_rotation_3d, Formulation::spring_3d, Formulation::spring_2d};
  const Eigen::Matrix3d tensor = Eigen::Vector3d(0.3, 0.4, 0.5).asDiagonal();
  const std::vector<DiscreteInertia> inertias = {
      {.mass = 5.0, .tensor = tensor, .offset = {0, 0, 2}}, {.mass = 6.0}, {.mass = 7.0}};
  const std::vector<Eigen::Vector3d> centres = {{1, 2, 5}, {2, 0, 0}, {0, 5, 0}};
  const std::vector<Eigen::Matrix3d> about_centres = {tensor, Eigen::Vector3d(0, 48, 48).asDiagonal(),
                                                      Eigen::Matrix3d::Zero()};
  for (int cell = 0; cell < 3; ++cell) {
    const auto k = static_cast<std::size_t>(cell);
    ElementProperties properties;
    for (int each = 0; each < 3; ++each) {
      const Formulation kind = kinds[static_cast<std::size_t>(each)];
      const std::vector<double> ones(static_cast<std::size_t>(discrete_components(kind)), 1.0);
      properties.discrete[each] = diagonal_stiffness(*mesh, each, kind, ones, DiscreteFrame::global);
    }
    properties.masses[cell] = rigid_mass(*mesh, cell, kinds[k], inertias[k], DiscreteFrame::global);
    const MassInertia result = of(Body(mesh, kinds, dense(1), properties));
    const double count = mesh->cell(cell).size() == 2 ? 2.0 : 1.0;
    CHECK(result.mass == Approx(count * inertias[k].mass).epsilon(1e-12));
    CHECK((result.centre - centres[k]).norm() < 1e-12);
    CHECK((result.inertia - about_centres[k]).norm() < 1e-10);
  }
}

TEST_CASE("principal axes are those that an inertia was turned by", "[fields]") {
  const Eigen::Vector3d moments(1.0, 2.0, 4.0), angles(0.4, -0.7, 0.3);
  const Eigen::Matrix3d axes = nautical_axes(angles[0], angles[1], angles[2]);
  const PrincipalInertia found = principal_inertia(axes.transpose() * moments.asDiagonal() * axes);
  CHECK((found.moments - moments).norm() < 1e-14);
  CHECK((nautical_angles(found.axes) - angles).norm() < 1e-14);
}

TEST_CASE("equal moments have axes along those of the mesh", "[fields]") {
  CHECK(principal_inertia(3.0 * Eigen::Matrix3d::Identity()).axes == Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d upright = Eigen::Vector3d(5.0, 5.0, 1.0).asDiagonal();  // a rod along Z
  const Eigen::Vector3d angles = nautical_angles(principal_inertia(upright).axes);
  CHECK((angles - std::numbers::pi / 2 * Eigen::Vector3d(0, -1, 1)).norm() < 1e-14);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.0, 0.6, 0.8);  // a square plate across it, but for rounding
  Eigen::Matrix3d square = Eigen::Matrix3d::Identity() + normal * normal.transpose();
  square(0, 1) = square(1, 0) = 1e-13;
  const Eigen::Matrix3d axes = principal_inertia(square).axes;
  CHECK((axes - nautical_axes(0.0, 0.0, std::atan2(-0.6, 0.8))).norm() < 1e-9);
}
