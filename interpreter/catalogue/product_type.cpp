#include "interpreter/catalogue/product_type.hpp"

#include <algorithm>

namespace comma::interpreter {
namespace {

/// The type of the concept that a keyword names, if it is of the kind that the product is.
std::string type_like(const ProductPage& product, const Keywords& keywords, const Catalogue& catalogue) {
  const auto named = std::ranges::find(keywords.items, product.like, &Keyword::name);
  const bool fits = named != keywords.items.end() && named->value.is_concept() &&
                    catalogue.is_a(named->value.as_concept()->type, product.type);
  return fits ? named->value.as_concept()->type : product.type;
}

}  // namespace

std::optional<std::string> product_type(const CommandPage& page, const KeywordScope& scope, const Keywords& keywords,
                                        const Catalogue& catalogue) {
  for (const ProductPage& product : page.products) {
    const Truth fits = product.condition == nullptr ? Truth::yes : holds(*product.condition, scope);
    if (fits == Truth::unknown) return std::nullopt;
    if (fits == Truth::yes) return product.like.empty() ? product.type : type_like(product, keywords, catalogue);
  }
  return "";
}

}  // namespace comma::interpreter
