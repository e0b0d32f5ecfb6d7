// Evaluations of a formula a second, on one core. Run it as build/bin/formula_bench [EXPRESSION]; X and Y are its
// parameters.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>

#include "interpreter/formulas/formula.hpp"

namespace {

constexpr int evaluations = 20'000'000;

void measure(const std::string& text) {
  const comma::interpreter::Formula formula(text, {"X", "Y"});
  double sum = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < evaluations; ++i) {
    const std::array<double, 2> arguments{1e-6 * i, 0.5};
    sum += formula(arguments);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  fmt::print("{:<40} {:6.1f} million evaluations a second ({}; sum {:.6g})\n", text,
             1e-6 * evaluations / elapsed.count(), formula.is_compiled() ? "compiled" : "by the tree", sum);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    measure(argv[1]);
    return 0;
  }
  for (const char* text : {"sin(X)*Y+2.0", "X*Y+2.0", "1.0 if X < 3.0 else X**2 / Y", "max(X, Y) % 0.25"})
    measure(text);
}
