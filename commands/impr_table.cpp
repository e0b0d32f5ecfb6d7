#include <fmt/format.h>

#include <algorithm>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

// The columns that NOM_PARA asks for, in its order.
Table restricted(const Table& table, const std::vector<std::string>& names, const Call& call) {
  Table part;
  part.title = table.title;
  part.rows.resize(table.rows.size());
  for (const std::string& name : names) {
    const int column = table.column(name);
    if (column < 0) {
      const std::string near = interpreter::nearest(name, table.columns);
      throw interpreter::DiagnosticError("unknown-column", "IMPR_TABLE: the table has no column " + name, call.span_of("NOM_PARA"),
                                         near.empty() ? "" : "did you mean " + near + "?");
    }
    part.columns.push_back(name);
    for (std::size_t i = 0; i < table.rows.size(); ++i) part.rows[i].push_back(table.rows[i][column]);
  }
  return part;
}

}  // namespace

Product impr_table(const Call& call, Context& context) {
  constexpr int result_unit = 8;
  Table table = call.data<TableConcept>("TABLE").table;
  if (call.has("NOM_PARA")) table = restricted(table, call.texts("NOM_PARA"), call);
  const std::string comment = call.text("COMMENTAIRE");
  if (call.has("TITRE")) table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n" + comment + " "));
  const std::string format = call.has("FORMAT_R") ? call.text("FORMAT_R") : "E12.5";
  const std::string separator = call.has("SEPARATEUR") ? call.text("SEPARATEUR") : " ";
  const auto path = context.files.output(static_cast<int>(call.integer("UNITE")), "resu", result_unit);
  context.write(path, format_table(table, separator, format, comment) + "\n");
  return nullptr;
}

}  // namespace comma::commands
