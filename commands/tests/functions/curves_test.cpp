#include "commands/functions/curves.hpp"

#include <catch2/catch.hpp>

using namespace comma::commands;

namespace {

Drawing drawing() {
  Drawing drawing;
  drawing.title = "a \"tip\"";
  drawing.x = {"INST", std::array{0.0, 4.0}, 2.0, true};
  drawing.curves.push_back({"rises", {1.0, 2.0}, {-0.5, 8.0}, 2, {}, {}, {}});
  drawing.curves.push_back({"falls", {1.0}, {0.0}, {}, 0, 3, 10});
  return drawing;
}

}  // namespace

TEST_CASE("A project file of Grace has a set for each curve, and looks only where they are given") {
  const std::string text = grace_file(drawing());
  CHECK_THAT(text, Catch::Contains("@title \"a 'tip'\"\n"));
  CHECK_THAT(
      text,
      Catch::Contains(
          "@xaxis label \"INST\"\n@world xmin 0\n@world xmax 4\n@xaxes scale logarithmic\n@xaxis tick major 2\n"));
  CHECK_THAT(text, !Catch::Contains("@yaxis"));
  CHECK_THAT(text, Catch::Contains("@s0 legend \"rises\"\n@s0 line color 2\n@s0 symbol color 2\n@s1 legend "
                                   "\"falls\"\n@s1 line linestyle 3\n@s1 symbol 0\n"
                                   "@s1 symbol skip 10\n"));
  CHECK_THAT(text, Catch::Contains("@target G0.S0\n@type xy\n  1.000000000000E+00  -5.000000000000E-01\n  "
                                   "2.000000000000E+00   8.000000000000E+00\n&\n"
                                   "@target G0.S1\n"));
}

TEST_CASE("Curves as columns stand behind their labels") {
  CHECK(curve_columns(drawing()).starts_with("# rises\n  1.000000000000E+00  -5.000000000000E-01\n"));
  CHECK_THAT(drawing_description(drawing()),
             Catch::Contains("X: INST, logarithmic, from 0 to 4, grid 2\n") && Catch::Contains("curve 2: falls\n"));
}
