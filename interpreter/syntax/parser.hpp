// From tokens to the tree, by recursive descent. A broken statement is reported once and stepped over; the rest of the
// file is still read, so that all syntax errors come at once.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/syntax/ast.hpp"
#include "interpreter/syntax/lexer.hpp"
#include "interpreter/syntax/scope.hpp"

namespace comma::interpreter {

/// Reads a whole file. Errors go to `diagnostics`; the tree then holds the sound statements, and a BrokenStatement in
/// the place of each other one.
Ast parse(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics);

/// Reads a text that is one expression, line breaks counting as blanks; null when it is none. `names` gets its free
/// names in the order of use, repeated ones repeated.
NodePtr parse_expression(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics,
                         std::vector<std::string>* names = nullptr);

/// Brackets and operators within each other (a bracket with an expression in it counts twice), and blocks: as deep as
/// Python.
inline constexpr int deepest_nesting = 400;
inline constexpr int deepest_block = 100;
/// The height of an expression's tree (a + b + c + ... is as high as it is long), which bounds the evaluator's stack.
inline constexpr int highest_tree = 2000;
/// After so many errors, the file is something else than a command file.
inline constexpr int most_errors = 100;

class Parser {
 public:
  /// `inside_brackets`: line breaks and indentation mean nothing, as in brackets.
  Parser(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics, bool inside_brackets = false);

  Block parse_file();
  NodePtr parse_only_expression();
  std::vector<std::string> free_names() const { return scopes_->free_names(); }

 private:
  struct Failure {
    Diagnostic finding;
    std::uint32_t token_begin = 0;  ///< the token at which it was noticed
  };
  struct Nesting;
  struct Signature {
    std::vector<Parameter> parameters;
    std::vector<NodePtr> defaults;
  };

  /// A field of an f-string: the same file and scopes, a part of the text.
  Parser(Parser& around, std::uint32_t begin, std::uint32_t end);

  // Tokens and errors (parser.cpp).
  void advance();
  const Token& ahead();
  bool at(std::string_view symbol_or_keyword) const;
  bool accept(std::string_view symbol_or_keyword);
  void expect_closing(std::string_view bracket);
  void expect_colon(std::string_view after);
  bool separate_items(std::string_view closing);
  Token lex();
  Span span_of(const Token& token) const;
  Span span_of(const Node& node) const { return {file_, node.begin, node.end}; }
  [[noreturn]] void fail(std::string code, std::string message, Span span, std::string hint = {});
  [[noreturn]] void fail_here(std::string expected);
  void report(std::string code, std::string message, Span span, std::string hint = {});
  void report_mended(std::string code, std::string message, Span span, std::string hint = {});
  bool starts_line_outside(const Token& token) const;
  bool starts_statement(const Token& token) const;
  void recover(Failure failure, const Token& start);
  void skip_orphan_blocks();

  // Statements (parser_statements.cpp).
  void leave_out(const Token& start, Block& block, std::size_t sound, ScopeStack::Checkpoint checkpoint);
  void leave_out_rest(Block& block) const;
  void parse_line(Block& block);
  void parse_statements(Block& block);
  StatementPtr parse_compound();
  StatementPtr parse_simple();
  void parse_simple_line(Block& block);
  void parse_unexpected_block(Block& block);
  Block parse_block(std::string_view after, std::uint32_t header_begin);
  StatementPtr parse_expression_statement();
  StatementPtr parse_assignment(NodePtr first);
  StatementPtr parse_annotated(NodePtr target);
  StatementPtr parse_if();
  template <class Loop>
  void parse_loop_blocks(Loop& statement, std::string_view word);
  StatementPtr parse_while();
  StatementPtr parse_for();
  StatementPtr parse_function();
  StatementPtr parse_try();
  StatementPtr parse_with();
  TryStatement::Handler parse_handler();
  void report_misplaced(std::string message, std::string hint);
  StatementPtr parse_return();
  StatementPtr parse_raise();
  StatementPtr parse_assert();
  StatementPtr parse_del();
  StatementPtr parse_loop_exit();
  StatementPtr parse_scope_declaration();
  StatementPtr parse_import();
  StatementPtr parse_import_from();
  std::string parse_dotted_name();
  void refuse_unsupported();

  // Expressions (parser_expressions.cpp).
  NodePtr parse_expression_list();
  NodePtr parse_item();
  NodePtr parse_expression();
  NodePtr parse_or();
  NodePtr parse_and();
  NodePtr parse_not();
  NodePtr parse_comparison();
  NodePtr parse_binary(int lowest);
  NodePtr parse_factor();
  NodePtr parse_postfix();
  NodePtr parse_call(NodePtr callee);
  void parse_argument(CallNode& call);
  bool is_number_without_point(const Node& node) const;
  NodePtr parse_subscript(NodePtr object);
  NodePtr parse_subscript_item();
  NodePtr parse_lambda();
  std::optional<Operator> comparison_operator();

  // Atoms and displays (parser_atoms.cpp).
  NodePtr parse_atom();
  NodePtr parse_name();
  NodePtr parse_parenthesised();
  NodePtr parse_list_display();
  NodePtr parse_brace_display();
  NodePtr parse_dict_rest(NodePtr started, std::uint32_t begin);
  NodePtr parse_comprehension(ComprehensionNode::Kind kind, NodePtr element, NodePtr value, std::size_t uses_mark,
                              std::uint32_t begin);
  NodePtr parse_target_list(std::string_view until);
  NodePtr parse_texts();
  void parse_formatted(FormattedNode& node, std::uint32_t begin, std::uint32_t end, bool raw, int level);
  std::uint32_t parse_field(FormattedNode& node, std::uint32_t begin, std::uint32_t end, bool raw, int level);

  // Functions and targets (parser_functions.cpp).
  Signature parse_parameters(std::string_view closing, bool annotations);
  void parse_parameter(Signature& signature, Parameter::Kind kind, bool annotations);
  void check_parameters(const Signature& signature);
  void bind_target(Node& target);
  void bind_targets(std::vector<NodePtr>& targets, const Node& whole);
  void skip_annotation();
  /// Takes from the scope that ends here what the function keeps of it.
  void close_scope(FunctionCode& code);

  void deepen(Node& node, const Node* child);

  std::shared_ptr<const SourceFile> file_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  std::shared_ptr<ScopeStack> scopes_;
  Token now_;
  std::optional<Token> ahead_;
  std::uint32_t previous_end_ = 0;
  std::vector<Token> open_brackets_;
  int nesting_ = 0;
  int blocks_ = 0;
  int loops_ = 0;
  bool orphan_ = false;  ///< inside the block of a broken header: what it needs around it may be missing
  bool flawed_ = false;  ///< something was reported about the statement: it cannot be trusted
  bool broken_ = false;  ///< the statement has a token that the lexer has reported: what follows from it is no news
  int errors_ = 0;
};

/// Counts one level of nesting for as long as it lives.
struct Parser::Nesting {
  explicit Nesting(Parser& owner) : parser(owner) {
    if (++parser.nesting_ <= deepest_nesting) return;
    --parser.nesting_;
    parser.fail("too-deep", "this expression is nested too deeply", parser.span_of(parser.now_),
                "build it in several statements");
  }
  ~Nesting() { --parser.nesting_; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  Parser& parser;
};

}  // namespace comma::interpreter
