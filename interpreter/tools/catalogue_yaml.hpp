// The catalogue as people write it: YAML pages -> the JSON that the program embeds. Used by the build and by tests; the
// program itself never reads YAML. commands/catalogue/README.md describes the format.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"

namespace comma::interpreter::tools {

using Json = nlohmann::ordered_json;

/// Parts that several pages share: name (`use: solveur`) -> YAML text.
using SharedParts = std::map<std::string, std::string>;

/// One page as JSON. `path` names it in messages. Throws std::runtime_error "path:line: what is wrong" on YAML that
/// does not parse and on keys that the format does not have.
Json page_from_yaml(const std::string& yaml, const std::string& path, const SharedParts& shared = {});

/// The list of concept types: name -> {doc, is_a}.
Json types_from_yaml(const std::string& yaml, const std::string& path);

/// What contradicts itself on a page: defaults against types, words and bounds; rules and conditions that name unknown
/// keywords; missing documentation; unknown concept types ... Empty when the page is right.
std::vector<std::string> problems_of(const CommandPage& page, const Catalogue& catalogue);

/// Pages compiled in memory, with the bytes that a Catalogue points into.
class CompiledCatalogue {
 public:
  void add_types(const std::string& yaml, const std::string& path = "concept_types.yaml");
  void add_page(const std::string& yaml, const std::string& path = "page.yaml", const SharedParts& shared = {});
  /// Every page of a folder: *.yaml, with concept_types.yaml and shared/*.yaml. Throws as page_from_yaml.
  static CompiledCatalogue from_folder(const std::string& folder);

  /// Valid as long as this object lives and nothing is added.
  std::vector<CatalogueBlob> blobs() const;

 private:
  std::map<std::string, std::vector<std::uint8_t>> bytes_;
};

}  // namespace comma::interpreter::tools
