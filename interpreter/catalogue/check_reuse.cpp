#include "interpreter/catalogue/check_reuse.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace comma::interpreter {
namespace {

/// The concepts at "A" or in the occurrences at "A/B"; unknown values count as `handle` itself.
void collect_at(const Keywords& keywords, std::string_view path, const ConceptPtr& handle,
                std::vector<ConceptPtr>& found) {
  const std::size_t slash = path.find('/');
  if (slash != std::string_view::npos) {
    for (const Keywords& factor : keywords.factors(path.substr(0, slash)))
      collect_at(factor, path.substr(slash + 1), handle, found);
    return;
  }
  const auto item = std::ranges::find(keywords.items, path, &Keyword::name);
  if (item == keywords.items.end()) return;
  std::vector<Value> values{item->value};
  if (item->value.is_sequence()) values.assign(item->value.items().begin(), item->value.items().end());
  for (const Value& value : values) {
    if (value.is_unknown()) found.push_back(handle);
    if (value.is_concept()) found.push_back(value.as_concept());
  }
}

/// The checks of reuse=.
class ReuseCheck {
 public:
  ReuseCheck(const CommandCall& written, const CommandPage& page, const Argument* reuse, CheckContext& context)
      : written_(written), page_(page), reuse_(reuse), context_(context) {}

  void run(CheckedCall& checked) {
    if (reuse_ == nullptr) {
      if (page_.reuse == Reuse::compulsory)
        error(fmt::format("{} changes {} in place and needs reuse=", page_.name, page_.reuse_same_as.front()),
              written_.name_span, fmt::format("add reuse= with the concept of {}", page_.reuse_same_as.front()));
      return;
    }
    const Value& value = *reuse_->value;
    if (value.is_unknown()) return;
    if (page_.reuse == Reuse::none)
      return error(page_.name + " makes a new concept: it has no reuse=", reuse_->name_span);
    if (!value.is_concept())
      return error(fmt::format("reuse= wants a concept, not {}", value.repr()), reuse_->value_span);
    check_concept(value.as_concept(), checked);
  }

 private:
  void check_concept(const ConceptPtr& handle, CheckedCall& checked) {
    const bool fits = std::ranges::any_of(page_.products, [&](const ProductPage& product) {
      return context_.catalogue.is_a(handle->type, product.type);
    });
    if (!fits)
      return error(fmt::format("{} cannot change {} in place: it is {} ({})", page_.name, handle->name,
                               with_article(context_.catalogue.describe_type(handle->type)), handle->type),
                   reuse_->value_span);
    std::vector<ConceptPtr> named;
    for (const std::string& path : page_.reuse_same_as) collect_at(checked.call, path, handle, named);
    const bool same = std::ranges::find(named, handle) != named.end();
    if (!same && !named.empty())
      error(fmt::format("reuse={} must be the concept of {}", handle->name, fmt::join(page_.reuse_same_as, " or ")),
            reuse_->value_span);
    if (page_.reuse == Reuse::beside) return;
    checked.call.result = handle;
    checked.call.reuse = true;
    checked.product_type = handle->type;
  }

  void error(std::string message, const Span& span, std::string hint = {}) {
    context_.diagnostics.error("bad-reuse", std::move(message), span, std::move(hint));
  }

  const CommandCall& written_;
  const CommandPage& page_;
  const Argument* reuse_;
  CheckContext& context_;
};

}  // namespace

void check_reuse(const CommandCall& written, const CommandPage& page, const Argument* reuse, CheckContext& context,
                 CheckedCall& checked) {
  ReuseCheck(written, page, reuse, context).run(checked);
}

}  // namespace comma::interpreter
