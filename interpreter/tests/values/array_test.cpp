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

std::string printed(const std::string& expressions) {
  const std::string output = output_of("print(" + expressions + ")");
  return output.empty() ? "" : output.substr(0, output.size() - 1);
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
  CHECK(output_of("def f(v):\n  v *= 2.\n  v[0] = 7.\nx = np.array([1., 2.])\nf(x)\nprint(x.tolist())") ==
        "[7.0, 4.0]\n");
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

TEST_CASE("Signs, logic and matrix products of arrays", "[array]") {
  CHECK(printed(R"(-np.array([1, -2]), +np.array([1., -2.]), -np.array([0.]))") == R"([-1  2] [ 1. -2.] [-0.])");
  CHECK(printed(R"(~np.array([True, False]), ~np.array([0, 5]))") == R"([False  True] [-1 -6])");
  CHECK(
      printed(
          R"((np.array([1, 2, 3]) > 1) & (np.array([1, 2, 3]) < 3), (np.array([1, 2]) > 1) | (np.array([1, 2]) < 2))") ==
      R"([False  True False] [ True  True])");
  CHECK(printed(R"(np.array([6, 3]) & 5, np.array([6, 3]) ^ 5, np.array([True, False]) ^ True)") ==
        R"([4 1] [3 6] [False  True])");
  CHECK(
      printed(
          R"(np.array([True, True]) + np.array([True, False]), np.array([True, False]) * 2, np.array([True, False]) / 2)") ==
      R"([ True  True] [2 0] [0.5 0. ])");
  CHECK(
      printed(
          R"(np.array([[1, 2], [3, 4]]) @ np.array([5, 6]), np.array([1, 2]) @ np.array([3, 4]), [1., 2.] @ np.array([[1, 2], [3, 4]]))") ==
      R"([17 39] 11 [ 7. 10.])");
  CHECK(printed(R"(np.array([[1], [2]]) @ np.array([[3, 4]]))") ==
        R"([[3 4]
 [6 8]])");
  CHECK(printed(R"(1 / np.array([0, -1]) * np.array([0, 1]), 1 / (np.array([0]) * -1))") == R"([nan -1.] [inf])");
  CHECK(
      printed(
          R"(np.array([1, 2]) == None, np.array([1, 2]) == [1, 3], 3 in np.array([[1, 2], [3, 4]]), 5 in np.array([1.]))") ==
      R"([False False] [ True False] True False)");
  CHECK(
      printed(
          R"(2 ** np.array([1, 2, 3]), np.array([4., 9.]) ** 0.5, 7 % np.array([3, -3]), -7 // np.array([2., 4.]))") ==
      R"([2 4 8] [2. 3.] [ 1 -2] [-4. -2.])");
}

TEST_CASE("Masks and lists of indices pick numbers", "[array]") {
  CHECK(printed(R"(np.array([1, 5, 2])[np.array([1, 5, 2]) > 1])") == R"([5 2])");
  CHECK(printed(R"(np.array([[1, 2], [3, 4]])[np.array([[True, False], [True, True]])])") == R"([1 3 4])");
  CHECK(printed(R"(np.array([[1, 2], [3, 4], [5, 6]])[[0, 2]])") ==
        R"([[1 2]
 [5 6]])");
  CHECK(
      printed(R"(np.array([[1, 2], [3, 4], [5, 6]])[[0, 2], 1], np.array([[1, 2], [3, 4], [5, 6]])[[0, 2], [1, 0]])") ==
      R"([2 6] [2 5])");
  CHECK(printed(R"(np.array([[1, 2, 3], [4, 5, 6]])[:, [0, 2]])") ==
        R"([[1 3]
 [4 6]])");
  CHECK(printed(R"(np.array([[1, 2, 3], [4, 5, 6]])[1, [0, -1]], np.array([[1, 2, 3], [4, 5, 6]])[[True, False]])") ==
        R"([4 6] [[1 2 3]])");
  CHECK(printed(R"(np.array([[1, 2, 3], [4, 5, 6]])[:, np.array([True, False, True])])") ==
        R"([[1 3]
 [4 6]])");
  CHECK(printed(R"(np.arange(4)[np.array([[0, 1], [2, 3]])])") ==
        R"([[0 1]
 [2 3]])");
  CHECK(printed(R"(np.arange(3)[[]], np.arange(3)[:, np.newaxis], np.arange(3)[None])") ==
        R"([] [[0]
 [1]
 [2]] [[0 1 2]])");
  CHECK(printed(R"(np.arange(4)[range(1, 3)], np.arange(5)[np.arange(5) > 9])") == R"([1 2] [])");
}

TEST_CASE("Arrays are written as numpy writes them", "[array]") {
  CHECK(printed(R"(np.array([1., 2.5, -3.]), np.array([1, 10, -100]), np.array([True, False]))") ==
        R"([ 1.   2.5 -3. ] [   1   10 -100] [ True False])");
  CHECK(printed(R"(repr(np.array([1., 2.5])), repr(np.array([[1, 2], [30, 4]])), repr(np.array([True])))") ==
        R"(array([1. , 2.5]) array([[ 1,  2],
       [30,  4]]) array([ True]))");
  CHECK(printed(R"(np.array([[1., 2.], [3.25, 4.]]))") ==
        R"([[1.   2.  ]
 [3.25 4.  ]])");
  CHECK(
      printed(
          R"(np.array([1e-5, 1.]), np.array([1e10, 1.]), np.array([1e200, -1e-200]), np.array([123456.789, 0.001]))") ==
      R"([1.e-05 1.e+00] [1.e+10 1.e+00] [ 1.e+200 -1.e-200] [1.23456789e+05 1.00000000e-03])");
  CHECK(printed(R"(np.array([1/3, 2/3]), np.array([1e8]), np.array([12345678.9]), np.array([0.1 + 0.2]))") ==
        R"([0.33333333 0.66666667] [1.e+08] [12345678.9] [0.3])");
  CHECK(
      printed(
          R"(np.array([float('nan'), 1.]), np.array([float('inf'), -float('inf'), 0.5]), np.array([float('nan')]))") ==
      R"([nan  1.] [ inf -inf  0.5] [nan])");
  CHECK(printed(R"(np.linspace(0, 1, 30))") ==
        R"([0.         0.03448276 0.06896552 0.10344828 0.13793103 0.17241379
 0.20689655 0.24137931 0.27586207 0.31034483 0.34482759 0.37931034
 0.4137931  0.44827586 0.48275862 0.51724138 0.55172414 0.5862069
 0.62068966 0.65517241 0.68965517 0.72413793 0.75862069 0.79310345
 0.82758621 0.86206897 0.89655172 0.93103448 0.96551724 1.        ])");
  CHECK(printed(R"(repr(np.linspace(0, 1, 11)))") ==
        R"(array([0. , 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1. ]))");
  CHECK(printed(R"(np.arange(2000))") == R"([   0    1    2 ... 1997 1998 1999])");
  CHECK(printed(R"(np.zeros((40, 40)))") ==
        R"([[0. 0. 0. ... 0. 0. 0.]
 [0. 0. 0. ... 0. 0. 0.]
 [0. 0. 0. ... 0. 0. 0.]
 ...
 [0. 0. 0. ... 0. 0. 0.]
 [0. 0. 0. ... 0. 0. 0.]
 [0. 0. 0. ... 0. 0. 0.]])");
  CHECK(printed(R"(repr(np.array([])), np.array([]), repr(np.zeros((0, 3))), repr(np.zeros((3, 0))))") ==
        R"(array([], dtype=float64) [] array([], shape=(0, 3), dtype=float64) array([], shape=(3, 0), dtype=float64))");
  CHECK(printed(R"(np.array([range(10), range(10, 20), range(20, 30)]) * 1000.5)") ==
        R"([[    0.   1000.5  2001.   3001.5  4002.   5002.5  6003.   7003.5  8004.
   9004.5]
 [10005.  11005.5 12006.  13006.5 14007.  15007.5 16008.  17008.5 18009.
  19009.5]
 [20010.  21010.5 22011.  23011.5 24012.  25012.5 26013.  27013.5 28014.
  29014.5]])");
  CHECK(printed(R"('%s and {}'.format(np.array([1, 2])) % np.array([0.5]))") == R"([0.5] and [1 2])");
}

TEST_CASE("What is written through masks and lists of indices lands in the array", "[array]") {
  CHECK(output_of("b = np.array([1., 5., 7.])\nb[b > 2] = 0\nprint(b)") == "[1. 0. 0.]\n");
  CHECK(output_of("b = np.array([1., 5., 7.])\nb[b > 2] += 1\nb[[0, 2]] *= 10\nprint(b)") == "[10.  6. 80.]\n");
  CHECK(output_of("b = np.array([1., 5., 7.])\nb[b > 2] = [8, 9]\nprint(b)") == "[1. 8. 9.]\n");
  CHECK(output_of("m = np.zeros((2, 3))\nm[:, [0, 2]] = [[1, 2], [3, 4]]\nm[m == 0] = -1\nprint(m)") ==
        "[[ 1. -1.  2.]\n [ 3. -1.  4.]]\n");
  CHECK(output_of("m = np.arange(4.)\nm[m > 0][0] = 9\nprint(m)") == "[0. 1. 2. 3.]\n");
}

TEST_CASE("What arrays cannot do is told by name", "[array]") {
  CHECK(finding_of("np.array([1., 2.]) & 1").second == "& works on arrays of bool or int, not of float");
  CHECK(finding_of("~np.array([1.])").second == "~ works on arrays of bool or int, not of float");
  CHECK(finding_of("-np.array([True])").second == "the - of booleans is not supported");
  CHECK(finding_of("a = np.zeros((2, 2))\na @= a").second == "In-place matrix multiplication is not (yet) supported.");
  CHECK(finding_of("np.array([1, 2]) @ [1, 2, 3]").second == "shapes (2,) and (3,) not aligned: 2 != 3");
  CHECK(finding_of("np.array([[[1]]])").second == "arrays have one or two dimensions here, not three");
  CHECK(finding_of("np.zeros((2, 2, 2))").second == "arrays have one or two dimensions here, not 3");
  CHECK(finding_of("np.zeros((2, 2))[:, :, None]").second == "arrays have one or two dimensions here, not 3");
  CHECK(finding_of("np.arange(3)[[True, False]]").second ==
        "boolean index did not match indexed array along dimension 0; dimension is 3 but corresponding boolean "
        "dimension is 2");
  CHECK(finding_of("np.arange(3)[[0, 3]]").second == "index 3 is out of bounds for axis 0 with size 3");
  CHECK(finding_of("np.arange(3)[[0.5]]").second == "arrays used as indices must be of integer (or boolean) type");
  CHECK(finding_of("if np.arange(3) > 1: pass").first == "value-error");
}
