// The catalogue pages of commands/catalogue/*.yaml, as the build embedded them.
#pragma once

#include <span>

#include "interpreter/catalogue/catalogue.hpp"

namespace comma::commands {

/// For the constructor of interpreter::Catalogue; lives as long as the program.
std::span<const interpreter::CatalogueBlob> catalogue_blobs();

}  // namespace comma::commands
