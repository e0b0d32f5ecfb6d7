#include "commands/tables/text_table.hpp"

#include <sstream>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

namespace comma::commands {
namespace {

Table sample() {
  Table table;
  table.title = "two steps";
  table.add_row({{"INST", 0.5}, {"N", std::int64_t{4}}, {"NAME", "first"}});
  table.add_row({{"INST", 1.0}, {"N", Cell()}, {"NAME", "second"}});
  return table;
}

TEST_CASE("A table that is written is read again, types and empty cells and all") {
  std::istringstream twice(aster_table(sample()) + aster_table(sample()));
  const Table read = read_aster_table(twice, " ", 2);
  CHECK(read.title == "two steps");
  CHECK(read.columns == std::vector<std::string>{"INST", "N", "NAME"});
  CHECK(read.rows == sample().rows);
  TableLayout layout;
  layout.separator = ";";
  std::istringstream plain(format_table(sample(), layout));
  CHECK(read_plain_table(plain, ";", 1).rows == sample().rows);
}

TEST_CASE("A table that is not there, and a line that does not fit, are told") {
  std::istringstream once(aster_table(sample()));
  CHECK_THROWS_AS(read_aster_table(once, " ", 2), solver::Error);
  std::istringstream wide("A B\n1 2\n1 2 3\n");
  CHECK_THROWS_AS(read_plain_table(wide, " ", 1), solver::Error);
}

TEST_CASE("Lines with words part blocks of numbers, and names that stand twice get a number") {
  std::istringstream file("time load\n1. 2.\n2D0 +3\n\n7\n");
  const auto blocks = read_number_blocks(file, "");
  REQUIRE(blocks.size() == 2);
  CHECK(blocks[0] == NumberBlock{{1.0, 2.0}, {2.0, 3.0}});
  CHECK(blocks[1] == NumberBlock{{7.0}});
  std::istringstream names("DX DX\n1 x\n");
  const Table table = read_plain_table(names, " ", 1);
  CHECK(table.columns == std::vector<std::string>{"DX", "DX_1"});
  CHECK(table.rows[0][1] == Cell("x"));
}

}  // namespace
}  // namespace comma::commands
