#include "commands/tables/table.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "commands/concepts.hpp"
#include "commands/tables/fortran_format.hpp"
#include "commands/tables/reductions.hpp"
#include "commands/tables/row_keys.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

using namespace comma::commands;
using comma::interpreter::DiagnosticError;

TEST_CASE("A table is printed in aligned columns, an empty cell as a dash") {
  Table table;
  table.title = "forces";
  table.columns = {"NOEUD", "DX"};
  table.rows = {{std::string("N1"), 1.5}, {std::string("N12"), Cell()}};
  const std::string head = "#\n#" + std::string(80, '-') + "\n";
  CHECK(format_table(table) ==
        head + "##forces\nNOEUD    DX          \nN1        1.50000E+00\nN12      -           \n");
  table.columns[0] = "NAME_OF_NODE";
  CHECK(format_table(table, {.separator = ",", .real_format = "F8.2", .names_comment = "%"}) ==
        head + "##forces\n%NAME_OF_NODE,DX\n    N1      ,        1.50\n    N12     ,    -       \n");
}

TEST_CASE("A table in Code_Aster's own format says what its columns hold") {
  Table table;
  table.title = "forces";
  table.columns = {"NOEUD", "STEP", "DX"};
  table.rows = {{std::string("N1"), std::int64_t{3}, 1.5}};
  CHECK(aster_table(table) ==
        "#\n#" + std::string(80, '-') + "\n##DEBUT_TABLE\n#TITRE forces\n NOEUD    STEP         DX          \n" +
            " K8       I            R           \n N1                  3  1.50000E+00\n#FIN_TABLE\n");
}

TEST_CASE("A crossed table has a row and a column for each value of two columns") {
  Table table;
  table.columns = {"INST", "NOEUD", "DX"};
  table.rows = {{2.0, std::string("B"), 30.0}, {1.0, std::string("B"), 20.0}, {1.0, std::string("A"), 10.0}};
  const Table both = crossed(table);
  CHECK(both.title == "DX FONCTION DE NOEUD ET INST");
  CHECK(both.columns == std::vector<std::string>{"NOEUD/INST", "1.0", "2.0"});
  REQUIRE(both.rows.size() == 2);
  CHECK(both.rows[0] == std::vector<Cell>{std::string("A"), 10.0, Cell()});
  CHECK(both.rows[1] == std::vector<Cell>{std::string("B"), 20.0, 30.0});
}

TEST_CASE("A number that is none stands in a row of its own of a crossed table") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Table table;
  table.columns = {"NOEUD", "INST", "DX"};
  table.rows = {{std::string("A"), none, 10.0}, {std::string("A"), 0.0, 20.0}, {std::string("B"), -0.0, 30.0}};
  const Table both = crossed(table);
  REQUIRE(both.rows.size() == 2);
  CHECK(std::ranges::count(both.rows, std::vector<Cell>{0.0, 20.0, 30.0}) == 1);
}

TEST_CASE("Rows and columns that are wholly empty go") {
  Table table;
  table.columns = {"A", "B"};
  table.rows = {{1.0, Cell()}, {Cell(), Cell()}, {2.0, Cell()}};
  drop_empty(table);
  CHECK(table.columns == std::vector<std::string>{"A"});
  CHECK(table.rows == std::vector<std::vector<Cell>>{{1.0}, {2.0}});
}

TEST_CASE("A column added later is empty in the rows before") {
  Table table;
  table.columns = {"A"};
  table.rows = {{1.0}};
  CHECK(table.add_column("B") == 1);
  CHECK(std::holds_alternative<std::monostate>(table.rows[0][1]));
  CHECK(table.add_column("A") == 0);
}

TEST_CASE("Fortran's edit descriptors") {
  CHECK(format_real(-1234.5678, "E12.5") == "-1.23457E+03");
  CHECK(format_real(1234.5678, "1PE13.6") == " 1.234568E+03");
  CHECK(format_real(3.14159, "F8.3") == "   3.142");
  CHECK_THROWS_AS(format_real(1.0, "Q5"), DiagnosticError);
  CHECK(format_real(2.5, " es9.2E3 ") == " 2.50E+00");
  for (const char* wrong : {"E12", "E12.", "E.5", "2PE12.5", "E-12.5", "E12.5 x", "", "P", "E12.5E"})
    CHECK_THROWS_AS(RealFormat(wrong), DiagnosticError);
}

TEST_CASE("A format is as wide as a line at most") {
  CHECK(format_real(1.0, "F200.1").size() == 200);
  CHECK_THROWS_AS(RealFormat("E99999999999.5"), DiagnosticError);
  CHECK_THROWS_AS(RealFormat("E201.5"), DiagnosticError);
  CHECK_THROWS_AS(RealFormat("E" + std::string(300000, '1') + ".5"), DiagnosticError);
}

TEST_CASE("A reduction passes over no number that is none") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  using Reduction = double (*)(std::span<const double>);
  for (const Reduction reduction : {Reduction{least}, Reduction{greatest}, Reduction{sum_of}, Reduction{sum_of_sizes},
                                    Reduction{mean_of}, Reduction{least_size}, Reduction{greatest_size}}) {
    for (const auto& numbers : {std::vector{none, 1.0, 2.0}, std::vector{1.0, none, 2.0}, std::vector{1.0, 2.0, none}})
      CHECK(std::isnan(reduction(numbers)));
  }
  const std::vector<double> numbers = {-3.0, 1.0, 2.0};
  CHECK(least(numbers) == -3.0);
  CHECK(greatest(numbers) == 2.0);
  CHECK(sum_of_sizes(numbers) == 6.0);
  CHECK(least_size(numbers) == 1.0);
  CHECK(greatest_size(numbers) == 3.0);
}

TEST_CASE("A command file reads a table cell by column and row") {
  using comma::interpreter::Value;
  TableConcept table;
  table.table.columns = {"DX", "NOEUD"};
  table.table.rows = {{2.5, std::string("N1")}};
  CHECK(table.subscript(Value::tuple({Value("DX"), Value(1)})).as_real() == 2.5);
  CHECK(table.subscript(Value::tuple({Value("NOEUD"), Value(1)})).as_text() == "N1");
  CHECK_THROWS_AS(table.subscript(Value::tuple({Value("DX"), Value(2)})), DiagnosticError);
  CHECK_THROWS_AS(table.subscript(Value("DX")), DiagnosticError);
}

TEST_CASE("Rows are found by what they name, numbers by what they are but for rounding") {
  using Cells = std::vector<Cell>;
  const std::vector<int> columns = {0, 2};
  const std::vector<Cells> rows = {{std::string("A"), 1.0, 0.1},
                                   {std::string("B"), 2.0, 0.1},
                                   {std::string("A"), 3.0, 0.1},
                                   {std::string("A"), 4.0, Cell()},
                                   {std::int64_t{2}, 5.0, 1.0}};
  RowKeys known(columns, SameKey());
  for (std::size_t i = 0; i < rows.size(); ++i) known.add(rows[i], i);
  const auto found = [&](const Cell& first, const Cell& second) {
    return known.find(Cells{first, second}, std::vector<int>{0, 1});
  };
  CHECK(found(std::string("A"), 0.1 * (1.0 + 5e-10)) == std::size_t{0});
  CHECK(!found(std::string("A"), 0.1 * (1.0 + 5e-9)));
  CHECK(found(std::string("A"), Cell()) == std::size_t{3});
  CHECK(found(2.0, std::int64_t{1}) == std::size_t{4});
  CHECK(!found(std::string("2"), 1.0));
  CHECK(known.take(rows[0], columns) == std::size_t{0});
  CHECK(known.take(rows[0], columns) == std::size_t{2});
  CHECK(!known.take(rows[0], columns));
  // Where the words of two neighbours differ.
  const double edge = 1.234565;
  for (const double side : {1.0 - 4e-10, 1.0, 1.0 + 4e-10})
    for (const double other : {1.0 - 4e-10, 1.0, 1.0 + 4e-10}) {
      const Cells held = {Cell(edge * side)};
      RowKeys one({0}, SameKey());
      one.add(held, 7);
      CHECK(one.find(Cells{Cell(edge * other)}, std::vector<int>{0}) == std::size_t{7});
    }
  const Cells held = {Cell(1.04)};
  RowKeys printed({0}, SameKey(RealFormat("F4.1")));
  printed.add(held, 1);
  CHECK(printed.find(Cells{Cell(0.96)}, std::vector<int>{0}) == std::size_t{1});
}
