// The types of arrays as values: a.dtype, and what dtype= is given.
#pragma once

#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"

namespace comma::interpreter {

/// np.dtype('float64'): equal to float, to 'float64' and to its like.
struct DtypeObject : HostObject {
  explicit DtypeObject(NumberType which) : type(which) {}
  NumberType type;
  std::string type_name() const override { return "numpy.dtype"; }
  std::string repr() const override { return "dtype('" + text() + "')"; }
  std::string text() const { return std::string(name_of(type)); }
  bool equals(const Object& other) const override;
  std::optional<Value> attribute(std::string_view name) const override;
  std::vector<std::string> attribute_names() const override { return {"name", "kind", "itemsize"}; }
  std::optional<Value> compared(Operator op, const Value& other) const override;
};

Value dtype_value(NumberType type);

/// float, 'float64', a.dtype ... as a type; nothing for None. Raises NotImplementedError for types that arrays have
/// not.
std::optional<NumberType> number_type_of(const Value& word);

}  // namespace comma::interpreter
