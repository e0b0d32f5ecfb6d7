#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "commands/commands.hpp"
#include "commands/functions/curves.hpp"
#include "commands/tables/row_keys.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// One table for each combination of values in the columns of PAGINATION, in the order in which they first come.
std::vector<Table> pages_of(const Table& table, const Call& call) {
  if (!call.has("PAGINATION")) return {table};
  std::vector<int> columns;
  for (const std::string& name : call.texts("PAGINATION"))
    columns.push_back(column_of(table, name, call, "PAGINATION"));
  std::vector<Table> pages;
  FirstComers known;
  for (const auto& row : table.rows) {
    std::vector<Cell> key;
    for (const int column : columns) key.push_back(row[static_cast<std::size_t>(column)]);
    const std::size_t page = known.number_of(key);
    if (page == pages.size()) pages.push_back({table.title, table.columns, {}});
    pages[page].rows.push_back(row);
  }
  return pages;
}

// FORMAT="XMGRACE": the first column against the second.
std::string as_curve(const Table& table, const Call& call) {
  if (table.columns.size() != 2) {
    throw DiagnosticError(
        "wrong-count", fmt::format("IMPR_TABLE: a curve needs two columns, and the table has {}", table.columns.size()),
        call.span, "name the columns of the abscissae and of the ordinates in NOM_PARA");
  }
  Curve curve;
  curve.label = table.columns[1];
  curve.x = numbers_in(table, 0, call);
  curve.y = numbers_in(table, 1, call);
  if (curve.x.size() != curve.y.size()) {
    throw DiagnosticError("empty-cell", "IMPR_TABLE: a curve is made from a table with empty cells", call.span,
                          "leave their rows out by FILTRE=_F(NOM_PARA=..., CRIT_COMP='NON_VIDE')");
  }
  Drawing drawing;
  drawing.title = table.title;
  drawing.x.label = table.columns[0];
  drawing.curves.push_back(std::move(curve));
  return grace_file(drawing);
}

TableLayout layout_of(const Call& call) {
  TableLayout layout{call.text("SEPARATEUR"), call.text("FORMAT_R"),    call.text("COMMENTAIRE"),
                     call.text("COMM_PARA"),  call.text("DEBUT_LIGNE"), call.text("FIN_LIGNE")};
  if (call.text("FORMAT") == "AGRAF" && layout.names_comment.empty()) layout.names_comment = layout.comment;
  return layout;
}

// Scripts that read Code_Aster's tables look for the last line of the title that a table has by itself: the names of
// the columns follow.
std::string own_title(const Call& call, const TableLayout& layout) {
  return fmt::format("{} (comma)\n{}TABLE_SDASTER", call.concept_of("TABLE")->name, layout.comment);
}

std::string page_text(const Table& page, const Call& call, const TableLayout& layout) {
  const std::string& format = call.text("FORMAT");
  if (format == "XMGRACE") return as_curve(page, call);
  if (format == "ASTER") return aster_table(page, layout) + "\n";
  if (format != "TABLEAU_CROISE") return format_table(page, layout) + "\n";
  if (page.columns.size() == 3) return format_table(crossed(page), layout) + "\n";
  throw DiagnosticError(
      "wrong-count",
      fmt::format("IMPR_TABLE: a crossed table is made of three columns, and the table has {}", page.columns.size()),
      call.span, "name the columns of the rows, of the columns and of the values in NOM_PARA");
}

}  // namespace

Product impr_table(const Call& call, Context& context) {
  constexpr int result_unit = 8;
  Table table = call.data<TableConcept>("TABLE").table;
  for (const Keywords& filter : call.factors("FILTRE")) table = filtered(table, filter);
  if (call.has("TRI")) sort_rows(table, call.factor("TRI"));
  const TableLayout layout = layout_of(call);
  if (call.has("TITRE")) table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n" + layout.comment + " "));
  if (table.title.empty() && call.text("FORMAT") == "TABLEAU") table.title = own_title(call, layout);
  std::string text;
  for (Table& page : pages_of(table, call)) {
    if (call.has("NOM_PARA")) page = with_columns(page, columns_of(page, call));
    text += page_text(page, call, layout);
  }
  context.write(static_cast<int>(call.integer("UNITE")), "resu", result_unit, text);
  return nullptr;
}

}  // namespace comma::commands
