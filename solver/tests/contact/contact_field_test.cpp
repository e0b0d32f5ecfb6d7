#include "solver/contact/contact_field.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace {

ContactPair pair(int slave, PairingStatus status) {
  ContactPair result;
  result.slave = slave;
  result.status = status;
  result.normal = {0.6, 0.8, 0};
  return result;
}

}  // namespace

TEST_CASE("Contact, open, not paired and foreign nodes") {
  const std::vector<Vector3d> places(4, Vector3d(1, 2, 3));
  const std::vector<ContactPair> pairs = {pair(0, PairingStatus::paired), pair(1, PairingStatus::paired),
                                          pair(2, PairingStatus::too_far)};
  const std::vector<double> gaps = {0.0, 0.25, absent};
  const NodalField field = contact_field(pairs, gaps, Eigen::Vector3d(10, 0, 0), 4, places);
  const auto at = [&](int node, const char* name) { return field.at(node, field.component(name)); };
  CHECK(at(0, "CONT") == 2.0);
  CHECK(at(0, "RN") == 10.0);
  CHECK(at(0, "RNX") == exactly(-6.0));
  CHECK(at(0, "RY") == exactly(-8.0));
  CHECK(at(0, "RTGX") == 0.0);
  CHECK(at(0, "GLI") == 0.0);
  CHECK(at(1, "CONT") == 0.0);
  CHECK(at(1, "JEU") == 0.25);
  CHECK(at(1, "RN") == 0.0);
  CHECK(at(2, "CONT") == 0.0);
  CHECK(at(2, "JEU") == 0.0);
  for (const char* force : {"RN", "RNX", "RTAY", "RTGZ", "R"}) CHECK(at(2, force) == 0.0);
  CHECK(std::isnan(at(3, "RN")));
  CHECK(std::isnan(at(3, "CONT")));
}

TEST_CASE("In the mixed formulation a node that faces nothing tells how far it is from the nearest place") {
  const std::vector<Vector3d> places(2, Vector3d(1, 2, 3));
  std::vector<NodeContact> contacts(2);
  for (int node = 0; node < 2; ++node)
    contacts[static_cast<std::size_t>(node)].pair = pair(node, PairingStatus::outside);
  contacts[0].gap = 0.25;
  contacts[0].pair.foot = {4, 5, 6};
  contacts[1].has_foot = false;
  const NodalField field = contact_field(contacts, 2, places);
  const auto at = [&](int node, const char* name) { return field.at(node, field.component(name)); };
  CHECK(at(0, "CONT") == -1.0);
  CHECK(at(0, "JEU") == 0.25);
  CHECK(at(0, "PROJ_Y") == 5.0);
  CHECK(at(1, "CONT") == -1.0);
  CHECK(at(1, "PT_X") == 0.0);
}

TEST_CASE("In the discrete formulation a node that is left out has no gap") {
  const std::vector<Vector3d> places(1, Vector3d(1, 2, 3));
  const std::vector<NodeContact> contacts = {{.pair = pair(0, PairingStatus::excluded), .has_foot = false}};
  const NodalField field = contact_field(contacts, 1, places, 0.0, Unpaired::open);
  CHECK(field.at(0, field.component("CONT")) == 0.0);
  CHECK(field.at(0, field.component("JEU")) == 0.0);
}

TEST_CASE("A node that one zone holds is not unpaired because another zone does not see it") {
  const std::vector<Vector3d> places(1, Vector3d::Zero());
  const std::vector<double> gaps = {0.0, absent};
  for (const bool swapped : {false, true}) {
    std::vector<ContactPair> pairs = {pair(0, PairingStatus::paired), pair(0, PairingStatus::outside)};
    Eigen::Vector2d multipliers(5, 0);
    std::vector<double> these = gaps;
    if (swapped) {
      std::swap(pairs[0], pairs[1]);
      std::swap(these[0], these[1]);
      multipliers = {0, 5};
    }
    const NodalField field = contact_field(pairs, these, multipliers, 1, places);
    CHECK(field.at(0, field.component("CONT")) == 2.0);
    CHECK(field.at(0, field.component("RN")) == 5.0);
  }
}

TEST_CASE("A node that two zones hold carries the forces of both, and the gap of the nearer one") {
  const std::vector<Vector3d> places(1, Vector3d::Zero());
  const std::vector<ContactPair> pairs(2, pair(0, PairingStatus::paired));
  for (const bool swapped : {false, true}) {
    const std::vector<double> gaps = swapped ? std::vector<double>{0.5, 0.0} : std::vector<double>{0.0, 0.5};
    const NodalField one =
        contact_field(pairs, gaps, swapped ? Eigen::Vector2d(0, 5) : Eigen::Vector2d(5, 0), 1, places);
    CHECK(one.at(0, one.component("RN")) == 5.0);
    CHECK(one.at(0, one.component("CONT")) == 2.0);
    CHECK(one.at(0, one.component("JEU")) == 0.0);
  }
  const NodalField both = contact_field(pairs, std::vector<double>{0.0, 0.0}, Eigen::Vector2d(5, 3), 1, places);
  CHECK(both.at(0, both.component("RN")) == 8.0);
  CHECK(both.at(0, both.component("R")) == 8.0);
}

TEST_CASE("Where contact is only watched, bodies that touch do not overlap") {
  const std::vector<Vector3d> places(3, Vector3d(60, 155, 0));
  std::vector<ContactPair> pairs;
  for (int node = 0; node < 3; ++node) pairs.push_back(pair(node, PairingStatus::watched));
  const std::vector<double> gaps = {-1e-13, -1e-6, 0.5};
  const NodalField field = contact_field(pairs, gaps, Vector3d::Zero(), 3, places);
  const int status = field.component("CONT");
  CHECK(field.at(0, status) == -1.0);
  CHECK(field.at(1, status) == 3.0);
  CHECK(field.at(2, status) == -1.0);
}
