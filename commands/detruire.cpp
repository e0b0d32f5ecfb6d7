#include "commands/commands.hpp"

namespace comma::commands {

// A concept lives as long as something reads it; a name is free for another as soon as it is assigned again.
Product detruire(const Call&, Context&) { return nullptr; }

}  // namespace comma::commands
