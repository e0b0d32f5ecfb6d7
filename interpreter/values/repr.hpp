// How values are written: Python's repr() and str(), to the last digit.
#pragma once

#include <complex>
#include <string>
#include <string_view>

#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// The shortest digits that read back as the same number: "0.1", "1e+16", "inf", "nan", "2.0".
std::string repr_of(double value);
std::string repr_of(std::complex<double> value);  ///< "(1+2j)", "3j"
/// In single quotes, or in double ones when that saves an escape.
std::string repr_of(std::string_view text);
std::string repr_of(const Value& value);
/// The decimal digits of an int of any size; raises ValueError beyond Python's limit of 4300 digits.
std::string decimal_digits(const BigInteger& value);

/// Python's str(): a text is itself, an exception its message, everything else its repr().
std::string text_of(const Value& value);

}  // namespace comma::interpreter
