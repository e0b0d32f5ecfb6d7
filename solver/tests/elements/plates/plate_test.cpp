#include <catch2/catch.hpp>

#include <numbers>

#include "solver/elements/plates/plate_axes.hpp"
#include "solver/error.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace plate_test {

constexpr double young = 2e11;
constexpr double poisson = 0.3;
constexpr Formulation both[] = {Formulation::thin_plate, Formulation::shear_plate};
constexpr CellType cells[] = {CellType::tria3, CellType::quad4};

/// Where a point (x, y) of the plate lies in space: turned about all axes, so that no component is special.
struct Place {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows

  Point at(double x, double y) const {
    const Eigen::Vector3d p = axes.transpose() * Eigen::Vector3d(x, y, 0.0);
    return {p[0], p[1], p[2]};
  }
};

Place tilted() {
  return {(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
              .toRotationMatrix()
              .transpose()};
}

/// A rectangle in n x m quadrangles, or twice as many triangles; `shift` moves the nodes inside off the regular grid.
std::shared_ptr<Mesh> rectangle(CellType type, double length, double width, int n, int m, double shift,
                                const Place& place) {
  auto mesh = std::make_shared<Mesh>();
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < m;
      const double move = inside ? shift : 0.0;
      mesh->nodes.push_back(
          place.at(length / n * (i + move * std::sin(3.0 * i + j)), width / m * (j + move * std::cos(2.0 * j - i))));
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (type == CellType::quad4) mesh->add_cell(type, std::array{a, b, c, d});
      if (type != CellType::tria3) continue;
      mesh->add_cell(type, std::array{a, b, c});
      mesh->add_cell(type, std::array{a, c, d});
    }
  }
  return mesh;
}

Body plate(const std::shared_ptr<Mesh>& mesh, Formulation formulation, const PlateSection& section,
           double nu = poisson) {
  ElementProperties properties;
  for (int cell = 0; cell < mesh->cell_count(); ++cell) properties.plates[cell] = section;
  return Body(mesh, std::vector<Formulation>(mesh->cell_types.size(), formulation), elastic(young, nu), properties);
}

/// Displacements and rotations given in the plate's axes as a function of x and y there.
template <class F>
Eigen::VectorXd displacements(const Body& body, const Place& place, F&& field) {
  Eigen::VectorXd u(body.dofs->size());
  for (int node = 0; node < body.model.mesh->node_count(); ++node) {
    const Eigen::Vector3d at = place.axes * Eigen::Map<const Eigen::Vector3d>(body.model.mesh->nodes[node].data());
    const Eigen::Matrix<double, 6, 1> own = field(at[0], at[1]);
    u.segment<3>(6 * node) = place.axes.transpose() * own.head<3>();
    u.segment<3>(6 * node + 3) = place.axes.transpose() * own.tail<3>();
  }
  return u;
}

using Six = Eigen::Matrix<double, 6, 1>;

/// Displacements of constant strain e and curvature k, (xx, yy, 2 xy) each.
auto constant_strains(const Eigen::Vector3d& e, const Eigen::Vector3d& k) {
  return [e, k](double x, double y) {
    Six u;
    const double beta_x = k[0] * x + 0.5 * k[2] * y, beta_y = k[1] * y + 0.5 * k[2] * x;
    u << e[0] * x + 0.5 * e[2] * y, e[1] * y + 0.5 * e[2] * x, -0.5 * (k[0] * x * x + k[1] * y * y + k[2] * x * y),
        -beta_y, beta_x, 0.0;
    return u;
  };
}

Eigen::Matrix3d plane_law(double rigidity) {
  Eigen::Matrix3d law;
  law << 1, poisson, 0, poisson, 1, 0, 0, 0, 0.5 * (1 - poisson);
  return rigidity * law;
}

/// Displacements where the degrees of freedom for which `held` says so are kept at 0.
template <class Held>
Eigen::VectorXd solve(const Body& body, const Eigen::VectorXd& force, Held&& held) {
  std::vector<int> free;
  for (int dof = 0; dof < body.dofs->size(); ++dof) {
    if (!held(body.model.mesh->nodes[body.dofs->node_of(dof)], body.dofs->component_of(dof))) free.push_back(dof);
  }
  const Eigen::MatrixXd k = body.dense_stiffness();
  Eigen::VectorXd u = body.zero();
  const Eigen::VectorXd moved = Eigen::MatrixXd(k(free, free)).ldlt().solve(Eigen::VectorXd(force(free)));
  u(free) = moved;
  return u;
}

TEST_CASE("the stiffness of a plate does not depend on the unit of length", "[elements]") {
  constexpr double unit = 1e-4;
  for (const Formulation formulation : both) {
    for (const CellType type : {CellType::tria3, CellType::quad4}) {
      CAPTURE(name_of(type));
      const auto stiffness = [&](double scale) {
        const PlateSection section{
            .thickness = 1e-3 * scale, .offset = 2e-4 * scale, .direction = Eigen::Vector3d::UnitX(), .drilling = 0.0};
        return plate(rectangle(type, 0.3 * scale, 0.2 * scale, 1, 1, 0.0, {}), formulation, section).dense_stiffness();
      };
      const Eigen::MatrixXd one = stiffness(1.0), other = stiffness(unit);
      // Translations by translations, translations by rotations, rotations by rotations.
      std::array<double, 3> largest{}, off{};
      for (Eigen::Index i = 0; i < one.rows(); ++i) {
        for (Eigen::Index j = 0; j < one.cols(); ++j) {
          const std::size_t rotations = (i % 6 >= 3) + (j % 6 >= 3);
          largest[rotations] = std::max(largest[rotations], std::abs(one(i, j)));
          off[rotations] = std::max(
              off[rotations], std::abs(one(i, j) - other(i, j) / std::pow(unit, 1.0 + static_cast<double>(rotations))));
        }
      }
      for (std::size_t kind = 0; kind < 3; ++kind) CHECK(off[kind] <= 2e-14 * largest[kind]);
    }
  }
}

// Code_Aster leaves out of the shear force how the map of a quadrangle varies, which costs quadrangles that are no
// parallelograms a shear force under constant curvature and, where shear deforms them, the exact curvature.
TEST_CASE("plates have constant strains and curvatures exactly, on distorted meshes, in the axes asked for",
          "[elements]") {
  const Place place = tilted();
  const Eigen::Vector3d e(1e-4, -3e-4, 2e-4), k(2e-3, 1e-3, -3e-3);
  const double h = 0.05, offset = 0.02;
  const double membrane = young * h / (1 - poisson * poisson);
  for (const Formulation formulation : both) {
    for (const CellType type : cells) {
      const PlateSection section{
          .thickness = h, .offset = offset, .direction = place.axes.row(0).transpose(), .drilling = 0.0};
      const bool distorted = type == CellType::tria3 || formulation == Formulation::thin_plate;
      const Body body = plate(rectangle(type, 2.0, 1.5, 3, 3, distorted ? 0.25 : 0.0, place), formulation, section);
      const Eigen::VectorXd u = displacements(body, place, constant_strains(e, k));
      const Eigen::Vector3d normal = plane_law(membrane) * (e + offset * k);
      const Eigen::Vector3d moment = plane_law(membrane * h * h / 12) * k + offset * normal;
      const ElementField forces = body.assembler->plate_forces(u, PlatePlaces::corners, {}, 0.0);
      for (int cell = 0; cell < body.model.mesh->cell_count(); ++cell) {
        for (int point = 0; point < forces.points(cell); ++point) {
          for (int c = 0; c < 3; ++c) {
            CHECK(std::abs(forces.at(cell, point, c) - normal[c]) < 1e-9 * normal.norm());
            CHECK(std::abs(forces.at(cell, point, 3 + c) - moment[c]) < 1e-9 * moment.norm());
          }
          const bool is_exact = type == CellType::tria3 || !distorted;
          for (int c = 6; is_exact && c < 8; ++c) CHECK(std::abs(forces.at(cell, point, c)) < 1e-9 * moment.norm());
        }
      }
      // Energy per area: the exact one, everywhere.
      const ElementField energies = body.assembler->elastic_energies(u);
      const auto whole = [&](const char* name) { return sum_over_cells(energies, energies.component(name)); };
      const double density = 0.5 * (normal.dot(e) + moment.dot(k));
      CHECK(whole("TOTALE") == Approx(3.0 * density).epsilon(1e-10));
      const Eigen::Vector3d of_surface = plane_law(membrane) * e, of_curvature = plane_law(membrane) * k;
      const double about_surface = h * h / 12 + offset * offset;
      CHECK(whole("MEMBRANE") == Approx(1.5 * of_surface.dot(e)).epsilon(1e-10));
      CHECK(whole("FLEXION") == Approx(1.5 * about_surface * of_curvature.dot(k)).epsilon(1e-10));
      CHECK(whole("COUPL_MF") == Approx(3.0 * offset * of_surface.dot(k)).epsilon(1e-10));
      CHECK(std::abs(whole("CISAILLE")) < 1e-10 * density);
    }
  }
}

// Of thin plates alone: the rotations of plates with shear differ between cells that share a side, which costs them
// this equilibrium on distorted meshes (Batoz and Katili, 1992).
TEST_CASE("nodes inside a thin plate of constant strain and curvature are in equilibrium", "[elements]") {
  const Place place = tilted();
  for (const CellType type : cells) {
    const Body body = plate(rectangle(type, 2.0, 1.5, 3, 3, 0.25, place), Formulation::thin_plate,
                            {.thickness = 0.05, .offset = 0.02, .drilling = 0.0});
    const Eigen::VectorXd u = displacements(body, place, constant_strains({1e-4, -3e-4, 2e-4}, {2e-3, 1e-3, -3e-3}));
    const Eigen::VectorXd forces = body.assembler->internal_forces(u);
    for (const int node : {5, 6, 9, 10}) CHECK(forces.segment<6>(6 * node).norm() < 1e-9 * forces.norm());
  }
}

TEST_CASE("a plate has six motions without energy and none more once its normal rotation is tied", "[elements]") {
  const Place place = tilted();
  for (const Formulation formulation : both) {
    for (const CellType type : cells) {
      const Body body = plate(rectangle(type, 2.0, 1.5, 2, 2, 0.2, place), formulation,
                              {.thickness = 0.1, .offset = 0.03, .drilling = -1e-2});
      const Eigen::VectorXd values = symmetric_eigen(body.dense_stiffness()).values;
      CHECK(values.head(6).cwiseAbs().maxCoeff() < 1e-12 * values.maxCoeff());
      CHECK(values[6] > 1e-7 * values.maxCoeff());
      const auto u = body.displacements([](const Point&, int c) { return c < 3 ? 1.0 / 3 + c : 0.0; });
      CHECK(body.assembler->internal_forces(u).norm() == 0.0);
    }
  }
}

TEST_CASE("rotation about the normal is free, tied to the membrane, or held against the ground", "[elements]") {
  const auto energy_of_spin = [](double drilling, bool rigid) {
    const Body body = plate(rectangle(CellType::quad4, 1.0, 1.0, 1, 1, 0.0, {}), Formulation::thin_plate,
                            {.thickness = 0.1, .drilling = drilling});
    const Eigen::VectorXd u = displacements(body, {}, [&](double x, double y) {
      Six spin;
      spin << (rigid ? -y : 0.0), (rigid ? x : 0.0), 0.0, 0.0, 0.0, 1.0;
      return spin;
    });
    return 0.5 * u.dot(body.dense_stiffness() * u);
  };
  CHECK(std::abs(energy_of_spin(0.0, false)) < 1e-12);
  CHECK(energy_of_spin(-1e-3, false) == exactly(0.5 * 1e-3 * young * 0.1));  // 1/2 |c| E h A (theta_z - spin)^2
  CHECK(std::abs(energy_of_spin(-1e-3, true)) < 1e-9 * energy_of_spin(-1e-3, false));
  // The body turns with it, and the far larger forces of its membrane cancel.
  CHECK(energy_of_spin(2e-5, true) == Approx(2 * energy_of_spin(1e-5, true)).epsilon(1e-6));
  CHECK(energy_of_spin(1e-5, true) > 0.0);
}

TEST_CASE("what holds the normal rotation of a plate does not depend on the axes asked for", "[elements]") {
  for (const Formulation formulation : both) {
    for (const CellType type : cells) {
      CAPTURE(name_of(type));
      const auto stiffness = [&](const Eigen::Vector3d& direction) {
        return plate(rectangle(type, 3.0, 1.0, 2, 2, 0.2, tilted()), formulation,
                     {.thickness = 0.1, .direction = direction, .drilling = 1e-2})
            .dense_stiffness();
      };
      const Eigen::MatrixXd one = stiffness(Eigen::Vector3d::UnitX());
      CHECK((one - stiffness(Eigen::Vector3d(1.0, 2.0, 0.5))).cwiseAbs().maxCoeff() <
            1e-12 * one.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("two plates that lie on each other are one of twice the thickness", "[elements]") {
  // Huygens and Steiner: 2 (h^3 / 12 + h (h / 2)^2) = (2 h)^3 / 12, and the couplings cancel.
  const Place place = tilted();
  const double h = 0.04;
  for (const CellType type : cells) {
    const auto mesh = rectangle(type, 2.0, 1.5, 2, 2, 0.2, place);
    const auto stiffness = [&](double thickness, double offset) {
      return plate(mesh, Formulation::thin_plate, {.thickness = thickness, .offset = offset, .drilling = 0.0})
          .dense_stiffness();
    };
    const Eigen::MatrixXd one = stiffness(2 * h, 0.0);
    CHECK((stiffness(h, 0.5 * h) + stiffness(h, -0.5 * h) - one).norm() < 1e-12 * one.norm());
  }
}

TEST_CASE("a strip bends like a beam, and shears like one where the plate knows shear", "[elements]") {
  const double length = 2.0, width = 0.5, h = 0.2, load = 1e5;
  const double bending = load * std::pow(length, 3) / (3 * young * width * h * h * h / 12);
  const double shear = load * length / (5.0 / 6.0 * 0.5 * young * width * h);  // Poisson's ratio 0
  for (const Formulation formulation : both) {
    const Body body =
        plate(rectangle(CellType::quad4, length, width, 4, 1, 0.0, {}), formulation, {.thickness = h}, 0.0);
    Eigen::VectorXd force = body.zero();
    for (const int node : {4, 9}) force[body.dofs->dof(node, Component::dz)] = 0.5 * load;
    const Eigen::VectorXd u = solve(body, force, [](const Point& at, Component) { return at[0] == 0.0; });
    CHECK(u[body.dofs->dof(4, Component::dz)] ==
          Approx(bending + (formulation == Formulation::shear_plate ? shear : 0.0)).epsilon(1e-8));
    const ElementField forces = body.assembler->plate_forces(u, PlatePlaces::corners, {}, 0.0);
    for (int cell = 0; cell < 4; ++cell) {
      for (int point = 0; point < 4; ++point) {
        const double x = body.model.mesh->nodes[body.model.mesh->cell(cell)[point]][0];
        CHECK(std::abs(forces.at(cell, point, 3) - load / width * (x - length)) < 1e-7 * load / width * length);
        CHECK(std::abs(forces.at(cell, point, 6) - load / width) < 1e-7 * load / width);
      }
    }
  }
}

/// The deflection at the middle of a simply supported square of side 1 under a pressure of 1 (Navier's series;
/// Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 30; with shear as for any simply supported
/// polygon).
double navier(double bending, double shear) {
  double sum = 0.0;
  for (int m = 1; m < 200; m += 2) {
    for (int n = 1; n < 200; n += 2) {
      const double wave = std::numbers::pi * std::numbers::pi * (m * m + n * n);
      const double load = 16.0 / (std::numbers::pi * std::numbers::pi * m * n);
      const double sign = ((m + n) / 2) % 2 == 1 ? 1.0 : -1.0;
      sum += sign * load * (1.0 / (bending * wave * wave) + shear / wave);
    }
  }
  return sum;
}

/// The same by a quarter of the plate in n x n parts.
double quarter(CellType type, Formulation formulation, double h, int n) {
  const double half = 0.5, part = half / n;
  const Body body = plate(rectangle(type, half, half, n, n, 0.0, {}), formulation, {.thickness = h});
  Eigen::VectorXd force = body.zero();
  for (int node = 0; node < body.model.mesh->node_count(); ++node) {
    const Point& at = body.model.mesh->nodes[node];
    const double share = (at[0] == 0.0 || at[0] == half ? 0.5 : 1.0) * (at[1] == 0.0 || at[1] == half ? 0.5 : 1.0);
    force[body.dofs->dof(node, Component::dz)] = share * part * part;
  }
  const Eigen::VectorXd u = solve(body, force, [&](const Point& at, Component c) {
    const bool side_x = at[0] == half, side_y = at[1] == half, middle_x = at[0] == 0.0, middle_y = at[1] == 0.0;
    switch (c) {
      case Component::dx:
      case Component::dy:
      case Component::drz:
        return true;
      case Component::dz:
        return side_x || side_y;
      case Component::drx:
        return side_x || middle_y;
      default:
        return side_y || middle_x;
    }
  });
  return u[body.dofs->dof(0, Component::dz)];
}

TEST_CASE("a simply supported square plate bends as Navier's series says", "[elements]") {
  for (const double h : {0.01, 0.2}) {
    for (const Formulation formulation : both) {
      const double bending = young * h * h * h / (12 * (1 - poisson * poisson));
      const bool shears = formulation == Formulation::shear_plate;
      const double exact = navier(bending, shears ? 1.0 / (5.0 / 6.0 * young / (2 * (1 + poisson)) * h) : 0.0);
      if (!shears) CHECK(exact * bending == Approx(0.00406).epsilon(1e-3));  // Timoshenko's table 8
      for (const CellType type : cells) {
        CAPTURE(h, shears, name_of(type));
        const double coarse = std::abs(quarter(type, formulation, h, 3) / exact - 1);
        const double fine = std::abs(quarter(type, formulation, h, 6) / exact - 1);
        CHECK(fine < 0.01);
        CHECK(fine < 0.5 * coarse);
      }
    }
  }
}

TEST_CASE("a warped quadrangle is the plate on its mean plane", "[elements]") {
  const auto flat = rectangle(CellType::quad4, 2.0, 1.0, 1, 1, 0.0, {}),
             saddle = rectangle(CellType::quad4, 2.0, 1.0, 1, 1, 0.0, {});
  for (const int node : {0, 3}) saddle->nodes[node][2] = 0.05;
  for (const int node : {1, 2}) saddle->nodes[node][2] = -0.05;
  CHECK(warp_of_plate(*flat, 0) == 0.0);
  CHECK(warp_of_plate(*saddle, 0) == Approx(0.1 / std::hypot(2.0, 1.0)));
  for (const Formulation formulation : {Formulation::thin_plate, Formulation::shear_plate}) {
    const Eigen::MatrixXd expected = plate(flat, formulation, {.thickness = 0.1}).dense_stiffness();
    CHECK((plate(saddle, formulation, {.thickness = 0.1}).dense_stiffness() - expected).norm() <
          1e-12 * expected.norm());
  }
}

TEST_CASE("plates that cannot be are errors", "[elements]") {
  const auto code_of = [](auto&& make) -> std::string {
    try {
      make();
    } catch (const Error& error) {
      return error.code();
    }
    return "";
  };
  const auto square = [] { return rectangle(CellType::quad4, 1.0, 1.0, 1, 1, 0.0, {}); };
  CHECK(code_of([&] { plate(square(), Formulation::thin_plate, {.thickness = 0.0}); }) == "invalid-properties");
  CHECK(code_of([&] {
          plate(square(), Formulation::thin_plate, {.thickness = 0.1, .direction = {0, 0, 1}});
        }) == "zero-vector");
  CHECK(code_of([&] { Body(square(), Formulation::thin_plate, elastic(young, poisson)); }) == "missing-properties");
  const auto dart = square();
  dart->nodes[3] = {0.1, 0.1, 0.0};
  dart->nodes[0] = {0.3, 0.3, 0.0};
  CHECK(code_of([&] { plate(dart, Formulation::thin_plate, {.thickness = 0.1}); }) == "distorted-cell");
}

TEST_CASE("a normal rotation that is tied does not follow the parasitic spin of bilinear functions", "[plate]") {
  // Pure in-plane bending u = x y, v = -x^2 / 2 about the middle of a square: at its nodes v is the same, so that the
  // bilinear spin is -x / 2 where that of the surface is -x. Both vanish on average, and so does the rotation that is
  // tied to them.
  const Body body = plate(rectangle(CellType::quad4, 2.0, 2.0, 1, 1, 0.0, {}), Formulation::thin_plate,
                          {.thickness = 0.1, .drilling = -1e-3});
  const auto tie_energy = [&](const Eigen::VectorXd& u) {
    const Body untied = plate(rectangle(CellType::quad4, 2.0, 2.0, 1, 1, 0.0, {}), Formulation::thin_plate,
                              {.thickness = 0.1, .drilling = 0.0});
    return 0.5 * u.dot((body.dense_stiffness() - untied.dense_stiffness()) * u);
  };
  const Eigen::VectorXd bent = displacements(body, {}, [](double x, double y) {
    Six motion;
    motion << (x - 1.0) * (y - 1.0), -0.5 * (x - 1.0) * (x - 1.0), 0.0, 0.0, 0.0, 0.0;
    return motion;
  });
  CHECK(std::abs(tie_energy(bent)) < 1e-12 * 1e-3 * young * 0.1);
}

TEST_CASE("plates that go on softer keep the stresses that they had", "[plate]") {
  const Place place = tilted();
  for (const Formulation formulation : both) {
    for (const CellType type : cells) {
      const auto mesh = rectangle(type, 2.0, 1.0, 2, 2, 0.1, place);
      const PlateSection section{.thickness = 0.1, .offset = 0.02, .layers = 2, .drilling = 0.0};
      const Body hard = plate(mesh, formulation, section);
      const Body soft(mesh, std::vector<Formulation>(mesh->cell_types.size(), formulation),
                      elastic(0.25 * young, poisson), hard.properties);
      Eigen::VectorXd u = hard.zero();
      for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = 1e-3 * std::cos(2.0 * static_cast<double>(i));
      const Eigen::VectorXd forces = hard.assembler->internal_forces(u);
      ElementField stresses = hard.assembler->stresses(u);
      soft.assembler->resume(u, &stresses, nullptr);
      CHECK((soft.assembler->internal_forces(u) - forces).norm() < 1e-12 * forces.norm());
      CHECK((soft.assembler->internal_forces(3.0 * u) - 1.5 * forces).norm() < 1e-12 * forces.norm());
      const Eigen::Map<const Eigen::VectorXd> given(stresses.values.data(),
                                                    static_cast<Eigen::Index>(stresses.values.size()));
      const ElementField kept = soft.assembler->stresses(u);
      CHECK((Eigen::Map<const Eigen::VectorXd>(kept.values.data(), given.size()) - given).norm() <
            1e-12 * given.norm());
      // No forces have a stress at one place of the thickness alone.
      stresses.values.assign(stresses.values.size(), 0.0);
      stresses.values.front() = 1e9;
      CHECK_THROWS_WITH(soft.assembler->resume(u, &stresses, nullptr), Catch::Contains("elastic plate"));
    }
  }
}

}  // namespace plate_test
