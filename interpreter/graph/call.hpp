// A command call after its check against the catalogue: every keyword exists, has its type, its bounds and its default.
// This is all that a command function sees of the language.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/concept.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

class Keywords;

/// One keyword of a checked call. `value` is converted to its catalogue type (an integer given for a real is a real);
/// a simple keyword that admits several values always holds a tuple; a factor keyword holds `factors` instead.
struct Keyword {
  std::string name;
  Value value;
  std::vector<Keywords> factors;
  Span name_span;  ///< empty for a default
  Span value_span;
  bool given = false;  ///< false: the value is the catalogue's default
};

/// The keywords of a call, or of one occurrence of a factor keyword. All accessors throw std::logic_error when the
/// keyword is absent or of another type: that is a bug of the command or of its catalogue page, never of the user's
/// file.
class Keywords {
 public:
  std::vector<Keyword> items;
  Span span;  ///< the whole call, or the whole _F(...)

  bool has(std::string_view keyword) const;    ///< given, or filled by a default
  bool given(std::string_view keyword) const;  ///< written in the file
  const Keyword& at(std::string_view keyword) const;

  double real(std::string_view keyword) const;
  std::int64_t integer(std::string_view keyword) const;
  const std::string& text(std::string_view keyword) const;
  const ConceptPtr& concept_of(std::string_view keyword) const;

  /// One or several values, as a vector; empty when the keyword is absent.
  std::vector<double> reals(std::string_view keyword) const;
  std::vector<std::int64_t> integers(std::string_view keyword) const;
  std::vector<std::string> texts(std::string_view keyword) const;
  std::vector<ConceptPtr> concepts(std::string_view keyword) const;
  /// Those of its values that are concepts.
  std::vector<ConceptPtr> concepts_among(std::string_view keyword) const;

  /// The occurrences of a factor keyword; empty when it is absent.
  const std::vector<Keywords>& factors(std::string_view keyword) const;
  /// Its only occurrence (one that the catalogue bounds to one and that is present).
  const Keywords& factor(std::string_view keyword) const;

  /// Where the value of a keyword stands; the whole call when it is a default or absent.
  Span span_of(std::string_view keyword) const;

  /// The data of a concept keyword as T. Throws std::logic_error if it has not been computed or is of another kind.
  template <class T>
  T& data(std::string_view keyword) const;
};

/// A checked call.
struct Call : Keywords {
  std::string command;
  ConceptPtr result;  ///< what it produces or, with reuse=, changes in place; null if nothing
  bool reuse = false;
};

/// Error `destroyed-concept`, without a place: of what reads a concept after DETRUIRE.
DiagnosticError destroyed_concept(const Concept& handle);

[[noreturn]] void throw_wrong_data(std::string_view keyword, const Concept* concept_handle);

template <class T>
T& data_of(const ConceptPtr& handle, std::string_view keyword = "") {
  T* data = handle ? dynamic_cast<T*>(handle->data.get()) : nullptr;
  if (data == nullptr) throw_wrong_data(keyword, handle.get());
  return *data;
}

template <class T>
T& Keywords::data(std::string_view keyword) const {
  return data_of<T>(concept_of(keyword), keyword);
}

}  // namespace comma::interpreter
