#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

// (filled when the discrete stiffness builders of solver/elements are known)

}  // namespace comma::commands
