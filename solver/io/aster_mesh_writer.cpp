// Writing a mesh as a .mail file (U3.01.00).
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "solver/error.hpp"
#include "solver/io/aster_mesh_file.hpp"

namespace comma::solver {
namespace {

/// Readers stop at this column.
constexpr std::size_t line_width = 80;

/// Words in free format, broken into lines; every entry starts a line of its own.
class AsterMeshWriter {
 public:
  void line(std::string_view text) { fmt::format_to(std::back_inserter(text_), "{}\n", text); }

  void entry(std::string_view name) {
    end_entry();
    word(name);
  }

  void word(std::string_view text) {
    if (column_ > 0 && column_ + 1 + text.size() > line_width) end_entry();
    fmt::format_to(std::back_inserter(text_), "{}{}", column_ > 0 ? " " : "", text);
    column_ += text.size() + (column_ > 0 ? 1 : 0);
  }

  void end_entry() {
    if (column_ > 0) text_.push_back('\n');
    column_ = 0;
  }

  void end_subfile() {
    end_entry();
    line("FINSF");
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t column_ = 0;
};

/// A name must come back as one word.
const std::string& checked(const std::string& name) {
  const bool breaks = name.find_first_of(" ,%=\t\r\n") != std::string::npos;
  if (name.empty() || breaks || name == "FINSF") {
    throw Error("invalid-name", fmt::format("the name \"{}\" cannot be written in the ASTER format", name));
  }
  if (name.size() > line_width)
    throw Error("name-too-long", fmt::format("{} has more than {} characters", name, line_width));
  return name;
}

void write_nodes(AsterMeshWriter& writer, const Mesh& mesh) {
  writer.line(mesh.dimension == 2 ? "COOR_2D" : "COOR_3D");
  for (int i = 0; i < mesh.node_count(); ++i) {
    writer.entry(checked(mesh.node_name(i)));
    for (int j = 0; j < (mesh.dimension == 2 ? 2 : 3); ++j) writer.word(fmt::format("{}", mesh.nodes[i][j]));
  }
  writer.end_subfile();
}

/// One sub-file for each run of cells of one type, so that their order comes back.
void write_cells(AsterMeshWriter& writer, const Mesh& mesh) {
  for (int i = 0; i < mesh.cell_count(); ++i) {
    const CellType type = mesh.cell_types[i];
    if (i == 0 || mesh.cell_types[i - 1] != type) writer.line(name_of(type));
    writer.entry(checked(mesh.cell_name(i)));
    for (const int node : mesh.cell(i)) writer.word(mesh.node_name(node));
    writer.end_entry();
    if (i + 1 == mesh.cell_count() || mesh.cell_types[i + 1] != type) writer.end_subfile();
  }
}

template <typename NameOf>
void write_groups(AsterMeshWriter& writer, std::string_view keyword, const auto& groups, NameOf name_of_member) {
  for (const auto& [name, members] : groups) {
    writer.line(keyword);
    writer.entry(checked(name));
    writer.end_entry();
    for (const int member : members) writer.word(name_of_member(member));
    writer.end_subfile();
  }
}

}  // namespace

std::string format_aster_mesh(const Mesh& mesh) {
  AsterMeshWriter writer;
  write_nodes(writer, mesh);
  write_cells(writer, mesh);
  write_groups(writer, "GROUP_NO", mesh.node_groups, [&](int node) { return mesh.node_name(node); });
  write_groups(writer, "GROUP_MA", mesh.cell_groups, [&](int cell) { return mesh.cell_name(cell); });
  writer.line("FIN");
  return writer.take();
}

}  // namespace comma::solver
