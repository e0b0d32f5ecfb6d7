// CA.TestCase(): claims that a command file makes about its own values, under the names of Python's unittest. Each claim
// goes to the host, which makes a verdict of it; a claim that does not hold stops nothing.
#pragma once

#include "interpreter/objects.hpp"

namespace comma::interpreter {

struct TestCaseObject : Object {
  std::string type_name() const override { return "TestCase"; }
};

/// TestCase(): takes the name of a method or nothing, as unittest does; neither means anything here.
Value make_test_case(Evaluator& evaluator, const CallArguments& arguments);

}  // namespace comma::interpreter
