#include "commands/functions/functions.hpp"

#include <catch2/catch.hpp>

#include <array>

#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

using namespace comma::commands;
using comma::interpreter::Concept;
using comma::interpreter::DiagnosticError;
using comma::interpreter::Formula;
using comma::interpreter::Value;
using comma::solver::Extension;
using comma::solver::Point;
using comma::solver::TabulatedFunction;

namespace {

std::shared_ptr<Concept> handle_of(std::shared_ptr<FunctionConcept> function) {
  auto handle = std::make_shared<Concept>();
  handle->name = "F";
  handle->data = std::move(function);
  return handle;
}

std::shared_ptr<Concept> formula(const char* text, std::vector<std::string> parameters) {
  return handle_of(std::make_shared<FormulaConcept>(Formula(text, std::move(parameters)), comma::interpreter::Span()));
}

std::shared_ptr<const TabulatedFunction> line(double slope) {
  TabulatedFunction function;
  function.parameter = "EPSI";
  function.x = {0.0, 1.0};
  function.y = {0.0, slope};
  return std::make_shared<const TabulatedFunction>(function);
}

std::string code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const DiagnosticError& error) {
    return error.diagnostic().code;
  } catch (const comma::solver::Error& error) {
    return error.code();
  }
  return "";
}

}  // namespace

TEST_CASE("The solver gives a formula place and time by name, in whatever order it asks for them") {
  const auto field = field_function(formula("1000 * INST + 100 * Z + 10 * Y + X", {"INST", "Y", "X", "Z"}), {});
  CHECK(field(Point{1.0, 2.0, 3.0}, 4.0) == 4321.0);
  const auto constant = field_function(handle_of(std::make_shared<ConstantConcept>(7.0)), {});
  CHECK(constant(Point{1.0, 2.0, 3.0}, 4.0) == 7.0);
  const auto time = time_function(formula("INST**2", {"INST"}), {});
  CHECK(time(3.0) == 9.0);
}

TEST_CASE("A parameter that has no value there is an error, not a zero") {
  CHECK(code_of([] { field_function(formula("X * TEMP", {"X", "TEMP"}), {}); }) == "unknown-parameter");
  CHECK(code_of([] { time_function(formula("X", {"X"}), {}); }) == "unknown-parameter");
}

TEST_CASE("The function that the solver holds outlives the concept") {
  auto handle = formula("2 * INST", {"INST"});
  const auto time = time_function(handle, {});
  handle->data.reset();
  handle.reset();
  CHECK(time(1.5) == 3.0);
}

TEST_CASE("A function of two parameters interpolates between its rows and goes on as it is told") {
  TabulatedFunction edges;
  edges.parameter = "TEMP";
  edges.x = {0.0, 10.0, 30.0};
  edges.right = Extension::constant;
  const auto at = [&](double temperature, double strain) {
    return SurfaceConcept(edges, {line(1.0), line(2.0), line(6.0)}).evaluate(std::array{temperature, strain});
  };
  CHECK(at(0.0, 0.5) == Approx(0.5));
  CHECK(at(10.0, 0.5) == Approx(1.0));
  CHECK(at(5.0, 1.0) == Approx(1.5));
  CHECK(at(20.0, 1.0) == Approx(4.0));
  CHECK(at(99.0, 1.0) == Approx(6.0));
  CHECK(code_of([&] { at(-1.0, 1.0); }) == "out-of-function");
  edges.left = Extension::linear;
  CHECK(at(-10.0, 1.0) == Approx(0.0).margin(1e-12));
}

TEST_CASE("A function called in the language with wrong arguments, or beyond its ends, is an error of the language") {
  const TabulatedConcept table(*line(1.0));
  CHECK(table.call({Value(0.25)}).as_real() == 0.25);
  CHECK(code_of([&] { table.call({Value("a")}); }) == "type-error");
  CHECK(code_of([&] { table.call({Value(1), Value(2)}); }) == "type-error");
  CHECK_THROWS_AS(table.call({Value(2.0)}), DiagnosticError);
}
