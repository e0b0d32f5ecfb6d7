#include "solver/nonlinear/iterations/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

struct LineTrial {
  double rho;
  double work;
};

/// Where the secant through two trials vanishes; nothing if they are level.
std::optional<double> secant(const LineTrial& a, const LineTrial& b) {
  if (a.work == b.work) return std::nullopt;
  return b.rho - b.work * (b.rho - a.rho) / (b.work - a.work);
}

/// The trials so far, and what they say of the next.
class LineTrials {
 public:
  LineTrials(const LineSearch& options, double start) : options_(options), last_{0.0, start}, start_(start) {}

  std::optional<double> after(const LineTrial& trial) {
    const std::optional<double> next = secant(last_, trial);
    const bool changes_sign = last_.work * trial.work < 0.0;
    last_ = trial;
    if (!options_.bracketed) return next;
    if (trial.work * start_ <= 0.0) {
      far_ = trial.rho;
    } else {
      near_ = trial.rho;
      if (std::isinf(far_)) return 3.0 * trial.rho;
    }
    const double middle = 0.5 * (near_ + far_);
    if (!next) return middle;
    const bool is_taken = changes_sign ? (*next - middle) * (trial.rho - middle) >= 0.0 : near_ < *next && *next < far_;
    return is_taken ? *next : middle;
  }

 private:
  const LineSearch& options_;
  LineTrial last_;
  double start_;
  double near_ = 0.0, far_ = std::numeric_limits<double>::infinity();  ///< between which the work changes sign
};

/// What is about zero becomes `excluded`, though that be below `smallest`.
double admissible(const LineSearch& options, double rho) {
  return std::abs(rho) < options.excluded ? options.excluded : std::clamp(rho, options.smallest, options.largest);
}

}  // namespace

double search_line(const LineSearch& options, double start, const std::function<double(double)>& work) {
  LineTrials trials(options, start);
  LineTrial best{1.0, std::numeric_limits<double>::infinity()};
  std::optional<Error> failure;
  double rho = 1.0;
  for (int iteration = 0; iteration <= std::max(1, options.max_iterations); ++iteration) {
    try {
      const LineTrial trial{rho, work(rho)};
      failure.reset();
      if (std::abs(trial.work) < std::abs(best.work)) best = trial;
      if (std::abs(trial.work) <= options.tolerance * std::abs(start)) return trial.rho;
      const std::optional<double> next = trials.after(trial);
      if (!next) break;
      rho = admissible(options, *next);
      if (rho == trial.rho) break;  // at a bound
    } catch (const Error& error) {
      if (error.code() != "integration-failure") throw;
      failure = error;
      rho = admissible(options, 0.5 * rho);
    }
  }
  if (!std::isfinite(best.work) && failure) throw *failure;
  return best.rho;
}

}  // namespace comma::solver
