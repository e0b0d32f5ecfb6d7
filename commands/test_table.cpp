#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/tables/reductions.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

TestedValue reduced(const Call& call, const Table& table, int column) {
  const std::string& type = call.text("TYPE_TEST");
  if (call.given("VALE_CALC_K"))
    throw DiagnosticError("wrong-type", "TEST_TABLE: TYPE_TEST makes a number of the column",
                          call.span_of("VALE_CALC_K"), "leave out TYPE_TEST to compare a text");
  const auto numbers = numbers_in(table, column, call);
  if (numbers.empty())
    throw DiagnosticError("wrong-count", "TEST_TABLE: no row is left to reduce", call.span, "loosen FILTRE");
  if (type == "MAX") return greatest(numbers);
  if (type == "MIN") return least(numbers);
  return type == "SOMM" ? sum_of(numbers) : sum_of_sizes(numbers);
}

// A row that has nothing in the column takes no part, unless it is the only one.
TestedValue only_cell(const Call& call, const Table& all, int column) {
  Table table = all;
  if (all.rows.size() > 1) {
    std::erase_if(table.rows, [&](const auto& row) {
      return std::holds_alternative<std::monostate>(row[static_cast<std::size_t>(column)]);
    });
  }
  if (table.rows.size() != 1) {
    throw DiagnosticError("wrong-count",
                          fmt::format("TEST_TABLE: {} rows are left; a value is tested in one", table.rows.size()),
                          call.span_of("FILTRE"), "make FILTRE stricter or looser, or give TYPE_TEST");
  }
  const Cell& cell = table.rows.front()[static_cast<std::size_t>(column)];
  const auto* text = std::get_if<std::string>(&cell);
  const bool compares_text = call.given("VALE_CALC_K");
  if (text != nullptr && compares_text) return *text;
  if (text != nullptr) {
    throw DiagnosticError("wrong-type", fmt::format("TEST_TABLE: the cell holds the text '{}'", *text),
                          call.span_of("NOM_PARA"), "compare it by VALE_CALC_K");
  }
  if (compares_text && !std::holds_alternative<std::monostate>(cell)) {
    throw DiagnosticError("wrong-type", "TEST_TABLE: the cell holds a number", call.span_of("VALE_CALC_K"),
                          "compare it by VALE_CALC or VALE_CALC_I");
  }
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return *integer;
  throw DiagnosticError("wrong-type", "TEST_TABLE: the cell is empty", call.span_of("NOM_PARA"));
}

std::string label_of(const Call& call) {
  std::string label = call.concept_of("TABLE")->name + " " + call.text("NOM_PARA");
  if (call.has("LEGENDE")) return call.text("LEGENDE");
  if (call.given("TYPE_TEST")) label += " " + call.text("TYPE_TEST");
  for (const Keywords& filter : call.factors("FILTRE")) {
    label += fmt::format(", {} {}", filter.text("NOM_PARA"), filter.text("CRIT_COMP"));
    for (const char* keyword : {"VALE", "VALE_I", "VALE_K"}) {
      if (!filter.given(keyword)) continue;
      for (const auto& value : filter.at(keyword).value.items()) label += " " + value.repr();
    }
  }
  return label;
}

}  // namespace

Product test_table(const Call& call, Context& context) {
  Table table = call.data<TableConcept>("TABLE").table;
  for (const Keywords& filter : call.factors("FILTRE")) table = filtered(table, filter);
  const int column = column_of(table, call.text("NOM_PARA"), call);
  const TestedValue value = call.given("TYPE_TEST") ? reduced(call, table, column) : only_cell(call, table, column);
  for (Verdict& verdict : judge(call, "TEST_TABLE", label_of(call), value)) context.report(std::move(verdict));
  return nullptr;
}

}  // namespace comma::commands
