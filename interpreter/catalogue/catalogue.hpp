// The catalogue: what each command is called, takes and gives. It is data, one YAML page a command, compiled at build
// time into one compact blob a page; a page is decoded when its command is first used. Checks, defaults and `comma
// explain` all read the structures below, so they cannot disagree.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/formulas/expression.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// What a keyword may hold. The kinds from `text` to `parameter` all hold text; they say what the text names.
enum class Kind {
  real,
  integer,
  complex,
  text,
  expression,  ///< an expression of the language; it may use the variables around the call, see expression_keywords.hpp
  node_group,
  cell_group,
  node,
  cell,
  component,
  field,
  parameter,
  input_unit,   ///< number of a file that the command reads
  output_unit,  ///< number of a file that the command writes
  concept_kind,
  factor,
  anything  ///< any value of the language, as it was written
};

/// The word of the YAML pages for a kind ("node_group"); "concept" for a concept.
std::string_view name_of(Kind kind);
/// The kind of a YAML word, or nothing: the word is then the type of a concept.
std::optional<Kind> kind_named(std::string_view word);
bool holds_text(Kind kind);

/// One type that a keyword admits.
struct TypePage {
  Kind kind = Kind::text;
  std::string concept_type;  ///< for Kind::concept_kind: "maillage_sdaster"; "any" admits every concept
};

/// One word (or number) that a keyword admits.
struct WordPage {
  Value value;
  std::string doc;
  bool supported = true;
  std::string no_effect;  ///< why choosing it changes nothing in comma, or empty
};

/// A relation between the keywords of one level.
struct RulePage {
  enum class Kind { exactly_one, at_least_one, at_most_one, all_or_none, requires_all, requires_one, excludes };
  Kind kind = Kind::exactly_one;
  std::vector<std::string> keywords;  ///< for the last three kinds, the first is the one that asks
  bool asks_for_more() const {
    return kind == Kind::all_or_none || kind == Kind::requires_all || kind == Kind::requires_one;
  }
};

std::string_view name_of(RulePage::Kind kind);
std::optional<RulePage::Kind> rule_named(std::string_view word);

struct KeywordPage;
struct BlockPage;

/// The keywords that stand together at one level: a command, a factor keyword, a block.
struct LevelPage {
  std::vector<KeywordPage> keywords;
  std::vector<RulePage> rules;
  std::vector<BlockPage> blocks;
  /// What any other name is (the parameters that FORMULE takes), or null: there is no other.
  std::shared_ptr<const KeywordPage> further;
};

/// A count or a bound that may be missing.
struct Bounds {
  std::optional<double> above, at_least, below, at_most;
};

constexpr int unlimited = -1;

struct KeywordPage {
  std::string name;
  std::vector<std::string> aliases;  ///< older names, still accepted
  std::string doc;
  std::string unit;  ///< "m", "Pa", "s" ... empty when it has none
  std::vector<TypePage> types;
  int min_count = 1;  ///< values, or occurrences of a factor
  int max_count = 1;  ///< `unlimited` for any number
  std::vector<WordPage> words;
  Bounds bounds;
  bool required = false;
  bool supported = true;
  std::string no_effect;    ///< why it cannot change a result of comma, or empty
  bool missed = false;      ///< with `no_effect`: it asks for what comma does not give, and an alarm says so
  std::string counts_when;  ///< a condition as of a block, without which it is read by nothing: an alarm then; or empty
  std::shared_ptr<const Expression> counts;
  std::optional<Value> default_value;
  bool present_by_default = false;  ///< a factor that stands there, with its defaults, when it is not written
  LevelPage inside;                 ///< of a factor

  bool is_factor() const { return types.size() == 1 && types.front().kind == Kind::factor; }
  bool holds_many() const { return max_count != 1; }
};

/// Keywords that exist only under a condition: an expression over the keywords of its level and of the levels around
/// it, where a keyword that is absent is None.
struct BlockPage {
  std::string when;
  std::shared_ptr<const Expression> condition;
  LevelPage inside;
};

enum class Cost { cheap, solve };
/// naming: says where outputs go and inputs stand, and opens nothing (DEFI_FICHIER); setup: always runs (DEBUT, FIN).
enum class Role { value, verdict, output, naming, setup };
/// Whether no verdict depends on what the command makes itself: where comma cannot do it, an alarm is enough.
inline bool only_writes(Role role) { return role == Role::output || role == Role::naming; }
/// What reuse= does: nothing is to be written, the concept may be or must be changed in place, or it is only checked,
/// and the command makes a new one beside it.
enum class Reuse { none, allowed, compulsory, beside };

struct ProductPage {
  std::string when;  ///< empty: always
  std::shared_ptr<const Expression> condition;
  std::string type;
  std::string like;  ///< the keyword whose concept says which of the types under `type` it is; empty: none
};

struct CommandPage {
  std::string name;
  std::string doc;
  std::string category;
  std::string example;
  std::string note;                   ///< what comma does differently, or does not do
  std::vector<ProductPage> products;  ///< the first whose condition holds; empty: the command gives nothing
  Cost cost = Cost::cheap;
  Role role = Role::value;
  bool standalone = false;  ///< the product keeps nothing of the concepts that were read (a table, a function)
  bool destroys = false;    ///< the concepts that are named are of no use afterwards
  bool supported = true;
  Reuse reuse = Reuse::none;
  std::vector<std::string> reuse_same_as;  ///< paths, "MAILLAGE" or "ETAT_INIT/EVOL_NOLI": one holds the reused concept
  LevelPage inside;
};

/// Calls `visit(keyword, conditions)` for each keyword of a level and of its blocks, whether their conditions hold or
/// not. `conditions` joins those of the blocks around the keyword with "and"; `outer` are those of the level.
template <class Visit>
void visit_keywords(const LevelPage& level, const Visit& visit, const std::string& outer = {}) {
  for (const KeywordPage& keyword : level.keywords) visit(keyword, outer);
  for (const BlockPage& block : level.blocks)
    visit_keywords(block.inside, visit, outer.empty() ? block.when : outer + " and " + block.when);
}

/// A type of concept: "evol_noli", a "nonlinear result", which is also a "resultat_sdaster".
struct ConceptTypePage {
  std::string name;
  std::string doc;
  std::vector<std::string> is_a;
};

/// One page as the build embedded it.
struct CatalogueBlob {
  std::string_view name;  ///< the command; "" for the list of concept types
  std::span<const std::uint8_t> bytes;
};

/// All pages. Blobs must outlive it. Not thread-safe: pages are decoded on first use.
class Catalogue {
 public:
  explicit Catalogue(std::span<const CatalogueBlob> blobs);

  bool has(std::string_view command) const;
  /// Sorted.
  std::vector<std::string> names() const;
  /// Throws std::out_of_range for a name that it does not have.
  const CommandPage& page(std::string_view command) const;

  /// Whether a concept of type `type` may stand where `wanted` is asked ("any", itself, or what it is a kind of).
  bool is_a(std::string_view type, std::string_view wanted) const;
  /// "mesh" for "maillage_sdaster"; the type itself if the list does not have it.
  std::string describe_type(std::string_view type) const;

 private:
  const std::map<std::string, ConceptTypePage, std::less<>>& types() const;

  std::map<std::string, std::span<const std::uint8_t>, std::less<>> blobs_;
  mutable std::map<std::string, std::unique_ptr<CommandPage>, std::less<>> pages_;
  mutable std::optional<std::map<std::string, ConceptTypePage, std::less<>>> types_;
};

/// "a mesh", "an element characteristics field".
std::string with_article(std::string_view noun);

}  // namespace comma::interpreter
