// One number out of several, at least one: NaN if one of them is, so that none is passed over.
#pragma once

#include <span>

namespace comma::commands {

double least(std::span<const double> numbers);
double greatest(std::span<const double> numbers);
double sum_of(std::span<const double> numbers);
double sum_of_sizes(std::span<const double> numbers);
double mean_of(std::span<const double> numbers);
/// The smallest and the largest absolute value.
double least_size(std::span<const double> numbers);
double greatest_size(std::span<const double> numbers);

}  // namespace comma::commands
