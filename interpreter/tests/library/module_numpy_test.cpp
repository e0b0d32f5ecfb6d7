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
  for (const auto& [expression, code] :
       {std::pair{"np.array([2**53 + 2])[0]", "overflow"}, std::pair{"(np.arange(5) ** 40).tolist()", "overflow"},
        std::pair{"np.sum([2**62, 2**62])", "overflow"}, std::pair{"np.dot([2**40, 1], [2**40, 1])", "overflow"},
        std::pair{"np.array([float('nan')], dtype=int)[0]", "value-error"},
        std::pair{"np.array([2]) ** -1", "value-error"}, std::pair{"np.array([1, 2]) // 0", "zero-division"},
        std::pair{"np.array([1, 2]) % 0", "zero-division"}}) {
    INFO(expression);
    const Run run(std::string("import numpy as np\nprint(") + expression + ")\n");
    REQUIRE(run.diagnostics.items().size() == 1);
    CHECK(run.diagnostics.items()[0].code == code);
  }
}

TEST_CASE("Arrays tell their type and their shape", "[numpy]") {
  CHECK(
      printed(
          R"(np.array([1, 2]).dtype, repr(np.array([1.]).dtype), np.array([True]).dtype, np.array([1, 2.5]).dtype, (np.array([1]) > 0).dtype)") ==
      R"(int64 dtype('float64') bool float64 bool)");
  CHECK(
      printed(
          R"(np.array([1.]).dtype == float, np.array([1.]).dtype == 'float64', np.array([1]).dtype == np.float64, np.array([1]).dtype.kind, float == np.array([1]).dtype)") ==
      R"(True True False i False)");
  CHECK(
      printed(
          R"(np.array([[1, 2, 3]]).shape, np.array([[1, 2, 3]]).ndim, np.array([[1, 2, 3]]).size, len(np.array([[1, 2, 3]])))") ==
      R"((1, 3) 2 3 1)");
  CHECK(
      printed(
          R"(np.array([1.7, -1.7]).astype(int), np.array([0, 2]).astype(bool), np.array([1, 2]).astype('float64'), np.array([True]).astype(float))") ==
      R"([ 1 -1] [False  True] [1. 2.] [1.])");
  CHECK(
      printed(
          R"(np.array([1, 0], dtype=bool), np.array([1.5], dtype='int'), np.zeros(2, int), np.ones((2, 1), dtype=bool))") ==
      R"([ True False] [1] [0 0] [[ True]
 [ True]])");
  CHECK(
      printed(
          R"(np.arange(6).reshape(2, 3), np.arange(6).reshape((3, -1)), np.reshape(range(4), (2, 2)), np.arange(4).reshape(-1))") ==
      R"([[0 1 2]
 [3 4 5]] [[0 1]
 [2 3]
 [4 5]] [[0 1]
 [2 3]] [0 1 2 3])");
  CHECK(
      printed(
          R"(np.arange(6).reshape(2, 3).T.reshape(6), np.arange(6).reshape(2, 3).flatten(), np.ravel([[1, 2], [3, 4]]))") ==
      R"([0 3 1 4 2 5] [0 1 2 3 4 5] [1 2 3 4])");
  CHECK(printed(R"(np.array([5]).item(), np.array([[1, 2], [3, 4]]).item(2), np.array([[1, 2], [3, 4]]).tolist())") ==
        R"(5 3 [[1, 2], [3, 4]])");
}

TEST_CASE("Reductions go over the array or along an axis", "[numpy]") {
  CHECK(
      printed(
          R"(np.array([[1, 2], [3, 4]]).sum(), np.array([[1, 2], [3, 4]]).sum(axis=0), np.array([[1, 2], [3, 4]]).sum(1), np.sum([True, True]))") ==
      R"(10 [4 6] [3 7] 2)");
  CHECK(
      printed(
          R"(np.array([[1, 2], [3, 5]]).mean(), np.mean([[1, 2], [3, 5]], axis=0), np.array([[1., 2.], [3., 5.]]).mean(axis=-1))") ==
      R"(2.75 [2.  3.5] [1.5 4. ])");
  CHECK(
      printed(
          R"(np.array([[1, 7], [3, 4]]).max(axis=0), np.array([[1, 7], [3, 4]]).min(axis=1), np.max([1, 2.5]), np.amin([3, 1]))") ==
      R"([3 7] [1 3] 2.5 1)");
  CHECK(
      printed(
          R"(np.array([[1, 7], [3, 4]]).argmax(), np.array([[1, 7], [3, 4]]).argmin(axis=1), np.argmax([1., float('nan'), 3.]), np.max([1., float('nan'), 3.]))") ==
      R"(1 [0 0] 1 nan)");
  CHECK(
      printed(
          R"(np.prod([1, 2, 3]), np.array([[1., 2.], [3., 4.]]).prod(axis=0), np.cumsum([1, 2, 3]), np.cumsum([[1, 2], [3, 4]]), np.cumsum([[1, 2], [3, 4]], axis=0))") ==
      R"(6 [3. 8.] [1 3 6] [ 1  3  6 10] [[1 2]
 [4 6]])");
  CHECK(
      printed(
          R"(np.std([1., 2., 4.]), np.array([[1., 2.], [3., 6.]]).std(axis=0), np.std([1., 2., 4.], ddof=1), np.var([1, 2, 4]))") ==
      R"(1.247219128924647 [1. 2.] 1.5275252316519465 1.5555555555555554)");
  CHECK(
      printed(
          R"(np.any([0, 1]), np.all([[1, 0], [1, 1]], axis=0), np.array([True, False]).any(), np.array([True, False]).all())") ==
      R"(True [ True False] True False)");
  CHECK(
      printed(
          R"(np.median([3, 1, 2]), np.median([[1, 2], [3, 5]], axis=1), np.array([[1, 2], [3, 4]]).sum(axis=1, keepdims=True))") ==
      R"(2.0 [1.5 4. ] [[3]
 [7]])");
  CHECK(
      printed(
          R"(np.sum(np.linspace(0, 1, 1000) ** 3), np.mean(np.sqrt(np.arange(77.))), np.sum(np.sqrt(np.arange(3000.).reshape(300, 10)), axis=0)[3], np.sum(np.sqrt(np.arange(3000.).reshape(10, 300)), axis=1)[3])") ==
      R"(250.25025025025025 5.79035781577659 10943.789946496854 9710.492226950531)");
  CHECK(
      printed(
          R"(np.sort([3, 1, 2]), np.sort([[3, 1], [0, 2]]), np.sort([[3, 1], [0, 2]], axis=0), np.argsort([3, 1, 2]), np.unique([3, 1, 3, 2]), np.unique([[1, 0], [0, 1]]))") ==
      R"([1 2 3] [[1 3]
 [0 2]] [[0 1]
 [3 2]] [1 2 0] [1 2 3] [0 1])");
  CHECK(
      printed(
          R"(np.diff([1, 4, 9]), np.diff([1., 4., 9.], 2), np.diff([[1, 2, 4], [0, 5, 5]]), np.diff([[1, 2, 4], [0, 5, 5]], axis=0), np.count_nonzero([0, 3, 1]))") ==
      R"([3 5] [2.] [[1 2]
 [5 0]] [[-1  3  1]] 2)");
}

TEST_CASE("Functions that make arrays", "[numpy]") {
  CHECK(
      printed(
          R"(np.eye(2), np.eye(2, 3, k=1), np.identity(2, dtype=int), np.full((2, 2), 7), np.full(2, 0.5), np.zeros_like([1, 2]), np.ones_like(np.array([[1., 2.]])), np.full_like([1., 2.], 3))") ==
      R"([[1. 0.]
 [0. 1.]] [[0. 1. 0.]
 [0. 0. 1.]] [[1 0]
 [0 1]] [[7 7]
 [7 7]] [0.5 0.5] [0 0] [[1. 1.]] [3. 3.])");
  CHECK(
      printed(
          R"(np.linspace(0, 1, 4, endpoint=False), np.linspace(0, 1, num=3), np.linspace(5, 6, 1), np.logspace(0, 2, 3), np.logspace(0, 3, 4, base=2.))") ==
      R"([0.   0.25 0.5  0.75] [0.  0.5 1. ] [5.] [  1.  10. 100.] [1. 2. 4. 8.])");
  CHECK(
      printed(
          R"(np.arange(3), np.arange(1, 2, 0.3), np.arange(0, 1, 0.1).tolist(), np.arange(5, 0, -2), np.arange(3, dtype=float), np.arange(3.))") ==
      R"([0 1 2] [1.  1.3 1.6 1.9] [0.0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5, 0.6000000000000001, 0.7000000000000001, 0.8, 0.9] [5 3 1] [0. 1. 2.] [0. 1. 2.])");
  CHECK(
      printed(
          R"(np.vstack(([1, 2], [3, 4])), np.hstack(([1, 2], [3])), np.column_stack(([1, 2], [3., 4.])), np.hstack(([[1], [2]], [[3], [4]])))") ==
      R"([[1 2]
 [3 4]] [1 2 3] [[1. 3.]
 [2. 4.]] [[1 3]
 [2 4]])");
  CHECK(
      printed(
          R"(np.concatenate(([[1, 2]], [[3, 4]]), axis=1), np.append([1, 2], [[3], [4]]), np.append([[1, 2]], [[3, 4]], axis=0), np.append([1], 2.5), np.concatenate(([[1], [2]], [[3], [4]]), axis=None))") ==
      R"([[1 2 3 4]] [1 2 3 4] [[1 2]
 [3 4]] [1.  2.5] [1 2 3 4])");
  CHECK(
      printed(
          R"(np.diag([1, 2]), np.diag([[1, 2], [3, 4]]), np.diag([1], k=1), np.diag([[1, 2, 3], [4, 5, 6]], k=1), np.trace([[1, 2], [3, 4]]))") ==
      R"([[1 0]
 [0 2]] [1 4] [[0 1]
 [0 0]] [2 6] 5)");
}

TEST_CASE("Functions of each element", "[numpy]") {
  CHECK(
      printed(
          R"(np.abs([-1, 2]), np.sign([-2., 0., 3.]), np.square([1, -2]), np.sqrt(16), np.floor([1.7, -1.2]), np.ceil(1.2), np.abs(-3))") ==
      R"([1 2] [-1.  0.  1.] [1 4] 4.0 [ 1. -2.] 2.0 3)");
  CHECK(
      printed(
          R"(np.degrees(np.pi), np.deg2rad([180., 90.]), np.radians(180), np.rad2deg(np.pi / 2), np.arctan2([1., -1.], 1), np.hypot(3, [4., 0.]))") ==
      R"(180.0 [3.14159265 1.57079633] 3.141592653589793 90.0 [ 0.78539816 -0.78539816] [5. 3.])");
  CHECK(
      printed(
          R"(np.maximum([1, 5], [3, 2]), np.minimum([1., 5.], 2), np.power([1, 2], 2), np.clip([1, 5, 9], 2, 6), np.array([1., 5.]).clip(max=2), np.isnan([1., float('nan')]))") ==
      R"([3 5] [1. 2.] [1 4] [2 5 6] [1. 2.] [False  True])");
  CHECK(
      printed(
          R"(np.round([1.235, 2.5, -0.5], 2), np.around(2.5), np.round(1234.5, -2), np.array([0.126, 1.5]).round(1), np.round([1, 2], 1))") ==
      R"([ 1.24  2.5  -0.5 ] 2.0 1200.0 [0.1 1.5] [1 2])");
  CHECK(
      printed(
          R"(np.isclose(1., 1. + 1e-9), np.isclose([1., 2.], [1., 2.1]), np.allclose([1., 2.], [1., 2. + 1e-9]), np.array_equal([1, 2], [1, 2]), np.array_equal([1, 2], [1, 3]))") ==
      R"(True [ True False] True True False)");
  CHECK(
      printed(
          R"(np.where(np.array([1, 5]) > 2, 10, [1, 2]), np.where([0, 1, 1]), np.where(np.array([[0, 1], [1, 0]]))[1], np.nonzero([3, 0]))") ==
      R"([ 1 10] (array([1, 2]),) [1 0] (array([0]),))");
  CHECK(
      printed(
          R"(np.logical_and([True, False], True), np.logical_or(0, [1, 0]), np.logical_not([1, 0]), np.isfinite([1., float('inf')]))") ==
      R"([ True False] [ True False] [False  True] [ True False])");
}

TEST_CASE("Curves and polynomials", "[numpy]") {
  CHECK(
      printed(
          R"(np.interp(0.25, [0., 1.], [0., 2.]), np.interp([-1., 0.5, 3.], [0., 1., 2.], [1., 3., 5.]), np.interp(5, [0., 1.], [0., 2.], right=-1))") ==
      R"(0.5 [1. 2. 5.] -1.0)");
  CHECK(
      printed(
          R"(np.trapz([1, 2, 3]), np.trapz([1., 2., 4.], [0., 1., 3.]), np.trapz([[1, 2], [3, 4]], dx=2.), np.polyval([1, 0, -2], 3), np.polyval([1., 2.], [0., 1.]))") ==
      R"(4.0 7.5 [3. 7.] 7 [2. 3.])");
  CHECK(
      printed(
          R"(np.round(np.polyfit([0, 1, 2, 3], [1, 3, 5, 7], 1), 10), np.round(np.polyfit([0., 1., 2., 3., 4.], [1., 2., 0., 5., 3.], 2), 10))") ==
      R"([2. 1.] [0.07142857 0.41428571 0.94285714])");
}

TEST_CASE("Vectors and matrices", "[numpy]") {
  CHECK(
      printed(
          R"(np.dot([[1, 2], [3, 4]], [[1, 0], [0, 2]]), np.dot(2, [1, 2]), np.matmul([[1, 2], [3, 4]], [1, 1]), np.vdot([1, 2], [3, 4]), np.inner([1, 2], [3, 4]), np.inner([[1, 2], [3, 4]], [[1, 0], [1, 1]]), np.array([1, 2]).dot([3, 4]))") ==
      R"([[1 4]
 [3 8]] [2 4] [3 7] 11 11 [[1 3]
 [3 7]] 11)");
  CHECK(printed(R"(np.outer([1, 2], [3, 4]), np.cross([1., 0., 0.], [0., 1., 0.]))") ==
        R"([[3 4]
 [6 8]] [0. 0. 1.])");
  CHECK(
      printed(
          R"(np.linalg.norm([3., 4.]), np.linalg.norm([[1., 2.], [3., 4.]]), np.linalg.norm([1, -3], 1), np.linalg.norm([1, -3], np.inf), np.linalg.norm([[3., 4.], [5., 12.]], axis=1), np.linalg.norm([[1, -2], [3, 4]], 1))") ==
      R"(5.0 5.477225575051661 4.0 3.0 [ 5. 13.] 6.0)");
  CHECK(
      printed(
          R"(np.linalg.solve([[2., 1.], [1., 3.]], [3., 5.]), np.linalg.solve([[0., 1.], [2., 0.]], [[1., 0.], [0., 1.]]), np.linalg.det([[0., 2.], [3., 0.]]), np.linalg.det([[1, 2], [2, 4]]))") ==
      R"([0.8 1.4] [[0.  0.5]
 [1.  0. ]] -6.0 0.0)");
  CHECK(
      printed(
          R"(np.round(np.linalg.inv([[4., 7.], [2., 6.]]), 12), np.round(np.linalg.eigvalsh([[2., 1.], [1., 2.]]), 12), np.round(np.linalg.eigvalsh([[4., 1., 0.], [1., 3., 1.], [0., 1., 2.]]), 10))") ==
      R"([[ 0.6 -0.7]
 [-0.2  0.4]] [1. 3.] [1.26794919 3.         4.73205081])");
}

TEST_CASE("Arrays pass for numbers and sequences where numpy lets them", "[numpy]") {
  CHECK(printed("float(np.array([2.5])), int(np.array([3])), list(reversed(np.array([1, 2])))") == "2.5 3 [2, 1]");
  CHECK(printed("isinstance(np.eye(2), np.ndarray), max(np.array([1, 3])), sum(np.array([[1, 2], [3, 4]]))") ==
        "True 3 [4 6]");
}

TEST_CASE("Methods that change an array change it in place", "[numpy]") {
  const auto output_of = [](const std::string& statements) {
    const Run run("import numpy as np\n" + statements + "\n");
    INFO(statements);
    CHECK(run.findings().empty());
    return run.output;
  };
  CHECK(output_of("a = np.array([3, 1, 2])\nb = a[1:]\na.sort()\nprint(a, b)") == "[1 2 3] [2 3]\n");
  CHECK(output_of("a = np.zeros((2, 2))\na[0].fill(3)\nprint(a)") == "[[3. 3.]\n [0. 0.]]\n");
  CHECK(output_of("a = np.arange(4)\na.reshape(2, 2)[1, 0] = 9\nprint(a)") == "[0 1 9 3]\n");
  CHECK(output_of("a = np.arange(6).reshape(2, 3)\na[:, 1].reshape(2, 1)[0] = 9\na.T.reshape(6)[0] = 7\nprint(a)") ==
        "[[0 9 2]\n [3 4 5]]\n");
}

TEST_CASE("Functions of numpy refuse what they cannot do", "[numpy]") {
  for (const auto& [expression, message] :
       {std::pair{"np.linalg.solve([[1., 2.], [2., 4.]], [1., 1.])", "Singular matrix"},
        std::pair{"np.linalg.inv([[1., 2.]])", "Last 2 dimensions of the array must be square"},
        std::pair{"np.arange(6).reshape(4, -1)", "cannot reshape array of size 6 into shape (4,-1)"},
        std::pair{"np.sum([1, 2], axis=1)", "axis 1 is out of bounds for array of dimension 1"},
        std::pair{"np.max([])", "zero-size array to reduction operation which has no identity"},
        std::pair{"np.polyfit([1., 1.], [1., 2.], 1)", "polyfit is poorly conditioned: too few different points"},
        std::pair{"np.zeros(2, dtype=complex)", "arrays are of float, int or bool, not of <class 'complex'>"},
        std::pair{"np.array(5)", "an array of one or two dimensions is wanted here, not a number"}}) {
    INFO(expression);
    const Run run(std::string("import numpy as np\nx = ") + expression + "\n");
    REQUIRE(run.diagnostics.items().size() == 1);
    CHECK(run.diagnostics.items()[0].message == message);
  }
}

TEST_CASE("What numpy has and comma has not is told by name", "[numpy]") {
  const Run run("import numpy as np\nx = np.fft\n");
  REQUIRE(run.diagnostics.items().size() == 1);
  CHECK(run.diagnostics.items()[0].message == "module 'numpy' has no attribute 'fft'");
}
