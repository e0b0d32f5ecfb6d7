// Sums of products in doubled precision, from error-free transformations of doubles.
#pragma once

#include <cmath>

namespace comma::solver {

/// The unevaluated sum high + low, |low| much smaller than |high|.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  double value() const { return high + low; }
};

/// a + b without error (Knuth, The Art of Computer Programming 2, section 4.2.2).
[[gnu::always_inline]] inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b;
  const double rest = sum - a;
  return {sum, (a - (sum - rest)) + (b - rest)};
}

/// Adds a number to a running sum.
[[gnu::always_inline]] inline void add(DoubleDouble& sum, double term) {
  const DoubleDouble next = exact_sum(sum.high, term);
  sum.high = next.high;
  sum.low += next.low;
}

/// Adds a product to a running sum: as if in twice the working precision (Ogita, Rump, Oishi, "Accurate sum and dot
/// product", SIAM J. Sci. Comput. 26, 2005, algorithm 5.3). Inlined without fail: the caller may be compiled for
/// processors that multiply and add in one instruction.
[[gnu::always_inline]] inline void add_product(DoubleDouble& sum, double a, double b) {
  const double product = a * b;
  add(sum, product);
  sum.low += std::fma(a, b, -product);
}

}  // namespace comma::solver
