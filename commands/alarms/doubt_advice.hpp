// What a doubt about the contact of a step means to who wrote the command file, and what to try.
#pragma once

#include <string>

#include "solver/contact/definition.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::commands {

struct DoubtAdvice {
  std::string code;  ///< of the alarm (docs/alarms.md)
  std::string message;
  std::string hint;
};

/// `contact` is the definition whose zones the doubt counts; of bounds alone (LIAISON_UNIL), an empty one.
DoubtAdvice advice_on(const solver::ContactDoubt& doubt, const solver::ContactDefinition& contact,
                      const solver::Mesh& mesh);

}  // namespace comma::commands
