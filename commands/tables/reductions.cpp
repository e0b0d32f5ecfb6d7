#include "commands/tables/reductions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace comma::commands {

namespace {

std::vector<double> sizes_of(std::span<const double> numbers) {
  std::vector<double> sizes(numbers.size());
  std::ranges::transform(numbers, sizes.begin(), [](double number) { return std::abs(number); });
  return sizes;
}

}  // namespace

double least(std::span<const double> numbers) {
  double best = numbers.front();
  for (const double each : numbers) {
    if (std::isnan(each) || each < best) best = each;
  }
  return best;
}

double greatest(std::span<const double> numbers) {
  double best = numbers.front();
  for (const double each : numbers) {
    if (std::isnan(each) || each > best) best = each;
  }
  return best;
}

double sum_of(std::span<const double> numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }
double sum_of_sizes(std::span<const double> numbers) { return sum_of(sizes_of(numbers)); }
double mean_of(std::span<const double> numbers) { return sum_of(numbers) / static_cast<double>(numbers.size()); }
double least_size(std::span<const double> numbers) { return least(sizes_of(numbers)); }
double greatest_size(std::span<const double> numbers) { return greatest(sizes_of(numbers)); }

}  // namespace comma::commands
