// CA.TestCase(): claims that a command file makes about its own values, under the names of Python's unittest. Each
// claim goes to the host, which makes a verdict of it; a claim that does not hold stops nothing.
#pragma once

#include "interpreter/evaluation/host.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

/// assertRaises(ERROR), assertRaisesRegex(ERROR, pattern): what a block or a call has to raise; `exception` is what it
/// raised.
struct ExpectedError : HostObject {
  Value classes;
  std::optional<std::string> pattern;  ///< that the exception's text holds
  Assertion assertion;
  Value exception;

  std::string type_name() const override { return "_AssertRaisesContext"; }
  std::optional<Value> attribute(std::string_view name) const override;
  std::vector<std::string> attribute_names() const override { return {"exception"}; }

  /// Gives its verdict on what was raised, null for nothing. False for an exception of another class: it goes on its
  /// way up.
  bool judge(Evaluator& evaluator, const std::shared_ptr<ExceptionObject>& raised);
};

struct TestCaseObject : Object {
  std::string type_name() const override { return "TestCase"; }
};

/// TestCase(): takes the name of a method or nothing, as unittest does; neither means anything here.
Value make_test_case(Evaluator& evaluator, const CallArguments& arguments);

}  // namespace comma::interpreter
