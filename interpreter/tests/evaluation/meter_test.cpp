#include "interpreter/evaluation/meter.hpp"

#include <catch2/catch.hpp>

#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using testing::Run;

TEST_CASE("Whatever takes too much ends in a diagnostic", "[meter]") {
  Limits limits;
  limits.steps = 200'000;
  limits.largest_object = 1U << 20;
  limits.integer_bits = 1U << 13;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"while True:\n    x = 1\n", "limit-steps"},
      {"for i in range(10**18): pass\n", "limit-steps"},
      {"x = sum(i for i in range(10**18))\n", "limit-steps"},
      {"x = list(range(10**18))\n", "limit-memory"},
      {"x = 'a' * 10**12\n", "limit-memory"},
      {"x = [0] * 10**12\n", "limit-memory"},
      {"x = 10**10**10\n", "limit-memory"},
      {"x = 1 << 10**12\n", "limit-memory"},
      {"x = 3\nfor i in range(100): x = x * x\n", "limit-memory"},
      {"s = 'ab'\nwhile True: s += s\n", "limit-memory"},
      {"l = [1]\nwhile True: l += l\n", "limit-memory"},
      {"l = []\nwhile True: l.append('x' * 100000)\n", "limit-steps"},
      {"x = '%1000000d' % 1 * 50\n", "limit-memory"},
      {"x = '{:900000}'.format(1) * 50\n", "limit-memory"},
      {"x = '-'.join(['a' * 1000] * 3000)\n", "limit-memory"},
      {"import numpy\nx = numpy.zeros(10**12)\n", "limit-memory"},
      {"import math\nx = math.factorial(10**9)\n", "limit-memory"},
      {"x = 'aaaa'.replace('', 'b' * 900000)\n", "limit-memory"},
      {"try:\n    while True: pass\nexcept: pass\nprint('never')\n", "limit-steps"},
  };
  for (const auto& [text, code] : cases) {
    INFO(text);
    const Run run(text, limits);
    REQUIRE(run.diagnostics.items().size() == 1);
    CHECK(run.diagnostics.items()[0].code == code);
    CHECK(run.diagnostics.items()[0].span.file != nullptr);
    CHECK(run.output.empty());
  }
}

TEST_CASE("Endless recursion is an exception that can be caught, in calls and in expressions", "[meter]") {
  CHECK(Run("def f(n): return f(n + 1)\ntry:\n    f(0)\nexcept RecursionError:\n    print('deep')\n").output ==
        "deep\n");
  CHECK(
      Run("def f(n): return [f(i) for i in [n]]\ntry:\n    f(0)\nexcept RecursionError:\n    print('deep')\n").output ==
      "deep\n");
  CHECK(Run("def f(n): return sorted([1, 2], key=lambda v: f(v))\ntry:\n    f(0)\nexcept RecursionError:\n    "
            "print('deep')\n")
            .output == "deep\n");
}
