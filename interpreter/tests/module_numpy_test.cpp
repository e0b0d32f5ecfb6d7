#include <catch2/catch.hpp>

#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using testing::Run;

namespace {

std::string printed(const std::string& expression) {
  const Run run("import numpy as np\nprint(" + expression + ")\n");
  INFO(expression);
  CHECK(run.findings().empty());
  return run.output.substr(0, run.output.size() - 1);
}

}  // namespace

TEST_CASE("Arrays compute element by element", "[numpy]") {
  CHECK(printed("(np.array([1, 2, 3]) * 2 + 1).tolist()") == "[3, 5, 7]");
  CHECK(printed("(1.0 / np.array([1., 2., 4.])).tolist()") == "[1.0, 0.5, 0.25]");
  CHECK(printed("(np.array([1, 2]) + np.array([10, 20])).tolist()") == "[11, 22]");
  CHECK(printed("(np.array([1., 5.]) > 2).tolist()") == "[False, True]");
}

TEST_CASE("Arrays are sliced by rows and columns", "[numpy]") {
  CHECK(printed("np.array([[1, 2], [3, 4]])[:, 1].tolist()") == "[2, 4]");
  CHECK(printed("np.array([[1, 2], [3, 4]])[1, 0]") == "3");
  CHECK(printed("np.array([[1, 2], [3, 4]])[0].tolist()") == "[1, 2]");
  CHECK(printed("np.arange(5)[::-1].tolist()") == "[4, 3, 2, 1, 0]");
  CHECK(printed("np.array([[1, 2, 3]]).shape") == "(1, 3)");
}

TEST_CASE("Arrays are turned round and put one after the other", "[numpy]") {
  CHECK(printed("np.array([[1, 2], [3, 4], [5, 6]]).T.tolist()") == "[[1, 3, 5], [2, 4, 6]]");
  CHECK(printed("np.transpose([[1., 2.]]).shape, np.array([1, 2]).T.tolist()") == "(2, 1) [1, 2]");
  CHECK(printed("np.concatenate((np.array([1, 2]), [3.5])).tolist()") == "[1.0, 2.0, 3.5]");
  CHECK(printed("np.concatenate([[[1, 2]], [[3, 4], [5, 6]]]).tolist()") == "[[1, 2], [3, 4], [5, 6]]");
  const Run run("import numpy as np\nx = np.concatenate([[[1, 2]], [3]])\n");
  REQUIRE(run.diagnostics.items().size() == 1);
  CHECK(run.diagnostics.items()[0].code == "value-error");
}

TEST_CASE("Ranges and reductions agree with their definitions", "[numpy]") {
  CHECK(printed("np.linspace(0, 1, 5).tolist()") == "[0.0, 0.25, 0.5, 0.75, 1.0]");
  CHECK(printed("np.arange(0, 1, 0.25).tolist()") == "[0.0, 0.25, 0.5, 0.75]");
  CHECK(printed("np.dot([1, 2], [3, 4]), np.linalg.norm([3., 4.]), np.cross([1, 0, 0], [0, 1, 0]).tolist()") ==
        "11 5.0 [0, 0, 1]");
  CHECK(printed("np.array([3, 1, 2]).max(), np.argmin([3, 1, 2]), np.mean([1, 2]), np.sum([1, 2])") == "3 1 1.5 3");
  CHECK(printed("np.dot([[1, 2], [3, 4]], [1, 1]).tolist()") == "[3, 7]");
}

TEST_CASE("Arrays of integers give no integer that they do not hold exactly", "[numpy]") {
  CHECK(printed("np.array([2**53]).tolist(), np.sum([2**52, 2**52])") == "[9007199254740992] 9007199254740992");
  CHECK(printed("(np.array([2**53]) * 4.0).tolist()") == "[3.602879701896397e+16]");
  for (const auto& [expression, code] : {std::pair{"np.array([2**53 + 2])[0]", "overflow"},
                                         std::pair{"(np.arange(5) ** 40).tolist()", "overflow"},
                                         std::pair{"np.sum([2**62, 2**62])", "overflow"},
                                         std::pair{"np.dot([2**40, 1], [2**40, 1])", "overflow"},
                                         std::pair{"np.array([float('nan')], dtype=int)[0]", "value-error"},
                                         std::pair{"np.array([2]) ** -1", "value-error"},
                                         std::pair{"np.array([1, 2]) // 0", "zero-division"},
                                         std::pair{"np.array([1, 2]) % 0", "zero-division"}}) {
    INFO(expression);
    const Run run(std::string("import numpy as np\nprint(") + expression + ")\n");
    REQUIRE(run.diagnostics.items().size() == 1);
    CHECK(run.diagnostics.items()[0].code == code);
  }
}

TEST_CASE("What numpy has and comma has not is told by name", "[numpy]") {
  const Run run("import numpy as np\nx = np.fft\n");
  REQUIRE(run.diagnostics.items().size() == 1);
  CHECK(run.diagnostics.items()[0].message == "module 'numpy' has no attribute 'fft'");
}
