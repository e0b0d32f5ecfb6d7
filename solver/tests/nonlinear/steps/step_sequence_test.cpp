#include "solver/nonlinear/steps/step_sequence.hpp"

#include <array>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/nonlinear/steps/watched_increment.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// The instants reached when every step takes as many iterations, and those that `fails` says fail.
template <typename Fails>
std::vector<double> walk(StepPlan plan, int iterations, Fails&& fails) {
  StepSequence sequence(std::move(plan));
  std::vector<double> reached;
  double now = 0.0;
  while (!sequence.finished()) {
    const double target = sequence.target();
    if (fails(now, target)) {
      if (!sequence.cut()) break;
      continue;
    }
    sequence.accept(iterations);
    reached.push_back(now = target);
  }
  return reached;
}

const auto never = [](double, double) { return false; };

}  // namespace

TEST_CASE("without rules the instants are those of the list") {
  CHECK(walk(StepPlan({0.0, 1.0, 3.0}), 9, never) == std::vector<double>{1.0, 3.0});
}

TEST_CASE("a step that is too long is cut, and its parts again, but for what comes after") {
  StepPlan plan({0.0, 1.0, 2.0});
  plan.cutting = StepCutting{2, 3, 0.0};
  const auto longer_than_a_quarter = [](double now, double target) { return now < 1.0 && target - now > 0.26; };
  CHECK(walk(plan, 1, longer_than_a_quarter) == std::vector<double>{0.25, 0.5, 0.75, 1.0, 2.0});
}

TEST_CASE("cutting ends at the depth and at the shortest step allowed") {
  StepPlan plan({0.0, 1.0});
  plan.cutting = StepCutting{2, 3, 0.0};
  double last = 1.0;
  const auto always = [&](double, double target) {
    last = target;
    return true;
  };
  CHECK(walk(plan, 1, always).empty());
  CHECK(last == 0.125);
  plan.cutting->shortest = 0.2;
  CHECK(walk(plan, 1, always).empty());
  CHECK(last == 0.25);
}

/// 17.3: a quarter after six residuals; after seven 1/7 and three times 2/7.
TEST_CASE("where the program chooses the parts a first half one tries whether shorter steps do") {
  StepCutting rule;
  rule.automatic = true;
  StepSequence short_history(StepPlan({0.0, 1.0}));
  CHECK(short_history.cut(rule, 6));
  CHECK(short_history.target() == 0.25);
  StepSequence sequence(StepPlan({0.0, 1.0}));
  CHECK(sequence.cut(rule, 7));
  for (int k = 0; k < 4; ++k, sequence.accept(1)) CHECK(sequence.target() == exactly((2 * k + 1) / 7.0));
  StepSequence failing(StepPlan({0.0, 1.0}));
  int cuts = 0;
  while (failing.cut(rule)) ++cuts;
  CHECK(cuts == automatic_depth);
}

TEST_CASE("for a while steps are no longer than a length, and meet the instants of the list") {
  StepSequence sequence(StepPlan({0.0, 1.0, 2.0}));
  CHECK(sequence.refine({0.4, 1.5}));
  CHECK_FALSE(sequence.refine({0.4, 1.5}));
  std::vector<double> reached;
  while (!sequence.finished()) {
    reached.push_back(sequence.target());
    sequence.accept(1);
  }
  const std::vector<double> expected = {0.4, 0.8, 1.0, 1.4, 1.8, 2.0};
  REQUIRE(reached.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(reached[k] == exactly(expected[k]));
}

TEST_CASE("hard steps make the next ones shorter where that is asked for") {
  StepPlan plan({0.0, 1.0, 2.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].beyond = true;
  plan.adaptation->rules[0].few_iterations = 5;
  plan.adaptation->rules[0].needed = 1;
  plan.adaptation->rules[0].growth = -0.5;
  CHECK(walk(plan, 6, never) == std::vector<double>{1.0, 2.0});
  const std::vector<double> hard = walk(plan, 7, [](double now, double) { return now > 1.9; });
  REQUIRE(hard.size() > 3);
  CHECK(hard[1] == 1.5);
  CHECK(hard[2] == 1.75);
  StepPlan far({0.0, 1.0, 3.0});  // 1 + 1/2 + 1/4 ... does not get there
  far.adaptation = plan.adaptation;
  CHECK_THROWS_WITH(walk(far, 7, never), Catch::Contains("the next one has no length"));
}

TEST_CASE("easy steps grow, and still meet the instants of the list") {
  StepPlan plan({0.0, 1.0, 8.0, 9.0});
  plan.adaptation = StepAdaptation{};
  // 1 and 2 are easy, so the next is twice as long; the one after meets the wall at 8.
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 2.0, 4.0, 6.0, 8.0, 9.0});
  // The first step is that of the list, however long.
  plan.adaptation->longest = 0.5;
  const std::vector<double> bounded = walk(plan, 3, never);
  CHECK(std::vector(bounded.begin(), bounded.begin() + 3) == std::vector<double>{1.0, 1.5, 2.0});
  plan.adaptation->most_steps = 4;
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 1.5, 2.0, 2.5});
}

TEST_CASE("no step shorter than the shortest is left before an instant of the list") {
  StepPlan plan({0.0, 1.0, 2.9});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].always = true;
  plan.adaptation->rules[0].growth = 0.8;
  plan.adaptation->shortest = 0.05;
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 2.8, 2.9});
  plan.adaptation->shortest = 0.2;
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 2.9});
}

TEST_CASE("of several rules for steps the one that makes them shortest counts") {
  StepPlan plan({0.0, 1.0, 20.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules.assign(2, AdaptationRule());
  plan.adaptation->rules[0].needed = 1;
  plan.adaptation->rules[1].growth = 0.5;
  // Doubled after the first step; after the second both rules hold.
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 3.0, 6.0, 12.0, 20.0});
  // Where none holds steps keep their length.
  plan.adaptation->usual_iterations = 1;
  CHECK(walk(plan, 3, never).size() == 20);
}

/// As Code_Aster 17.3 goes on: a step of 0.4 cut in three, two easy parts and then twice as far, past where it was to
/// end.
TEST_CASE("where steps adapt the first part of one that was cut alone is meant") {
  StepPlan plan({0.0, 0.2, 1.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->shortest = 1e-3;
  plan.cutting = StepCutting{.parts = 3, .depth = 1};
  StepSequence sequence(plan);
  std::vector<double> reached;
  while (!sequence.finished()) {
    if (reached.size() == 2 && sequence.target() > 0.7) {
      CHECK(sequence.target() == exactly(0.8));
      CHECK(sequence.cut());
      CHECK(sequence.is_part());
      CHECK(sequence.may_be_cut());
    }
    reached.push_back(sequence.target());
    sequence.accept(3);
  }
  const std::vector<double> expected = {0.2, 0.4, 0.4 + 0.4 / 3.0, 0.4 + 0.8 / 3.0, 0.4 + 1.6 / 3.0, 1.0};
  REQUIRE(reached.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(reached[k] == exactly(expected[k]));
}

TEST_CASE("steps aim at a number of iterations") {
  StepPlan plan({0.0, 1.0, 10.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].always = true;
  plan.adaptation->rules[0].wanted_iterations = 4;
  CHECK(walk(plan, 0, never) == std::vector<double>{1.0, 3.0, 7.0, 10.0});
}

TEST_CASE("steps that are to become shorter than allowed end the computation") {
  StepPlan plan({0.0, 1.0, 10.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].always = true;
  plan.adaptation->rules[0].wanted_iterations = 4;
  plan.adaptation->shortest = 0.5;
  CHECK(walk(plan, 3, never) == std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0});
  CHECK_THROWS_WITH(walk(plan, 63, never), Catch::Contains("PAS_MINI"));
}

TEST_CASE("steps adapt so that a watched field changes by as much as is wanted") {
  StepPlan plan({0.0, 0.5, 2.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].always = true;
  plan.adaptation->rules[0].increment = WatchedIncrement{"DEPL", "DX", {}, {}, 0.3};
  StepSequence sequence(plan);
  std::vector<double> reached;
  // The field is t^2: from 0.1 on a step of length h aims at h * 0.3 / change for the next.
  for (double now = 0.0; !sequence.finished();) {
    const double target = sequence.target();
    sequence.accept(1, std::array{target * target - now * now});
    reached.push_back(now = target);
  }
  REQUIRE(reached.size() > 3);
  CHECK(reached[0] == 0.5);
  double before = 0.0, length = 0.5;
  for (std::size_t k = 0; k + 2 < reached.size(); ++k) {
    length *= 0.3 / (reached[k] * reached[k] - before * before);
    CHECK(reached[k + 1] == exactly(reached[k] + length));
    before = reached[k];
  }
  CHECK(reached.back() == 2.0);
}

TEST_CASE("after a step that an instant of the list made shorter the planned length goes on") {
  StepPlan plan({0.0, 0.2, 0.5, 2.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->rules[0].always = true;
  plan.adaptation->rules[0].increment = WatchedIncrement{"DEPL", "DX", {}, {}, 0.2};
  StepSequence sequence(plan);
  std::vector<double> reached;
  // The field is t: steps of 0.2 are wanted. That from 0.4 ends at 0.5, half as long; its change is half of what is
  // wanted, and the next is twice as long as planned.
  for (double now = 0.0; !sequence.finished();) {
    const double target = sequence.target();
    sequence.accept(1, std::array{target - now});
    reached.push_back(now = target);
  }
  const std::vector<double> expected = {0.2, 0.4, 0.5, 0.9, 1.1, 1.3, 1.5, 1.7, 1.9, 2.0};
  REQUIRE(reached.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(reached[k] == exactly(expected[k]));
}

TEST_CASE("the change of a field is the largest over the places that are watched") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  NodalField field{"DEPL_R", {"DX", "DY"}, {1.0, 9.0, 2.0, 9.0, 3.0, 9.0}};
  ResultStep before, after;
  before.fields.emplace("DEPL", field);
  field.values[0] = 1.5;
  field.values[4] = 1.0;
  field.values[3] = -100.0;
  after.fields.emplace("DEPL", field);
  WatchedIncrement watched{"DEPL", "DX", {}, {}, 1.0};
  const auto change = [&] {
    return largest_change(watched_values(watched, before, mesh), watched_values(watched, after, mesh));
  };
  CHECK(change() == 2.0);
  watched.nodes = {0, 1};
  CHECK(change() == 0.5);
  watched.component = "DZ";
  CHECK_THROWS_AS(change(), Error);
}
