// The module math, all of it that Python 3.11 has and that concerns numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

double real_argument(const Value& value) {
  if (value.is_text() || !is_numeric(value) || value.is_complex())
    raise(ErrorKind::type, "must be real number, not " + value.type_name());
  return real_of(value);
}

/// nan out of numbers is outside the function's domain, infinity out of finite numbers is an overflow: as Python tells
/// them.
Value checked(double result, double x, double y = 0.0) {
  if (std::isnan(result) && !std::isnan(x) && !std::isnan(y)) raise(ErrorKind::value, "math domain error");
  if (std::isinf(result) && std::isfinite(x) && std::isfinite(y)) raise(ErrorKind::overflow, "math range error");
  return result;
}

template <double (*Function)(double)>
Value unary(Evaluator&, const CallArguments& arguments) {
  expect_arguments("math function", arguments, 1, 1);
  const double x = real_argument(arguments[0]);
  return checked(Function(x), x);
}

template <double (*Function)(double, double)>
Value binary(Evaluator&, const CallArguments& arguments) {
  expect_arguments("math function", arguments, 2, 2);
  const double x = real_argument(arguments[0]);
  const double y = real_argument(arguments[1]);
  return checked(Function(x, y), x, y);
}

double to_degrees(double x) { return x * (180.0 / std::numbers::pi); }
double to_radians(double x) { return x * (std::numbers::pi / 180.0); }

double gamma_function(double x) {
  if (x == std::trunc(x) && x <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  return std::tgamma(x);
}

double log_gamma(double x) {
  if (x == std::trunc(x) && x <= 0.0 && std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  return std::lgamma(x);
}

/// atanh(+-1) and log1p(-1) are poles: Python calls them domain errors.
double pole_free_atanh(double x) {
  return std::abs(x) >= 1.0 ? std::numeric_limits<double>::quiet_NaN() : std::atanh(x);
}
double pole_free_log1p(double x) { return x <= -1.0 ? std::numeric_limits<double>::quiet_NaN() : std::log1p(x); }

/// Logarithm of any positive int, however large.
double natural_log(const Value& value) {
  if (const auto integer = integer_of(value); integer && !integer->fits_int64()) {
    if (integer->is_negative()) raise(ErrorKind::value, "math domain error");
    const std::size_t bits = integer->bit_length();
    const double head = integer->shifted_right(bits - 64).to_double();
    return std::log(head) + static_cast<double>(bits - 64) * std::numbers::ln2;
  }
  const double x = real_argument(value);
  if (x <= 0.0) raise(ErrorKind::value, "math domain error");
  return std::log(x);
}

Value log(Evaluator&, const CallArguments& arguments) {
  expect_arguments("log", arguments, 1, 2);
  const double numerator = natural_log(arguments[0]);
  if (arguments.size() == 1) return numerator;
  const double denominator = natural_log(arguments[1]);
  if (denominator == 0.0) raise(ErrorKind::zero_division, "float division by zero");
  return numerator / denominator;
}

template <double (*Function)(double)>
Value log_base(Evaluator&, const CallArguments& arguments) {
  expect_arguments("math function", arguments, 1, 1);
  const double x = real_argument(arguments[0]);
  if (x <= 0.0) raise(ErrorKind::value, "math domain error");
  return Function(x);
}

template <double (*Function)(double)>
Value to_integer(Evaluator&, const CallArguments& arguments) {
  expect_arguments("math function", arguments, 1, 1);
  if (const auto integer = integer_of(arguments[0])) return Value::integer(*integer);
  const double x = real_argument(arguments[0]);
  if (std::isnan(x)) raise(ErrorKind::value, "cannot convert float NaN to integer");
  if (std::isinf(x)) raise(ErrorKind::overflow, "cannot convert float infinity to integer");
  return Value::integer(BigInteger::from_double(Function(x)));
}

Value power_of(Evaluator&, const CallArguments& arguments) {
  expect_arguments("pow", arguments, 2, 2);
  const double x = real_argument(arguments[0]);
  const double y = real_argument(arguments[1]);
  if (x == 0.0 && y < 0.0 && std::isfinite(y)) raise(ErrorKind::value, "math domain error");
  return checked(std::pow(x, y), x, y);
}

Value fmod(Evaluator&, const CallArguments& arguments) {
  expect_arguments("fmod", arguments, 2, 2);
  const double x = real_argument(arguments[0]);
  const double y = real_argument(arguments[1]);
  return checked(std::fmod(x, y), x, y);
}

template <bool (*Test)(double)>
Value test(Evaluator&, const CallArguments& arguments) {
  expect_arguments("math function", arguments, 1, 1);
  return Test(real_argument(arguments[0]));
}

bool is_nan(double x) { return std::isnan(x); }
bool is_infinite(double x) { return std::isinf(x); }
bool is_finite(double x) { return std::isfinite(x); }

Value hypot(Evaluator&, const CallArguments& arguments) {
  std::vector<double> parts;
  for (const Value& value : arguments.positional) parts.push_back(std::abs(real_argument(value)));
  if (parts.empty()) return 0.0;
  if (parts.size() == 2) return std::hypot(parts[0], parts[1]);
  const double largest = *std::max_element(parts.begin(), parts.end());
  if (largest == 0.0 || !std::isfinite(largest)) return largest;
  double sum = 0.0;
  for (double part : parts) sum += (part / largest) * (part / largest);
  return largest * std::sqrt(sum);
}

Value dist(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("dist", arguments, 2, 2);
  const auto a = list_of(arguments[0], evaluator.meter());
  const auto b = list_of(arguments[1], evaluator.meter());
  if (a.size() != b.size()) raise(ErrorKind::value, "both points must have the same number of dimensions");
  CallArguments differences;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences.positional.emplace_back(real_argument(a[i]) - real_argument(b[i]));
  return hypot(evaluator, differences);
}

/// Shewchuk's exact partial sums: the result is the rounded exact sum.
Value fsum(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("fsum", arguments, 1, 1);
  std::vector<double> partials;
  for (const Value& value : list_of(arguments[0], evaluator.meter())) {
    double x = real_argument(value);
    std::size_t kept = 0;
    for (double y : partials) {
      if (std::abs(x) < std::abs(y)) std::swap(x, y);
      const double high = x + y;
      const double low = y - (high - x);
      if (low != 0.0) partials[kept++] = low;
      x = high;
    }
    partials.resize(kept);
    partials.push_back(x);
  }
  double sum = 0.0;
  std::size_t n = partials.size();
  double low = 0.0;
  if (n > 0) sum = partials[--n];
  while (n > 0) {
    const double x = sum;
    const double y = partials[--n];
    sum = x + y;
    low = y - (sum - x);
    if (low != 0.0) break;
  }
  // Half an ulp that the rest would tip over.
  if (n > 0 && ((low < 0.0 && partials[n - 1] < 0.0) || (low > 0.0 && partials[n - 1] > 0.0))) {
    const double twice = low * 2.0;
    const double x = sum + twice;
    if (twice == x - sum) sum = x;
  }
  return sum;
}

Value prod(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("prod", arguments, 1, 1, {"start"});
  const Value* start = arguments.find("start");
  Value product = start != nullptr ? *start : Value(1);
  for (const Value& value : list_of(arguments[0], evaluator.meter())) {
    product = binary_operation(Operator::multiply, product, value, evaluator.meter());
  }
  return product;
}

std::int64_t count_argument(const Value& value, std::string_view function) {
  const std::int64_t n = index_of(value);
  if (n < 0) raise(ErrorKind::value, fmt::format("{}() not defined for negative values", function));
  return n;
}

void grow(BigInteger& product, std::int64_t factor, Meter& meter) {
  meter.step();
  meter.check_integer(product.bit_length() + 64);
  meter.work(product.bit_length() / 32);
  product = product * BigInteger(factor);
}

Value factorial(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("factorial", arguments, 1, 1);
  const std::int64_t n = count_argument(arguments[0], "factorial");
  BigInteger product(1);
  for (std::int64_t i = 2; i <= n; ++i) {
    grow(product, i, evaluator.meter());
  }
  return Value::integer(product);
}

Value permutations(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("perm", arguments, 1, 2);
  const std::int64_t n = count_argument(arguments[0], "perm");
  const std::int64_t k = arguments.size() > 1 && !arguments[1].is_none() ? count_argument(arguments[1], "perm") : n;
  if (k > n) return 0;
  BigInteger product(1);
  for (std::int64_t i = n - k + 1; i <= n; ++i) {
    grow(product, i, evaluator.meter());
  }
  return Value::integer(product);
}

Value combinations(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("comb", arguments, 2, 2);
  const std::int64_t n = count_argument(arguments[0], "comb");
  std::int64_t k = count_argument(arguments[1], "comb");
  if (k > n) return 0;
  k = std::min(k, n - k);
  BigInteger result(1);
  for (std::int64_t i = 1; i <= k; ++i) {
    grow(result, n - k + i, evaluator.meter());
    result = BigInteger::floor_divide(result, BigInteger(i)).first;
  }
  return Value::integer(result);
}

BigInteger integer_argument(const Value& value) {
  if (const auto integer = integer_of(value)) return *integer;
  raise(ErrorKind::type, fmt::format("'{}' object cannot be interpreted as an integer", value.type_name()));
}

BigInteger common_divisor(BigInteger a, BigInteger b, Meter& meter) {
  while (!b.is_zero()) {
    meter.work(16 + (a.bit_length() + b.bit_length()) / 32);
    BigInteger rest = BigInteger::floor_divide(a, b).second;
    a = std::move(b);
    b = std::move(rest);
  }
  return a.magnitude();
}

Value gcd(Evaluator& evaluator, const CallArguments& arguments) {
  BigInteger result;
  for (const Value& value : arguments.positional)
    result = common_divisor(result, integer_argument(value), evaluator.meter());
  return Value::integer(result);
}

Value lcm(Evaluator& evaluator, const CallArguments& arguments) {
  BigInteger result(1);
  for (const Value& value : arguments.positional) {
    const BigInteger x = integer_argument(value).magnitude();
    if (x.is_zero()) return 0;
    evaluator.meter().check_integer(result.bit_length() + x.bit_length());
    evaluator.meter().work((result.bit_length() / 32 + 1) * (x.bit_length() / 32 + 1));
    result = BigInteger::floor_divide(result * x, common_divisor(result, x, evaluator.meter())).first;
  }
  return Value::integer(result);
}

Value isqrt(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("isqrt", arguments, 1, 1);
  const BigInteger n = integer_argument(arguments[0]);
  if (n.is_negative()) raise(ErrorKind::value, "isqrt() argument must be nonnegative");
  if (n.is_zero()) return 0;
  // Newton's iteration from above decreases until it has passed the root.
  BigInteger x = BigInteger(1).shifted_left((n.bit_length() + 1) / 2);
  while (true) {
    evaluator.meter().work((n.bit_length() / 32 + 1) * (n.bit_length() / 32 + 1));
    const BigInteger y = (x + BigInteger::floor_divide(n, x).first).shifted_right(1);
    if (y >= x) return Value::integer(x);
    x = y;
  }
}

Value isclose(Evaluator&, const CallArguments& arguments) {
  expect_arguments("isclose", arguments, 2, 2, {"rel_tol", "abs_tol"});
  const double a = real_argument(arguments[0]);
  const double b = real_argument(arguments[1]);
  const Value* relative = arguments.find("rel_tol");
  const Value* absolute = arguments.find("abs_tol");
  if (a == b) return true;
  if (std::isinf(a) || std::isinf(b)) return false;
  const double scale = std::max(std::abs(a), std::abs(b));
  const double allowed = std::max((relative != nullptr ? real_argument(*relative) : 1e-9) * scale,
                                  absolute != nullptr ? real_argument(*absolute) : 0.0);
  return std::abs(a - b) <= allowed;
}

Value frexp(Evaluator&, const CallArguments& arguments) {
  expect_arguments("frexp", arguments, 1, 1);
  int exponent = 0;
  const double fraction = std::frexp(real_argument(arguments[0]), &exponent);
  return Value::tuple({fraction, exponent});
}

Value ldexp(Evaluator&, const CallArguments& arguments) {
  expect_arguments("ldexp", arguments, 2, 2);
  const double x = real_argument(arguments[0]);
  const auto exponent = static_cast<int>(std::clamp<std::int64_t>(index_of(arguments[1]), -5000, 5000));
  return checked(std::ldexp(x, exponent), x);
}

Value modf(Evaluator&, const CallArguments& arguments) {
  expect_arguments("modf", arguments, 1, 1);
  double whole = 0.0;
  const double fraction = std::modf(real_argument(arguments[0]), &whole);
  return Value::tuple({fraction, whole});
}

constexpr std::array math_table = {
    FunctionRow{"sin", unary<std::sin>},
    FunctionRow{"cos", unary<std::cos>},
    FunctionRow{"tan", unary<std::tan>},
    FunctionRow{"asin", unary<std::asin>},
    FunctionRow{"acos", unary<std::acos>},
    FunctionRow{"atan", unary<std::atan>},
    FunctionRow{"sinh", unary<std::sinh>},
    FunctionRow{"cosh", unary<std::cosh>},
    FunctionRow{"tanh", unary<std::tanh>},
    FunctionRow{"asinh", unary<std::asinh>},
    FunctionRow{"acosh", unary<std::acosh>},
    FunctionRow{"atanh", unary<pole_free_atanh>},
    FunctionRow{"atan2", binary<std::atan2>},
    FunctionRow{"exp", unary<std::exp>},
    FunctionRow{"exp2", unary<std::exp2>},
    FunctionRow{"expm1", unary<std::expm1>},
    FunctionRow{"log1p", unary<pole_free_log1p>},
    FunctionRow{"log", log},
    FunctionRow{"log2", log_base<std::log2>},
    FunctionRow{"log10", log_base<std::log10>},
    FunctionRow{"sqrt", unary<std::sqrt>},
    FunctionRow{"cbrt", unary<std::cbrt>},
    FunctionRow{"fabs", unary<std::fabs>},
    FunctionRow{"degrees", unary<to_degrees>},
    FunctionRow{"radians", unary<to_radians>},
    FunctionRow{"gamma", unary<gamma_function>},
    FunctionRow{"lgamma", unary<log_gamma>},
    FunctionRow{"erf", unary<std::erf>},
    FunctionRow{"erfc", unary<std::erfc>},
    FunctionRow{"pow", power_of},
    FunctionRow{"fmod", fmod},
    FunctionRow{"remainder", binary<std::remainder>},
    FunctionRow{"copysign", binary<std::copysign>},
    FunctionRow{"nextafter", binary<std::nextafter>},
    FunctionRow{"floor", to_integer<std::floor>},
    FunctionRow{"ceil", to_integer<std::ceil>},
    FunctionRow{"trunc", to_integer<std::trunc>},
    FunctionRow{"isnan", test<is_nan>},
    FunctionRow{"isinf", test<is_infinite>},
    FunctionRow{"isfinite", test<is_finite>},
    FunctionRow{"hypot", hypot},
    FunctionRow{"dist", dist},
    FunctionRow{"fsum", fsum},
    FunctionRow{"prod", prod},
    FunctionRow{"factorial", factorial},
    FunctionRow{"perm", permutations},
    FunctionRow{"comb", combinations},
    FunctionRow{"gcd", gcd},
    FunctionRow{"lcm", lcm},
    FunctionRow{"isqrt", isqrt},
    FunctionRow{"isclose", isclose},
    FunctionRow{"frexp", frexp},
    FunctionRow{"ldexp", ldexp},
    FunctionRow{"modf", modf},
};

using NameTable = std::unordered_map<std::string_view, Value>;

NameTable make_math() {
  NameTable names;
  for (const FunctionRow& row : math_table) {
    names.emplace(row.name,
                  Value(std::shared_ptr<Object>(std::make_shared<BuiltinObject>(std::string(row.name), row.function))));
  }
  names.emplace("pi", Value(std::numbers::pi));
  names.emplace("e", Value(std::numbers::e));
  names.emplace("tau", Value(2.0 * std::numbers::pi));
  names.emplace("inf", Value(std::numeric_limits<double>::infinity()));
  names.emplace("nan", Value(std::numeric_limits<double>::quiet_NaN()));
  return names;
}

constexpr std::array<std::string_view, 24> common = {
    "sin",   "cos",  "tan", "asin", "acos",  "atan", "atan2", "sinh",  "cosh",    "tanh",    "exp",   "log",
    "log10", "sqrt", "pi",  "ceil", "floor", "fabs", "fmod",  "hypot", "radians", "degrees", "asinh", "acosh"};

}  // namespace

const Value* common_math_value(std::string_view name) {
  return std::find(common.begin(), common.end(), name) == common.end() ? nullptr : math_value(name);
}

std::span<const FunctionRow> math_functions() { return math_table; }

const Value* math_value(std::string_view name) {
  static const NameTable names = make_math();
  const auto found = names.find(name);
  return found == names.end() ? nullptr : &found->second;
}

}  // namespace comma::interpreter
