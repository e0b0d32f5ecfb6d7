#include "solver/fields/integrals/mass_inertia.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/mesh/axes.hpp"

namespace comma::solver {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What a node of a discrete element can do: translations 0 to 2, rotations 3 to 5.
std::vector<int> motions_of(Formulation formulation) {
  if (formulation == Formulation::spring_2d) return {0, 1};
  if (formulation == Formulation::spring_rotation_2d) return {0, 1, 5};
  if (formulation == Formulation::spring_rotation_3d) return {0, 1, 2, 3, 4, 5};
  return {0, 1, 2};
}

/// Of a place, by the translation and the rotation of a rigid body about the origin.
Matrix6 rigid_motion(const Point& at) {
  Matrix6 motion = Matrix6::Identity();
  motion.topRightCorner<3, 3>() << 0, at[2], -at[1], -at[2], 0, at[0], at[1], -at[0], 0;
  return motion;
}

/// Integrals of density times 1, x and x x^T.
class Moments {
 public:
  explicit Moments(const FieldInput& input)
      : input_(input), solid_points_(input.model, PointFamily::stiffness), points_(input.model, PointFamily::mass) {}

  void add(int cell) {
    if (points_.covers(cell)) return add_continuum(cell);
    switch (input_.model.formulations[cell]) {
      case Formulation::bar:
      case Formulation::bar_2d:
        return add_member(cell, false);
      case Formulation::euler_beam:
      case Formulation::timoshenko_beam:
        return add_member(cell, true);
      case Formulation::thin_plate:
      case Formulation::shear_plate:
        if (!input_.model.is_skin(cell)) add_plate(cell);
        return;
      default:
        return add_discrete(cell);
    }
  }

  MassInertia result() const {
    MassInertia result;
    result.mass = mass_;
    if (mass_ == 0.0) return result;
    result.centre = first_ / mass_;
    const Eigen::Matrix3d about_centre = second_ - mass_ * result.centre * result.centre.transpose();
    result.inertia = about_centre.trace() * Eigen::Matrix3d::Identity() - about_centre;
    return result;
  }

 private:
  void add_continuum(int cell) {
    const bool axisymmetric = is_axisymmetric(input_.model.formulations[cell]);
    const CellMaterial material = material_of(input_, cell);
    // Code_Aster has the mass of solids where their stresses are, on the one point of a TETRA4.
    ContinuumPoints& points = dimension(input_.model.mesh->cell_types[cell]) == 3 ? solid_points_ : points_;
    const auto& samples = points.samples(cell);
    for (std::size_t g = 0; g < samples.size(); ++g) {
      const ContinuumPoint point = points.locate(cell, samples[g]);
      const MaterialPoint at = points.material_point(cell, input_.state, samples[g], point.at, static_cast<int>(g));
      const double mass = point.weight * density(*material.elasticity, at);
      if (!axisymmetric) {
        add_mass(mass, point.at, point.at * point.at.transpose());
        continue;
      }
      // A ring, whose axis Code_Aster calls Z here: its mean x x^T spreads r^2 over X and Y alike.
      const double r = point.at[0];
      const double z = point.at[1];
      add_mass(2 * std::numbers::pi * mass, Eigen::Vector3d(0, 0, z),
               Eigen::Vector3d(0.5 * r * r, 0.5 * r * r, z * z).asDiagonal());
    }
  }

  void add_member(int cell, bool beam) {
    const Mesh& mesh = *input_.model.mesh;
    const auto nodes = mesh.cell(cell);
    const auto found = input_.properties.sections.find(cell);
    if (found == input_.properties.sections.end()) {
      throw Error("missing-properties",
                  fmt::format("the bar or beam on cell {} has no cross-section", mesh.cell_name(cell)));
    }
    const BeamSection& section = found->second;
    const Eigen::Matrix3d axes = own_axes(mesh, cell, section.roll);
    const Eigen::Vector3d a(mesh.nodes[nodes[0]].data());
    const Eigen::Vector3d b(mesh.nodes[nodes[1]].data());
    constexpr std::array<double, 2> half = {0.5, 0.5};
    MaterialPoint at;
    input_.state.sample(cell, nodes, half, VariableState::all_points, at);
    const double per_volume = density(*material_of(input_, cell).elasticity, at);
    const double length = (b - a).norm();
    // Areas of beams go with the square of the place at most, second moments with its fourth power: three points are
    // exact. Code_Aster 17.3 has the mass of a bar in its middle.
    static const Quadrature exact = quadrature(CellType::seg2, "FPG3"), middle = quadrature(CellType::seg2, "FPG1");
    for (const QuadraturePoint& point : beam ? exact : middle) {
      const double s = 0.5 * (1.0 + point.at[0]);
      const double volume_density = 0.5 * point.weight * length * per_volume;
      const BeamSection here = section_at(section, s);
      const Eigen::Vector3d x = (1.0 - s) * a + s * b;
      add_mass(volume_density * here.area, x, x * x.transpose());
      if (!beam) continue;
      // The second moment about the own y axis is the integral of z^2.
      const Eigen::Matrix3d own = Eigen::Vector3d(0.0, here.inertia_z, here.inertia_y).asDiagonal();
      second_ += volume_density * axes.transpose() * own * axes;
    }
  }

  void add_plate(int cell) {
    const Mesh& mesh = *input_.model.mesh;
    const auto found = input_.properties.plates.find(cell);
    if (found == input_.properties.plates.end())
      throw Error("missing-properties", fmt::format("the plate on cell {} has no thickness", mesh.cell_name(cell)));
    const CellType type = mesh.cell_types[cell];
    const auto nodes = mesh.cell(cell);
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t a = 0; a < nodes.size(); ++a)
      places.col(static_cast<Eigen::Index>(a)) = Eigen::Vector3d(mesh.nodes[nodes[a]].data());
    // Squares of places are of degree 2 on triangles, 3 with the area of a quadrangle.
    for (const QuadraturePoint& point : quadrature(type, nodes.size() == 3 ? "FPG3" : "FPG4")) {
      const Eigen::VectorXd shape = shape_functions(type, point.at);
      const Eigen::Matrix<double, 3, 2> tangents = places * shape_derivatives(type, point.at);
      const Eigen::Vector3d normal = tangents.col(0).cross(tangents.col(1));
      MaterialPoint at;
      input_.state.sample(cell, nodes, {shape.data(), static_cast<std::size_t>(shape.size())},
                          VariableState::all_points, at);
      const double thickness = found->second.thickness;
      const double mass = point.weight * normal.norm() * thickness * density(*material_of(input_, cell).elasticity, at);
      // Code_Aster has the middle on the surface of the mesh, wherever it lies.
      const Eigen::Vector3d x = places * shape, across = normal.normalized();
      add_mass(mass, x, x * x.transpose() + thickness * thickness / 12.0 * across * across.transpose());
    }
  }

  /// The mass matrix of a discrete element under the motions of a rigid body about the origin: mass, first moments and
  /// inertia.
  void add_discrete(int cell) {
    const auto found = input_.properties.masses.find(cell);
    if (found == input_.properties.masses.end()) return;
    const Mesh& mesh = *input_.model.mesh;
    const auto nodes = mesh.cell(cell);
    const std::vector<int> motions = motions_of(input_.model.formulations[cell]);
    const auto k = static_cast<Eigen::Index>(motions.size());
    Matrix6 whole = Matrix6::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        Matrix6 block = Matrix6::Zero();
        block(motions, motions) =
            found->second.block(static_cast<Eigen::Index>(a) * k, static_cast<Eigen::Index>(b) * k, k, k);
        // In the plane what would move across it is as heavy.
        if (std::ranges::find(motions, 2) == motions.end()) block(2, 2) = block(0, 0);
        whole += rigid_motion(mesh.nodes[nodes[a]]).transpose() * block * rigid_motion(mesh.nodes[nodes[b]]);
      }
    }
    const Eigen::Matrix3d turned = whole.topRightCorner<3, 3>();
    const Eigen::Matrix3d inertia = whole.bottomRightCorner<3, 3>();
    mass_ += whole.topLeftCorner<3, 3>().trace() / 3.0;
    first_ +=
        0.5 * Eigen::Vector3d(turned(1, 2) - turned(2, 1), turned(2, 0) - turned(0, 2), turned(0, 1) - turned(1, 0));
    second_ += 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
  }

  void add_mass(double mass, const Eigen::Vector3d& at, const Eigen::Matrix3d& square) {
    mass_ += mass;
    first_ += mass * at;
    second_ += mass * square;
  }

  const FieldInput& input_;
  ContinuumPoints solid_points_, points_;
  double mass_ = 0.0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

// Moments add up from squares of places: nearer to each other than this they are equal.
constexpr double same_moments = 1e-9;

Eigen::Vector3d pointing(const Eigen::Vector3d& axis) {
  constexpr double zero = 1e-9;
  for (const double component : axis)
    if (std::abs(component) > zero) return component > 0.0 ? axis : Eigen::Vector3d(-axis);
  return axis;
}

// The second and the third axis have two senses: they take that in which the roll is between -90 degrees and 90.
Eigen::Matrix3d least_rolled(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Eigen::Matrix3d axes;
  axes << first.transpose(), second.transpose(), first.cross(second).transpose();
  constexpr double quarter = std::numbers::pi / 2, rounding = 1e-9;
  const double roll = nautical_angles(axes)[2];
  if (roll > quarter + rounding || roll < -quarter + rounding) axes.bottomRows<2>() *= -1.0;
  return axes;
}

// Of the axes of the mesh the projection of the one that lies best across another axis.
Eigen::Vector3d first_axis_across(const Eigen::Vector3d& normal) {
  constexpr double rounding = 1e-9;  // axes that lie across equally well: the first
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) < std::abs(normal[best]) - rounding) best = i;
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(best);
  return (axis - axis.dot(normal) * normal).normalized();
}

}  // namespace

PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(inertia);
  const Eigen::Vector3d moments = solved.eigenvalues();
  const double tolerance = same_moments * std::abs(moments[2]);
  const bool low = moments[1] - moments[0] <= tolerance, high = moments[2] - moments[1] <= tolerance;
  if (low && high) return {moments, Eigen::Matrix3d::Identity()};
  const Eigen::Matrix3d found = solved.eigenvectors();
  const Eigen::Vector3d first = pointing(low ? first_axis_across(found.col(2)) : Eigen::Vector3d(found.col(0)));
  const Eigen::Vector3d second = low    ? Eigen::Vector3d(found.col(2)).cross(first)
                                 : high ? first_axis_across(first)
                                        : Eigen::Vector3d(found.col(1));
  return {moments, least_rolled(first, second)};
}

Eigen::Matrix3d inertia_about(const MassInertia& body, const Eigen::Vector3d& point) {
  const Eigen::Vector3d arm = body.centre - point;
  return body.inertia + body.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

MassInertia mass_inertia(const FieldInput& input, std::optional<std::span<const int>> cells) {
  Moments moments(input);
  if (cells) {
    for (const int cell : *cells) moments.add(cell);
  } else {
    for (int cell = 0; cell < input.model.mesh->cell_count(); ++cell) moments.add(cell);
  }
  return moments.result();
}

}  // namespace comma::solver
