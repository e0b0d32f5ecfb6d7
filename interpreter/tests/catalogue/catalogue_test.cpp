#include "interpreter/catalogue/catalogue.hpp"

#include <catch2/catch.hpp>

#include "interpreter/tests/little_catalogue.hpp"
#include "interpreter/tools/catalogue_yaml.hpp"

using namespace comma::interpreter;
using tools::page_from_yaml;

namespace {

std::string problem_of(const std::string& yaml, const tools::SharedParts& shared = {}) {
  try {
    page_from_yaml(yaml, "page.yaml", shared);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const std::string head = "command: C\ndoc: Does.\ncategory: mesh\n";

/// What problems_of says of a page made of `head` and `rest`.
std::vector<std::string> problems(const std::string& rest) {
  const tests::LittleCatalogue little({head + rest});
  return tools::problems_of(little.catalogue->page("C"), *little.catalogue);
}

}  // namespace

TEST_CASE("A page keeps types, words, bounds, defaults and the order of its keywords") {
  const tests::LittleCatalogue little = tests::little_catalogue();
  const CommandPage& page = little.catalogue->page("LOAD");
  CHECK(page.doc == "Makes a load.");
  REQUIRE(page.inside.keywords.size() == 11);
  CHECK(page.inside.keywords[0].name == "MODEL");
  CHECK(page.inside.keywords[0].types[0].concept_type == "model");
  CHECK(page.inside.keywords[1].bounds.above == 0.0);
  CHECK(page.inside.keywords[2].max_count == 3);
  CHECK(page.inside.keywords[3].max_count == unlimited);
  CHECK(page.inside.keywords[5].default_value->as_integer() == 1);
  CHECK(page.inside.keywords[6].words[2].supported == false);
  CHECK(page.inside.keywords[10].present_by_default);
  CHECK(page.inside.blocks[0].inside.blocks.size() == 1);
}

TEST_CASE("A type that is a kind of another stands for it, not the other way round") {
  const tests::LittleCatalogue little = tests::little_catalogue();
  CHECK(little.catalogue->is_a("special_load", "load"));
  CHECK_FALSE(little.catalogue->is_a("load", "special_load"));
  CHECK(little.catalogue->is_a("load", "any"));
  CHECK(little.catalogue->describe_type("special_load") == "special load");
}

TEST_CASE("Words of YAML that look like booleans stay words") {
  const auto page =
      page_from_yaml(head + "keywords: {K: {type: text, doc: D, words: [OUI, NON, Y, 3D_SI], default: NON}}", "p");
  CHECK(page["keywords"]["K"]["words"] == tools::Json({"OUI", "NON", "Y", "3D_SI"}));
}

TEST_CASE("Names joined by commas share one description") {
  const auto page = page_from_yaml(head + "keywords: {'DX, DY': {type: real, doc: D}}", "p");
  CHECK(page["keywords"].contains("DX"));
  CHECK(page["keywords"].contains("DY"));
}

TEST_CASE("Keywords under `unsupported` are marked so") {
  const auto page = page_from_yaml(head + "unsupported: {K: {type: text, doc: D, unsupported_words: [A]}}", "p");
  CHECK(page["keywords"]["K"]["supported"] == false);
  CHECK(page["keywords"]["K"]["words"]["A"]["supported"] == false);
}

TEST_CASE("A shared part comes after the page's own keys, which win") {
  const tools::SharedParts shared{
      {"part",
       "keywords: {A: {type: real, doc: shared}, B: {type: real, doc: shared}}\nrules: [{at_most_one: [A, B]}]"}};
  const auto page = page_from_yaml(
      head + "use: part\nkeywords: {B: {type: integer, doc: own}}\nrules: [{exactly_one: [A, B]}]", "p", shared);
  CHECK(page["keywords"]["A"]["doc"] == "shared");
  CHECK(page["keywords"]["B"]["doc"] == "own");
  CHECK(page["keywords"].begin().key() == "B");
  CHECK(page["rules"].size() == 2);
}

TEST_CASE("What the format does not have stops the build, and is named") {
  CHECK(problem_of(head + "kewords: {}").find("the format has no key 'kewords'") != std::string::npos);
  CHECK(
      problem_of(head + "keywords: {A: {type: real, doc: D, defalt: 1}}").find("C/A: the format has no key 'defalt'") !=
      std::string::npos);
  CHECK(problem_of(head + "keywords: {A: {doc: D}}").find("'type' is missing") != std::string::npos);
  CHECK(problem_of(head + "keywords: {A: {type: factor, doc: D}}").find("a factor lists its keywords") !=
        std::string::npos);
  CHECK(problem_of(head + "keywords: {A: {type: factor, doc: D, keywords: {}}}").empty());
  CHECK(problem_of(head + "further: {type: real}").find("C/(any other name): the key 'doc' is missing") !=
        std::string::npos);
  CHECK(problem_of(head + "rules: [{one_of: [A]}]").find("no rule is called 'one_of'") != std::string::npos);
  CHECK(problem_of(head + "use: nothing").find("there is no shared part 'nothing'") != std::string::npos);
  CHECK(problem_of("command: C\ndoc: D\ncategory: fun").find("'fun' is none of mesh") != std::string::npos);
  CHECK(problem_of(head + "cost: [").find("page.yaml:4") != std::string::npos);
  CHECK(problem_of(head + "doc: again").find("page.yaml:4: doc is written twice") != std::string::npos);
}

TEST_CASE("A page that contradicts itself is found out") {
  CHECK(problems("keywords: {A: {type: real, doc: D, default: text}}").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D, default: -1.0, at_least: 0}}").size() == 1);
  CHECK(problems("keywords: {A: {type: text, doc: D, words: [X, Y], default: Z}}").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D, max: 2, min: 2, default: 1.0}}").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D, required: true, default: 1.0}}").size() == 1);
  CHECK(problems("keywords: {A: {type: martian, doc: D}}").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D}}\nrules: [{exactly_one: [A, B]}]").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D}}\nblocks: [{when: B == 1}]").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: ''}}").size() == 1);
  CHECK(problems("keywords: {A: {type: real, doc: D, default: 1}}").empty());
}

TEST_CASE(
    "Every page of comma is right: defaults obey their types, words and bounds, rules and conditions name keywords") {
  const auto compiled = tools::CompiledCatalogue::from_folder(std::string(COMMA_SOURCE_DIR) + "/commands/catalogue");
  const auto blobs = compiled.blobs();
  const Catalogue catalogue(blobs);
  REQUIRE(catalogue.names().size() >= 21);
  for (const std::string& name : catalogue.names()) {
    INFO(name);
    const CommandPage& page = catalogue.page(name);
    CHECK(tools::problems_of(page, catalogue) == std::vector<std::string>{});
    CHECK(page.name == name);
    CHECK_FALSE(page.example.empty());
  }
}
