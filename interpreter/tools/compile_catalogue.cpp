// Compiles a folder of catalogue pages into one C++ source:  compile_catalogue FOLDER OUTPUT.cpp
// A page that is wrong stops the build, with everything that is wrong with every page.
#include <fmt/format.h>
#include <fmt/os.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "interpreter/tools/catalogue_yaml.hpp"

namespace {

using comma::interpreter::Catalogue;
using comma::interpreter::CatalogueBlob;

/// Prints what is wrong with the pages; returns how many problems there are.
std::size_t inspect(const std::vector<CatalogueBlob>& blobs) {
  const Catalogue catalogue(blobs);
  std::size_t count = 0;
  for (const std::string& name : catalogue.names())
    for (const std::string& problem : comma::interpreter::tools::problems_of(catalogue.page(name), catalogue)) {
      fmt::print(stderr, "catalogue: {}\n", problem);
      ++count;
    }
  return count;
}

void write_bytes(fmt::ostream& out, std::size_t index, const CatalogueBlob& blob) {
  constexpr std::size_t per_line = 40;
  out.print("const std::uint8_t page_{}[] = {{", index);
  for (std::size_t i = 0; i < blob.bytes.size(); ++i) out.print("{}{},", i % per_line == 0 ? "\n" : "", blob.bytes[i]);
  out.print("}};\n");
}

void write_source(const std::string& path, const std::vector<CatalogueBlob>& blobs) {
  fmt::ostream out = fmt::output_file(path);
  out.print("// Written by compile_catalogue from the YAML pages; do not edit.\n");
  out.print("#include \"commands/catalogue.hpp\"\n\nnamespace comma::commands {{\nnamespace {{\n\n");
  for (std::size_t i = 0; i < blobs.size(); ++i) write_bytes(out, i, blobs[i]);
  out.print("\nconst interpreter::CatalogueBlob pages[] = {{\n");
  for (std::size_t i = 0; i < blobs.size(); ++i) out.print("    {{\"{}\", page_{}}},\n", blobs[i].name, i);
  out.print("}};\n\n}}  // namespace\n\n");
  out.print(
      "std::span<const interpreter::CatalogueBlob> catalogue_blobs() {{ return pages; }}\n\n}}  // namespace "
      "comma::commands\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: compile_catalogue FOLDER OUTPUT.cpp\n");
    return 2;
  }
  try {
    const auto compiled = comma::interpreter::tools::CompiledCatalogue::from_folder(argv[1]);
    const auto blobs = compiled.blobs();
    if (inspect(blobs) > 0) return 1;
    write_source(argv[2], blobs);
  } catch (const std::exception& error) {
    fmt::print(stderr, "catalogue: {}\n", error.what());
    return 1;
  }
  return 0;
}
