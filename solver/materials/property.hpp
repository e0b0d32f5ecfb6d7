// Material properties: numbers, or functions of what is known at a point (temperature, time, place ...).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "solver/functions/function.hpp"

namespace comma::solver {

/// What properties may depend on. The first ones, up to the strains, are command variables (U4.43.03, AFFE_VARC), which
/// have a reference value; the strains have none.
enum class Parameter : std::uint8_t {
  temperature,
  drying,
  hydration,
  neutral_1,
  neutral_2,
  neutral_3,
  strain_xx,  ///< of a strain without stress that is known beforehand, as tensor components in global axes
  strain_yy,
  strain_zz,
  strain_xy,
  strain_xz,
  strain_yz,
  time,
  x,
  y,
  z
};
inline constexpr int parameter_count = 16;
inline constexpr int command_variable_count = 12;
/// The components of the strain that is known beforehand.
inline constexpr std::array<Parameter, 6> strain_parameters = {Parameter::strain_xx, Parameter::strain_yy,
                                                               Parameter::strain_zz, Parameter::strain_xy,
                                                               Parameter::strain_xz, Parameter::strain_yz};

/// "temperature" ... for messages.
std::string_view name_of(Parameter parameter);

/// What is known at one point of a body; NaN where it is not given.
class MaterialPoint {
 public:
  MaterialPoint() {
    values_.fill(std::numeric_limits<double>::quiet_NaN());
    references_.fill(std::numeric_limits<double>::quiet_NaN());
  }
  double& operator[](Parameter parameter) { return values_[static_cast<std::size_t>(parameter)]; }
  double operator[](Parameter parameter) const { return values_[static_cast<std::size_t>(parameter)]; }
  /// The value of a command variable at which it strains nothing.
  double& reference(Parameter variable) { return references_[static_cast<std::size_t>(variable)]; }
  double reference(Parameter variable) const { return references_[static_cast<std::size_t>(variable)]; }
  void place(const Point& at) {
    (*this)[Parameter::x] = at[0];
    (*this)[Parameter::y] = at[1];
    (*this)[Parameter::z] = at[2];
  }

 private:
  std::array<double, parameter_count> values_;
  std::array<double, command_variable_count> references_;
};

class Property {
 public:
  using Function = std::function<double(const MaterialPoint&)>;

  Property(double value = 0.0) : value_(value) {}  // NOLINT: a number is a property
  explicit Property(Function function) : function_(std::move(function)) {}

  bool is_constant() const { return !function_; }
  double operator()(const MaterialPoint& at) const { return function_ ? function_(at) : value_; }

 private:
  double value_ = 0.0;
  Function function_;
};

/// A table over one parameter. Evaluating it throws Error `missing-variable` where the parameter is not given,
/// `out-of-function` past its ends.
Property tabulated_property(TabulatedFunction table, Parameter parameter);

}  // namespace comma::solver
