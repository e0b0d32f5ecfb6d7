// What operators do to arrays: element by element, after the smaller shape has been stretched to the larger.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

bool compares(Operator op) { return op >= Operator::less; }

/// Python's // and % for floats, but with numpy's inf and nan where the divisor is zero.
double remainder(double a, double b) {
  const double rest = std::fmod(a, b);
  if (rest == 0.0) return std::copysign(0.0, b);
  return (b < 0.0) != (rest < 0.0) ? rest + b : rest;
}

double floor_quotient(double a, double b) {
  if (b == 0.0) return a / b;
  const double quotient = (a - remainder(a, b)) / b;
  if (quotient == 0.0) return std::copysign(0.0, a / b);
  const double floor = std::floor(quotient);
  return quotient - floor > 0.5 ? floor + 1.0 : floor;
}

double apply_bits(Operator op, double a, double b) {
  const std::int64_t x = array_number(a, NumberType::integer).as_integer();
  const std::int64_t y = array_number(b, NumberType::integer).as_integer();
  return static_cast<double>(op == Operator::bit_and ? x & y : op == Operator::bit_or ? x | y : x ^ y);
}

double apply(Operator op, double a, double b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::floor_divide:
      return floor_quotient(a, b);
    case Operator::modulo:
      return remainder(a, b);
    case Operator::power:
      return std::pow(a, b);
    case Operator::less:
      return a < b ? 1.0 : 0.0;
    case Operator::less_equal:
      return a <= b ? 1.0 : 0.0;
    case Operator::greater:
      return a > b ? 1.0 : 0.0;
    case Operator::greater_equal:
      return a >= b ? 1.0 : 0.0;
    case Operator::equal:
      return a == b ? 1.0 : 0.0;
    case Operator::not_equal:
      return a != b ? 1.0 : 0.0;
    case Operator::bit_and:
    case Operator::bit_or:
    case Operator::bit_xor:
      return apply_bits(op, a, b);
    default:
      raise(ErrorKind::type, fmt::format("arrays have no operator {} here", symbol_of(op)));
  }
}

/// What integers have no integer for: numpy refuses such a power, and makes zeros of such quotients with a warning.
void require_whole(Operator op, const std::vector<double>& right) {
  if (op == Operator::power && std::ranges::any_of(right, [](double exponent) { return exponent < 0.0; }))
    raise(ErrorKind::value, "Integers to negative integer powers are not allowed.", "take an array of float");
  if ((op == Operator::floor_divide || op == Operator::modulo) && std::ranges::find(right, 0.0) != right.end())
    raise(ErrorKind::zero_division, "integer division or modulo by zero");
}

NumberType type_of_result(Operator op, NumberType a, NumberType b) {
  const NumberType joint = std::max(a, b);
  if (op == Operator::bit_and || op == Operator::bit_or || op == Operator::bit_xor) {
    if (joint == NumberType::real)
      raise(ErrorKind::type, fmt::format("{} works on arrays of bool or int, not of float", symbol_of(op)),
            "put comparisons in brackets: (a > 1) & (a < 2)");
    return joint;
  }
  if (compares(op)) return NumberType::boolean;
  if (op == Operator::divide) return NumberType::real;
  if (joint != NumberType::boolean) return joint;
  if (op == Operator::subtract)
    raise(ErrorKind::type, "numpy boolean subtract, the `-` operator, is not supported", "use the ^ operator");
  return op == Operator::add || op == Operator::multiply ? joint : NumberType::integer;
}

}  // namespace

Shape broadcast_shape(const Shape& a, const Shape& b) {
  const Shape& shorter = a.size() < b.size() ? a : b;
  Shape result = a.size() < b.size() ? b : a;
  for (std::size_t k = 1; k <= shorter.size(); ++k) {
    std::size_t& length = result[result.size() - k];
    const std::size_t other = shorter[shorter.size() - k];
    if (length != other && length != 1 && other != 1)
      raise(ErrorKind::value,
            fmt::format("operands could not be broadcast together with shapes {} {}", text_of(a), text_of(b)));
    if (length == 1) length = other;
  }
  return result;
}

std::vector<double> spread(const Numbers& numbers, const Shape& shape) {
  if (numbers.shape == shape) return numbers.data;
  const std::size_t size = size_of(shape);
  if (numbers.data.size() == 1) return std::vector<double>(size, numbers.data[0]);
  const std::size_t columns = shape.back(), own_columns = numbers.shape.back();
  const bool one_row = numbers.shape.size() == 1 || numbers.shape[0] == 1;
  std::vector<double> result(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t row = one_row ? 0 : i / columns, column = own_columns == 1 ? 0 : i % columns;
    result[i] = numbers.data[row * own_columns + column];
  }
  return result;
}

Numbers combine(Operator op, const Numbers& a, const Numbers& b, Meter& meter) {
  if (op == Operator::matrix_multiply) return matrix_product(a, b, meter);
  Numbers result;
  result.type = type_of_result(op, a.type, b.type);
  result.shape = broadcast_shape(a.shape, b.shape);
  meter.allocate(size_of(result.shape) * sizeof(double));
  result.data = spread(a, result.shape);
  const std::vector<double> right = spread(b, result.shape);
  if (result.type == NumberType::integer) require_whole(op, right);
  for (std::size_t i = 0; i < right.size(); ++i)
    result.data[i] = converted(apply(op, result.data[i], right[i]), result.type);
  return result;
}

Value array_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  if ((op == Operator::equal || op == Operator::not_equal) && (a.is_none() || b.is_none())) {
    const Shape shape = numbers_of(a.is_none() ? b : a, meter).shape;
    return make_value(
        {std::vector<double>(size_of(shape), op == Operator::equal ? 0.0 : 1.0), shape, NumberType::boolean});
  }
  return make_value(combine(op, numbers_of(a, meter), numbers_of(b, meter), meter));
}

Numbers negated(Operator op, Numbers a) {
  if (op == Operator::invert && a.type == NumberType::real)
    raise(ErrorKind::type, "~ works on arrays of bool or int, not of float");
  if (op != Operator::invert && a.type == NumberType::boolean)
    raise(ErrorKind::type, fmt::format("the {} of booleans is not supported", symbol_of(op)),
          "~ turns True into False");
  for (double& number : a.data) {
    if (a.type == NumberType::boolean)
      number = 1.0 - number;
    else if (op == Operator::invert)
      number = -number - 1.0;
    else if (op == Operator::minus)
      number = converted(-number, a.type);
  }
  return a;
}

void array_update(Operator op, ArrayObject& a, const Value& b, Meter& meter) {
  if (op == Operator::matrix_multiply)
    raise(ErrorKind::type, "In-place matrix multiplication is not (yet) supported.",
          "use 'a = a @ b' instead of 'a @= b'");
  const Numbers result = combine(op, a.numbers(), numbers_of(b, meter), meter);
  if (result.type > a.type) {
    raise(ErrorKind::type,
          fmt::format("cannot cast the output of {}= from dtype('{}') to dtype('{}'): the array keeps its type",
                      symbol_of(op), name_of(result.type), name_of(a.type)),
          fmt::format("write a = a {} b, or make the array of float", symbol_of(op)));
  }
  if (result.shape != a.shape) {
    raise(ErrorKind::value,
          fmt::format("non-broadcastable output operand with shape {} doesn't match the broadcast shape {}",
                      text_of(a.shape), text_of(result.shape)));
  }
  a.write(result.data);
}

Numbers matrix_product(const Numbers& a, const Numbers& b, Meter& meter) {
  if (a.shape.empty() || b.shape.empty())
    raise(ErrorKind::value, "matmul: an operand is a number, but arrays of one or two dimensions are wanted",
          "multiply with *");
  const std::size_t inner = a.shape.back();
  if (inner != b.shape.front())
    raise(ErrorKind::value, fmt::format("shapes {} and {} not aligned: {} != {}", text_of(a.shape), text_of(b.shape),
                                        inner, b.shape.front()));
  const std::size_t rows = a.shape.size() == 2 ? a.shape[0] : 1, columns = b.shape.size() == 2 ? b.shape[1] : 1;
  meter.allocate(rows * columns * sizeof(double));
  meter.work(rows * columns * inner);
  Numbers result{std::vector<double>(rows * columns, 0.0), {}, std::max(a.type, b.type)};
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < inner; ++k) {
      for (std::size_t j = 0; j < columns; ++j)
        result.data[i * columns + j] += a.data[i * inner + k] * b.data[k * columns + j];
    }
  }
  if (a.shape.size() == 2) result.shape.push_back(rows);
  if (b.shape.size() == 2) result.shape.push_back(columns);
  if (result.type == NumberType::boolean)
    for (double& number : result.data) number = converted(number, NumberType::boolean);
  return result;
}

}  // namespace comma::interpreter
