// The command graph: one node a call, ordered by what the calls read and write, like instructions in a processor. A
// later reader waits for an earlier writer; a writer in place (reuse=) waits for the earlier readers and the earlier
// writer.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::interpreter {

enum class Hazard { read_after_write, write_after_read, write_after_write };

/// "raw", "war", "waw".
std::string_view name_of(Hazard hazard);

/// This node waits for node `from` because of `resource`: a concept's name, or "file 80".
struct Edge {
  int from = 0;
  Hazard hazard = Hazard::read_after_write;
  std::string resource;
};

enum class NodeState { waiting, done, failed, skipped };

/// What wants a node's work; a node that many want counts for the strongest.
enum class Need { nothing, output, verdict };

/// "nothing", "output", "verdict".
std::string_view name_of(Need need);
std::string_view name_of(NodeState state);

struct CommandNode {
  int id = 0;  ///< position in the file's order of execution
  Call call;
  ConceptPtr product;  ///< made, or changed in place; null if the command gives nothing
  Cost cost = Cost::cheap;
  Role role = Role::value;
  bool complete = true;  ///< false: a value is unknown or unsupported, so it never runs
  std::vector<Edge> waits_for;
  std::vector<int> reads;  ///< ids of the concepts that its keywords name
  NodeState state = NodeState::waiting;
  bool has_run = false;   ///< though it may have failed
  bool caught = false;    ///< inside try: the file itself deals with what goes wrong
  bool left_out = false;  ///< a command that only writes, and that comma does not run
  bool forgiven = false;  ///< it failed inside try: what it left may still be read
  double seconds = 0;
  std::vector<Span> called_from;  ///< the calls of the file's functions that led to it, the innermost first
};

/// Where the command starts in its file, 0 if that is not known.
int line_of(const CommandNode& node);

class CommandGraph {
 public:
  /// Appends a call. `page` says what it costs, what it is for, and whether its product keeps what it read. The
  /// product's reads_through is filled here. The call waits for what made the concepts that it names, and for what has
  /// changed in place what those were made from: of the rest, what made them has waited.
  CommandNode& add(Call call, ConceptPtr product, const CommandPage& page, bool complete = true);

  /// A call that was to change the concept in place is wrong: what reads it from here on, or something made from it, is
  /// not complete.
  void spoil(const Concept& changed);
  /// Whether such a call was to change it.
  bool is_spoiled(const Concept& handle) const;
  /// Whether the call that has made or changed the concept last is complete; true of one that no call has made.
  bool is_made(const Concept& handle) const;

  std::vector<CommandNode>& nodes() { return nodes_; }
  const std::vector<CommandNode>& nodes() const { return nodes_; }

  /// For each node, what needs it. Setup commands count as needed by a verdict: they always run.
  std::vector<Need> needs() const;

  /// The nodes whose work `id` builds on, itself included, in order.
  std::vector<int> required_by(int id) const;

  /// The last node that made or changed a concept, or -1.
  int last_writer(const Concept& handle) const;

 private:
  /// Who touched a resource last. Resources: concept id >= 0; file unit n as -1 - n.
  struct History {
    int writer = -1;
    std::vector<int> readers;  ///< since that writer
    bool is_spoiled = false;
    bool is_changed = false;       ///< in place, by reuse=
    std::string name;              ///< once it is changed
    std::set<int> changed_behind;  ///< the changed concepts among all that reading this one reads
  };

  void note_change(const Concept& changed);
  void remember_sources(Concept& product, const std::vector<ConceptPtr>& sources, bool in_place);
  bool take_changes(int reader, int source);
  void spread_changes();

  void read(CommandNode& node, int resource, const std::string& name);
  void write(CommandNode& node, int resource, const std::string& name);

  std::vector<CommandNode> nodes_;
  std::map<int, History> histories_;
};

}  // namespace comma::interpreter
