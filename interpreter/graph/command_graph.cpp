#include "interpreter/graph/command_graph.hpp"

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

int file_resource(int unit) { return -1 - unit; }

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
  std::map<int, const Concept*> named;
  for (const ConceptPtr& handle : accesses.concepts) named.emplace(handle->id, handle.get());
  if (call.reuse && product) named.emplace(product->id, product.get());
  // What a concept was made from is waited for by what made it; what has changed since is not.
  std::map<int, std::string> resources;
  for (const auto& [id, handle] : named) {
    resources.emplace(id, handle->name);
    node.reads.push_back(id);
    for (const int behind : histories_[id].changed_behind) resources.emplace(behind, histories_[behind].name);
  }
  for (const auto& [id, name] : resources) {
    read(node, id, name);
    node.complete = node.complete && !histories_[id].is_spoiled;
  }
  for (const int unit : accesses.files_read) read(node, file_resource(unit), fmt::format("file {}", unit));
  for (const int unit : accesses.files_written) write(node, file_resource(unit), fmt::format("file {}", unit));
  // It waits for all that reads them before.
  if (page.destroys)
    for (const auto& [id, handle] : named) write(node, id, handle->name);
  if (product) {
    if (call.reuse) note_change(*product);
    write(node, product->id, product->name);
    if (!page.standalone) remember_sources(*product, accesses.concepts, call.reuse);
  }
  node.call = std::move(call);
  return nodes_.emplace_back(std::move(node));
}

void CommandGraph::spoil(const Concept& changed) {
  note_change(changed);
  histories_[changed.id].is_spoiled = true;
}

bool CommandGraph::is_spoiled(const Concept& handle) const {
  const auto found = histories_.find(handle.id);
  return found != histories_.end() && found->second.is_spoiled;
}

bool CommandGraph::is_made(const Concept& handle) const {
  const auto found = histories_.find(handle.id);
  if (found == histories_.end() || found->second.writer < 0) return true;
  return nodes_[static_cast<std::size_t>(found->second.writer)].complete;
}

/// From the first change on, whoever reads something made from the concept counts among its readers.
void CommandGraph::note_change(const Concept& changed) {
  History& own = histories_[changed.id];
  own.name = changed.name;
  if (own.is_changed) return;
  own.is_changed = true;
  spread_changes();
  std::set<int> readers(own.readers.begin(), own.readers.end());
  for (const CommandNode& node : nodes_) {
    const auto through = [&](int id) { return histories_[id].changed_behind.contains(changed.id); };
    if (node.id > own.writer && std::ranges::any_of(node.reads, through)) readers.insert(node.id);
  }
  own.readers.assign(readers.begin(), readers.end());
}

/// A table or a function holds its own numbers; any other product refers to what it was made from. What is changed in
/// place by something made from it (a mesh by a field on it) does not: each would keep the other alive.
void CommandGraph::remember_sources(Concept& product, const std::vector<ConceptPtr>& sources, bool in_place) {
  bool news = false;
  for (const ConceptPtr& source : sources) {
    if (source.get() == &product || std::ranges::find(product.reads_through, source) != product.reads_through.end())
      continue;
    if (in_place && histories_[source->id].changed_behind.contains(product.id)) continue;
    product.reads_through.push_back(source);
    news = take_changes(product.id, source->id) || news;
  }
  if (in_place && news) spread_changes();
}

/// Whether `reader` has more behind it now that it reads `source`.
bool CommandGraph::take_changes(int reader, int source) {
  auto& behind = histories_[reader].changed_behind;
  const std::size_t before = behind.size();
  const History& from = histories_[source];
  if (from.is_changed) behind.insert(source);
  behind.insert(from.changed_behind.begin(), from.changed_behind.end());
  return behind.size() > before;
}

/// Something may read a concept that reads more since: until nothing is new.
void CommandGraph::spread_changes() {
  for (bool news = true; news;) {
    news = false;
    for (const CommandNode& node : nodes_) {
      if (!node.product) continue;
      for (const ConceptPtr& source : node.product->reads_through)
        news = take_changes(node.product->id, source->id) || news;
    }
  }
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
    if (only_writes(node->role)) own = std::max(own, Need::output);
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
