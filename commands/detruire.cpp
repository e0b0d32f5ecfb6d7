#include "commands/commands.hpp"
#include "commands/concepts.hpp"

namespace comma::commands {

namespace {

// What others share of it (a model, a mesh) they keep.
void release(const interpreter::ConceptPtr& handle, const interpreter::Span& span) {
  const interpreter::ConceptData* data = handle->data.get();
  if (dynamic_cast<const ResultConcept*>(data) == nullptr && dynamic_cast<const FieldConcept*>(data) == nullptr &&
      dynamic_cast<const TableConcept*>(data) == nullptr)
    return;
  handle->data.reset();
  handle->destroyed_at = span;
}

}  // namespace

// A name is free for another concept as soon as it is assigned again.
Product detruire(const Call& call, Context&) {
  const auto release_all = [&](const interpreter::Keywords& keywords) {
    if (!keywords.has("NOM")) return;
    for (const interpreter::ConceptPtr& handle : keywords.concepts_among("NOM")) release(handle, call.span);
  };
  release_all(call);
  for (const interpreter::Keywords& keywords : call.factors("CONCEPT")) release_all(keywords);
  return nullptr;
}

}  // namespace comma::commands
