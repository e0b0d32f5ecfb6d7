#include "solver/contact_law/raised_penalties.hpp"

#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

MixedZone soft_zone() {
  MixedZone zone;
  zone.penalised = zone.friction_penalised = true;
  zone.augmentation = 100.0;
  zone.friction_penalty = 5.0;
  return zone;
}

/// One value a zone.
Excess excess_of(std::vector<double> depth, std::vector<double> slip) {
  Excess excess(depth.size());
  excess.depth = std::move(depth);
  excess.slip = std::move(slip);
  return excess;
}

/// The penalty of contact and that of friction of a point of zone `number`.
std::pair<double, double> penalties_of(const RaisedPenalties& raised, int number) {
  CondensedPoint point;
  raised.apply(soft_zone(), number, point);
  return {point.law.augmentation, point.law.friction_augmentation};
}

}  // namespace

TEST_CASE("A penalty of contact is doubled however deep points are, one of friction grows by more than they slip") {
  const double excess = GENERATE(1.01, 3.0, 1e4);
  RaisedPenalties raised(2);
  REQUIRE(raised.raise(excess_of({excess, 0.5}, {0.0, 0.0})));
  CHECK(penalties_of(raised, 0) == std::pair(200.0, 5.0));
  CHECK(penalties_of(raised, 1) == std::pair(100.0, 5.0));
  REQUIRE(raised.raise(excess_of({0.0, 0.0}, {0.0, excess})));
  CHECK(penalties_of(raised, 1).first == 100.0);
  CHECK(penalties_of(raised, 1).second > 5.0 * excess);
}

TEST_CASE("Where nothing is too much penalties stay as they are, raised ones too") {
  RaisedPenalties raised(1);
  raised.raise(excess_of({2.0}, {4.0}));
  const auto before = penalties_of(raised, 0);
  CHECK_FALSE(raised.raise(excess_of({1.0}, {0.9})));
  CHECK(penalties_of(raised, 0) == before);
  CHECK(before.second > 5.0 * 4.0);
}

TEST_CASE("A computation that goes on takes penalties as they were raised, and its own limits") {
  RaisedPenalties before(1), after(1);
  before.raise(excess_of({4.0}, {0.0}));
  CHECK(before.are_raised());
  after.limit_depth(0.5, 10.0);
  CHECK_FALSE(after.are_raised());
  after.go_on_from(before, 0, 0);
  CHECK(penalties_of(after, 0) == penalties_of(before, 0));
  CHECK(after.allowed_depth() == 0.5);
}

TEST_CASE("A factor that would be too large is an error") {
  RaisedPenalties raised(1);
  CHECK_FALSE(raised.allowed_depth());
  raised.limit_depth(0.5, 10.0);
  for (int round = 0; round < 3; ++round) CHECK(raised.raise(excess_of({9.0}, {0.0})));
  CHECK_THROWS_AS(raised.raise(excess_of({9.0}, {0.0})), Error);
}

TEST_CASE("How far a penalty may be raised is measured by the bodies, not by what was given") {
  const auto raised_to = [](double softness, double slip) {
    RaisedPenalties raised(1);
    Excess excess = excess_of({0.0}, {slip});
    excess.soft_friction = {softness};
    return raised.raise(excess);
  };
  CHECK_THROWS_AS(raised_to(1.0, 1e13), Error);
  CHECK(raised_to(1e6, 1e13));
  CHECK_THROWS_AS(raised_to(1e6, 1e19), Error);
  // That of friction says nothing of contact.
  RaisedPenalties pressed(1);
  Excess deep = excess_of({2.0}, {0.0});
  deep.soft_friction = {1e12};
  for (int doublings = 0; doublings < 39; ++doublings) pressed.raise(deep);
  CHECK_THROWS_AS(pressed.raise(deep), Error);
}

}  // namespace comma::solver
