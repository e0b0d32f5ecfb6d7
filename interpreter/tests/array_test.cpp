// What numpy 1.24 answers, written down.
#include <catch2/catch.hpp>

#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using testing::Run;

namespace {

std::string output_of(const std::string& statements) {
  const Run run("import numpy as np\n" + statements + "\n");
  INFO(statements);
  CHECK(run.findings().empty());
  return run.output;
}

/// The code and the message of the only finding.
std::pair<std::string, std::string> finding_of(const std::string& statements) {
  const Run run("import numpy as np\n" + statements + "\n");
  INFO(statements);
  REQUIRE(run.diagnostics.items().size() == 1);
  return {run.diagnostics.items()[0].code, run.diagnostics.items()[0].message};
}

}  // namespace

TEST_CASE("Integers and slices give windows on the same numbers", "[array]") {
  const std::string a = "a = np.array([[1, 2, 3], [4, 5, 6]])\n";
  const auto left = [&](const std::string& statements) { return output_of(a + statements + "\nprint(a.tolist())"); };
  CHECK(left("a[0][0] = 9") == "[[9, 2, 3], [4, 5, 6]]\n");
  CHECK(left("b = a[1]\nb[0] = 9") == "[[1, 2, 3], [9, 5, 6]]\n");
  CHECK(left("b = a[:, 1]\nb[:] = 0") == "[[1, 0, 3], [4, 0, 6]]\n");
  CHECK(left("a[::-1, ::2][0] = [7, 8]") == "[[1, 2, 3], [7, 5, 8]]\n");
  CHECK(left("a.T[0] = [7, 8]") == "[[7, 2, 3], [8, 5, 6]]\n");
  CHECK(left("a.ravel()[1] = 9\na.flatten()[0] = 9") == "[[1, 9, 3], [4, 5, 6]]\n");
  CHECK(left("for r in a: r[2] = 5") == "[[1, 2, 5], [4, 5, 5]]\n");
  CHECK(left("b = np.asarray(a)\nb[0, 0] = 9") == "[[9, 2, 3], [4, 5, 6]]\n");
  CHECK(left("b = np.array(a); b[0, 0] = 9\nc = a.copy(); c[0, 0] = 9\nd = a * 1; d[0, 0] = 9\n"
             "e = list(a[0]); e[0] = 9") == "[[1, 2, 3], [4, 5, 6]]\n");
}

TEST_CASE("What is written into an array is stretched to the place and keeps the array's type", "[array]") {
  const std::string a = "a = np.array([[1, 2, 3], [4, 5, 6]])\n";
  CHECK(output_of(a + "a[:, 1:] = [[7], [8]]\nprint(a.tolist())") == "[[1, 7, 7], [4, 8, 8]]\n");
  CHECK(output_of(a + "a[1] = 2.9\nprint(a.tolist())") == "[[1, 2, 3], [2, 2, 2]]\n");
  CHECK(output_of("a = np.arange(5)\na[1:] = a[:-1]\nprint(a.tolist())") == "[0, 0, 1, 2, 3]\n");
  CHECK(finding_of(a + "a[0] = [1, 2]").second == "could not broadcast input array from shape (2,) into shape (3,)");
  CHECK(finding_of(a + "a[0, 0] = float('nan')").second == "cannot convert float NaN to integer");
  CHECK(finding_of(a + "a[2]").second == "index 2 is out of bounds for axis 0 with size 2");
  CHECK(finding_of(a + "a[0, 3] = 1").second == "index 3 is out of bounds for axis 1 with size 3");
  CHECK(finding_of(a + "a[0, 0, 0]").second == "too many indices for array: array is 2-dimensional");
}

TEST_CASE("In-place operators change the array itself", "[array]") {
  CHECK(output_of("x = np.array([1., 2.])\ny = x\ny += 1\nprint(x.tolist(), y is x)") == "[2.0, 3.0] True\n");
  CHECK(output_of("def f(v):\n  v *= 2.\n  v[0] = 7.\nx = np.array([1., 2.])\nf(x)\nprint(x.tolist())") == "[7.0, 4.0]\n");
  CHECK(output_of("a = np.array([[1., 2.], [3., 4.]])\na[0] -= 1\na[:, 1] /= 2\na[1, 0] **= 2\nprint(a.tolist())") ==
        "[[0.0, 0.5], [9.0, 2.0]]\n");
  CHECK(output_of("a = np.array([7, -7])\na //= 2\na %= 3\nprint(a.tolist())") == "[0, 2]\n");
  CHECK(output_of("a = np.ones((2, 2))\na += [1, 2]\nprint(a.tolist())") == "[[2.0, 3.0], [2.0, 3.0]]\n");
  for (const std::string statement : {"a += 0.5", "a /= 2", "a *= np.array([1.])"}) {
    const auto [code, message] = finding_of("a = np.array([1, 2])\n" + statement);
    CHECK(code == "type-error");
    CHECK(message.find("from dtype('float64') to dtype('int64')") != std::string::npos);
  }
  CHECK(finding_of("a = np.array([1, 2])\na += [[1], [2]]").second ==
        "non-broadcastable output operand with shape (2,) doesn't match the broadcast shape (2,2)");
}

TEST_CASE("Shapes are stretched to one another", "[array]") {
  CHECK(output_of("print((np.array([[1, 2], [3, 4]]) * [10, 20]).tolist())") == "[[10, 40], [30, 80]]\n");
  CHECK(output_of("print((np.array([1, 2]) * [[10], [20]]).tolist())") == "[[10, 20], [20, 40]]\n");
  CHECK(finding_of("np.array([1, 2]) + [1, 2, 3]").second ==
        "operands could not be broadcast together with shapes (2,) (3,)");
}

TEST_CASE("Floor division and remainder are those of floats", "[array]") {
  CHECK(output_of("x = np.array([1.0, -1.0])\nprint((x // 0.1).tolist(), (x % 0.1).tolist())") ==
        "[9.0, -10.0] [0.09999999999999995, 5.551115123125783e-17]\n");
}
