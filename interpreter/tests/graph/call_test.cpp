#include "interpreter/graph/call.hpp"

#include <catch2/catch.hpp>

#include "interpreter/tests/little_catalogue.hpp"

using namespace comma::interpreter;

namespace {

Keyword keyword(const std::string& name, Value value, bool given = true) {
  return {name, std::move(value), {}, {}, {}, given};
}

struct MeshData : ConceptData {
  int nodes = 4;
};
struct TableData : ConceptData {};

}  // namespace

TEST_CASE("Keywords are read by their type, as one value or as several") {
  Keywords keywords;
  keywords.items.push_back(keyword("E", Value(2.0)));
  keywords.items.push_back(keyword("N", Value(3), false));
  keywords.items.push_back(keyword("G", Value::tuple({Value("A"), Value("B")})));
  CHECK(keywords.real("E") == 2.0);
  CHECK(keywords.integer("N") == 3);
  CHECK(keywords.has("N"));
  CHECK_FALSE(keywords.given("N"));
  CHECK(keywords.texts("G") == std::vector<std::string>{"A", "B"});
  CHECK(keywords.reals("E") == std::vector<double>{2.0});
  CHECK(keywords.reals("ABSENT").empty());
  CHECK(keywords.factors("ABSENT").empty());
}

TEST_CASE("Asking for what a checked call cannot lack is a fault of the command") {
  Keywords keywords;
  CHECK_THROWS_AS(keywords.at("E"), std::logic_error);
  CHECK_THROWS_AS(keywords.factor("ZONE"), std::logic_error);
}

TEST_CASE("The data of a concept is given as what it is, or refused") {
  const ConceptPtr mesh = tests::new_concept("MA", "mesh");
  Keywords keywords;
  keywords.items.push_back(keyword("MESH", Value(mesh)));
  CHECK_THROWS_AS(keywords.data<MeshData>("MESH"), std::logic_error);
  mesh->data = std::make_shared<MeshData>();
  CHECK(keywords.data<MeshData>("MESH").nodes == 4);
  CHECK_THROWS_AS(keywords.data<TableData>("MESH"), std::logic_error);
}

TEST_CASE("A default has the span of its call") {
  const CommandCall written = tests::written_call("LOAD", {{"E", Value(1.0)}});
  Keywords keywords;
  keywords.span = written.span;
  Keyword given = keyword("E", Value(1.0));
  given.value_span = written.arguments[0].value_span;
  keywords.items.push_back(given);
  keywords.items.push_back(keyword("N", Value(1), false));
  CHECK(tests::text_at(keywords.span_of("E")) == "1.0");
  CHECK(tests::text_at(keywords.span_of("N")) == tests::text_at(written.span));
}
