#include "interpreter/catalogue/check.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "interpreter/tests/little_catalogue.hpp"
#include "interpreter/values/array.hpp"

using namespace comma::interpreter;
using namespace comma::interpreter::tests;

namespace {

/// Checks calls of the little catalogue and keeps what was said.
struct Checker {
  LittleCatalogue little = little_catalogue();
  Diagnostics diagnostics;
  ConceptPtr mesh = new_concept("MA", "mesh", 0);
  ConceptPtr model = new_concept("MO", "model", 1);

  CheckedCall check(const std::string& name, const Arguments& arguments, Severity unsupported = Severity::error) {
    return check_call(written_call(name, arguments), little.catalogue->page(name), *little.catalogue, diagnostics,
                      unsupported);
  }

  /// The one diagnostic of LOAD(MODEL=MO, ...).
  Diagnostic only(Arguments arguments) {
    arguments.insert(arguments.begin(), {"MODEL", Value(model)});
    return only_of("LOAD", arguments);
  }

  Diagnostic only_of(const std::string& name, const Arguments& arguments) {
    const CheckedCall checked = check(name, arguments);
    REQUIRE(diagnostics.items().size() == 1);
    CHECK_FALSE(checked.sound);
    return diagnostics.items().front();
  }
};

void expect(const Diagnostic& found, const std::string& code, const std::string& message, const std::string& at,
            const std::string& hint = "") {
  CHECK(found.code == code);
  CHECK(found.message == message);
  CHECK(text_at(found.span) == at);
  CHECK(found.hint == hint);
}

}  // namespace

TEST_CASE("A call without a mistake is converted and completed with defaults") {
  Checker checker;
  const CheckedCall checked = checker.check(
      "LOAD", {{"MODEL", Value(checker.model)}, {"PRES", Value(3)}, {"AXIS", Value::list({Value(1), Value(0)})}});
  REQUIRE(checker.diagnostics.items().empty());
  CHECK(checked.sound);
  CHECK(checked.complete);
  CHECK(checked.product_type == "load");
  const Call& call = checked.call;
  CHECK(call.concept_of("MODEL") == checker.model);
  CHECK(call.at("PRES").value.is_real());
  CHECK(call.real("PRES") == 3.0);
  CHECK(call.reals("AXIS") == std::vector<double>{1.0, 0.0});
  CHECK(call.integer("LEVEL") == 1);
  CHECK_FALSE(call.given("LEVEL"));
  CHECK(call.factor("TUNE").integer("STEPS") == 10);
  CHECK_FALSE(call.has("POINTS"));
}

TEST_CASE("A vector of numpy is taken as the tuple of its numbers") {
  Checker checker;
  const CheckedCall checked = checker.check("LOAD", {{"MODEL", Value(checker.model)},
                                                     {"AXIS", make_value({{1.0, 0.0}, {2}, NumberType::integer})},
                                                     {"POINTS", make_value({{0.5, 1.0, 1.5}, {3}, NumberType::real})}});
  REQUIRE(checker.diagnostics.items().empty());
  CHECK(checked.call.reals("AXIS") == std::vector<double>{1.0, 0.0});
  CHECK(checked.call.at("POINTS").value.is_tuple());
  CHECK(checked.call.reals("POINTS") == std::vector<double>{0.5, 1.0, 1.5});
}

TEST_CASE("Vectors of numpy are checked as tuples are") {
  CHECK(Checker().only({{"AXIS", make_value({{1.0}, {1}, NumberType::real})}}).code == "wrong-count");
  CHECK(Checker().only({{"AXIS", make_value({{1.0, HUGE_VAL}, {2}, NumberType::real})}}).code == "out-of-bounds");
  const Diagnostic matrix = Checker().only({{"AXIS", make_value({{1.0, 2.0}, {1, 2}, NumberType::real})}});
  CHECK(matrix.code == "wrong-type");
  CHECK(matrix.hint == "a keyword takes an array of one dimension: flatten() makes it one");
}

TEST_CASE("A condition brings its block, with defaults that further conditions see") {
  Checker checker;
  const CheckedCall weak = checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"SPECIAL", Value("YES")}});
  CHECK(weak.product_type == "special_load");
  CHECK(weak.call.real("STRENGTH") == 2.0);
  CHECK_FALSE(weak.call.has("WARNING"));
  const CheckedCall strong =
      checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"SPECIAL", Value("YES")}, {"STRENGTH", Value(6.0)}});
  CHECK(strong.call.text("WARNING") == "strong");
  CHECK(checker.diagnostics.items().empty());
}

TEST_CASE("A block inside a factor sees the keywords around the factor") {
  Checker checker;
  const Value spot = factor({{"ALL", Value("YES")}, {"DEGREE", Value(2)}});
  const CheckedCall checked =
      checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"SPECIAL", Value("YES")}, {"SPOT", spot}});
  CHECK(checker.diagnostics.items().empty());
  CHECK(checked.call.factors("SPOT").front().integer("DEGREE") == 2);
}

TEST_CASE("Factors may be one, several, or a dict") {
  Checker checker;
  const Value one = factor({{"ALL", Value("YES")}});
  const Value dict = Value::dict({{"GROUP", Value("TOP")}});
  const CheckedCall checked =
      checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"SPOT", Value::list({one, dict})}});
  CHECK(checker.diagnostics.items().empty());
  REQUIRE(checked.call.factors("SPOT").size() == 2);
  CHECK(checked.call.factors("SPOT")[1].texts("GROUP") == std::vector<std::string>{"TOP"});
}

TEST_CASE("The number that an editor gives a command passes with any") {
  Checker checker;
  CHECK(checker.check("LOAD", {{"identifier", Value("3:1")}, {"MODEL", Value(checker.model)}, {"PRES", Value(3)}})
            .complete);
  CHECK(checker.diagnostics.items().empty());
}

TEST_CASE("None leaves a keyword out") {
  Checker checker;
  const CheckedCall checked =
      checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"LEVEL", Value()}, {"PRES", Value()}});
  CHECK(checker.diagnostics.items().empty());
  CHECK(checked.call.integer("LEVEL") == 1);
  CHECK_FALSE(checked.call.has("PRES"));
}

TEST_CASE("An older name of a keyword gives the newer one") {
  Checker checker;
  const CheckedCall checked = checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"OLD_NEAR", Value(0.5)}});
  CHECK(checker.diagnostics.items().empty());
  CHECK(checked.call.real("NEAR") == 0.5);
  CHECK(checked.call.given("NEAR"));
}

TEST_CASE("Complex numbers are numbers or ('RI', real, imaginary) or ('MP', modulus, degrees)") {
  Checker checker;
  const auto phase = [&](const Value& value) {
    return checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"PRES", Value(1.0)}, {"PHASE", value}})
        .call.at("PHASE")
        .value.as_complex();
  };
  CHECK(phase(Value::tuple({Value("RI"), Value(1.0), Value(2)})) == std::complex<double>(1.0, 2.0));
  CHECK(phase(Value(4.0)) == std::complex<double>(4.0, 0.0));
  const auto turned = phase(Value::tuple({Value("MP"), Value(2.0), Value(90.0)}));
  CHECK(turned.real() == Approx(0.0).margin(1e-15));
  CHECK(turned.imag() == Approx(2.0));
  CHECK(checker.diagnostics.items().empty());
}

TEST_CASE("A misspelt keyword is told with the nearest one") {
  expect(Checker().only({{"PRESS", Value(1.0)}}), "unknown-keyword", "LOAD has no keyword PRESS", "PRESS",
         "did you mean PRES?");
}

TEST_CASE("A keyword of a block is told with the condition of the block") {
  expect(Checker().only({{"STRENGTH", Value(1.0)}}), "unknown-keyword", "LOAD has STRENGTH only when SPECIAL == 'YES'",
         "STRENGTH");
}

TEST_CASE("A keyword of a factor that stands outside is sent inside") {
  expect(Checker().only({{"WEIGHT", Value(1.0)}}), "unknown-keyword", "LOAD has no keyword WEIGHT", "WEIGHT",
         "it belongs inside SPOT=_F(...)");
}

TEST_CASE("A misspelt word is told with the nearest one") {
  expect(Checker().only({{"SPECIAL", Value("YESS")}}), "unknown-word", "LOAD/SPECIAL does not know 'YESS'", "'YESS'",
         "did you mean 'YES'?");
}

TEST_CASE("A word that resembles none is told with all of them") {
  expect(Checker().only({{"SPECIAL", Value("QQQQQQ")}}), "unknown-word", "LOAD/SPECIAL does not know 'QQQQQQ'",
         "'QQQQQQ'", "one of 'YES', 'NO', 'MAYBE'");
}

TEST_CASE("A missing compulsory keyword is told at the command") {
  expect(Checker().only_of("LOAD", {}), "missing-keyword", "LOAD needs MODEL", "LOAD",
         "write MODEL=...: The model that bears it.");
}

TEST_CASE("A text where a number is wanted") {
  expect(Checker().only({{"PRES", Value("abc")}}), "wrong-type", "LOAD/PRES wants a real number, not the text 'abc'",
         "'abc'");
  expect(Checker().only({{"PRES", Value("2.5e3")}}), "wrong-type",
         "LOAD/PRES wants a real number, not the text '2.5e3'", "'2.5e3'", "leave out the quotes");
}

TEST_CASE("A real where an integer is wanted") {
  expect(Checker().only({{"LEVEL", Value(1.5)}}), "wrong-type", "LOAD/LEVEL wants an integer, not 1.5", "1.5",
         "write it without a decimal point");
}

TEST_CASE("A bool is no number") {
  expect(Checker().only({{"PRES", Value(true)}}), "wrong-type", "LOAD/PRES wants a real number, not True (bool)",
         "True");
}

TEST_CASE("A concept of another type is told with what it is and what makes the right one") {
  Checker checker;
  expect(checker.only_of("LOAD", {{"MODEL", Value(checker.mesh)}}), "wrong-concept-type",
         "LOAD/MODEL wants a model (model), not MA, a mesh (mesh)", "MA", "made by MODEL");
}

TEST_CASE("A special concept passes where the general one is asked") {
  Checker checker;
  const CheckedCall checked =
      checker.check("SOLVE", {{"MODEL", Value(checker.model)}, {"LOAD", Value(new_concept("L", "special_load", 5))}});
  CHECK(checked.sound);
}

TEST_CASE("A simple value where _F is wanted") {
  expect(Checker().only({{"SPOT", Value(3)}}), "wrong-type", "LOAD/SPOT wants _F(...), not 3", "3",
         "write SPOT=_F(...)");
}

TEST_CASE("_F where a simple value is wanted") {
  const Diagnostic found = Checker().only({{"PRES", factor({{"A", Value(1)}})}});
  CHECK(found.code == "wrong-type");
  CHECK(found.hint == "LOAD/PRES is a simple keyword: give it a value, without _F(...)");
}

TEST_CASE("A number out of its bounds") {
  expect(Checker().only({{"PRES", Value(0.0)}}), "out-of-bounds", "LOAD/PRES must be above 0; it is 0.0", "0.0");
  expect(Checker().only({{"LEVEL", Value(4)}}), "out-of-bounds", "LOAD/LEVEL must be at least 0 and at most 3; it is 4",
         "4");
}

TEST_CASE("An integer that the machine would cut off") {
  expect(Checker().only({{"TUNE", factor({{"STEPS", Value(std::int64_t{4294967296})}})}}), "out-of-bounds",
         "LOAD/TUNE/STEPS must be an integer of 32 bits; it is 4294967296", "4294967296", "2147483647 at most");
}

TEST_CASE("Too few and too many values") {
  expect(Checker().only({{"AXIS", Value(1.0)}}), "wrong-count", "LOAD/AXIS wants 2 to 3 values, not 1", "1.0");
  const Value two = Value::tuple({Value(1.0), Value(2.0)});
  expect(Checker().only({{"PRES", two}}), "wrong-count", "LOAD/PRES wants 1 value, not 2", "(1.0, 2.0)");
}

TEST_CASE("A single value between brackets is a single value") {
  Checker checker;
  const CheckedCall checked =
      checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"PRES", Value::tuple({Value(2.0)})}});
  CHECK(checked.call.real("PRES") == 2.0);
}

TEST_CASE("Too many occurrences of a factor") {
  const Value spot = factor({{"ALL", Value("YES")}});
  const Diagnostic found = Checker().only({{"SPOT", Value::tuple({spot, spot, spot})}});
  CHECK(found.code == "too-many-occurrences");
  CHECK(found.message == "LOAD/SPOT takes 1 to 2 occurrences, not 3");
}

TEST_CASE("Keywords that exclude each other") {
  expect(Checker().only({{"PRES", Value(1.0)}, {"POINTS", Value(2.0)}}), "exclusive-keywords",
         "LOAD takes PRES or POINTS, not both", "POINTS", "keep one of them");
}

TEST_CASE("A misspelt keyword excludes none") {
  CHECK(Checker().only({{"PRESS", Value(1.0)}, {"POINTS", Value(2.0)}}).code == "unknown-keyword");
}

TEST_CASE("None of the keywords of which one is needed") {
  const Diagnostic found = Checker().only({{"SPOT", factor({{"WEIGHT", Value(2.0)}})}});
  expect(found, "missing-one-of", "LOAD/SPOT needs one of GROUP, ALL", "_F(WEIGHT=2.0, )");
}

TEST_CASE("A keyword that goes together with another") {
  expect(Checker().only({{"PHASE", Value(1.0)}}), "requires-keyword", "LOAD/PHASE goes together with PRES", "PHASE",
         "add PRES");
  const Diagnostic found = Checker().only({{"SPOT", factor({{"ALL", Value("YES")}, {"UNIT_Y", Value(1.0)}})}});
  expect(found, "requires-keyword", "LOAD/SPOT/UNIT_Y goes together with UNIT_X", "UNIT_Y", "add UNIT_X");
}

TEST_CASE("A keyword given twice, also under its older name") {
  expect(Checker().only({{"NEAR", Value(1.0)}, {"OLD_NEAR", Value(2.0)}}), "duplicate-keyword",
         "LOAD is given NEAR twice (OLD_NEAR is its older name)", "OLD_NEAR", "keep one of them");
}

TEST_CASE("A missing keyword inside a factor's block") {
  Checker checker;
  const Value spot = factor({{"ALL", Value("YES")}});
  const Diagnostic found = checker.only({{"SPECIAL", Value("YES")}, {"SPOT", spot}});
  CHECK(found.code == "missing-keyword");
  CHECK(found.message == "LOAD/SPOT needs DEGREE");
}

TEST_CASE("What comma does not support is an error before a run and an alarm in a check") {
  Checker run;
  expect(run.only({{"LATER", Value(1.0)}}), "unsupported", "comma does not support LOAD/LATER yet", "LATER");
  Checker word;
  expect(word.only({{"SPECIAL", Value("MAYBE")}}), "unsupported", "comma does not support LOAD/SPECIAL='MAYBE' yet",
         "'MAYBE'");
  Checker check;
  const CheckedCall checked =
      check.check("LOAD", {{"MODEL", Value(check.model)}, {"LATER", Value(1.0)}}, Severity::alarm);
  CHECK(checked.sound);
  CHECK_FALSE(checked.complete);
  CHECK_FALSE(check.diagnostics.has_errors());
}

TEST_CASE("reuse= where nothing is changed in place") {
  Checker checker;
  expect(checker.only_of("MODEL", {{"reuse", Value(checker.model)}, {"MESH", Value(checker.mesh)}}), "bad-reuse",
         "MODEL makes a new concept: it has no reuse=", "reuse");
}

TEST_CASE("reuse= that is missing where it is compulsory") {
  Checker checker;
  expect(checker.only_of("SHIFT", {{"MESH", Value(checker.mesh)}}), "bad-reuse",
         "SHIFT changes MESH in place and needs reuse=", "SHIFT", "add reuse= with the concept of MESH");
}

TEST_CASE("reuse= of another concept than the one that is given") {
  Checker checker;
  const ConceptPtr other = new_concept("MB", "mesh", 7);
  expect(checker.only_of("SHIFT", {{"reuse", Value(other)}, {"MESH", Value(checker.mesh)}}), "bad-reuse",
         "reuse=MB must be the concept of MESH", "MB");
}

TEST_CASE("reuse= of a concept of another type") {
  Checker checker;
  expect(checker.only_of("SHIFT", {{"reuse", Value(checker.model)}, {"MESH", Value(checker.mesh)}}), "bad-reuse",
         "SHIFT cannot change MO in place: it is a model (model)", "MO");
}

TEST_CASE("reuse= gives back the same concept") {
  Checker checker;
  const CheckedCall checked = checker.check("SHIFT", {{"reuse", Value(checker.mesh)}, {"MESH", Value(checker.mesh)}});
  CHECK(checked.sound);
  CHECK(checked.call.reuse);
  CHECK(checked.call.result == checker.mesh);
}

TEST_CASE("An unknown value passes every check, and the call will not run") {
  Checker checker;
  const Value unknown = Value::unknown();
  const CheckedCall checked = checker.check(
      "LOAD",
      {{"MODEL", unknown}, {"PRES", unknown}, {"SPECIAL", unknown}, {"SPOT", unknown}, {"STRENGTH", Value(1.0)}});
  CHECK(checker.diagnostics.items().empty());
  CHECK(checked.sound);
  CHECK_FALSE(checked.complete);
}

TEST_CASE("All mistakes of a call are told, each once") {
  Checker checker;
  checker.check("LOAD", {{"PRESS", Value(1.0)}, {"LEVEL", Value(9)}, {"SPECIAL", Value("YESS")}});
  std::vector<std::string> codes;
  for (const Diagnostic& found : checker.diagnostics.items()) codes.push_back(found.code);
  CHECK(codes == std::vector<std::string>{"missing-keyword", "out-of-bounds", "unknown-word", "unknown-keyword"});
}

TEST_CASE("A value of a wrong type in a condition makes one error, at the value") {
  Checker checker;
  const Diagnostic found = checker.only({{"SPECIAL", Value("YES")}, {"STRENGTH", Value("strong")}});
  expect(found, "wrong-type", "LOAD/STRENGTH wants a real number, not the text 'strong'", "'strong'");
}

TEST_CASE("An empty list of occurrences leaves a factor out") {
  Checker checker;
  const CheckedCall checked = checker.check("LOAD", {{"MODEL", Value(checker.model)}, {"SPOT", Value::tuple({})}});
  CHECK(checker.diagnostics.items().empty());
  CHECK_FALSE(checked.call.has("SPOT"));
}

TEST_CASE("A page may let the user choose further names; their values pass as they were written") {
  const LittleCatalogue little(
      {"command: FORMULA\ndoc: Makes a formula.\ncategory: functions\n"
       "keywords: {TEXT: {type: text, doc: The expression., required: true}}\n"
       "further: {type: anything, doc: A name of the expression.}"});
  const auto check = [&](const Arguments& arguments, Diagnostics& diagnostics) {
    return check_call(written_call("FORMULA", arguments), little.catalogue->page("FORMULA"), *little.catalogue,
                      diagnostics, Severity::error);
  };
  const Value list = Value::list({Value(1.0), Value("b")});
  Diagnostics said;
  const CheckedCall checked = check({{"TEXT", Value("a*x")}, {"a", Value(2)}, {"table", list}}, said);
  CHECK(said.items().empty());
  CHECK(checked.complete);
  CHECK(checked.call.integer("a") == 2);
  CHECK(checked.call.at("table").value.is_list());
  check({{"TEXT", Value("a*x")}, {"a", Value(2)}, {"a", Value(3)}}, said);
  REQUIRE(said.items().size() == 1);
  CHECK(said.items().front().code == "duplicate-keyword");
}

TEST_CASE("reuse= goes with a keyword only where that keyword is given") {
  Checker checker;
  const ConceptPtr result = new_concept("R", "result", 9);
  const CheckedCall checked = checker.check("SOLVE", {{"reuse", Value(result)}, {"MODEL", Value(checker.model)}});
  CHECK(checked.sound);
  CHECK(checked.call.result == result);
}

TEST_CASE("A keyword of a block that may not be there is judged as far as it is certain") {
  Checker checker;
  const auto only = checker.only({{"SPECIAL", Value::unknown()}, {"STRENGTH", Value("strong")}});
  expect(only, "wrong-type", "LOAD/STRENGTH wants a real number, not the text 'strong'", "'strong'");
}

TEST_CASE("Where further keywords may be given that are not known, none is missing") {
  Checker checker;
  CommandCall call =
      written_call("LOAD", {{"PRES", Value(-1.0)}, {"PHASE", Value(1.0)}, {"SPOT", factor({{"UNIT_X", Value(1.0)}})}});
  call.open = true;
  const CheckedCall checked = check_call(call, checker.little.catalogue->page("LOAD"), *checker.little.catalogue,
                                         checker.diagnostics, Severity::error);
  std::vector<std::string> codes;
  for (const Diagnostic& item : checker.diagnostics.items()) codes.push_back(item.code);
  CHECK(codes == std::vector<std::string>{"out-of-bounds", "missing-one-of", "requires-keyword"});
  CHECK_FALSE(checked.complete);
}
