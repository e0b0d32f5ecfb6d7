// Integers without limit, as Python's int has them: sign and magnitude in base 2^32. Only numbers beyond 64 bits come
// here, so plain schoolbook algorithms (D. Knuth, The Art of Computer Programming, volume 2, section 4.3.1) are enough.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace comma::interpreter {

class BigInteger {
 public:
  BigInteger() = default;
  BigInteger(std::int64_t value);
  /// The integer part of a finite double (rounded toward zero).
  static BigInteger from_double(double value);
  /// Digits of `base` (2 to 36) without sign or prefix; nothing if a character is no digit.
  static std::optional<BigInteger> parse(std::string_view digits, int base);

  bool is_zero() const { return limbs_.empty(); }
  bool is_negative() const { return negative_; }
  bool is_odd() const { return !limbs_.empty() && (limbs_[0] & 1U) != 0; }
  bool fits_int64() const;
  std::int64_t to_int64() const;  ///< only if fits_int64()
  /// Nearest double, ties to even; infinite when too large.
  double to_double() const;
  std::string to_string(int base = 10) const;  ///< lower-case digits, a leading '-' when negative
  std::size_t bit_length() const;              ///< of the magnitude

  BigInteger operator-() const;
  BigInteger magnitude() const;
  friend BigInteger operator+(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator*(const BigInteger& a, const BigInteger& b);
  friend std::strong_ordering operator<=>(const BigInteger& a, const BigInteger& b);
  friend bool operator==(const BigInteger& a, const BigInteger& b) = default;

  /// Quotient rounded toward minus infinity and remainder with the divisor's sign. The divisor is not zero.
  static std::pair<BigInteger, BigInteger> floor_divide(const BigInteger& a, const BigInteger& b);
  /// a / b as the nearest double (both may exceed the range of double). The divisor is not zero.
  static double true_divide(const BigInteger& a, const BigInteger& b);
  static BigInteger power(BigInteger base, std::uint64_t exponent);
  BigInteger shifted_left(std::uint64_t bits) const;
  BigInteger shifted_right(std::uint64_t bits) const;  ///< rounds toward minus infinity

  /// The operation on infinite two's complement numbers.
  enum class Bitwise { conjunction, disjunction, exclusive };
  static BigInteger bitwise(Bitwise operation, const BigInteger& a, const BigInteger& b);

 private:
  using Limbs = std::vector<std::uint32_t>;
  void trim();
  std::string bit_digits(unsigned bits) const;
  static std::strong_ordering compare_magnitudes(const Limbs& a, const Limbs& b);
  static Limbs add(const Limbs& a, const Limbs& b);
  static Limbs subtract(const Limbs& larger, const Limbs& smaller);
  static std::pair<Limbs, Limbs> divide(const Limbs& a, const Limbs& b);
  static std::pair<Limbs, std::uint32_t> divide_small(const Limbs& a, std::uint32_t b);
  Limbs twos_complement(std::size_t limbs) const;

  Limbs limbs_;  ///< least significant first, the last one not zero
  bool negative_ = false;
};

}  // namespace comma::interpreter
