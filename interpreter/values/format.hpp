// Text from values: format specs ("{:>8.3f}"), str.format, and the older % formatting.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "interpreter/evaluation/meter.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// format(value, spec). Raises ValueError for a spec that is none or does not fit the type.
std::string format_value(const Value& value, std::string_view spec, Meter& meter);

/// text % arguments; a tuple gives the values one by one, a dict those of "%(name)s".
std::string format_percent(const std::string& text, const Value& arguments, Meter& meter);

/// text.format(...). `field` gives the value of a field's name: "", "0", "name", "name.attr", "name[key]".
std::string format_fields(const std::string& text, const std::function<Value(std::string_view)>& field, Meter& meter);

/// The value after !r, !s or !a.
Value convert_value(const Value& value, char conversion);

}  // namespace comma::interpreter
