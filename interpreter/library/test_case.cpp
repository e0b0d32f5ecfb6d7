#include "interpreter/library/test_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "interpreter/library/builtins.hpp"
#include "interpreter/library/pattern.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

constexpr int default_places = 7;  // unittest's own: assertAlmostEqual rounds the difference to 7 decimals

using Options = std::vector<std::string_view>;

/// The arguments of an assertion: its operands, then options in unittest's order, by place or by name.
class Claim {
 public:
  Claim(std::string_view method, const CallArguments& arguments, std::size_t operands, Options options = {"msg"})
      : arguments_(arguments), operands_(operands), options_(std::move(options)) {
    const std::size_t most = operands + options_.size();
    if (arguments.size() < operands || arguments.size() > most) {
      raise(ErrorKind::type,
            fmt::format("{}() takes {} to {} arguments, not {}", method, operands, most, arguments.size()));
    }
    for (const auto& item : arguments.named) {
      if (std::find(options_.begin(), options_.end(), item.name) == options_.end()) {
        raise(ErrorKind::type, fmt::format("{}() got an unexpected keyword argument '{}'", method, item.name));
      }
    }
    assertion_.method = method;
    assertion_.span = arguments.span;
    if (const Value message = option("msg"); message.is_text()) assertion_.message = message.as_text();
    assertion_.computed = arguments[0];
    if (operands > 1) assertion_.reference = arguments[1];
  }

  const Value& first() const { return arguments_[0]; }
  const Value& second() const { return arguments_[1]; }

  /// None when it is not given.
  Value option(std::string_view name) const {
    if (const Value* value = arguments_.find(name)) return *value;
    const auto place = static_cast<std::size_t>(std::find(options_.begin(), options_.end(), name) - options_.begin());
    return operands_ + place < arguments_.size() ? arguments_[operands_ + place] : Value();
  }

  Value judge(Evaluator& evaluator, bool holds, double tolerance = 0.0) {
    assertion_.holds = holds;
    assertion_.tolerance = tolerance;
    evaluator.host().judge(assertion_);
    return Value();
  }

 private:
  const CallArguments& arguments_;
  std::size_t operands_;
  Options options_;
  Assertion assertion_;
};

using Holds = bool (*)(const Value&, const Value&);

template <Operator op>
bool holds_as(const Value& a, const Value& b) {
  return truth(compare(op, a, b));
}
bool is_same(const Value& a, const Value& b) { return identical(a, b); }
bool is_other(const Value& a, const Value& b) { return !identical(a, b); }
bool lies_in(const Value& a, const Value& b) { return contains(b, a); }
bool lies_outside(const Value& a, const Value& b) { return !contains(b, a); }

struct Relation {
  std::string_view method;
  Holds holds;
};

constexpr std::array relations = {
    Relation{"assertEqual", holds_as<Operator::equal>},
    Relation{"assertNotEqual", holds_as<Operator::not_equal>},
    Relation{"assertSequenceEqual", holds_as<Operator::equal>},
    Relation{"assertListEqual", holds_as<Operator::equal>},
    Relation{"assertTupleEqual", holds_as<Operator::equal>},
    Relation{"assertDictEqual", holds_as<Operator::equal>},
    Relation{"assertSetEqual", holds_as<Operator::equal>},
    Relation{"assertGreater", holds_as<Operator::greater>},
    Relation{"assertGreaterEqual", holds_as<Operator::greater_equal>},
    Relation{"assertLess", holds_as<Operator::less>},
    Relation{"assertLessEqual", holds_as<Operator::less_equal>},
    Relation{"assertIs", is_same},
    Relation{"assertIsNot", is_other},
    Relation{"assertIn", lies_in},
    Relation{"assertNotIn", lies_outside},
};

template <std::size_t index>
Value assert_relation(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim(relations[index].method, arguments, 2);
  return claim.judge(evaluator, relations[index].holds(claim.first(), claim.second()));
}

Value assert_true(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertTrue", arguments, 1);
  return claim.judge(evaluator, truth(claim.first()));
}

Value assert_false(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertFalse", arguments, 1);
  return claim.judge(evaluator, !truth(claim.first()));
}

Value assert_none(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertIsNone", arguments, 1);
  return claim.judge(evaluator, claim.first().is_none());
}

Value assert_not_none(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertIsNotNone", arguments, 1);
  return claim.judge(evaluator, !claim.first().is_none());
}

/// How far apart two almost equal numbers may lie: `delta`, or half a unit of the last of `places` decimals.
double tolerance_of(const Claim& claim) {
  if (const Value delta = claim.option("delta"); !delta.is_none()) return real_of(delta);
  const Value places = claim.option("places");
  return 0.5 * std::pow(10.0, -static_cast<double>(places.is_none() ? default_places : index_of(places)));
}

Value judge_distance(Evaluator& evaluator, std::string_view method, const CallArguments& arguments, bool near) {
  Claim claim(method, arguments, 2, {"places", "msg", "delta"});
  const double tolerance = tolerance_of(claim);
  const bool equal = truth(compare(Operator::equal, claim.first(), claim.second()));
  const bool within = equal || std::abs(real_of(claim.first()) - real_of(claim.second())) <= tolerance;
  return claim.judge(evaluator, within == near, tolerance);
}

Value assert_almost_equal(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  return judge_distance(evaluator, "assertAlmostEqual", arguments, true);
}

Value assert_not_almost_equal(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  return judge_distance(evaluator, "assertNotAlmostEqual", arguments, false);
}

/// The names of the classes, as a message tells them.
std::string names_of(const Value& classes) {
  if (const auto* one = classes.as_object<ExceptionClassObject>()) return std::string(class_of(one->kind).name);
  std::string names;
  if (!classes.is_tuple())
    raise(ErrorKind::type, "assertRaises() arg 1 must be an exception type or tuple of exception types");
  for (const Value& each : classes.items()) names += (names.empty() ? "" : ", ") + names_of(each);
  return "(" + names + ")";
}

/// Without a function to call: what `with` watches over. With one: the call, judged.
Value expect_error(Evaluator& evaluator, std::string_view method, const CallArguments& arguments,
                   std::size_t operands) {
  if (arguments.size() < operands)
    raise(ErrorKind::type, fmt::format("{}() takes at least {} arguments, not {}", method, operands, arguments.size()));
  auto claim = std::make_shared<ExpectedError>();
  claim->classes = arguments[0];
  names_of(arguments[0]);
  if (operands > 1) {
    if (!arguments[1].is_text()) raise(ErrorKind::type, "the pattern must be a str, not " + arguments[1].type_name());
    claim->pattern = arguments[1].as_text();
    finds_pattern("", *claim->pattern);
  }
  claim->assertion.method = method;
  claim->assertion.span = arguments.span;
  if (arguments.size() == operands) {
    for (const auto& option : arguments.named)
      if (option.name != "msg")
        raise(ErrorKind::type, fmt::format("{}() got an unexpected keyword argument '{}'", method, option.name));
    if (const Value* message = arguments.find("msg"); message != nullptr && message->is_text())
      claim->assertion.message = message->as_text();
    return Value(std::shared_ptr<Object>(std::move(claim)));
  }
  CallArguments rest = arguments;
  rest.positional.erase(rest.positional.begin(), rest.positional.begin() + static_cast<std::ptrdiff_t>(operands) + 1);
  const auto raised = evaluator.attempt(arguments[operands], rest);
  if (!claim->judge(evaluator, raised)) throw RaisedError(raised);
  return Value();
}

Value assert_raises(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  return expect_error(evaluator, "assertRaises", arguments, 1);
}

Value assert_raises_regex(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  return expect_error(evaluator, "assertRaisesRegex", arguments, 2);
}

Value assert_instance(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertIsInstance", arguments, 2);
  return claim.judge(evaluator, is_instance(claim.first(), claim.second()));
}

Value assert_not_instance(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  Claim claim("assertNotIsInstance", arguments, 2);
  return claim.judge(evaluator, !is_instance(claim.first(), claim.second()));
}

/// printSummary(): the run itself sums its verdicts up.
Value print_summary(Evaluator&, const Value&, const CallArguments& arguments) {
  expect_arguments("printSummary", arguments, 0, 0);
  return Value();
}

template <std::size_t... index>
constexpr auto make_methods(std::index_sequence<index...>) {
  return std::array{MethodRow{relations[index].method, assert_relation<index>}...,
                    MethodRow{"assertTrue", assert_true},
                    MethodRow{"assertFalse", assert_false},
                    MethodRow{"assertIsNone", assert_none},
                    MethodRow{"assertIsNotNone", assert_not_none},
                    MethodRow{"assertAlmostEqual", assert_almost_equal},
                    MethodRow{"assertNotAlmostEqual", assert_not_almost_equal},
                    MethodRow{"assertIsInstance", assert_instance},
                    MethodRow{"assertNotIsInstance", assert_not_instance},
                    MethodRow{"assertRaises", assert_raises},
                    MethodRow{"assertRaisesRegex", assert_raises_regex},
                    MethodRow{"printSummary", print_summary}};
}

constexpr auto check_table = make_methods(std::make_index_sequence<relations.size()>());

}  // namespace

std::optional<Value> ExpectedError::attribute(std::string_view name) const {
  return name == "exception" ? std::optional(exception) : std::nullopt;
}

bool ExpectedError::judge(Evaluator& evaluator, const std::shared_ptr<ExceptionObject>& raised) {
  if (!raised && !evaluator.host().runs_calls()) return true;
  if (raised && !catches(classes, *raised)) return false;
  if (raised) exception = Value(std::shared_ptr<Object>(raised));
  assertion.holds = raised && (!pattern || finds_pattern(raised->text(), *pattern));
  if (!assertion.holds && assertion.message.empty())
    assertion.message = raised
                            ? fmt::format("{} does not hold {}", Value(raised->text()).repr(), Value(*pattern).repr())
                            : names_of(classes) + " not raised";
  evaluator.host().judge(assertion);
  return true;
}

Value make_test_case(Evaluator&, const CallArguments& arguments) {
  expect_arguments("TestCase", arguments, 0, 1);
  return Value(std::shared_ptr<Object>(std::make_shared<TestCaseObject>()));
}

std::span<const MethodRow> test_case_methods() { return check_table; }

}  // namespace comma::interpreter
