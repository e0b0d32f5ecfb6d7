#include "interpreter/graph/command_graph.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "interpreter/catalogue/check.hpp"
#include "interpreter/graph/command_graph_export.hpp"
#include "interpreter/graph/graph_reduction.hpp"
#include "interpreter/tests/little_catalogue.hpp"

using namespace comma::interpreter;
using namespace comma::interpreter::tests;

namespace {

/// Adds checked calls of the little catalogue to a graph.
struct Builder {
  LittleCatalogue little = little_catalogue();
  CommandGraph graph;
  int next = 0;

  ConceptPtr add(const std::string& command, const Arguments& arguments, const std::string& name = "") {
    const CommandPage& page = little.catalogue->page(command);
    Diagnostics diagnostics;
    CheckedCall checked =
        check_call(written_call(command, arguments), page, *little.catalogue, diagnostics, Severity::error);
    REQUIRE(diagnostics.items().empty());
    ConceptPtr product = checked.call.result;
    if (!product && !checked.product_type->empty()) product = new_concept(name, *checked.product_type, next++);
    checked.call.result = product;
    graph.add(std::move(checked.call), product, page);
    return product;
  }

  /// "0 raw MA, ..." of a node.
  std::vector<std::string> waits(int id) const {
    std::vector<std::string> shown;
    for (const Edge& edge : graph.nodes()[static_cast<std::size_t>(id)].waits_for)
      shown.push_back(std::to_string(edge.from) + " " + std::string(name_of(edge.hazard)) + " " + edge.resource);
    return shown;
  }
};

using Waits = std::vector<std::string>;

}  // namespace

TEST_CASE("A reader waits for the writer, through the concepts that it reads through") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  const ConceptPtr result = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  CHECK(builder.waits(0).empty());
  CHECK(builder.waits(1) == Waits{"0 raw MA"});
  CHECK(builder.waits(2) == Waits{"1 raw MO"});
  CHECK(builder.graph.required_by(2) == std::vector<int>{0, 1, 2});
}

TEST_CASE("A picture leaves out the arrows that a longer way implies") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  const auto arrows = drawn_arrows(builder.graph);
  REQUIRE(arrows.size() == 2);
  CHECK((arrows[0].from == 0 && arrows[0].to == 1 && arrows[0].label == "MA" && arrows[0].carries));
  CHECK((arrows[1].from == 1 && arrows[1].to == 2 && arrows[1].label == "MO"));
}

TEST_CASE("A writer in place waits for earlier readers and the earlier writer; later readers wait for it") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  builder.add("SHIFT", {{"reuse", Value(mesh)}, {"MESH", Value(mesh)}});
  builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  CHECK(builder.waits(2) == Waits{"0 raw MA", "1 war MA", "0 waw MA"});
  CHECK(builder.waits(3) == Waits{"2 raw MA", "1 raw MO"});
}

TEST_CASE("What is changed in place by something made from it does not keep that alive") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  const std::weak_ptr<Concept> result = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  builder.add("SHIFT", {{"reuse", Value(mesh)}, {"MESH", Value(mesh)}, {"BY", Value(result.lock())}});
  builder.add("SOLVE", {{"MODEL", Value(model)}}, "AGAIN");
  CHECK(builder.waits(3) == Waits{"0 raw MA", "2 raw R", "1 war MA", "2 war MA", "0 waw MA"});
  CHECK(builder.waits(4) == Waits{"3 raw MA", "1 raw MO"});
  builder.graph = CommandGraph();
  CHECK(result.expired());
}

TEST_CASE(
    "A chain of products, each made from the one before, takes one arrow a link, and is let go of without recursion") {
  Builder builder;
  constexpr int links = 100000;
  ConceptPtr last = builder.add("MESH", {}, "MA");
  const ConceptPtr mesh = last;
  last = builder.add("MODEL", {{"MESH", Value(last)}}, "MO");
  for (int i = 0; i < links; ++i) {
    ConceptPtr next = std::make_shared<Concept>();
    next->reads_through.push_back(last);
    last = std::move(next);
  }
  const std::weak_ptr<Concept> first = last->reads_through.front();
  last.reset();
  CHECK(first.expired());

  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  ConceptPtr result = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  for (int i = 0; i < 50; ++i) {
    result = builder.add("SOLVE", {{"MODEL", Value(model)}, {"RESULT", Value(result)}}, "R");
    CHECK(builder.graph.nodes().back().waits_for.size() == 2);
  }
  // A change of the mesh waits for all that read it through others, and all that read it so later wait for the change.
  const int readers = static_cast<int>(builder.graph.nodes().size()) - 1;
  builder.add("SHIFT", {{"reuse", Value(mesh)}, {"MESH", Value(mesh)}});
  CHECK(static_cast<int>(builder.waits(readers + 1).size()) == readers + 2);
  builder.add("SOLVE", {{"MODEL", Value(model)}, {"RESULT", Value(result)}}, "R");
  CHECK(builder.graph.nodes().back().waits_for.size() == 3);
}

TEST_CASE("A standalone product does not hold on to what it was made from") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  const ConceptPtr result = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R");
  const ConceptPtr table = builder.add("TABLE", {{"RESULT", Value(result)}}, "T");
  builder.add("SOLVE", {{"reuse", Value(result)}, {"MODEL", Value(model)}, {"RESULT", Value(result)}});
  builder.add("VERIFY", {{"WHAT", Value(table)}});
  CHECK(builder.waits(5) == Waits{"3 raw T"});
}

TEST_CASE("Commands that write the same file stay in order; a reader of the file waits for its writer") {
  Builder builder;
  builder.add("PRINT", {});
  builder.add("PRINT", {});
  builder.add("PRINT", {{"UNIT", Value(20)}});
  builder.add("MESH", {}, "MA");
  builder.add("PRINT", {{"UNIT", Value(20)}});
  CHECK(builder.waits(1) == Waits{"0 waw file 8"});
  CHECK(builder.waits(2).empty());
  CHECK(builder.waits(3) == Waits{"2 raw file 20"});
  CHECK(builder.waits(4) == Waits{"3 war file 20", "2 waw file 20"});
}

TEST_CASE("Pruning keeps what a verdict or an output builds on, and nothing else") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  const ConceptPtr model = builder.add("MODEL", {{"MESH", Value(mesh)}}, "MO");
  const ConceptPtr tested = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R1");
  const ConceptPtr printed = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R2");
  const ConceptPtr idle = builder.add("SOLVE", {{"MODEL", Value(model)}}, "R3");
  builder.add("VERIFY", {{"WHAT", Value(tested)}});
  builder.add("PRINT", {{"WHAT", Value(printed)}});
  const auto needs = builder.graph.needs();
  CHECK(needs == std::vector<Need>{Need::verdict, Need::verdict, Need::verdict, Need::output, Need::nothing,
                                   Need::verdict, Need::output});
}

TEST_CASE("A change in place that comes after the verdict is not needed by it") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  builder.add("VERIFY", {{"WHAT", Value(mesh)}});
  builder.add("SHIFT", {{"reuse", Value(mesh)}, {"MESH", Value(mesh)}});
  CHECK(builder.graph.needs()[2] == Need::nothing);
  CHECK(builder.graph.required_by(1) == std::vector<int>{0, 1});
}

TEST_CASE("The exports show commands, concepts and hazards") {
  Builder builder;
  const ConceptPtr mesh = builder.add("MESH", {}, "MA");
  builder.add("SHIFT", {{"reuse", Value(mesh)}, {"MESH", Value(mesh)}});
  const auto json = to_json(builder.graph);
  CHECK(json["nodes"][0]["command"] == "MESH");
  CHECK(json["nodes"][1]["concept"] == "MA");
  CHECK(json["nodes"][1]["line"] == 1);
  CHECK(json["edges"][0] == nlohmann::json({{"from", 0}, {"to", 1}, {"kind", "raw"}, {"resource", "MA"}}));
  const std::string dot = to_dot(builder.graph);
  CHECK(dot.find("n0 -> n1 [label=\"MA\"]") != std::string::npos);
  CHECK(dot.find("label=\"MA = MESH (line 1)\"") != std::string::npos);
}
