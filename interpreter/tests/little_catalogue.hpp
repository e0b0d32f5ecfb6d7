// A small catalogue for the tests, and helpers that write calls of it as the evaluator would.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/host.hpp"
#include "interpreter/tools/catalogue_yaml.hpp"

namespace comma::interpreter::tests {

/// Pages compiled from YAML text, with the catalogue that reads them.
struct LittleCatalogue {
  explicit LittleCatalogue(const std::vector<std::string>& pages);

  tools::CompiledCatalogue compiled;
  std::vector<CatalogueBlob> blobs;
  std::unique_ptr<Catalogue> catalogue;
};

/// MESH, SHIFT (in place), MODEL, LOAD, SOLVE, TABLE, PRINT and VERIFY: enough for every kind of hazard.
LittleCatalogue little_catalogue();

using Arguments = std::vector<std::pair<std::string, Value>>;

/// Writes NAME(KEYWORD=value, ...) into a file of its own, so that each name and value has its span.
CommandCall written_call(const std::string& name, const Arguments& arguments);
Value factor(const Arguments& arguments);
ConceptPtr new_concept(const std::string& name, const std::string& type, int id = 0);

/// The text that a span covers.
std::string text_at(const Span& span);

}  // namespace comma::interpreter::tests
