#include "solver/contact/face_rule.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/contact/facet.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

double integral(CellType type, ContactRule rule, int order, int a, int b) {
  double sum = 0.0;
  for (const FacePoint& point : face_rule(type, rule, order))
    sum += point.weight * std::pow(point.xi[0], a) * std::pow(point.xi[1], b);
  return sum;
}

double even(int power) { return power % 2 == 0 ? 2.0 / (power + 1) : 0.0; }

}  // namespace

TEST_CASE("Gauss rules of n points integrate degree 2n - 1 on lines and squares") {
  for (int n = 1; n <= 8; ++n)
    for (int degree = 0; degree <= 2 * n - 1; ++degree) {
      CHECK(integral(CellType::seg2, ContactRule::gauss, n, degree, 0) == Approx(even(degree)).margin(1e-13));
      CHECK(integral(CellType::quad4, ContactRule::gauss, n, degree, 1) == Approx(0.0).margin(1e-13));
      CHECK(integral(CellType::quad4, ContactRule::gauss, n, degree, 0) == Approx(2 * even(degree)).margin(1e-13));
    }
}

TEST_CASE("Newton-Cotes rules integrate their degree, composite Simpson rules cubics") {
  for (int order = 1; order <= 8; ++order) {
    for (int degree = 0; degree <= order; ++degree)
      CHECK(integral(CellType::seg2, ContactRule::newton_cotes, order, degree, 0) ==
            Approx(even(degree)).margin(1e-11));
    for (int degree = 0; degree <= 3; ++degree)
      CHECK(integral(CellType::seg3, ContactRule::simpson, order, degree, 0) == Approx(even(degree)).margin(1e-13));
  }
}

TEST_CASE("Rules on triangles integrate polynomials of their degree") {
  const auto exact = [](int a, int b) {
    return std::tgamma(a + 1.0) * std::tgamma(b + 1.0) / std::tgamma(a + b + 3.0);
  };
  const auto check = [&](ContactRule rule, int order, int degree) {
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        CHECK(integral(CellType::tria3, rule, order, a, b) == Approx(exact(a, b)).epsilon(1e-11));
  };
  for (int order = 1; order <= 8; ++order) check(ContactRule::newton_cotes, order, order);
  const int gauss_degrees[] = {1, 2, 3, 4, 5, 6};
  for (int order = 1; order <= 6; ++order) check(ContactRule::gauss, order, gauss_degrees[order - 1]);
  // Corners and middles have no like weights of degree 2: linear functions, and what composition gains with the square
  // of the number of parts.
  for (int order = 1; order <= 4; ++order) check(ContactRule::simpson, order, 1);
  const double once = integral(CellType::tria3, ContactRule::simpson, 1, 2, 0) - exact(2, 0);
  for (int order = 2; order <= 4; ++order)
    CHECK((integral(CellType::tria3, ContactRule::simpson, order, 2, 0) - exact(2, 0)) * order * order ==
          exactly(once));
}

TEST_CASE("Every rule integrates one; the automatic ones lie on the nodes of linear faces") {
  for (const CellType type : {CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6, CellType::quad4,
                              CellType::quad8, CellType::quad9}) {
    const double measure = dimension(type) == 1 ? 2.0 : corner_count(type) == 3 ? 0.5 : 4.0;
    for (const ContactRule rule :
         {ContactRule::automatic, ContactRule::gauss, ContactRule::simpson, ContactRule::newton_cotes})
      CHECK(integral(type, rule, 0, 0, 0) == exactly(measure));
  }
  for (const CellType type : {CellType::seg2, CellType::tria3, CellType::quad4})
    for (const FacePoint& point : face_rule(type, ContactRule::automatic, 0)) {
      const auto shape = facet_shape(type, point.xi).values;
      CHECK(*std::max_element(shape.begin(), shape.end()) == exactly(1.0));
    }
}

TEST_CASE("The automatic rule of six-node triangles is of degree 4, each point nearest to the node it stands for") {
  CHECK(integral(CellType::tria6, ContactRule::automatic, 0, 2, 2) ==
        Approx(std::tgamma(3.0) * std::tgamma(3.0) / std::tgamma(7.0)));
  int node = 0;
  for (const FacePoint& point : face_rule(CellType::tria6, ContactRule::automatic, 0)) {
    const auto shape = facet_shape(CellType::tria6, point.xi).values;
    CHECK(std::max_element(shape.begin(), shape.begin() + 6) - shape.begin() == node);
    CHECK(point.stands_for == node++);
  }
}

TEST_CASE("An order that triangles have no Gauss rule of is an error") {
  CHECK_THROWS_AS(face_rule(CellType::tria3, ContactRule::gauss, 7), Error);
}
