// Arithmetic on numbers with Python's rules: / is true division, // and % round down, ints grow without limit.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

/// Above, an int is not a float any more without rounding.
constexpr std::int64_t exact_in_double = std::int64_t{1} << 53;

[[noreturn]] void raise_operands(Operator op, const Value& a, const Value& b) {
  const std::string_view symbol = op == Operator::power ? "** or pow()" : symbol_of(op);
  std::string hint;
  if (a.is_none() || b.is_none()) hint = "one side has no value (None)";
  if (a.is_text() != b.is_text() && (is_numeric(a) || is_numeric(b)))
    hint = "convert with str(...), int(...) or float(...)";
  raise(ErrorKind::type,
        fmt::format("unsupported operand type(s) for {}: '{}' and '{}'", symbol, a.type_name(), b.type_name()), hint);
}

double remainder_of(double a, double b) {
  const double rest = std::fmod(a, b);
  if (rest == 0.0) return std::copysign(0.0, b);
  return (b < 0.0) != (rest < 0.0) ? rest + b : rest;
}

double quotient_of(double a, double b) {
  const double rest = remainder_of(a, b);
  const double quotient = (a - rest) / b;
  if (quotient == 0.0) return std::copysign(0.0, a / b);
  const double floor = std::floor(quotient);
  return quotient - floor > 0.5 ? floor + 1.0 : floor;
}

std::complex<double> divide_complex(std::complex<double> a, std::complex<double> b) {
  if (b == 0.0) raise(ErrorKind::zero_division, "complex division by zero");
  // Smith's method: scaling by the larger part of the divisor keeps intermediate results in range.
  if (std::abs(b.real()) >= std::abs(b.imag())) {
    const double ratio = b.imag() / b.real();
    const double scale = b.real() + b.imag() * ratio;
    return {(a.real() + a.imag() * ratio) / scale, (a.imag() - a.real() * ratio) / scale};
  }
  const double ratio = b.real() / b.imag();
  const double scale = b.real() * ratio + b.imag();
  return {(a.real() * ratio + a.imag()) / scale, (a.imag() * ratio - a.real()) / scale};
}

std::complex<double> multiply_complex(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

std::complex<double> power_complex(std::complex<double> a, std::complex<double> b) {
  if (b == 0.0) return 1.0;
  if (a == 0.0) {
    if (b.imag() != 0.0 || b.real() < 0.0) raise(ErrorKind::zero_division, "0.0 to a negative or complex power");
    return 0.0;
  }
  // Small whole exponents by products: exact where the factors are.
  if (b.imag() == 0.0 && b.real() == std::trunc(b.real()) && std::abs(b.real()) <= 100.0) {
    std::complex<double> result = 1.0, factor = a;
    for (auto n = static_cast<unsigned>(std::abs(b.real())); n > 0; n >>= 1) {
      if ((n & 1U) != 0) result = multiply_complex(result, factor);
      factor = multiply_complex(factor, factor);
    }
    return b.real() < 0 ? divide_complex(1.0, result) : result;
  }
  const double modulus = std::abs(a);
  const double angle = std::arg(a);
  double length = std::pow(modulus, b.real());
  double phase = angle * b.real();
  if (b.imag() != 0.0) {
    length *= std::exp(-angle * b.imag());
    phase += b.imag() * std::log(modulus);
  }
  return {length * std::cos(phase), length * std::sin(phase)};
}

Value complex_operation(Operator op, const Value& a, const Value& b) {
  const std::complex<double> x = a.is_complex() ? a.as_complex() : real_of(a);
  const std::complex<double> y = b.is_complex() ? b.as_complex() : real_of(b);
  switch (op) {
    case Operator::add:
      return x + y;
    case Operator::subtract:
      return x - y;
    case Operator::multiply:
      return multiply_complex(x, y);
    case Operator::divide:
      return divide_complex(x, y);
    case Operator::power:
      return power_complex(x, y);
    default:
      raise_operands(op, a, b);
  }
}

Value power_real(double x, double y) {
  if (x == 0.0 && y < 0.0) raise(ErrorKind::zero_division, "0.0 cannot be raised to a negative power");
  if (x < 0.0 && std::isfinite(x) && std::isfinite(y) && y != std::floor(y)) return power_complex(x, y);
  const double result = std::pow(x, y);
  if (std::isinf(result) && std::isfinite(x) && std::isfinite(y))
    raise(ErrorKind::overflow, "(34, 'Numerical result out of range')");
  return result;
}

Value real_operation(Operator op, const Value& a, const Value& b) {
  const double x = real_of(a);
  const double y = real_of(b);
  switch (op) {
    case Operator::add:
      return x + y;
    case Operator::subtract:
      return x - y;
    case Operator::multiply:
      return x * y;
    case Operator::divide:
      if (y == 0.0) raise(ErrorKind::zero_division, "float division by zero");
      return x / y;
    case Operator::floor_divide:
      if (y == 0.0) raise(ErrorKind::zero_division, "float floor division by zero");
      return quotient_of(x, y);
    case Operator::modulo:
      if (y == 0.0) raise(ErrorKind::zero_division, "float modulo");
      return remainder_of(x, y);
    case Operator::power:
      return power_real(x, y);
    default:
      raise_operands(op, a, b);
  }
}

Value power_integer(const Value& a, const Value& b, Meter& meter) {
  const BigInteger base = *integer_of(a);
  const BigInteger exponent = *integer_of(b);
  if (exponent.is_negative()) return power_real(real_of(a), real_of(b));
  if (base.is_zero() || base == BigInteger(1))
    return exponent.is_zero() ? Value(1) : a.is_bool() ? Value(static_cast<int>(a.as_bool())) : a;
  if (base == BigInteger(-1)) return exponent.is_odd() ? Value(-1) : Value(1);
  const std::uint64_t times = exponent.fits_int64() ? static_cast<std::uint64_t>(exponent.to_int64())
                                                    : std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t bits =
      base.bit_length() * std::min<std::uint64_t>(times, std::numeric_limits<std::uint32_t>::max());
  meter.check_integer(bits);
  meter.work(bits / 32 * (bits / 32));
  return Value::integer(BigInteger::power(base, times));
}

Value big_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  const BigInteger x = *integer_of(a);
  const BigInteger y = *integer_of(b);
  switch (op) {
    case Operator::add:
      return Value::integer(x + y);
    case Operator::subtract:
      return Value::integer(x - y);
    case Operator::multiply:
      meter.check_integer(x.bit_length() + y.bit_length());
      return Value::integer(x * y);
    case Operator::bit_and:
      return Value::integer(BigInteger::bitwise(BigInteger::Bitwise::conjunction, x, y));
    case Operator::bit_or:
      return Value::integer(BigInteger::bitwise(BigInteger::Bitwise::disjunction, x, y));
    case Operator::bit_xor:
      return Value::integer(BigInteger::bitwise(BigInteger::Bitwise::exclusive, x, y));
    case Operator::left_shift:
    case Operator::right_shift: {
      if (y.is_negative()) raise(ErrorKind::value, "negative shift count");
      if (op == Operator::right_shift)
        return Value::integer(x.shifted_right(y.fits_int64() ? static_cast<std::uint64_t>(y.to_int64()) : ~0ULL));
      if (x.is_zero()) return 0;
      const std::uint64_t bits = y.fits_int64() ? static_cast<std::uint64_t>(y.to_int64()) : ~0ULL;
      meter.check_integer(std::max(bits, bits + x.bit_length()));
      return Value::integer(x.shifted_left(bits));
    }
    default:
      raise_operands(op, a, b);
  }
}

/// The operation on two 64-bit numbers, or nothing where the result may not fit.
std::optional<Value> small_operation(Operator op, std::int64_t x, std::int64_t y) {
  std::int64_t result = 0;
  switch (op) {
    case Operator::add:
      return __builtin_add_overflow(x, y, &result) ? std::nullopt : std::optional<Value>(result);
    case Operator::subtract:
      return __builtin_sub_overflow(x, y, &result) ? std::nullopt : std::optional<Value>(result);
    case Operator::multiply:
      return __builtin_mul_overflow(x, y, &result) ? std::nullopt : std::optional<Value>(result);
    case Operator::bit_and:
      return Value(x & y);
    case Operator::bit_or:
      return Value(x | y);
    case Operator::bit_xor:
      return Value(x ^ y);
    default:
      return std::nullopt;
  }
}

Value divide_integers(const Value& a, const Value& b) {
  const BigInteger y = *integer_of(b);
  if (y.is_zero()) raise(ErrorKind::zero_division, "division by zero");
  const auto small_x = small_integer(a);
  const auto small_y = small_integer(b);
  const auto exact = [](const std::optional<std::int64_t>& n) {
    return n && *n >= -exact_in_double && *n <= exact_in_double;
  };
  if (exact(small_x) && exact(small_y)) return static_cast<double>(*small_x) / static_cast<double>(*small_y);
  const double result = BigInteger::true_divide(*integer_of(a), y);
  if (std::isinf(result)) raise(ErrorKind::overflow, "integer division result too large for a float");
  return result;
}

/// Schoolbook products and quotients take the product of the lengths.
void charge_long_operands(const Value& a, const Value& b, Meter& meter) {
  if (!a.is_big_integer() && !b.is_big_integer()) return;
  const auto limbs = [](const Value& value) {
    return value.is_big_integer() ? value.as_big_integer().bit_length() / 32 + 1 : 1;
  };
  meter.work(limbs(a) * limbs(b) + limbs(a) + limbs(b));
}

Value integer_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  charge_long_operands(a, b, meter);
  if (op == Operator::divide) return divide_integers(a, b);
  if (op == Operator::floor_divide) return floor_divide(a, b);
  if (op == Operator::modulo) return modulo(a, b);
  if (op == Operator::power) return power_integer(a, b, meter);
  const bool logic = op == Operator::bit_and || op == Operator::bit_or || op == Operator::bit_xor;
  if (logic && a.is_bool() && b.is_bool())
    return Value(*integer_of(*small_operation(op, a.as_bool(), b.as_bool())) == BigInteger(1));
  const auto x = small_integer(a);
  const auto y = small_integer(b);
  if (x && y) {
    if (auto result = small_operation(op, *x, *y)) return *result;
  }
  return big_operation(op, a, b, meter);
}

}  // namespace

bool is_numeric(const Value& value) { return value.is_bool() || value.is_number() || value.is_complex(); }

std::optional<BigInteger> integer_of(const Value& value) {
  if (value.is_big_integer()) return value.as_big_integer();
  if (const auto small = small_integer(value)) return BigInteger(*small);
  return std::nullopt;
}

std::int64_t index_of(const Value& value) {
  if (const auto small = small_integer(value)) return *small;
  if (value.is_big_integer()) raise(ErrorKind::overflow, "Python int too large to convert to C ssize_t");
  raise(ErrorKind::type, "'" + value.type_name() + "' object cannot be interpreted as an integer",
        value.is_real() ? "convert it with int(...), or divide with //" : "");
}

double real_of(const Value& value) {
  if (value.is_bool()) return value.as_bool() ? 1.0 : 0.0;
  if (value.is_big_integer()) {
    const double real = value.as_real();
    if (std::isinf(real)) raise(ErrorKind::overflow, "int too large to convert to float");
    return real;
  }
  if (value.is_number()) return value.as_real();
  raise(ErrorKind::type, "must be real number, not " + value.type_name());
}

Value floor_divide(const Value& a, const Value& b) {
  if (!is_integral(a) || !is_integral(b)) return real_operation(Operator::floor_divide, a, b);
  const auto x = small_integer(a);
  const auto y = small_integer(b);
  if (y && *y == 0) raise(ErrorKind::zero_division, "integer division or modulo by zero");
  if (x && y && *y != -1) {
    const std::int64_t quotient = *x / *y;
    return *x % *y != 0 && (*x < 0) != (*y < 0) ? quotient - 1 : quotient;
  }
  return Value::integer(BigInteger::floor_divide(*integer_of(a), *integer_of(b)).first);
}

Value modulo(const Value& a, const Value& b) {
  if (!is_integral(a) || !is_integral(b)) return real_operation(Operator::modulo, a, b);
  const auto x = small_integer(a);
  const auto y = small_integer(b);
  if (y && *y == 0) raise(ErrorKind::zero_division, "integer modulo by zero");
  if (x && y && *y != -1) {
    const std::int64_t rest = *x % *y;
    return rest != 0 && (rest < 0) != (*y < 0) ? rest + *y : rest;
  }
  return Value::integer(BigInteger::floor_divide(*integer_of(a), *integer_of(b)).second);
}

Value power(const Value& a, const Value& b, Meter& meter) { return binary_operation(Operator::power, a, b, meter); }

/// Arithmetic on two numbers; other kinds are an error here.
Value number_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  if (!is_numeric(a) || !is_numeric(b)) raise_operands(op, a, b);
  if (a.is_complex() || b.is_complex()) return complex_operation(op, a, b);
  if (a.is_real() || b.is_real()) return real_operation(op, a, b);
  return integer_operation(op, a, b, meter);
}

Value unary_operation(Operator op, const Value& a) {
  if (a.is_unknown()) return a;
  if (op == Operator::logical_not) return !truth(a);
  if (const auto* array = a.as_object<ArrayObject>()) return make_value(negated(op, array->numbers()));
  if (is_integral(a)) {
    const BigInteger x = *integer_of(a);
    if (op == Operator::plus) return Value::integer(x);
    return Value::integer(op == Operator::minus ? -x : -x - BigInteger(1));
  }
  if (op != Operator::invert) {
    const bool minus = op == Operator::minus;
    if (a.is_real()) return minus ? -a.as_real() : a.as_real();
    if (a.is_complex()) return minus ? -a.as_complex() : a.as_complex();
  }
  raise(ErrorKind::type, fmt::format("bad operand type for unary {}: '{}'", symbol_of(op), a.type_name()));
}

}  // namespace comma::interpreter
