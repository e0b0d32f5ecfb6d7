#include "solver/functions/operations.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

using Pointers = std::vector<const TabulatedFunction*>;

const TabulatedFunction line{.x = {0.0, 1.0, 4.0}, .y = {1.0, 3.0, 9.0}};  // 1 + 2 x
const TabulatedFunction bump{.x = {0.0, 2.0, 4.0}, .y = {0.0, 4.0, 0.0}};

/// x^2 at equal steps.
TabulatedFunction parabola() {
  TabulatedFunction f;
  for (int i = 0; i <= 10; ++i) {
    f.x.push_back(0.1 * i);
    f.y.push_back(0.01 * i * i);
  }
  return f;
}

}  // namespace

TEST_CASE("a combination goes through the points of all its functions", "[functions]") {
  const TabulatedFunction f = combination(Pointers{&line, &bump}, std::array{2.0, -1.0});
  CHECK(f.x == std::vector<double>{0.0, 1.0, 2.0, 4.0});
  for (const double x : {0.0, 0.7, 1.5, 3.3, 4.0}) CHECK(f(x) == exactly(2.0 * line(x) - bump(x)));
}

TEST_CASE("a combination ends where one of its functions excludes, and goes on where it may", "[functions]") {
  TabulatedFunction shorter{.x = {1.0, 3.0}, .y = {1.0, 1.0}};
  CHECK(common_abscissas(Pointers{&line, &shorter}) == std::vector<double>{1.0, 3.0});
  shorter.right = Extension::constant;
  CHECK(common_abscissas(Pointers{&line, &shorter}) == std::vector<double>{1.0, 3.0, 4.0});
  const TabulatedFunction apart{.x = {5.0, 6.0}, .y = {1.0, 1.0}};
  CHECK_THROWS_AS(common_abscissas(Pointers{&line, &apart}), Error);
  const TabulatedFunction rounded{.x = {0.1 + 0.2, 1.0}, .y = {0.0, 0.0}}, written{.x = {0.3, 1.0}, .y = {0.0, 0.0}};
  CHECK(common_abscissas(Pointers{&rounded, &written}).size() == 2);
}

TEST_CASE("envelopes bound, means lie between, products multiply", "[functions]") {
  const Pointers both{&line, &bump};
  for (const double x : {0.0, 1.0, 2.0, 4.0}) {
    CHECK(upper_envelope(both)(x) == std::max(line(x), bump(x)));
    CHECK(lower_envelope(both)(x) == std::min(line(x), bump(x)));
    CHECK(mean(both)(x) == exactly(0.5 * (line(x) + bump(x))));
    CHECK(product(both)(x) == exactly(line(x) * bump(x)));
  }
}

TEST_CASE("the trapezoidal rule integrates a polygon exactly", "[functions]") {
  const TabulatedFunction area = integral(bump, 5.0);
  CHECK(area.y == std::vector<double>{5.0, 9.0, 13.0});
}

TEST_CASE("the mean over an interval comes from the integral at the points, linear between them", "[functions]") {
  // Figures of Code_Aster 17.3.
  TabulatedFunction kinked{.x = {0.0, 2.0, 4.0}, .y = {1.0, 3.0, -1.0}};
  CHECK(mean_between(kinked, 0.0, 4.0) == exactly(1.5));
  CHECK(mean_between(kinked, 0.5, 3.0) == exactly(1.6));
  CHECK_THROWS_AS(mean_between(kinked, 0.5, 4.5), Error);
  TabulatedFunction rising{.x = {1.0, 2.0, 4.0}, .y = {1.0, 3.0, 8.0}, .right = Extension::constant};
  CHECK(mean_between(rising, 1.5, 5.0) == Approx(3.428571428571));
  CHECK(mean_between(rising, 5.0, 7.0) == 0.0);
  rising.right = Extension::linear;
  CHECK(mean_between(rising, 1.5, 5.0) == exactly(5.0));
  rising.x_scale = Scale::logarithmic;
  CHECK(mean_between(rising, 1.5, 3.0) == Approx(4.843108337660));
}

TEST_CASE("Simpson's rule integrates a parabola exactly at every other of uneven points", "[functions]") {
  TabulatedFunction squares{.x = {0.0, 1.0, 1.5, 3.5, 4.0}, .y = {}};
  for (const double x : squares.x) squares.y.push_back(x * x);
  const TabulatedFunction area = simpson_integral(squares, 2.0);
  const double lost = 0.5 - 1.0 / 3.0;  // by the first trapezium
  for (std::size_t i = 0; i < squares.x.size(); ++i)
    CHECK(area.y[i] == exactly(2.0 + std::pow(squares.x[i], 3) / 3.0 + (i % 2 == 1 ? lost : 0.0)));
}

TEST_CASE("central differences are exact for a parabola inside, one-sided ones for a line at its ends", "[functions]") {
  const TabulatedFunction slope = derivative(parabola());
  for (std::size_t i = 1; i < 10; ++i) CHECK(slope.y[i] == exactly(2.0 * slope.x[i]));
  CHECK(derivative(line).y == std::vector<double>{2.0, 2.0, 2.0});
  CHECK_THROWS_AS(derivative({.x = {1.0}, .y = {1.0}}), Error);
}

TEST_CASE("the derivative at a point is the slope between its neighbours, however far they are", "[functions]") {
  CHECK(derivative({.x = {0.0, 1.0, 5.0}, .y = {0.0, 2.0, 18.0}}).y == std::vector<double>{2.0, 3.6, 4.0});  // 17.3
}

TEST_CASE("deriving an integral gives the function back to second order", "[functions]") {
  const auto worst = [](int count) {
    TabulatedFunction wave;
    for (int i = 0; i <= count; ++i) {
      wave.x.push_back(i * 3.0 / count);
      wave.y.push_back(std::sin(wave.x.back()));
    }
    const TabulatedFunction back = derivative(integral(wave, 0.0));
    double error = 0.0;
    for (std::size_t i = 1; i + 1 < wave.x.size(); ++i) error = std::max(error, std::abs(back.y[i] - wave.y[i]));
    return error;
  };
  CHECK(std::log2(worst(50) / worst(100)) == Approx(2.0).margin(0.1));
}

TEST_CASE("a function and its inverse undo each other", "[functions]") {
  TabulatedFunction falling{.parameter = "EPSI", .result = "SIGM", .x = {0.0, 1.0, 3.0}, .y = {8.0, 4.0, 2.0}};
  falling.left = Extension::constant;
  for (const TabulatedFunction& f : {line, falling}) {
    const TabulatedFunction back = inverse(f);
    for (const double x : f.x) CHECK(back(f(x)) == exactly(x));
    CHECK(inverse(back).x == f.x);
    CHECK(inverse(back).y == f.y);
    const TabulatedFunction same = composition(back, f);
    CHECK(same.y == f.x);
    CHECK(same.parameter == f.parameter);
    CHECK(same.left == back.left);
  }
  CHECK(inverse(falling).parameter == falling.parameter);
  // What is constant has no inverse.
  CHECK(inverse(falling).right == Extension::excluded);
  falling.left = Extension::linear;
  CHECK(inverse(falling).right == Extension::linear);
  CHECK_THROWS_AS(inverse(bump), Error);
}

TEST_CASE("a function at other abscissas goes on as it is extended", "[functions]") {
  TabulatedFunction ramp{.x = {1.0, 3.0}, .y = {2.0, 8.0}};
  ramp.right = Extension::constant;
  const TabulatedFunction other = resampled(ramp, {1.0, 2.0, 4.0});
  CHECK(other.x == std::vector<double>{1.0, 2.0, 4.0});
  CHECK(other.y == std::vector<double>{2.0, 5.0, 8.0});
  CHECK_THROWS_AS(resampled(ramp, {0.0, 2.0}), Error);
}

TEST_CASE("functions one after the other keep the ends of both, and one of them where they overlap", "[functions]") {
  TabulatedFunction late{.x = {3.0, 5.0}, .y = {0.0, 1.0}};
  late.right = Extension::constant;
  const TabulatedFunction by_second = in_succession(line, late, Overlap::right);
  CHECK(by_second.x == std::vector<double>{0.0, 1.0, 3.0, 5.0});
  CHECK(by_second.y == std::vector<double>{1.0, 3.0, 0.0, 1.0});
  CHECK(by_second.right == Extension::constant);
  CHECK(in_succession(line, late, Overlap::left).x == std::vector<double>{0.0, 1.0, 4.0, 5.0});
  // Whichever is written first.
  CHECK(in_succession(late, line, Overlap::right).x == by_second.x);
  CHECK(in_succession(late, line, Overlap::left).x == std::vector<double>{0.0, 1.0, 4.0, 5.0});
}

TEST_CASE("means, envelopes and fractiles want all functions at the points of all, sums do not", "[functions]") {
  const TabulatedFunction longer{.x = {0.0, 9.0}, .y = {0.0, 9.0}}, shorter{.x = {0.0, 4.0}, .y = {1.0, 1.0}};
  const Pointers two{&longer, &shorter};
  CHECK(combination(two, std::vector{1.0, 1.0}).x == std::vector<double>{0.0, 4.0});
  CHECK_THROWS_AS(mean(two), Error);
  CHECK_THROWS_AS(upper_envelope(two), Error);
  CHECK_THROWS_AS(fractile(two, 0.5), Error);
}

TEST_CASE("a fractile of functions goes from the lower to the upper envelope", "[functions]") {
  const Pointers two{&line, &bump};
  CHECK(fractile(two, 0.0).y == lower_envelope(two).y);
  CHECK(fractile(two, 1.0).y == upper_envelope(two).y);
  CHECK(fractile(two, 0.5).y == mean(two).y);
}

TEST_CASE("least squares give a polynomial back, and the mean for degree 0", "[functions]") {
  TabulatedFunction bent = parabola();
  bent.x_scale = Scale::logarithmic;
  CHECK(polynomial_fit(bent, 2).x_scale == Scale::linear);
  CHECK_THROWS_AS(in_succession(bent, parabola(), Overlap::left), Error);
  const TabulatedFunction fit = polynomial_fit(parabola(), 2);
  for (std::size_t i = 0; i < fit.x.size(); ++i) CHECK(fit.y[i] == Approx(fit.x[i] * fit.x[i]).margin(1e-14));
  CHECK(polynomial_fit(bump, 0).y[1] == exactly(4.0 / 3.0));
  CHECK_THROWS_AS(polynomial_fit(bump, 3), Error);
}
