#include "commands/tests/mutations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "interpreter/diagnostic.hpp"
#include "interpreter/source.hpp"
#include "interpreter/syntax/ast.hpp"
#include "interpreter/syntax/parser.hpp"

namespace comma::commands::tests {

using namespace interpreter;

namespace {

using Levels = std::vector<const LevelPage*>;
using Item = CallNode::Item;

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

void collect_pages(const LevelPage& level, std::string_view name, std::vector<const KeywordPage*>& found) {
  for (const KeywordPage& keyword : level.keywords) {
    if (keyword.name == name) found.push_back(&keyword);
  }
  for (const BlockPage& block : level.blocks) collect_pages(block.inside, name, found);
}

/// A typing error: two letters swapped; a letter too many where there is nothing to swap.
std::string misspell(std::string word) {
  for (std::size_t i = 1; i + 1 < word.size(); ++i) {
    if (word[i] == word[i + 1] || word[i] == '_' || word[i + 1] == '_') continue;
    std::swap(word[i], word[i + 1]);
    return word;
  }
  return word + "Q";
}

bool all_of_kind(const KeywordPage& page, const std::function<bool(Kind)>& wanted) {
  return !page.types.empty() &&
         std::ranges::all_of(page.types, [&](const TypePage& type) { return wanted(type.kind); });
}

bool is_numeric(Kind kind) { return kind == Kind::real || kind == Kind::integer; }

/// A value of the right type for a keyword that is added; empty when none can be made up.
std::string sample_value(const KeywordPage& page) {
  if (!page.supported || page.types.empty() || page.min_count > 1) return "";
  if (!page.words.empty()) return page.words.front().supported ? page.words.front().value.repr() : "";
  const Kind kind = page.types.front().kind;
  if (kind == Kind::real) {
    const auto lowest = page.bounds.above ? page.bounds.above : page.bounds.at_least;
    const auto highest = page.bounds.below ? page.bounds.below : page.bounds.at_most;
    if (lowest && highest) return fmt::format("{:.6f}", 0.5 * (*lowest + *highest));
    return lowest ? "1.0" : "0.5";
  }
  if (kind == Kind::integer) return "1";
  return holds_text(kind) ? "'SAMPLE'" : "";
}

bool has_block(const Statement& statement) {
  switch (statement.kind) {
    case StatementKind::if_:
    case StatementKind::while_:
    case StatementKind::for_:
    case StatementKind::function:
    case StatementKind::try_:
    case StatementKind::with_:
      return true;
    default:
      return false;
  }
}

class Planter {
 public:
  Planter(const std::string& text, const Catalogue& catalogue)
      : text_(text), catalogue_(catalogue), source_(std::make_shared<const SourceFile>("mutant.comm", text)) {
    Diagnostics nothing;
    tree_ = parse(source_, nothing);
  }

  std::vector<Mutant> run() {
    for (const StatementPtr& statement : tree_.statements) learn(*statement);
    for (const StatementPtr& statement : tree_.statements) {
      ++statement_;
      visit(*statement);
      if (statement->kind == StatementKind::assign) know(static_cast<const AssignStatement&>(*statement));
      after_block_ = has_block(*statement);
    }
    return std::move(mutants_);
  }

 private:
  struct Variable {
    std::string type;
    bool later_changed = false;  ///< assigned more than once
  };

  static const CallNode* command_of(const NodePtr& value) {
    return value && value->kind == NodeKind::call ? static_cast<const CallNode*>(value.get()) : nullptr;
  }
  std::string callee_of(const CallNode& call) const {
    return call.callee->kind == NodeKind::name ? static_cast<const NameNode&>(*call.callee).id : "";
  }

  void learn(const Statement& statement) {
    if (statement.kind != StatementKind::assign) return;
    const auto& assign = static_cast<const AssignStatement&>(statement);
    if (assign.targets.front()->kind == NodeKind::name)
      ++assignments_[static_cast<const NameNode&>(*assign.targets.front()).id];
  }

  /// After its statement, a variable may stand for a concept of its type.
  void know(const AssignStatement& assign) {
    const CallNode* call = command_of(assign.value);
    if (call == nullptr || assign.targets.front()->kind != NodeKind::name || !catalogue_.has(callee_of(*call))) return;
    const auto& products = catalogue_.page(callee_of(*call)).products;
    if (products.size() == 1) known_[static_cast<const NameNode&>(*assign.targets.front()).id] = products.front().type;
  }

  void visit(const Statement& statement) {
    const CallNode* call = nullptr;
    if (statement.kind == StatementKind::assign)
      call = command_of(static_cast<const AssignStatement&>(statement).value);
    if (statement.kind == StatementKind::expression)
      call = command_of(static_cast<const ValueStatement&>(statement).value);
    if (call == nullptr || !catalogue_.has(callee_of(*call))) return;
    plant_in_statement(statement, *call);
    // A component is wrong with respect to a field: that of NOM_CHAM, or displacements.
    const std::string written_call = written(*call);
    component_is_judged_ =
        written_call.starts_with("AFFE_CHAR") || written_call.starts_with("DEFI_CONTACT") ||
        (written_call.find("RESU") != std::string::npos && written_call.find("NOM_CHAM=") != std::string::npos);
    // Near it among those of the field is a displacement's; of another field all are listed.
    component_hint_ = count(written_call, "NOM_CHAM=") == count(written_call, "NOM_CHAM=\"DEPL\"") ? "DX" : "";
    const CommandPage& page = catalogue_.page(callee_of(*call));
    visit_level(*call, {&page.inside}, line_of(call->begin));
  }

  void plant_in_statement(const Statement& statement, const CallNode& call) {
    const std::string name = callee_of(call);
    add("misspelt command", call.callee->begin, call.callee->end, misspell(name), "unknown-command",
        line_of(call.begin), name);
    add_unreadable("unbalanced bracket", call.end - 1, call.end, "", "unclosed-bracket", line_of(call.callee->end));
    const std::string_view stray = after_block_ ? "bad-indentation" : "unexpected-indent";
    if (statement.begin > 0)
      add_unreadable("stray indentation", statement.begin, statement.begin, "  ", std::string(stray),
                     line_of(statement.begin));
    for (std::size_t i = 1; i < call.arguments.size(); ++i) {
      const std::uint32_t comma = call.arguments[i - 1].value->end;
      const bool plain = text_[comma] == ',' && call.arguments[i].kind == CallNode::Kind::keyword;
      if (plain)
        add_unreadable("missing comma", comma, comma + 1, " ", "missing-comma", line_of(call.arguments[i].name_begin));
    }
    if (statement.kind == StatementKind::assign) plant_late_definition(static_cast<const AssignStatement&>(statement));
  }

  /// The statement moves to the end of the file: its concept is used before it exists.
  void plant_late_definition(const AssignStatement& assign) {
    if (assign.targets.front()->kind != NodeKind::name) return;
    const std::string name = static_cast<const NameNode&>(*assign.targets.front()).id;
    if (assignments_[name] != 1) return;
    const auto use = first_use(name, assign.end);
    if (!use) return;
    std::string moved = text_.substr(0, assign.begin);
    const std::string statement = text_.substr(assign.begin, assign.end - assign.begin);
    moved += std::string(static_cast<std::size_t>(std::ranges::count(statement, '\n')), '\n');
    moved += text_.substr(assign.end) + "\n" + statement + "\n";
    mutants_.push_back(
        {"concept used before it exists", moved, line_of(*use), "unknown-name", "", statement_, false, 0, 0, ""});
  }

  /// Where a whole word stands next outside comments and quotes; scenes are plain enough for that.
  std::optional<std::uint32_t> first_use(const std::string& name, std::size_t from) const {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text_.find(name, from); at != std::string::npos; at = text_.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      const std::size_t line = text_.rfind('\n', at) + 1;
      const std::string before = text_.substr(line, at - line);
      const bool quoted = std::ranges::count(before, '"') % 2 != 0 || std::ranges::count(before, '\'') % 2 != 0;
      const bool keyword = end < text_.size() && text_[end] == '=' && text_[end + 1] != '=';
      if (is_word(text_[at - 1]) || (end < text_.size() && is_word(text_[end])) || quoted || keyword) continue;
      if (before.find('#') != std::string::npos) continue;
      return static_cast<std::uint32_t>(at);
    }
    return std::nullopt;
  }

  void visit_level(const CallNode& call, const Levels& levels, int line) {
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      const Item& item = call.arguments[i];
      if (item.kind != CallNode::Kind::keyword) continue;
      std::vector<const KeywordPage*> pages;
      for (const LevelPage* level : levels) collect_pages(*level, item.name, pages);
      if (pages.empty()) continue;
      plant_at_keyword(call, i, *pages.front(), levels, line);
      if (pages.front()->is_factor()) {
        visit_factor(*item.value, *pages.front(), pages);
      } else if (pages.size() == 1) {
        plant_at_value(item, *pages.front());
      }
    }
  }

  void visit_factor(const Node& value, const KeywordPage& page, const std::vector<const KeywordPage*>& pages) {
    Levels inner;
    for (const KeywordPage* candidate : pages) {
      if (candidate->is_factor()) inner.push_back(&candidate->inside);
    }
    const auto occurrences = occurrences_of(value);
    for (const CallNode* occurrence : occurrences) visit_level(*occurrence, inner, line_of(occurrence->begin));
    if (page.max_count == 1 && occurrences.size() == 1) {
      const std::string once = written(value);
      add("too many occurrences", value.begin, value.end, "(" + once + ", " + once + ")", "too-many-occurrences",
          line_of(value.begin));
    }
  }

  static std::vector<const CallNode*> occurrences_of(const Node& value) {
    std::vector<const CallNode*> found;
    if (value.kind == NodeKind::call) found.push_back(static_cast<const CallNode*>(&value));
    if (value.kind == NodeKind::tuple || value.kind == NodeKind::list) {
      for (const NodePtr& item : static_cast<const SequenceNode&>(value).items) {
        if (item->kind == NodeKind::call) found.push_back(static_cast<const CallNode*>(item.get()));
      }
    }
    return found;
  }

  /// C01 is no misspelling of C10 where both are keywords.
  static bool is_keyword(const std::string& name, const Levels& levels) {
    std::vector<const KeywordPage*> pages;
    for (const LevelPage* level : levels) collect_pages(*level, name, pages);
    return !pages.empty();
  }

  void plant_at_keyword(const CallNode& call, std::size_t index, const KeywordPage& page, const Levels& levels,
                        int line) {
    const Item& item = call.arguments[index];
    const bool nameable = item.name.size() > 2;
    if (!is_keyword(misspell(item.name), levels))
      add("misspelt keyword", item.name_begin, item.name_end, misspell(item.name), "unknown-keyword",
          line_of(item.name_begin), nameable ? item.name : "");
    add("keyword given twice", item.value->end, item.value->end, ", " + item.name + "=" + written(*item.value),
        "repeated-keyword", line_of(item.value->end));
    const bool always = std::ranges::any_of(levels, [&](const LevelPage* level) {
      return std::ranges::any_of(level->keywords, [&](const KeywordPage& keyword) { return &keyword == &page; });
    });
    if (page.required && always && levels.size() == 1) {
      const bool last = index + 1 == call.arguments.size();
      const auto after = static_cast<std::uint32_t>(item.value->end);
      const auto end = !last ? call.arguments[index + 1].name_begin : text_[after] == ',' ? after + 1 : after;
      const bool spread_follows = !last && call.arguments[index + 1].kind != CallNode::Kind::keyword;
      if (!spread_follows) {
        const std::string gap = text_.substr(item.value->end, end - item.value->end);
        add("missing compulsory keyword", item.name_begin, end,
            std::string(static_cast<std::size_t>(std::ranges::count(gap, '\n')), '\n'), "missing-keyword", line);
      }
    }
    for (const LevelPage* level : levels) plant_excluded(call, item, *level);
  }

  /// Adds a keyword that a rule of the level excludes beside this one.
  void plant_excluded(const CallNode& call, const Item& item, const LevelPage& level) {
    for (const RulePage& rule : level.rules) {
      const bool excludes = rule.kind == RulePage::Kind::exactly_one || rule.kind == RulePage::Kind::at_most_one;
      if (!excludes || std::ranges::find(rule.keywords, item.name) == rule.keywords.end()) continue;
      for (const std::string& other : rule.keywords) {
        const bool given =
            std::ranges::any_of(call.arguments, [&](const Item& argument) { return argument.name == other; });
        const auto page = std::ranges::find(level.keywords, other, &KeywordPage::name);
        if (given || page == level.keywords.end() || page->is_factor()) continue;
        const std::string value = sample_value(*page);
        if (value.empty()) continue;
        add("two exclusive keywords", item.value->end, item.value->end, ", " + other + "=" + value,
            "exclusive-keywords", line_of(item.value->end));
        return;
      }
    }
  }

  void plant_at_value(const Item& item, const KeywordPage& page) {
    plant_wrong_type(item, page);
    plant_out_of_bounds(item, page);
    if (item.value->kind == NodeKind::name)
      plant_unknown_concept(static_cast<const NameNode&>(*item.value), page, item);
    each_text(*item.value, [&](const ConstantNode& node) { plant_misspelt_text(item, node, page); });
    if (page.max_count == 1 && item.value->kind == NodeKind::constant && page.types.front().kind != Kind::anything) {
      const std::string once = written(*item.value);
      add("too many values", item.value->begin, item.value->end, "(" + once + ", " + once + ")", "wrong-count",
          line_of(item.value->begin));
    }
  }

  void plant_wrong_type(const Item& item, const KeywordPage& page) {
    const Node& value = *item.value;
    if (all_of_kind(page, is_numeric))
      add("wrong type", value.begin, value.end, "'WORD'", "wrong-type", line_of(value.begin));
    if (all_of_kind(page, holds_text))
      add("wrong type", value.begin, value.end, "3.5", "wrong-type", line_of(value.begin));
    if (!all_of_kind(page, [](Kind kind) { return kind == Kind::concept_kind; })) return;
    add("wrong type", value.begin, value.end, "3.5", "wrong-type", line_of(value.begin));
    for (const auto& [name, type] : known_) {
      const bool fits = std::ranges::any_of(
          page.types, [&](const TypePage& wanted) { return catalogue_.is_a(type, wanted.concept_type); });
      if (fits) continue;
      add("wrong concept type", value.begin, value.end, name, "wrong-concept-type", line_of(value.begin));
      break;
    }
  }

  void plant_out_of_bounds(const Item& item, const KeywordPage& page) {
    if (!all_of_kind(page, is_numeric) || page.max_count != 1) return;
    const bool whole = page.types.front().kind == Kind::integer;
    std::optional<double> outside;
    if (page.bounds.above || page.bounds.at_least)
      outside = std::min(page.bounds.above.value_or(0.0), page.bounds.at_least.value_or(0.0)) - 7.0;
    if (page.bounds.below || page.bounds.at_most)
      outside = 2.0 * std::max(page.bounds.below.value_or(0.0), page.bounds.at_most.value_or(0.0)) + 7.0;
    constexpr double largest_integer = 9.0e18;
    if (!outside || !page.words.empty() || (whole && std::abs(*outside) > largest_integer)) return;
    const std::string value = whole ? fmt::format("{:.0f}", *outside) : fmt::format("{}", *outside);
    add("out of bounds", item.value->begin, item.value->end, value, "out-of-bounds", line_of(item.value->begin));
  }

  void plant_unknown_concept(const NameNode& name, const KeywordPage& page, const Item& item) {
    if (page.types.front().kind != Kind::concept_kind || !known_.contains(name.id)) return;
    const bool nameable = name.id.size() > 2;
    add("unknown concept", name.begin, name.end, misspell(name.id), "unknown-name", line_of(item.value->begin),
        nameable ? name.id : "");
  }

  void plant_misspelt_text(const Item& item, const ConstantNode& node, const KeywordPage& page) {
    const std::string word = node.value.as_text();
    const std::string wrong = "\"" + misspell(word) + "\"";
    const int line = line_of(item.value->begin);
    const std::string hint = word.size() > 3 ? word : "";
    if (text_[node.end - 1] == '"')
      add_unreadable("string left open", node.end - 1, node.end, "", "unterminated-string", line_of(node.begin));
    if (!page.words.empty()) return add("misspelt word", node.begin, node.end, wrong, "unknown-word", line, hint);
    if (page.types.size() != 1) return;
    switch (page.types.front().kind) {
      case Kind::node_group:
      case Kind::cell_group:
        return add("unknown group", node.begin, node.end, wrong, "unknown-group", line, hint);
      case Kind::field:
        return add("unknown field", node.begin, node.end, wrong, "unknown-field", line, hint);
      case Kind::component:
        if (!component_is_judged_) return;
        return add("unknown component", node.begin, node.end, "\"DW\"", "unknown-component", line, component_hint_);
      default:
        return;
    }
  }

  static void each_text(const Node& value, const std::function<void(const ConstantNode&)>& visit) {
    if (value.kind == NodeKind::constant && static_cast<const ConstantNode&>(value).value.is_text())
      visit(static_cast<const ConstantNode&>(value));
    if (value.kind != NodeKind::tuple && value.kind != NodeKind::list) return;
    for (const NodePtr& item : static_cast<const SequenceNode&>(value).items) each_text(*item, visit);
  }

  std::string written(const Node& node) const { return text_.substr(node.begin, node.end - node.begin); }
  int line_of(std::uint32_t offset) const { return source_->position(offset).line; }

  void add(std::string kind, std::uint32_t begin, std::uint32_t end, const std::string& replacement, std::string code,
           int line, std::string hint = "") {
    const std::string mutant = text_.substr(0, begin) + replacement + text_.substr(end);
    mutants_.push_back(
        {std::move(kind), mutant, line, std::move(code), std::move(hint), statement_, true, begin, end, replacement});
  }
  void add_unreadable(std::string kind, std::uint32_t begin, std::uint32_t end, const std::string& replacement,
                      std::string code, int line) {
    add(std::move(kind), begin, end, replacement, std::move(code), line);
    mutants_.back().readable = false;
  }

  const std::string& text_;
  const Catalogue& catalogue_;
  std::shared_ptr<const SourceFile> source_;
  Ast tree_;
  std::map<std::string, int> assignments_;
  std::map<std::string, std::string> known_;  ///< concepts defined so far, and their types
  std::vector<Mutant> mutants_;
  int statement_ = 0;
  bool after_block_ = false;
  bool component_is_judged_ = false;
  std::string component_hint_;
};

/// The sound text with two of its parts replaced.
std::string with_both(const std::string& text, const Mutant& a, const Mutant& b) {
  const auto& [first, second] = std::minmax(a, b, [](const Mutant& x, const Mutant& y) { return x.begin < y.begin; });
  return text.substr(0, first.begin) + first.replacement + text.substr(first.end, second.begin - first.end) +
         second.replacement + text.substr(second.end);
}

bool moves_lines(const std::string& text, const Mutant& mutant) {
  const auto replaced = text.substr(mutant.begin, mutant.end - mutant.begin);
  return std::ranges::count(replaced, '\n') != std::ranges::count(mutant.replacement, '\n');
}

bool hangs_on_names(const Mutant& mutant) {
  return mutant.kind != "misspelt command" && mutant.kind != "misspelt keyword" &&
         mutant.kind != "missing compulsory keyword";
}

}  // namespace

std::vector<Mutant> plant_errors(const std::string& text, const Catalogue& catalogue) {
  return Planter(text, catalogue).run();
}

std::vector<Pair> plant_pairs(const std::string& text, const Catalogue& catalogue) {
  const std::vector<Mutant> mutants = plant_errors(text, catalogue);
  std::vector<Pair> pairs;
  std::size_t turn = 0;
  for (const Mutant& broken : mutants) {
    const bool replaces = broken.begin != broken.end || !broken.replacement.empty();
    if (broken.readable || !replaces) continue;
    // Each syntax error with another partner: all of them with all would be millions.
    for (std::size_t tried = 0; tried < mutants.size(); ++tried) {
      const Mutant& other = mutants[turn++ % mutants.size()];
      const bool behind = other.statement > broken.statement;
      if (!other.readable || other.statement == broken.statement || (behind && hangs_on_names(other))) continue;
      if (moves_lines(text, broken) || moves_lines(text, other)) continue;
      // An open bracket may hide what follows it.
      if (behind && broken.code == "unclosed-bracket") continue;
      pairs.push_back({broken, other, with_both(text, broken, other)});
      break;
    }
  }
  return pairs;
}

}  // namespace comma::commands::tests
