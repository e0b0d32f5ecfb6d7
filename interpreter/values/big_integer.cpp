#include "interpreter/values/big_integer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace comma::interpreter {

namespace {

constexpr std::uint64_t limb_base = std::uint64_t{1} << 32;

int digit_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'z') return c - 'a' + 10;
  if (c >= 'A' && c <= 'Z') return c - 'A' + 10;
  return 99;
}

}  // namespace

BigInteger::BigInteger(std::int64_t value) : negative_(value < 0) {
  std::uint64_t rest = negative_ ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
  for (; rest != 0; rest >>= 32) limbs_.push_back(static_cast<std::uint32_t>(rest));
}

BigInteger BigInteger::from_double(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::trunc(std::abs(value)), &exponent);
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  BigInteger result = exponent >= 53 ? BigInteger(mantissa).shifted_left(static_cast<std::uint64_t>(exponent - 53))
                                     : BigInteger(mantissa).shifted_right(static_cast<std::uint64_t>(53 - exponent));
  result.negative_ = value < 0 && !result.is_zero();
  return result;
}

std::optional<BigInteger> BigInteger::parse(std::string_view digits, int base) {
  if (digits.empty()) return std::nullopt;
  BigInteger result;
  for (char c : digits) {
    const int digit = digit_value(c);
    if (digit >= base) return std::nullopt;
    std::uint64_t carry = static_cast<std::uint64_t>(digit);
    for (std::uint32_t& limb : result.limbs_) {
      carry += static_cast<std::uint64_t>(limb) * static_cast<std::uint64_t>(base);
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) result.limbs_.push_back(static_cast<std::uint32_t>(carry));
  }
  return result;
}

void BigInteger::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  if (limbs_.empty()) negative_ = false;
}

bool BigInteger::fits_int64() const {
  const std::size_t bits = bit_length();
  if (bits <= 63) return true;
  return bits == 64 && negative_ && limbs_[0] == 0 && limbs_[1] == 0x80000000U;
}

std::int64_t BigInteger::to_int64() const {
  std::uint64_t value = 0;
  for (std::size_t i = std::min<std::size_t>(limbs_.size(), 2); i-- > 0;) value = value << 32 | limbs_[i];
  return static_cast<std::int64_t>(negative_ ? ~value + 1 : value);
}

double BigInteger::to_double() const {
  const std::size_t bits = bit_length();
  if (bits <= 63) return static_cast<double>(to_int64());
  if (bits > 1100)
    return negative_ ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  // The top 64 bits, with the last one set if anything was cut off, round as the whole number does.
  const std::uint64_t drop = bits - 64;
  const BigInteger top = magnitude().shifted_right(drop);
  std::uint64_t mantissa = static_cast<std::uint64_t>(top.limbs_[1]) << 32 | top.limbs_[0];
  if (top.shifted_left(drop) != magnitude()) mantissa |= 1;
  const double value = std::ldexp(static_cast<double>(mantissa), static_cast<int>(drop));
  return negative_ ? -value : value;
}

/// Digits of a base 2^bits, most significant first: cut out of the limbs.
std::string BigInteger::bit_digits(unsigned bits) const {
  std::string digits = negative_ ? "-" : "";
  const std::size_t count = (bit_length() + bits - 1) / bits;
  for (std::size_t i = count; i-- > 0;) {
    const std::size_t place = i * bits;
    std::uint64_t window = limbs_[place / 32];
    if (place / 32 + 1 < limbs_.size()) window |= static_cast<std::uint64_t>(limbs_[place / 32 + 1]) << 32;
    digits += "0123456789abcdef"[(window >> (place % 32)) & ((1U << bits) - 1)];
  }
  return digits;
}

std::string BigInteger::to_string(int base) const {
  if (is_zero()) return "0";
  if (base == 2 || base == 8 || base == 16) return bit_digits(base == 2 ? 1 : base == 8 ? 3 : 4);
  // As many digits at once as fit a limb, so that the number is divided as seldom as possible.
  std::uint32_t chunk = static_cast<std::uint32_t>(base);
  int chunk_digits = 1;
  while (static_cast<std::uint64_t>(chunk) * static_cast<std::uint64_t>(base) < limb_base) {
    chunk *= static_cast<std::uint32_t>(base);
    ++chunk_digits;
  }
  std::string digits;
  Limbs rest = limbs_;
  while (!rest.empty()) {
    auto [quotient, remainder] = divide_small(rest, chunk);
    rest = std::move(quotient);
    for (int i = 0; i < chunk_digits && (!rest.empty() || remainder != 0); ++i) {
      digits += "0123456789abcdefghijklmnopqrstuvwxyz"[remainder % static_cast<std::uint32_t>(base)];
      remainder /= static_cast<std::uint32_t>(base);
    }
  }
  if (negative_) digits += '-';
  std::reverse(digits.begin(), digits.end());
  return digits;
}

std::size_t BigInteger::bit_length() const {
  return limbs_.empty() ? 0 : 32 * (limbs_.size() - 1) + static_cast<std::size_t>(std::bit_width(limbs_.back()));
}

BigInteger BigInteger::operator-() const {
  BigInteger result = *this;
  result.negative_ = !negative_ && !is_zero();
  return result;
}

BigInteger BigInteger::magnitude() const {
  BigInteger result = *this;
  result.negative_ = false;
  return result;
}

std::strong_ordering BigInteger::compare_magnitudes(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() <=> b.size();
  return std::lexicographical_compare_three_way(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

BigInteger::Limbs BigInteger::add(const Limbs& a, const Limbs& b) {
  Limbs sum;
  sum.reserve(std::max(a.size(), b.size()) + 1);
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()) || carry != 0; ++i) {
    carry += static_cast<std::uint64_t>(i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0);
    sum.push_back(static_cast<std::uint32_t>(carry));
    carry >>= 32;
  }
  return sum;
}

BigInteger::Limbs BigInteger::subtract(const Limbs& larger, const Limbs& smaller) {
  Limbs difference = larger;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < difference.size(); ++i) {
    const std::uint64_t taken = borrow + (i < smaller.size() ? smaller[i] : 0);
    borrow = difference[i] < taken ? 1 : 0;
    difference[i] = static_cast<std::uint32_t>(difference[i] - taken);
  }
  return difference;
}

BigInteger operator+(const BigInteger& a, const BigInteger& b) {
  BigInteger result;
  if (a.negative_ == b.negative_) {
    result.limbs_ = BigInteger::add(a.limbs_, b.limbs_);
    result.negative_ = a.negative_;
  } else if (BigInteger::compare_magnitudes(a.limbs_, b.limbs_) >= 0) {
    result.limbs_ = BigInteger::subtract(a.limbs_, b.limbs_);
    result.negative_ = a.negative_;
  } else {
    result.limbs_ = BigInteger::subtract(b.limbs_, a.limbs_);
    result.negative_ = b.negative_;
  }
  result.trim();
  return result;
}

BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + (-b); }

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
  BigInteger result;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size() || carry != 0; ++j) {
      carry += result.limbs_[i + j];
      if (j < b.limbs_.size()) carry += static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  result.negative_ = a.negative_ != b.negative_;
  result.trim();
  return result;
}

std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b) {
  if (a.negative_ != b.negative_) return a.negative_ ? std::strong_ordering::less : std::strong_ordering::greater;
  return a.negative_ ? BigInteger::compare_magnitudes(b.limbs_, a.limbs_)
                     : BigInteger::compare_magnitudes(a.limbs_, b.limbs_);
}

std::pair<BigInteger::Limbs, std::uint32_t> BigInteger::divide_small(const Limbs& a, std::uint32_t b) {
  Limbs quotient(a.size());
  std::uint64_t rest = 0;
  for (std::size_t i = a.size(); i-- > 0;) {
    rest = rest << 32 | a[i];
    quotient[i] = static_cast<std::uint32_t>(rest / b);
    rest %= b;
  }
  while (!quotient.empty() && quotient.back() == 0) quotient.pop_back();
  return {std::move(quotient), static_cast<std::uint32_t>(rest)};
}

// Knuth's algorithm D: the divisor is scaled so that its top bit is set; a guessed digit is then at most 2 too large.
std::pair<BigInteger::Limbs, BigInteger::Limbs> BigInteger::divide(const Limbs& a, const Limbs& b) {
  if (compare_magnitudes(a, b) < 0) return {{}, a};
  if (b.size() == 1) {
    auto [quotient, rest] = divide_small(a, b[0]);
    return {std::move(quotient), rest == 0 ? Limbs{} : Limbs{rest}};
  }
  const auto scale = static_cast<std::uint64_t>(std::countl_zero(b.back()));
  BigInteger scaled_a, scaled_b;
  scaled_a.limbs_ = a;
  scaled_b.limbs_ = b;
  Limbs u = scaled_a.shifted_left(scale).limbs_;
  const Limbs v = scaled_b.shifted_left(scale).limbs_;
  const std::size_t n = v.size();
  u.resize(std::max(u.size(), a.size()) + 1, 0);
  Limbs quotient(u.size() - n, 0);
  for (std::size_t j = u.size() - n; j-- > 0;) {
    const std::uint64_t head = static_cast<std::uint64_t>(u[j + n]) << 32 | u[j + n - 1];
    std::uint64_t guess = head / v[n - 1];
    std::uint64_t rest = head % v[n - 1];
    while (guess >= limb_base || guess * v[n - 2] > (rest << 32 | u[j + n - 2])) {
      --guess;
      rest += v[n - 1];
      if (rest >= limb_base) break;
    }
    std::int64_t borrow = 0;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i <= n; ++i) {
      carry += i < n ? guess * v[i] : 0;
      const std::int64_t t =
          static_cast<std::int64_t>(u[i + j]) - borrow - static_cast<std::int64_t>(carry & 0xFFFFFFFFU);
      u[i + j] = static_cast<std::uint32_t>(t);
      borrow = t < 0 ? 1 : 0;
      carry >>= 32;
    }
    if (borrow != 0) {
      --guess;
      std::uint64_t sum = 0;
      for (std::size_t i = 0; i <= n; ++i) {
        sum += static_cast<std::uint64_t>(u[i + j]) + (i < n ? v[i] : 0);
        u[i + j] = static_cast<std::uint32_t>(sum);
        sum >>= 32;
      }
    }
    quotient[j] = static_cast<std::uint32_t>(guess);
  }
  BigInteger remainder;
  remainder.limbs_ = std::move(u);
  remainder.trim();
  return {std::move(quotient), remainder.shifted_right(scale).limbs_};
}

std::pair<BigInteger, BigInteger> BigInteger::floor_divide(const BigInteger& a, const BigInteger& b) {
  auto [q, r] = divide(a.limbs_, b.limbs_);
  BigInteger quotient, remainder;
  quotient.limbs_ = std::move(q);
  quotient.negative_ = a.negative_ != b.negative_;
  quotient.trim();
  remainder.limbs_ = std::move(r);
  remainder.negative_ = a.negative_;
  remainder.trim();
  if (!remainder.is_zero() && remainder.negative_ != b.negative_) {
    quotient = quotient - BigInteger(1);
    remainder = remainder + b;
  }
  return {std::move(quotient), std::move(remainder)};
}

double BigInteger::true_divide(const BigInteger& a, const BigInteger& b) {
  if (a.is_zero()) return 0.0;
  // Scale so that the integer quotient has 65 or 66 bits; the remainder only decides the last of them.
  const auto shift = static_cast<std::int64_t>(b.bit_length()) - static_cast<std::int64_t>(a.bit_length()) + 65;
  if (shift > 65 + 1080) return a.negative_ != b.negative_ ? -0.0 : 0.0;
  const BigInteger top = shift > 0 ? a.magnitude().shifted_left(static_cast<std::uint64_t>(shift)) : a.magnitude();
  const BigInteger bottom = shift < 0 ? b.magnitude().shifted_left(static_cast<std::uint64_t>(-shift)) : b.magnitude();
  auto [quotient, remainder] = floor_divide(top, bottom);
  if (!remainder.is_zero() && !quotient.is_odd()) quotient = quotient + BigInteger(1);
  const double value = std::ldexp(quotient.to_double(), static_cast<int>(std::max<std::int64_t>(-shift, -2000)));
  return a.negative_ != b.negative_ ? -value : value;
}

BigInteger BigInteger::power(BigInteger base, std::uint64_t exponent) {
  BigInteger result(1);
  while (true) {
    if ((exponent & 1U) != 0) result = result * base;
    exponent >>= 1;
    if (exponent == 0) return result;
    base = base * base;
  }
}

BigInteger BigInteger::shifted_left(std::uint64_t bits) const {
  if (is_zero()) return *this;
  BigInteger result;
  result.negative_ = negative_;
  result.limbs_.assign(bits / 32, 0);
  const auto part = static_cast<unsigned>(bits % 32);
  std::uint64_t carry = 0;
  for (std::uint32_t limb : limbs_) {
    carry |= static_cast<std::uint64_t>(limb) << part;
    result.limbs_.push_back(static_cast<std::uint32_t>(carry));
    carry >>= 32;
  }
  if (carry != 0) result.limbs_.push_back(static_cast<std::uint32_t>(carry));
  return result;
}

BigInteger BigInteger::shifted_right(std::uint64_t bits) const {
  const std::uint64_t whole = bits / 32;
  if (whole >= limbs_.size()) return negative_ ? BigInteger(-1) : BigInteger();
  BigInteger result;
  const auto part = static_cast<unsigned>(bits % 32);
  bool lost =
      std::any_of(limbs_.begin(), limbs_.begin() + static_cast<std::ptrdiff_t>(whole), [](auto l) { return l != 0; });
  lost = lost || (limbs_[whole] & ((std::uint32_t{1} << part) - 1)) != 0;
  for (std::size_t i = whole; i < limbs_.size(); ++i) {
    const std::uint64_t high = i + 1 < limbs_.size() ? limbs_[i + 1] : 0;
    result.limbs_.push_back(static_cast<std::uint32_t>((high << 32 | limbs_[i]) >> part));
  }
  result.negative_ = negative_;
  result.trim();
  return negative_ && lost ? result - BigInteger(1) : result;
}

BigInteger::Limbs BigInteger::twos_complement(std::size_t limbs) const {
  Limbs result = limbs_;
  result.resize(limbs, 0);
  if (!negative_) return result;
  std::uint64_t carry = 1;
  for (std::uint32_t& limb : result) {
    carry += static_cast<std::uint32_t>(~limb);
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return result;
}

BigInteger BigInteger::bitwise(Bitwise operation, const BigInteger& a, const BigInteger& b) {
  const std::size_t size = std::max(a.limbs_.size(), b.limbs_.size()) + 1;
  const Limbs x = a.twos_complement(size);
  const Limbs y = b.twos_complement(size);
  BigInteger result;
  result.limbs_.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (operation == Bitwise::conjunction) result.limbs_[i] = x[i] & y[i];
    if (operation == Bitwise::disjunction) result.limbs_[i] = x[i] | y[i];
    if (operation == Bitwise::exclusive) result.limbs_[i] = x[i] ^ y[i];
  }
  if ((result.limbs_.back() & 0x80000000U) != 0) {
    result.negative_ = true;
    result.limbs_ = result.twos_complement(size);
  }
  result.trim();
  return result;
}

}  // namespace comma::interpreter
