#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "commands/commands.hpp"
#include "commands/functions/curves.hpp"
#include "commands/tables/row_keys.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::vector<Cell> key_of(const std::vector<Cell>& row, const std::vector<int>& columns) {
  std::vector<Cell> key;
  for (const int column : columns) key.push_back(row[static_cast<std::size_t>(column)]);
  return key;
}

void add_to_title(Table& table, const std::string& line) { table.title += (table.title.empty() ? "" : "\n") + line; }

// One table for each combination of values in the columns of PAGINATION, by rising values, which its title says; these
// columns are left out.
std::vector<Table> pages_of(const Table& table, const Call& call) {
  if (!call.has("PAGINATION")) return {table};
  std::vector<int> columns;
  for (const std::string& name : call.texts("PAGINATION"))
    columns.push_back(column_of(table, name, call, "PAGINATION"));
  std::vector<Table> pages;
  std::vector<std::vector<Cell>> keys;
  FirstComers known;
  for (const auto& row : table.rows) {
    const auto key = key_of(row, columns);
    const std::size_t page = known.number_of(key);
    if (page == pages.size()) {
      keys.push_back(key);
      pages.push_back({table.title, table.columns, {}});
      for (std::size_t i = 0; i < columns.size(); ++i)
        add_to_title(pages.back(), call.texts("PAGINATION")[i] + ": " + shown_cell(key[i]));
    }
    pages[page].rows.push_back(row);
  }
  std::vector<std::size_t> order(pages.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::ranges::lexicographical_compare(keys[a], keys[b], stands_before);
  });
  std::vector<Table> sorted;
  for (const std::size_t page : order) sorted.push_back(without_columns(pages[page], columns));
  return sorted;
}

// FILTRE as the title of what is left tells of it.
std::string filter_line(const Keywords& filter) {
  std::vector<std::string> values;
  for (const char* keyword : {"VALE", "VALE_I", "VALE_K"}) {
    if (!filter.given(keyword)) continue;
    const interpreter::Value& value = filter.at(keyword).value;
    if (!value.is_sequence())
      values.push_back(value.repr());
    else
      for (const interpreter::Value& item : value.items()) values.push_back(item.repr());
  }
  return fmt::format("FILTRE -> NOM_PARA: {:<16} CRIT_COMP: {:<4} VALE: {}", filter.texts("NOM_PARA").front(),
                     filter.text("CRIT_COMP"), values.empty() ? "" : fmt::format("[{}]", fmt::join(values, ", ")));
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

// Those of NOM_PARA; what PAGINATION has put into the title is no column any more.
std::vector<int> columns_besides_pages(const Table& page, const Call& call) {
  const auto turned = call.texts("PAGINATION");
  std::vector<int> columns;
  for (const std::string& name : call.texts("NOM_PARA"))
    if (std::ranges::find(turned, name) == turned.end()) columns.push_back(column_of(page, name, call));
  return columns;
}

bool is_of_fixed_columns(const Call& call) {
  return call.text("FORMAT") == "XMGRACE" || call.text("FORMAT") == "TABLEAU_CROISE";
}

TableLayout layout_of(const Call& call) {
  TableLayout layout{call.text("SEPARATEUR"), call.text("FORMAT_R"),    call.text("COMMENTAIRE"),
                     call.text("COMM_PARA"),  call.text("DEBUT_LIGNE"), call.text("FIN_LIGNE")};
  if (call.text("FORMAT") == "AGRAF") layout.empty = "\\-";
  if (call.text("FORMAT") == "AGRAF" && layout.names_comment.empty()) layout.names_comment = layout.comment;
  return layout;
}

// Scripts that read Code_Aster's tables look for the last line of the title that a table has by itself: the names of
// the columns follow.
std::string own_title(const Call& call) {
  return fmt::format("{} (comma)\nTABLE_SDASTER", call.concept_of("TABLE")->name);
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
      call.span, "name the columns of the columns, of the rows and of the values in NOM_PARA");
}

}  // namespace

Product impr_table(const Call& call, Context& context) {
  constexpr int result_unit = 8;
  Table table = call.data<TableConcept>("TABLE").table;
  const TableLayout layout = layout_of(call);
  if (call.has("TITRE")) table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n"));
  if (table.title.empty() && call.text("FORMAT") == "TABLEAU") table.title = own_title(call);
  for (const Keywords& filter : call.factors("FILTRE")) {
    table = filtered(table, filter);
    if (call.text("FORMAT") != "XMGRACE") add_to_title(table, filter_line(filter));
  }
  if (call.has("TRI")) sort_rows(table, call.factor("TRI"));
  std::string text;
  for (Table& page : pages_of(table, call)) {
    if (call.has("NOM_PARA")) page = with_columns(page, columns_besides_pages(page, call));
    if (!is_of_fixed_columns(call)) drop_empty(page);
    text += page_text(page, call, layout);
  }
  context.write(static_cast<int>(call.integer("UNITE")), "resu", result_unit, text);
  return nullptr;
}

}  // namespace comma::commands
