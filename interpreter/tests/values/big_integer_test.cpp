#include "interpreter/values/big_integer.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace comma::interpreter;

namespace {

BigInteger random_integer(std::mt19937& random, int limbs) {
  BigInteger value;
  for (int i = 0; i < limbs; ++i) {
    // All-ones and zero limbs are where the quotient digit is guessed wrong.
    const std::uint32_t limb = random() % 4 == 0   ? 0xFFFFFFFFU
                               : random() % 4 == 0 ? 0U
                                                   : static_cast<std::uint32_t>(random());
    value = value.shifted_left(32) + BigInteger(static_cast<std::int64_t>(limb));
  }
  return random() % 2 == 0 ? value : -value;
}

}  // namespace

TEST_CASE("Quotient and remainder rebuild the dividend, the remainder has the divisor's sign", "[big_integer]") {
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    const BigInteger a = random_integer(random, 1 + static_cast<int>(random() % 9));
    const BigInteger b = random_integer(random, 1 + static_cast<int>(random() % 5));
    if (b.is_zero()) continue;
    const auto [q, r] = BigInteger::floor_divide(a, b);
    REQUIRE(q * b + r == a);
    REQUIRE(r.magnitude() < b.magnitude());
    REQUIRE((r.is_zero() || r.is_negative() == b.is_negative()));
  }
}

TEST_CASE("Numbers survive the way through text in any base", "[big_integer]") {
  std::mt19937 random(3);
  for (int base : {2, 7, 10, 16, 36}) {
    for (int i = 0; i < 50; ++i) {
      const BigInteger a = random_integer(random, 6).magnitude();
      REQUIRE(*BigInteger::parse(a.to_string(base), base) == a);
    }
  }
  CHECK_FALSE(BigInteger::parse("12a", 10));
  CHECK_FALSE(BigInteger::parse("", 10));
}

TEST_CASE("Shifts are products and floored quotients by powers of two", "[big_integer]") {
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    const BigInteger a = random_integer(random, 4);
    const std::uint64_t bits = random() % 140;
    const BigInteger power = BigInteger::power(BigInteger(2), bits);
    REQUIRE(a.shifted_left(bits) == a * power);
    REQUIRE(a.shifted_right(bits) == BigInteger::floor_divide(a, power).first);
  }
}

TEST_CASE("Bitwise operations act on two's complement: a + b = (a ^ b) + 2 (a & b)", "[big_integer]") {
  std::mt19937 random(11);
  using enum BigInteger::Bitwise;
  for (int i = 0; i < 500; ++i) {
    const BigInteger a = random_integer(random, 3), b = random_integer(random, 4);
    const BigInteger conj = BigInteger::bitwise(conjunction, a, b);
    REQUIRE(BigInteger::bitwise(exclusive, a, b) + conj + conj == a + b);
    REQUIRE(BigInteger::bitwise(disjunction, a, b) + conj == a + b);
  }
}

TEST_CASE("Conversion to double rounds to nearest even", "[big_integer]") {
  const BigInteger half = BigInteger(1).shifted_left(53);
  CHECK((half.shifted_left(20) + BigInteger(1).shifted_left(20)).to_double() == std::ldexp(1.0, 73));
  CHECK((half.shifted_left(20) + BigInteger(1).shifted_left(20) + BigInteger(1)).to_double() ==
        std::ldexp(std::ldexp(1.0, 53) + 2.0, 20));
  CHECK(std::isinf(BigInteger(1).shifted_left(5000).to_double()));
  CHECK(BigInteger::from_double(-1e30).to_double() == -1e30);
  CHECK(BigInteger::true_divide(BigInteger(1).shifted_left(3000), BigInteger(1).shifted_left(2999)) == 2.0);
}

TEST_CASE("The ends of 64 bits are told from what lies beyond", "[big_integer]") {
  const BigInteger largest(INT64_MAX), smallest(INT64_MIN);
  CHECK(largest.fits_int64());
  CHECK(smallest.fits_int64());
  CHECK(smallest.to_int64() == INT64_MIN);
  CHECK_FALSE((largest + BigInteger(1)).fits_int64());
  CHECK_FALSE((smallest - BigInteger(1)).fits_int64());
}
