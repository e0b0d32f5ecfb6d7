#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "commands/tables/text_table.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::vector<NumberBlock> read_blocks(const Call& call, Context& context) {
  std::ifstream file = open_input(call, context, {"fonction", "dat", "txt"});
  const std::string& separator = call.text("SEPAR");
  return read_number_blocks(file, separator == "None" ? "" : separator);
}

// A keyword names a block and a column of it, counted from 1.
std::vector<double> column_of(const Keywords& keywords, const char* keyword, const std::vector<NumberBlock>& blocks) {
  const auto index = keywords.integers(keyword);
  const auto block = static_cast<std::size_t>(index[0]), column = static_cast<std::size_t>(index[1]);
  if (block < 1 || block > blocks.size())
    throw DiagnosticError("out-of-bounds",
                          fmt::format("LIRE_FONCTION: the file has {} blocks of numbers, and block {} is asked for",
                                      blocks.size(), block),
                          keywords.span_of(keyword), "look at SEPAR, and at what stands between the numbers");
  std::vector<double> values;
  for (const auto& row : blocks[block - 1]) {
    if (column < 1 || column > row.size())
      throw DiagnosticError("out-of-bounds",
                            fmt::format("LIRE_FONCTION: a line of block {} has {} columns, and column {} is asked for",
                                        block, row.size(), column),
                            keywords.span_of(keyword));
    values.push_back(row[column - 1]);
  }
  return values;
}

void require_same_count(const Keywords& keywords, std::size_t abscissas, std::size_t values) {
  if (abscissas == values) return;
  throw DiagnosticError("wrong-count",
                        fmt::format("LIRE_FONCTION: {} abscissas stand against {} values", abscissas, values),
                        keywords.span);
}

// Abscissas rise; VERIF='NON' lets comma sort them.
void order_points(const Call& call, solver::TabulatedFunction& function, const char* keyword) {
  if (call.text("VERIF") == "NON")
    function.sort_points();
  else
    check_rising(call, keyword, function.x);
}

solver::TabulatedFunction read_curve(const Call& call, const std::vector<NumberBlock>& blocks) {
  solver::TabulatedFunction function;
  function.parameter = call.text("NOM_PARA");
  function.result = call.text("NOM_RESU");
  if (call.result) function.name = call.result->name;
  function.x = column_of(call, "INDIC_PARA", blocks);
  function.y = column_of(call, "INDIC_RESU", blocks);
  require_same_count(call, function.x.size(), function.y.size());
  order_points(call, function, "INDIC_PARA");
  read_shape(call, function);
  return function;
}

// One function a DEFI_FONCTION, for each value in the column INDIC_PARA.
Product read_surface(const Call& call, const std::vector<NumberBlock>& blocks) {
  solver::TabulatedFunction edges;
  edges.parameter = call.text("NOM_PARA");
  edges.result = call.text("NOM_RESU");
  edges.x = column_of(call, "INDIC_PARA", blocks);
  check_rising(call, "INDIC_PARA", edges.x);
  read_shape(call, edges);
  std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows;
  for (const Keywords& occurrence : call.factors("DEFI_FONCTION")) {
    solver::TabulatedFunction row;
    row.parameter = call.text("NOM_PARA_FONC");
    row.x = column_of(call, "INDIC_ABSCISSE", blocks);
    row.y = column_of(occurrence, "INDIC_RESU", blocks);
    require_same_count(occurrence, row.x.size(), row.y.size());
    order_points(call, row, "INDIC_ABSCISSE");
    read_shape(occurrence, row);
    rows.push_back(std::make_shared<const solver::TabulatedFunction>(std::move(row)));
  }
  if (rows.size() != edges.x.size())
    throw DiagnosticError("wrong-count",
                          fmt::format("LIRE_FONCTION: {} functions stand against {} values of {}", rows.size(),
                                      edges.x.size(), edges.parameter),
                          call.span_of("DEFI_FONCTION"));
  return std::make_shared<SurfaceConcept>(std::move(edges), std::move(rows));
}

}  // namespace

Product lire_fonction(const Call& call, Context& context) {
  const auto blocks = read_blocks(call, context);
  if (call.text("TYPE") == "NAPPE") return read_surface(call, blocks);
  return std::make_shared<TabulatedConcept>(read_curve(call, blocks));
}

}  // namespace comma::commands
