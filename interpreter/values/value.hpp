// The values of the command language: Python's None, bool, int, float, complex, str, tuple, list, dict, functions, and
// the two things of its own: _F(...) occurrences, which are dicts, and handles on concepts. Copying a Value is cheap.
// Sixteen bytes and a tag: small kinds lie inside, heavy ones are shared (see objects.hpp).
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/graph/concept.hpp"
#include "interpreter/source.hpp"

namespace comma::interpreter {

class BigInteger;
class Dict;
class Value;

/// Base of the kinds that only the evaluator works with: ranges, functions, modules, exceptions, iterators ...
struct Object {
  virtual ~Object() = default;
  virtual std::string type_name() const = 0;
  virtual std::string repr() const;
  virtual bool is_callable() const { return false; }
  virtual bool equals(const Object& other) const { return this == &other; }
  virtual std::size_t hash() const { return std::hash<const Object*>{}(this); }
};

/// A keyword argument as written: NAME=value, with both places.
struct Argument {
  std::string name;
  Span name_span;
  std::shared_ptr<const Value> value;
  Span value_span;
};

/// What _F(A=1, B=2), which is a dict, knows of its place in the file.
struct FactorPlaces {
  struct Place {
    Span name, value;
  };
  std::map<std::string, Place, std::less<>> of_keywords;  ///< those written in the brackets
  Span span;
  bool open = false;  ///< there are further keywords that are not known
};

/// The items of a tuple or of a list.
struct Sequence {
  Sequence() = default;
  explicit Sequence(std::vector<Value> values);
  Sequence(const Sequence&) = delete;
  Sequence& operator=(const Sequence&) = delete;
  ~Sequence();
  std::vector<Value> items;
};

struct Tuple : Sequence {
  using Sequence::Sequence;
};
struct List : Sequence {
  using Sequence::Sequence;
};
struct Set {
  std::unique_ptr<Dict> keys;
  bool frozen = false;
};

/// A value. Sequences and mappings have Python's reference meaning (a list assigned twice is one list).
class Value {
 public:
  struct Unknown {};
  using Storage = std::variant<std::monostate, Unknown, bool, std::int64_t, double, std::complex<double>,
                               std::shared_ptr<const std::string>, std::shared_ptr<const BigInteger>,
                               std::shared_ptr<Tuple>, std::shared_ptr<List>, std::shared_ptr<Dict>,
                               std::shared_ptr<Set>, ConceptPtr, std::shared_ptr<Object>>;

  Value();  ///< None
  Value(bool value);
  Value(std::int64_t value);
  Value(int value) : Value(static_cast<std::int64_t>(value)) {}
  Value(double value);
  Value(std::complex<double> value);
  Value(std::string text);
  Value(const char* text) : Value(std::string(text)) {}
  Value(ConceptPtr handle);
  Value(std::shared_ptr<Tuple> sequence);
  Value(std::shared_ptr<List> sequence);
  Value(std::shared_ptr<Dict> mapping);
  Value(std::shared_ptr<Set> set);
  Value(std::shared_ptr<Object> object);
  static Value tuple(std::vector<Value> items);
  static Value list(std::vector<Value> items);
  /// A dict of text keys, in the order given.
  static Value dict(std::vector<std::pair<std::string, Value>> items);
  /// An int of any size; one that fits 64 bits is stored as such.
  static Value integer(BigInteger value);
  /// The value of something that was already reported as wrong: every operation on it gives unknown again, every check
  /// passes it, so that one mistake makes one error.
  static Value unknown();

  bool is_unknown() const;
  bool is_none() const;
  bool is_bool() const;
  bool is_integer() const;      ///< an int that fits 64 bits; a bool is not one
  bool is_big_integer() const;  ///< an int beyond 64 bits
  bool is_real() const;         ///< a float
  bool is_number() const;       ///< int or float, not bool
  bool is_complex() const;
  bool is_text() const;
  bool is_tuple() const;
  bool is_list() const;
  bool is_sequence() const;  ///< tuple or list
  bool is_dict() const;
  bool is_set() const;
  bool is_factor() const;  ///< a dict that was written as _F(...)
  bool is_concept() const;
  bool is_callable() const;

  /// Each throws std::logic_error on a value of another type.
  bool as_bool() const;
  std::int64_t as_integer() const;
  double as_real() const;                   ///< also of an int
  std::complex<double> as_complex() const;  ///< also of an int or a float
  const std::string& as_text() const;
  std::span<const Value> items() const;  ///< of a tuple or a list
  const ConceptPtr& as_concept() const;
  const BigInteger& as_big_integer() const;
  Dict& as_dict() const;
  Dict& as_set() const;  ///< the keys of a set
  std::vector<Value>& as_list() const;
  /// The object as T, or null when it is of another kind.
  template <class T>
  T* as_object() const {
    const auto* object = std::get_if<std::shared_ptr<Object>>(&storage_);
    return object ? dynamic_cast<T*>(object->get()) : nullptr;
  }

  /// Python's name of the type: "int", "float", "str", "tuple" ... ; "_F" and the concept's own type name beside them.
  std::string type_name() const;
  /// Python's repr(); a concept shows its name.
  std::string repr() const;

  const Storage& storage() const { return storage_; }

 private:
  explicit Value(Storage storage) : storage_(std::move(storage)) {}
  Storage storage_;
};

}  // namespace comma::interpreter
