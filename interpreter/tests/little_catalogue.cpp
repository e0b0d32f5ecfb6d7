#include "interpreter/tests/little_catalogue.hpp"

#include "interpreter/values/dict.hpp"

namespace comma::interpreter::tests {
namespace {

const char* const concept_types = R"(
mesh: {doc: mesh}
model: {doc: model}
load: {doc: load}
special_load: {doc: special load, is_a: load}
result: {doc: result}
table: {doc: table}
)";

const char* const mesh_page = R"(
command: MESH
doc: Reads a mesh.
category: mesh
produces: mesh
keywords:
  UNIT: {type: input_unit, default: 20, doc: File.}
)";

const char* const shift_page = R"(
command: SHIFT
doc: Moves a mesh.
category: mesh
produces: mesh
reuse: {policy: compulsory, same_as: [MESH]}
keywords:
  MESH: {type: mesh, required: true, doc: Mesh.}
  BY: {type: result, doc: Result whose displacement moves it.}
)";

const char* const model_page = R"(
command: MODEL
doc: Makes a model.
category: model
produces: model
keywords:
  MESH: {type: mesh, required: true, doc: Mesh.}
)";

const char* const load_page = R"(
command: LOAD
doc: Makes a load.
category: loads
produces:
  - {type: special_load, when: "SPECIAL == 'YES'"}
  - {type: load}
example: L = LOAD(MODEL=MO, PRES=1.0)
keywords:
  MODEL: {type: model, required: true, doc: The model that bears it.}
  PRES: {type: real, above: 0, unit: Pa, doc: Pressure.}
  AXIS: {type: real, min: 2, max: 3, doc: Direction.}
  POINTS: {type: real, max: many, doc: Points.}
  PHASE: {type: complex, doc: Phase.}
  LEVEL: {type: integer, at_least: 0, at_most: 3, default: 1, doc: Level.}
  SPECIAL: {type: text, words: {YES: Special., NO: Ordinary., MAYBE: {doc: Undecided., supported: false}}, default: NO, doc: Kind.}
  NEAR: {type: real, aliases: [OLD_NEAR], default: -1.0, doc: Distance.}
  LATER: {type: real, supported: false, doc: Not yet.}
  SPOT:
    type: factor
    max: 2
    doc: Where.
    keywords:
      GROUP: {type: cell_group, max: many, doc: Groups.}
      ALL: {type: text, words: [YES], doc: Everything.}
      WEIGHT: {type: real, default: 1.0, doc: Weight.}
      UNIT_X: {type: real, doc: First component.}
      UNIT_Y: {type: real, doc: Second component.}
    rules:
      - exactly_one: [GROUP, ALL]
      - all_or_none: [UNIT_X, UNIT_Y]
    blocks:
      - when: SPECIAL == 'YES'
        keywords:
          DEGREE: {type: integer, required: true, doc: Degree of the special load.}
  TUNE:
    type: factor
    default: {}
    doc: Tuning.
    keywords:
      STEPS: {type: integer, default: 10, doc: Steps.}
blocks:
  - when: SPECIAL == 'YES'
    keywords:
      STRENGTH: {type: real, default: 2.0, doc: Strength.}
    blocks:
      - when: STRENGTH > 5.0
        keywords:
          WARNING: {type: text, default: strong, doc: Why.}
rules:
  - at_most_one: [PRES, POINTS]
  - requires: [PHASE, PRES]
)";

const char* const solve_page = R"(
command: SOLVE
doc: Solves.
category: solve
cost: solve
produces: result
reuse: {policy: allowed, same_as: [RESULT]}
keywords:
  MODEL: {type: model, required: true, doc: Model.}
  LOAD: {type: load, max: many, doc: Loads.}
  RESULT: {type: result, doc: Result to go on with.}
)";

const char* const table_page = R"(
command: TABLE
doc: Takes a table of a result.
category: post-process
produces: table
standalone: true
keywords:
  RESULT: {type: result, required: true, doc: Result.}
)";

const char* const print_page = R"(
command: PRINT
doc: Writes a file.
category: post-process
role: output
keywords:
  WHAT: {type: any, doc: Anything.}
  UNIT: {type: output_unit, default: 8, doc: File.}
unsupported:
  COLOUR: {type: text, doc: How it looks.}
)";

const char* const verify_page = R"(
command: VERIFY
doc: Gives a verdict.
category: verify
role: verdict
keywords:
  WHAT: {type: any, required: true, doc: Anything.}
)";

}  // namespace

LittleCatalogue::LittleCatalogue(const std::vector<std::string>& pages) {
  compiled.add_types(concept_types);
  for (const std::string& page : pages) compiled.add_page(page);
  blobs = compiled.blobs();
  catalogue = std::make_unique<Catalogue>(blobs);
}

LittleCatalogue little_catalogue() {
  return LittleCatalogue(
      {mesh_page, shift_page, model_page, load_page, solve_page, table_page, print_page, verify_page});
}

CommandCall written_call(const std::string& name, const Arguments& arguments) {
  std::string text = name + "(";
  std::vector<std::pair<std::size_t, std::size_t>> names, values;
  for (const auto& [keyword, value] : arguments) {
    names.emplace_back(text.size(), text.size() + keyword.size());
    text += keyword + "=";
    values.emplace_back(text.size(), text.size() + value.repr().size());
    text += value.repr() + ", ";
  }
  text += ")";
  const auto file = std::make_shared<const SourceFile>("test.comm", text);
  const auto span = [&](std::size_t begin, std::size_t end) {
    return Span{file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  };
  CommandCall call{name, span(0, name.size()), span(0, text.size()), {}};
  for (std::size_t i = 0; i < arguments.size(); ++i)
    call.arguments.push_back({arguments[i].first, span(names[i].first, names[i].second),
                              std::make_shared<const Value>(arguments[i].second),
                              span(values[i].first, values[i].second)});
  return call;
}

Value factor(const Arguments& arguments) {
  const CommandCall call = written_call("_F", arguments);
  auto places = std::make_shared<FactorPlaces>();
  places->span = call.span;
  auto made = std::make_shared<Dict>();
  for (const Argument& argument : call.arguments) {
    made->set(Value(argument.name), *argument.value);
    places->of_keywords.emplace(argument.name, FactorPlaces::Place{argument.name_span, argument.value_span});
  }
  made->factor = std::move(places);
  return Value(std::move(made));
}

ConceptPtr new_concept(const std::string& name, const std::string& type, int id) {
  auto handle = std::make_shared<Concept>();
  handle->name = name;
  handle->type = type;
  handle->id = id;
  return handle;
}

std::string text_at(const Span& span) {
  return span ? std::string(span.file->text().substr(span.begin, span.end - span.begin)) : "";
}

}  // namespace comma::interpreter::tests
