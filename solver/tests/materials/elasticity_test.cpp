#include "solver/materials/elasticity.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

const IsotropicModuli steel{2.1e11, 0.3};

}  // namespace

TEST_CASE("uniaxial stress gives E and Poisson's ratio back", "[materials]") {
  const Eigen::Matrix<double, 6, 1> strain = solid_stiffness(steel).ldlt().solve(Eigen::Matrix<double, 6, 1>::Unit(0));
  CHECK(strain[0] == exactly(1.0 / steel.young));
  CHECK(strain[1] == exactly(-steel.poisson / steel.young));
  CHECK(strain[2] == exactly(-steel.poisson / steel.young));
}

TEST_CASE("plane stress is the three-dimensional law with no stress across the plane", "[materials]") {
  const Eigen::Matrix4d law = solid_stiffness(steel).topLeftCorner<4, 4>();
  Eigen::Matrix4d condensed = law - law.col(2) * law.row(2) / law(2, 2);
  CHECK((condensed - plane_stress_stiffness(steel)).cwiseAbs().maxCoeff() < 1e-14 * steel.young);
}

TEST_CASE("constants without an elastic body behind them are refused", "[materials]") {
  CHECK_NOTHROW(check_elasticity(steel));
  CHECK_NOTHROW(check_elasticity({1.0, 0.0}));
  for (const auto& wrong :
       {IsotropicModuli{0.0, 0.3}, IsotropicModuli{-1.0, 0.3}, IsotropicModuli{1.0, 0.5001}, IsotropicModuli{1.0, -1.0},
        IsotropicModuli{std::numeric_limits<double>::quiet_NaN(), 0.0}}) {
    CHECK_THROWS_AS(check_elasticity(wrong), Error);
  }
  // What keeps its volume has stresses in a plane without any across it, and none in space.
  CHECK_NOTHROW(check_elasticity({1.0, 0.5}));
  CHECK(plane_stress_stiffness(IsotropicModuli{3.0, 0.5})(0, 0) == 4.0);
  CHECK_THROWS_WITH(solid_stiffness(IsotropicModuli{1.0, 0.5}), Catch::Contains("keeps its volume"));
}

namespace {

OrthotropicElasticity wood() {
  OrthotropicElasticity material;
  material.young = {11000.0, 500.0, 800.0};
  material.poisson = {0.4, 0.35, 0.3};
  material.shear = {700.0, 600.0, 60.0};
  material.expansion = {5e-6, 35e-6, 25e-6};
  return material;
}

const Eigen::Matrix3d some_axes = nautical_axes(0.7, -0.4, 1.1);

}  // namespace

TEST_CASE("an orthotropic stress along L strains T and N by NU_LT / E_L and NU_LN / E_L", "[materials]") {
  const Elasticity elasticity = wood();
  const Vector6d strain = solid_compliance({&elasticity, nullptr}, MaterialPoint()) * Vector6d::Unit(0);
  CHECK(strain[0] == exactly(1.0 / 11000));
  CHECK(strain[1] == exactly(-0.4 / 11000));
  CHECK(strain[2] == exactly(-0.35 / 11000));
}

TEST_CASE("a plane body does without the moduli that it does not use", "[materials]") {
  const Elasticity whole = wood();
  OrthotropicElasticity flat = wood();
  flat.shear[1] = flat.shear[2] = 0.0;
  const Elasticity without_shears = flat;
  CHECK_THROWS_AS(solid_stiffness(CellMaterial{&without_shears}, MaterialPoint()), Error);
  const CellMaterial held{&without_shears, nullptr, AcrossPlane::held};
  CHECK((plane_strain_stiffness(held, MaterialPoint()) - plane_strain_stiffness(CellMaterial{&whole}, MaterialPoint()))
            .norm() < 1e-9);
  flat.young[2] = 0.0;
  const Elasticity without_any = flat;
  CHECK_THROWS_AS(plane_strain_stiffness(CellMaterial{&without_any, nullptr, AcrossPlane::held}, MaterialPoint()),
                  Error);
  const CellMaterial free{&without_any, nullptr, AcrossPlane::free};
  CHECK((plane_stress_stiffness(free, MaterialPoint()) - plane_stress_stiffness(CellMaterial{&whole}, MaterialPoint()))
            .norm() < 1e-9);
  // Stresses in the plane strain the thickness by NU_LN and NU_TN all the same.
  CHECK((solid_compliance(free, MaterialPoint()).topLeftCorner<3, 2>() -
         solid_compliance(CellMaterial{&whole}, MaterialPoint()).topLeftCorner<3, 2>())
            .norm() < 1e-15);
}

TEST_CASE("stiffness and compliance of turned axes are inverse, and the turned law is the turned stress",
          "[materials]") {
  const Elasticity elasticity = wood();
  const CellMaterial turned{&elasticity, &some_axes};
  const Matrix6d stiffness = solid_stiffness(turned, MaterialPoint());
  CHECK((stiffness * solid_compliance(turned, MaterialPoint()) - Matrix6d::Identity()).cwiseAbs().maxCoeff() < 1e-12);
  // The same by tensors: turn the strain into the axes, apply the law there, turn the stress back.
  Eigen::Matrix3d strain;
  strain << 1.0, 0.2, -0.3, 0.2, -0.5, 0.4, -0.3, 0.4, 0.7;
  const Eigen::Matrix3d own = some_axes * strain * some_axes.transpose();
  Vector6d own_strain;
  own_strain << own(0, 0), own(1, 1), own(2, 2), 2 * own(0, 1), 2 * own(0, 2), 2 * own(1, 2);
  const Vector6d s = solid_stiffness(CellMaterial{&elasticity, nullptr}, MaterialPoint()) * own_strain;
  const Eigen::Matrix3d own_stress =
      (Eigen::Matrix3d() << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2]).finished();
  const Eigen::Matrix3d stress = some_axes.transpose() * own_stress * some_axes;
  Vector6d global;
  global << strain(0, 0), strain(1, 1), strain(2, 2), 2 * strain(0, 1), 2 * strain(0, 2), 2 * strain(1, 2);
  const Vector6d found = stiffness * global;
  CHECK(found[0] == exactly(stress(0, 0)));
  CHECK(found[3] == exactly(stress(0, 1)));
  CHECK(found[4] == exactly(stress(0, 2)));
  CHECK(found[5] == exactly(stress(1, 2)));
}

TEST_CASE("an isotropic law written as an orthotropic one does not notice its axes", "[materials]") {
  OrthotropicElasticity material;
  material.young = {2.1e11, 2.1e11, 2.1e11};
  material.poisson = {0.3, 0.3, 0.3};
  const double shear = 2.1e11 / 2.6;
  material.shear = {shear, shear, shear};
  const Elasticity elasticity = material;
  const CellMaterial turned{&elasticity, &some_axes};
  const Matrix6d expected = solid_stiffness(steel);
  CHECK((solid_stiffness(turned, MaterialPoint()) - expected).cwiseAbs().maxCoeff() < 1e-13 * expected.maxCoeff());
  CHECK((plane_stress_stiffness(turned, MaterialPoint()) - plane_stress_stiffness(steel)).cwiseAbs().maxCoeff() <
        1e-13 * expected.maxCoeff());
}

TEST_CASE("transverse isotropy does not notice a turn about its axis N", "[materials]") {
  TransverseElasticity material;
  material.young = 11000.0;
  material.young_normal = 8000.0;
  material.poisson = 0.18;
  material.poisson_normal = 0.15;
  material.shear_normal = 7000.0;
  const Elasticity elasticity = as_orthotropic(material);
  const Eigen::Matrix3d axes = nautical_axes(0.83, 0.0, 0.0);
  const Matrix6d straight = solid_stiffness(CellMaterial{&elasticity, nullptr}, MaterialPoint());
  const Matrix6d turned = solid_stiffness(CellMaterial{&elasticity, &axes}, MaterialPoint());
  CHECK((turned - straight).cwiseAbs().maxCoeff() < 1e-12 * straight.maxCoeff());
}

TEST_CASE("constants that would give negative energy are refused", "[materials]") {
  OrthotropicElasticity material = wood();
  material.poisson[0] = 6.0;  // NU_LT^2 E_T / E_L > 1
  const Elasticity elasticity = material;
  CHECK_THROWS_WITH(solid_stiffness(CellMaterial{&elasticity, nullptr}, MaterialPoint()),
                    Catch::Contains("negative strain energy"));
}

TEST_CASE("thermal strain vanishes at the reference, and is measured on the length where expansion was",
          "[materials]") {
  // L(T) = L0 (1 + a (T - 20) + b (T - 20)^2): mean coefficients a + b (T - 20) from 20, and the strain from 100 on, on
  // L0.
  const double a = 1e-5;
  const double b = 4e-9;
  const auto stretch = [&](double t) { return 1 + a * (t - 20) + b * (t - 20) * (t - 20); };
  const Property mean([&](const MaterialPoint& at) { return a + b * (at[Parameter::temperature] - 20); });
  MaterialPoint at;
  at.reference(Parameter::temperature) = 100.0;
  for (const double t : {-50.0, 20.0, 100.0, 100.001, 700.0}) {
    at[Parameter::temperature] = t;
    CHECK(thermal_strain({mean, 20.0}, at) == Approx(stretch(t) - stretch(100.0)).margin(1e-15));
  }
  at[Parameter::temperature] = 700.0;
  CHECK(thermal_strain(2e-5, at) == exactly(2e-5 * 600));
  at.reference(Parameter::temperature) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(thermal_strain(2e-5, at), Catch::Contains("reference"));
}

TEST_CASE("concrete shrinks as it dries and as it hydrates", "[materials]") {
  IsotropicElasticity concrete{3e10, 0.2};
  concrete.drying_shrinkage = 1e-5;
  concrete.hydration_shrinkage = 8e-5;
  MaterialPoint at;
  at[Parameter::drying] = 70.0;
  at.reference(Parameter::drying) = 100.0;
  at[Parameter::hydration] = 0.5;
  CHECK(inelastic_axial_strain(concrete, at) == exactly(-30 * 1e-5 - 0.5 * 8e-5));
}

TEST_CASE("a property by a table names the variable that it misses", "[materials]") {
  TabulatedFunction table;
  table.x = {0.0, 100.0};
  table.y = {2e11, 1e11};
  const Property young = tabulated_property(table, Parameter::temperature);
  MaterialPoint at;
  CHECK_THROWS_WITH(young(at), Catch::Contains("temperature"));
  at[Parameter::temperature] = 25.0;
  CHECK(young(at) == exactly(1.75e11));
}

TEST_CASE("a strain that is known beforehand adds to what command variables cause, whatever the axes of the material") {
  MaterialPoint at;
  for (int i = 0; i < 6; ++i) at[strain_parameters[static_cast<std::size_t>(i)]] = 1e-3 * (i + 1);
  Vector6d expected;
  expected << 1e-3, 2e-3, 3e-3, 8e-3, 10e-3, 12e-3;  // shear angles are twice the components
  const Elasticity steel = IsotropicElasticity{2e11, 0.3};
  CHECK((inelastic_strain({&steel, nullptr}, at) - expected).norm() <= 1e-18);
  OrthotropicElasticity wood;
  wood.young = {1e10, 5e8, 4e8};
  wood.poisson = {0.3, 0.3, 0.4};
  wood.shear = {6e8, 6e8, 6e7};
  const Elasticity turned = wood;
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  CHECK((inelastic_strain({&turned, &axes}, at) - expected).norm() <= 1e-18);
  CHECK_THROWS_WITH(inelastic_axial_strain(std::get<IsotropicElasticity>(steel), at),
                    Catch::Contains("known beforehand"));
}
