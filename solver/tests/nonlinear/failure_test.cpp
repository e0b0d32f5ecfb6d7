#include "solver/nonlinear/failure.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "cantilever.hpp"
#include "solver/error.hpp"

using namespace comma::solver;

TEST_CASE("Newton's method: displacements that overflow are in no balance") {
  testing::Cantilever cantilever;
  NewtonOptions options;
  options.tangent.prediction = options.tangent.correction = TangentKind::elastic;
  options.max_iterations = 40;
  StepPlan plan;
  plan.instants = {0.0, 1.0};
  std::vector<double> residuals;
  const auto note = [&](const IterationReport& report) { residuals.push_back(report.absolute_residual); };
  CHECK_THROWS_WITH(cantilever.solve(plan, options, note), Catch::Contains("iterations diverge"));
  REQUIRE(!residuals.empty());
  CHECK_FALSE(std::isfinite(residuals.back()));
}

TEST_CASE("Newton's method: a limit below rounding is told from a slow residual") {
  const auto after = [](double relative, double absolute) {
    IterationReport first, last;
    first.absolute_residual = 1e6;
    last.relative_residual = relative;
    last.absolute_residual = absolute;
    return std::vector{first, last};
  };
  CHECK_THROWS_WITH(throw_no_convergence(1.0, after(5e-15, 5e-6), {}, {}),
                    Catch::Contains("more than rounding allows"));
  CHECK_THROWS_WITH(throw_no_convergence(1.0, after(5e-5, 5e4), {}, {}), Catch::Contains("shrinks too slowly"));
  const auto iterations = [](double ratio) {
    std::vector<IterationReport> history(20);
    double share = 1e-9;
    for (IterationReport& line : history) {
      line.relative_residual = share;
      line.absolute_residual = 1e5 * share;
      share *= ratio;
    }
    return history;
  };
  CHECK_THROWS_WITH(throw_no_convergence(1.0, iterations(0.99), {}, {}), Catch::Contains("more than rounding allows"));
  CHECK_THROWS_WITH(throw_no_convergence(1.0, iterations(0.7), {}, {}), Catch::Contains("shrinks too slowly"));
}

TEST_CASE("Newton's method: iterations that go to and fro are told from slow ones") {
  std::vector<IterationReport> history(10);
  for (std::size_t k = 0; k < history.size(); ++k)
    history[k].relative_residual = history[k].absolute_residual = k % 2 == 0 ? 0.12 : 0.086;
  CHECK_THROWS_WITH(throw_no_convergence(1.0, history, {}, {}), Catch::Contains("to and fro"));
  std::vector<IterationReport> resting = history;
  for (IterationReport& line : resting) line.absolute_residual = history.front().absolute_residual;
  CHECK_THROWS_WITH(throw_no_convergence(1.0, resting, {}, {}), Catch::Contains("falls no more"));
  for (std::size_t k = 0; k < history.size(); ++k) history[k].absolute_residual *= 1.0 - 0.01 * static_cast<double>(k);
  CHECK_THROWS_WITH(throw_no_convergence(1.0, history, {}, {}), Catch::Contains("shrinks too slowly"));
}

TEST_CASE("Statuses that do not settle get advice about what there is") {
  const auto advice = [](const ContactDefinition& contact) {
    try {
      throw_condensed_limit(60, contact, false, {});
    } catch (const Error& error) {
      return error.hint();
    }
  };
  ContactDefinition contact;
  contact.zones.resize(1);
  CHECK(advice(contact) == "take smaller steps");
  contact.zones[0].mixed.penalised = true;
  CHECK(advice(contact) == "take smaller steps, or a smaller penalty (E_N)");
  contact.formulation = ContactFormulation::mixed;
  contact.zones[0].mixed.penalised = false;
  contact.zones[0].mixed.rule = ContactRule::simpson;
  CHECK_THAT(advice(contact), Catch::Contains("INTEGRATION='AUTO'") && !Catch::Contains("penalty"));
  contact.zones[0].mixed.friction = 0.3;
  CHECK_THAT(advice(contact), !Catch::Contains("LISSAGE"));
  contact.zones[0].normal_side = NormalSide::average;
  CHECK_THAT(advice(contact), Catch::Contains("LISSAGE='OUI'"));
}
