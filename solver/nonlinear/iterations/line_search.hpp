// How far to go along a correction of Newton's method.
#pragma once

#include <functional>

#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// The factor rho at which |work(rho)| <= tolerance |start|, or where it was least after the iterations allowed; 1
/// comes first. `start` is work(0). A rho at which `work` throws Error `integration-failure` is too far. Throws that
/// error when no rho will do.
double search_line(const LineSearch& options, double start, const std::function<double(double rho)>& work);

}  // namespace comma::solver
