#include "solver/mesh/named_groups.hpp"

#include <catch2/catch.hpp>

namespace comma::solver {
namespace {

using Names = std::vector<std::string>;

Names names_of(const Groups& groups) {
  Names names;
  for (const auto& [name, members] : groups) names.push_back(name);
  return names;
}

TEST_CASE("groups keep the order in which they came", "[groups]") {
  Groups groups = {{"TOP", {1}}, {"BOTTOM", {2, 3}}};
  groups["ALL"] = {1, 2, 3};
  CHECK(names_of(groups) == Names{"TOP", "BOTTOM", "ALL"});
  CHECK_FALSE(groups.try_emplace("TOP", {7}).second);
  CHECK(groups.at("TOP") == std::vector{1});
  CHECK(groups.find("ALL")->second == std::vector{1, 2, 3});
  CHECK(groups.find("SIDE") == groups.end());
}

TEST_CASE("groups behind one that goes are found as before", "[groups]") {
  Groups groups = {{"A", {0}}, {"B", {1}}, {"C", {2}}};
  CHECK(groups.erase("A"));
  CHECK_FALSE(groups.erase("A"));
  CHECK(groups.erase(groups.find("B"))->first == "C");
  CHECK(names_of(groups) == Names{"C"});
  CHECK(groups.at("C") == std::vector{2});
  CHECK_FALSE(groups.contains("B"));
}

TEST_CASE("a reference to members stays when others come", "[groups]") {
  Groups groups = {{"FIRST", {4}}};
  const std::vector<int>& first = groups.at("FIRST");
  for (int i = 0; i < 1000; ++i) groups[std::to_string(i)] = {i};
  CHECK(first == std::vector{4});
}

TEST_CASE("groups are the same in any order", "[groups]") {
  CHECK(Groups{{"A", {0}}, {"B", {1}}} == Groups{{"B", {1}}, {"A", {0}}});
  CHECK_FALSE(Groups{{"A", {0}}} == Groups{{"A", {1}}});
  CHECK_FALSE(Groups{{"A", {0}}} == Groups{});
}

}  // namespace
}  // namespace comma::solver
