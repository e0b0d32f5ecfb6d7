#include "solver/materials/property.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

std::string_view name_of(Parameter parameter) {
  constexpr std::array<std::string_view, parameter_count> names = {"temperature",
                                                                   "drying",
                                                                   "hydration",
                                                                   "neutral variable 1",
                                                                   "neutral variable 2",
                                                                   "neutral variable 3",
                                                                   "strain xx",
                                                                   "strain yy",
                                                                   "strain zz",
                                                                   "strain xy",
                                                                   "strain xz",
                                                                   "strain yz",
                                                                   "time",
                                                                   "X",
                                                                   "Y",
                                                                   "Z"};
  return names[static_cast<std::size_t>(parameter)];
}

Property tabulated_property(TabulatedFunction table, Parameter parameter) {
  return Property([table = std::move(table), parameter](const MaterialPoint& at) {
    const double value = at[parameter];
    if (std::isnan(value)) {
      throw Error("missing-variable",
                  fmt::format("a material property depends on the {}, which is not given here", name_of(parameter)),
                  "assign the command variable to these cells");
    }
    return table(value);
  });
}

}  // namespace comma::solver
