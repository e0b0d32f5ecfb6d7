#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/result_reading.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/fields/nodal_forces.hpp"

namespace comma::commands {

namespace {

const solver::NodalField& displacement(const solver::ResultStep& step) {
  const auto found = step.fields.find("DEPL");
  if (found == step.fields.end()) {
    throw interpreter::DiagnosticError("unknown-field", fmt::format("step INST={} of the result holds no DEPL", step.instant));
  }
  return std::get<solver::NodalField>(found->second);
}

void add_forces(const Call& call, ResultConcept& data) {
  const solver::StaticProblem& problem = data.problem;
  const solver::DofMap dofs(*problem.model);
  const solver::Assembler assembler(*problem.model, *problem.materials, *problem.properties, dofs);
  for (const solver::ResultStep* chosen : selected_steps(call, data.result)) {
    solver::ResultStep& step = data.result.steps[static_cast<std::size_t>(chosen - data.result.steps.data())];
    for (const std::string& option : call.texts("FORCE")) {
      step.fields[option] = option == "FORC_NODA"
                                ? solver::nodal_forces(assembler, dofs, displacement(step))
                                : solver::nodal_reactions(assembler, dofs, displacement(step), problem.loads, step.instant);
    }
  }
}

}  // namespace

// A new result holds the fields of the one that it is computed from, and the new ones beside them.
Product calc_champ(const Call& call, Context&) {
  auto& source = call.data<ResultConcept>("RESULTAT");
  if (call.reuse) {
    add_forces(call, source);
    return nullptr;
  }
  auto product = std::make_shared<ResultConcept>(source);
  add_forces(call, *product);
  return product;
}

}  // namespace comma::commands
