// import, from ... import, global, nonlocal: the statements that say where names come from.
#include <fmt/format.h>

#include "interpreter/syntax/parser.hpp"

namespace comma::interpreter {

std::string Parser::parse_dotted_name() {
  if (now_.kind != TokenKind::name) fail_here("the name of a module");
  std::string path(now_.text);
  advance();
  while (accept(".")) {
    if (now_.kind != TokenKind::name) fail_here("a name");
    path += "." + std::string(now_.text);
    advance();
  }
  return path;
}

StatementPtr Parser::parse_import() {
  auto statement = std::make_unique<ImportStatement>(StatementKind::import, now_.begin, now_.end);
  advance();
  do {
    ImportStatement::Item item;
    item.begin = now_.begin;
    item.path = parse_dotted_name();
    item.end = previous_end_;
    if (accept("as")) {
      if (now_.kind != TokenKind::name) fail_here("a name");
      item.renamed = true;
      item.name = parse_name();
    } else {
      // import a.b binds a
      const std::string first = item.path.substr(0, item.path.find('.'));
      auto name = std::make_unique<NameNode>(first, item.begin, item.end);
      scopes_->use(name.get());
      item.name = std::move(name);
    }
    bind_target(*item.name);
    statement->items.push_back(std::move(item));
  } while (accept(","));
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_import_from() {
  auto statement = std::make_unique<ImportStatement>(StatementKind::import_from, now_.begin, now_.end);
  advance();
  statement->module_begin = now_.begin;
  if (at(".") || at("...")) {
    fail("unknown-module", "relative imports are not part of the command language", span_of(now_),
         "name the module in full");
  }
  statement->module = parse_dotted_name();
  statement->module_end = previous_end_;
  if (!accept("import")) fail_here("'import'");
  if (at("*")) {
    if (scopes_->in_function())
      fail("syntax", "'import *' stands inside a function", span_of(now_), "move it to the top of the file");
    statement->items.emplace_back().begin = now_.begin;
    statement->items.back().end = now_.end;
    advance();
    statement->end = previous_end_;
    return statement;
  }
  const bool bracketed = accept("(");
  do {
    if (bracketed && at(")")) break;
    if (now_.kind != TokenKind::name) fail_here("a name");
    ImportStatement::Item item;
    item.begin = now_.begin;
    item.end = now_.end;
    item.path = std::string(now_.text);
    if (ahead().kind == TokenKind::keyword && ahead().text == "as") {
      advance();
      advance();
      if (now_.kind != TokenKind::name) fail_here("a name");
      item.renamed = true;
    }
    item.name = parse_name();
    bind_target(*item.name);
    statement->items.push_back(std::move(item));
  } while (accept(","));
  if (bracketed) expect_closing(")");
  statement->end = previous_end_;
  return statement;
}

StatementPtr Parser::parse_scope_declaration() {
  const bool global = at("global");
  if (!global && !scopes_->in_function() && !orphan_) {
    report("misplaced-statement", "'nonlocal' stands outside a function", span_of(now_), "remove it");
  }
  advance();
  do {
    if (now_.kind != TokenKind::name) fail_here("a name");
    const std::string name(now_.text);
    const bool declared = global ? scopes_->declare_global(name) : scopes_->declare_outer({name, now_.begin, now_.end});
    if (!declared && scopes_->in_function()) {
      report("syntax", fmt::format("{} is already a local variable here", name), span_of(now_),
             fmt::format("put '{}' before its first use", global ? "global" : "nonlocal"));
    }
    advance();
  } while (accept(","));
  return nullptr;
}

}  // namespace comma::interpreter
