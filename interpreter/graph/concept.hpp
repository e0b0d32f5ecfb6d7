// A concept is what a command produces: a mesh, a model, a result, a table ... The interpreter knows its name, its type
// and which node of the command graph fills it; the commands layer derives from ConceptData and knows the rest.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/source.hpp"

namespace comma::interpreter {

class Value;
enum class Operator;

/// A function of reals that a concept holds: what formulas and loads call, without making values.
struct RealFunction {
  virtual ~RealFunction() = default;
  /// Names of the arguments, in order; a function that asks for none takes any one argument.
  virtual const std::vector<std::string>& parameters() const = 0;
  /// One argument a parameter. Throws where the function is not defined.
  virtual double evaluate(std::span<const double> arguments) const = 0;
  /// How many functions deep its evaluation calls others.
  virtual int nesting() const { return 0; }
};

/// The filled inside of a concept. Commands derive from it. The functions are what the language can do with a
/// concept; by default a real function is called with numbers, and each of the others throws DiagnosticError
/// `not-supported`.
struct ConceptData {
  virtual ~ConceptData() = default;
  virtual const RealFunction* real_function() const { return nullptr; }
  virtual Value subscript(const Value& key) const;                ///< T["DX", 1]
  virtual Value call(const std::vector<Value>& arguments) const;  ///< F(2.0)
  virtual Value method(std::string_view name, const std::vector<Value>& arguments,
                       const std::map<std::string, Value>& keywords) const;  ///< MA.getNumberOfNodes()
  /// What len() gives; nothing for a concept without length.
  virtual std::optional<std::int64_t> length() const { return std::nullopt; }
  /// What an operator makes of it and of a number or a concept whose data is there; null where it makes nothing.
  /// `reversed`: the other one stands on the left.
  virtual std::shared_ptr<ConceptData> combined(Operator, const Value& /*other*/, bool /*reversed*/) const {
    return nullptr;
  }
  /// What method() answers to: for hasattr() and for hints.
  virtual std::vector<std::string> method_names() const { return {}; }
};

/// The id of a concept that is taken out of another while the file is evaluated (a table of a result): it has its data,
/// and no node of the graph makes it.
inline constexpr int detached_concept = std::numeric_limits<int>::min();

/// A concept as the language handles it; every Value that refers to it shares this object. `data` is null until the
/// graph node that produces it has run; a later command with reuse= changes `data` in place.
struct Concept {
  std::string name;  ///< the variable it was first assigned to; "_7" for one that has no name
  std::string type;  ///< Code_Aster's type name: "maillage_sdaster", "evol_noli", ...
  int id = 0;        ///< dense, in order of creation; or detached_concept
  Span defined_at;   ///< the call that made it
  std::shared_ptr<ConceptData> data;
  std::optional<Span> destroyed_at = {};                ///< the call that has taken the data away (DETRUIRE)
  int version = 0;                                      ///< how many commands have written `data`
  std::vector<std::shared_ptr<Concept>> reads_through;  ///< reading this one reads those too (a model reads its mesh)

  Concept() = default;
  Concept(const Concept&) = default;
  Concept& operator=(const Concept&) = default;
  /// Lets go of a long chain of concepts, each made from the one before, link by link.
  ~Concept();
};

using ConceptPtr = std::shared_ptr<Concept>;

/// What getMesh(), getModel() and getMaterialField() of a concept give: the nearest behind it of this type. Null for
/// another method, or where there is none.
ConceptPtr source_behind(const Concept& made, std::string_view method);

}  // namespace comma::interpreter
