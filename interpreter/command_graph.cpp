#include "interpreter/command_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace comma::interpreter {
namespace {

/// The files and concepts that the keywords of a call name.
struct Accesses {
  std::vector<ConceptPtr> concepts;
  std::set<int> files_read, files_written;
};

void collect(const Value& value, std::vector<ConceptPtr>& concepts) {
  if (value.is_concept()) concepts.push_back(value.as_concept());
  if (value.is_sequence())
    for (const Value& item : value.items()) collect(item, concepts);
}

/// Every keyword of a level, blocks included, whatever their conditions.
const KeywordPage* find_page(const LevelPage& level, std::string_view name, Kind kind) {
  for (const KeywordPage& keyword : level.keywords)
    if (keyword.name == name && !keyword.types.empty() && keyword.types.front().kind == kind) return &keyword;
  for (const BlockPage& block : level.blocks)
    if (const KeywordPage* found = find_page(block.inside, name, kind)) return found;
  return nullptr;
}

void collect(const Keywords& keywords, const LevelPage& level, Accesses& accesses) {
  for (const Keyword& keyword : keywords.items) {
    collect(keyword.value, accesses.concepts);
    if (keyword.value.is_integer()) {
      const int unit = static_cast<int>(keyword.value.as_integer());
      if (find_page(level, keyword.name, Kind::input_unit)) accesses.files_read.insert(unit);
      if (find_page(level, keyword.name, Kind::output_unit)) accesses.files_written.insert(unit);
    }
    if (keyword.factors.empty()) continue;
    const KeywordPage* page = find_page(level, keyword.name, Kind::factor);
    if (page == nullptr) continue;
    for (const Keywords& factor : keyword.factors) collect(factor, page->inside, accesses);
  }
}

/// A concept and all that reading it reads.
void close_over(const Concept* handle, std::map<int, const Concept*>& closure) {
  if (!closure.emplace(handle->id, handle).second) return;
  for (const ConceptPtr& behind : handle->reads_through) close_over(behind.get(), closure);
}

bool reads(const Concept& reader, const Concept& source) {
  std::map<int, const Concept*> closure;
  close_over(&reader, closure);
  return closure.contains(source.id);
}

/// A table or a function holds its own numbers; any other product refers to what it was made from. What is changed in place by
/// something made from it (a mesh by a field on it) does not: each would keep the other alive.
void remember_sources(const ConceptPtr& product, const std::vector<ConceptPtr>& sources, bool in_place) {
  for (const ConceptPtr& source : sources) {
    if (std::ranges::find(product->reads_through, source) != product->reads_through.end()) continue;
    if (source != product && !(in_place && reads(*source, *product))) product->reads_through.push_back(source);
  }
}

int file_resource(int unit) {
  return -1 - unit;
}

}  // namespace

int line_of(const CommandNode& node) {
  return node.call.span ? node.call.span.file->position(node.call.span.begin).line : 0;
}

std::string_view name_of(Hazard hazard) {
  switch (hazard) {
    case Hazard::read_after_write:
      return "raw";
    case Hazard::write_after_read:
      return "war";
    case Hazard::write_after_write:
      return "waw";
  }
  return "";
}

std::string_view name_of(Need need) {
  switch (need) {
    case Need::nothing:
      return "nothing";
    case Need::output:
      return "output";
    case Need::verdict:
      return "verdict";
  }
  return "";
}

std::string_view name_of(NodeState state) {
  switch (state) {
    case NodeState::waiting:
      return "waiting";
    case NodeState::done:
      return "done";
    case NodeState::failed:
      return "failed";
    case NodeState::skipped:
      return "skipped";
  }
  return "";
}

CommandNode& CommandGraph::add(Call call, ConceptPtr product, const CommandPage& page, bool complete) {
  CommandNode node;
  node.id = static_cast<int>(nodes_.size());
  node.cost = page.cost;
  node.role = page.role;
  node.complete = complete;
  node.product = product;

  Accesses accesses;
  collect(call, page.inside, accesses);
  std::map<int, const Concept*> closure;
  for (const ConceptPtr& handle : accesses.concepts) close_over(handle.get(), closure);
  if (call.reuse && product) close_over(product.get(), closure);
  for (const auto& [id, handle] : closure) read(node, id, handle->name);
  for (const int unit : accesses.files_read) read(node, file_resource(unit), fmt::format("file {}", unit));
  for (const int unit : accesses.files_written) write(node, file_resource(unit), fmt::format("file {}", unit));
  if (product) write(node, product->id, product->name);

  if (product && !page.standalone) remember_sources(product, accesses.concepts, call.reuse);
  node.call = std::move(call);
  return nodes_.emplace_back(std::move(node));
}

void CommandGraph::read(CommandNode& node, int resource, const std::string& name) {
  History& history = histories_[resource];
  if (history.writer >= 0) node.waits_for.push_back({history.writer, Hazard::read_after_write, name});
  if (history.readers.empty() || history.readers.back() != node.id) history.readers.push_back(node.id);
}

void CommandGraph::write(CommandNode& node, int resource, const std::string& name) {
  History& history = histories_[resource];
  for (const int reader : history.readers)
    if (reader != node.id) node.waits_for.push_back({reader, Hazard::write_after_read, name});
  if (history.writer >= 0 && history.writer != node.id)
    node.waits_for.push_back({history.writer, Hazard::write_after_write, name});
  history.writer = node.id;
  history.readers.clear();
}

std::vector<Need> CommandGraph::needs() const {
  std::vector<Need> needs(nodes_.size(), Need::nothing);
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    Need& own = needs[static_cast<std::size_t>(node->id)];
    if (node->role == Role::verdict || node->role == Role::setup) own = Need::verdict;
    if (node->role == Role::output) own = std::max(own, Need::output);
    for (const Edge& edge : node->waits_for) {
      if (edge.hazard != Hazard::read_after_write) continue;
      Need& source = needs[static_cast<std::size_t>(edge.from)];
      source = std::max(source, own);
    }
  }
  return needs;
}

std::vector<int> CommandGraph::required_by(int id) const {
  std::vector<bool> wanted(nodes_.size(), false);
  wanted[static_cast<std::size_t>(id)] = true;
  for (int i = id; i >= 0; --i) {
    if (!wanted[static_cast<std::size_t>(i)]) continue;
    for (const Edge& edge : nodes_[static_cast<std::size_t>(i)].waits_for)
      wanted[static_cast<std::size_t>(edge.from)] = true;
  }
  std::vector<int> ids;
  for (int i = 0; i <= id; ++i)
    if (wanted[static_cast<std::size_t>(i)]) ids.push_back(i);
  return ids;
}

int CommandGraph::last_writer(const Concept& handle) const {
  const auto history = histories_.find(handle.id);
  return history == histories_.end() ? -1 : history->second.writer;
}

}  // namespace comma::interpreter
