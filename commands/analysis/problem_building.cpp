#include "commands/analysis/problem_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "commands/analysis/same_mesh.hpp"
#include "commands/functions/functions.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/functions/deformed_place.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::LinearMethod;

namespace {

// On the initial geometry there is no deformed place.
void require_initial_places(const Keywords& excitation, const solver::Load& load) {
  const bool deformed = std::ranges::any_of(load.pressures, [](const solver::PressureLoad& pressure) {
    return solver::is_of_deformed_place(pressure.pressure_function) ||
           solver::is_of_deformed_place(pressure.shear_function);
  });
  if (!deformed) return;
  throw DiagnosticError("fixed-load",
                        excitation.concept_of("CHARGE")->name +
                            " has a pressure that depends on XF, YF or ZF, the place on the deformed body",
                        excitation.span_of("CHARGE"),
                        "let it follow the body in STAT_NON_LINE (TYPE_CHARGE='SUIV'), or let it depend on X, Y, Z");
}

bool is_on_face(const solver::DistributedForce& force, const solver::Model& model) {
  return model.is_skin(force.cell) && solver::dimension(model.mesh->cell_types[force.cell]) == 2;
}

// Forces on faces of solids act on the deformed area. Those on nodes have nothing to follow, and of others
// Code_Aster 17.3 knows no such thing.
void require_no_dead_forces(const Keywords& excitation, const solver::Load& load, const solver::Model& model) {
  const auto is_other = [&](const solver::DistributedForce& force) { return !is_on_face(force, model); };
  const bool on_nodes = !load.nodal_forces.empty();
  if (!on_nodes && std::ranges::none_of(load.distributed_forces, is_other)) return;
  throw DiagnosticError(
      "unsupported",
      fmt::format("{} has forces on {}, which do not follow the body", excitation.concept_of("CHARGE")->name,
                  on_nodes ? "nodes (FORCE_NODALE)" : "edges, volumes or plates (FORCE_CONTOUR, FORCE_INTERNE ...)"),
      excitation.span_of("TYPE_CHARGE"),
      "make them a load of their own, without TYPE_CHARGE='SUIV', or give a pressure (PRES_REP)");
}

// What grows with the distance from an axis or has axes that turn with the body is another force on the deformed body.
void require_no_others_that_follow(const Keywords& excitation, const solver::Load& load) {
  const bool turn =
      std::ranges::any_of(load.beam_forces,
                          [](const solver::BeamForce& each) { return each.axes == solver::BeamAxes::own; }) ||
      std::ranges::any_of(load.plate_forces, [](const solver::PlateForce& each) { return each.in_own_axes; });
  if (load.rotations.empty() && !turn) return;
  throw DiagnosticError(
      "unsupported",
      excitation.concept_of("CHARGE")->name +
          (turn ? " has forces in the axes of beams or plates" : " has centrifugal forces (ROTATION)") +
          ", which comma does not let follow the body",
      excitation.span_of("CHARGE"), "leave out TYPE_CHARGE='SUIV' where displacements are small");
}

// TYPE_CHARGE='SUIV': pressures and forces on faces follow, and rigid bodies turn; weight, displacements of single
// nodes and other relations, as they were written, are the same on any geometry.
void add_following(const Keywords& excitation, const solver::AppliedLoad& applied, solver::StaticProblem& problem) {
  const solver::Load& load = *applied.load;
  const auto moves_apart = [](const solver::LinearRelation& relation) {
    return relation.terms.size() > 1 && relation.rigid_link < 0 && (relation.value != 0.0 || relation.function);
  };
  if (std::ranges::any_of(load.relations, moves_apart)) {
    throw DiagnosticError("unsupported",
                          excitation.concept_of("CHARGE")->name +
                              " has relations between displacements with a value that is not zero, which do not "
                              "follow a body",
                          excitation.span_of("CHARGE"), "make them a load of their own, without TYPE_CHARGE='SUIV'");
  }
  if (problem.model) require_no_dead_forces(excitation, load, *problem.model);
  require_no_others_that_follow(excitation, load);
  auto following = std::make_shared<solver::Load>();
  following->pressures = load.pressures;
  following->distributed_forces = load.distributed_forces;
  auto dead = std::make_shared<solver::Load>(load);
  dead->pressures.clear();
  dead->distributed_forces.clear();
  std::erase_if(dead->relations, [](const solver::LinearRelation& relation) { return relation.rigid_link >= 0; });
  problem.turning_links.insert(problem.turning_links.end(), load.rigid_links.begin(), load.rigid_links.end());
  if (!following->pressures.empty() || !following->distributed_forces.empty())
    problem.followers.push_back({std::move(following), applied.multiplier});
  problem.loads.push_back({std::move(dead), applied.multiplier});
}

std::optional<LinearMethod> linear_method(const std::string& word) {
  if (word == "MUMPS") return LinearMethod::mumps;
  if (word == "MULT_FRONT") return LinearMethod::cholmod;
  if (word == "LDLT") return LinearMethod::eigen_ldlt;
  return std::nullopt;
}

// NPREC (U4.50.01): 0 stands for the default; a negative number means no test to MUMPS alone, elsewhere its sign says
// whether to stop, which comma always does.
int singular_digits(const Keywords& solver) {
  constexpr int default_digits = 8;
  const int digits = static_cast<int>(solver.integer("NPREC"));
  if (digits == 0) return default_digits;
  return solver.text("METHODE") == "MUMPS" ? digits : std::abs(digits);
}

// METHODE="GCPC". With a complete factor as preconditioner the iterations are nothing but the refinement that every
// direct method does in any case.
void take_iterations(const Keywords& solver, SolverChoice& choice) {
  choice.method = solver.text("PRE_COND") == "LDLT_INC" ? LinearMethod::conjugate_gradient : LinearMethod::cholmod;
  choice.options.iteration_tolerance = solver.real("RESI_RELA");
  choice.options.most_iterations = static_cast<int>(solver.integer("NMAX_ITER"));
}

// Discrete elements alone need no materials (U4.51.01).
bool needs_materials(const solver::Model& model) {
  return std::ranges::any_of(model.formulations, [](solver::Formulation each) {
    return each != solver::Formulation::none && !solver::is_discrete(each);
  });
}

void take_materials(const Call& call, solver::StaticProblem& problem) {
  if (!call.has("CHAM_MATER")) {
    if (problem.materials || !problem.model || needs_materials(*problem.model)) return;
    auto none = std::make_shared<solver::MaterialField>();
    none->by_cell.resize(static_cast<std::size_t>(problem.model->mesh->cell_count()));
    problem.materials = std::move(none);
    return;
  }
  const auto& materials = call.data<MaterialFieldConcept>("CHAM_MATER");
  if (problem.model) require_mesh(call, "CHAM_MATER", materials.mesh.get(), *problem.model->mesh);
  problem.materials = materials.field.get();
}

void take_properties(const Call& call, solver::StaticProblem& problem) {
  if (!call.has("CARA_ELEM")) return;
  const auto& properties = call.data<PropertiesConcept>("CARA_ELEM");
  if (problem.model)
    require_mesh(call, "CARA_ELEM", properties.model ? properties.model->mesh.get() : nullptr, *problem.model->mesh);
  problem.properties = properties.properties;
}

void require_loads_once(const Keywords& keywords) {
  std::set<const interpreter::Concept*> seen;
  for (const Keywords& excitation : keywords.factors("EXCIT")) {
    const interpreter::ConceptPtr& load = excitation.concept_of("CHARGE");
    if (!seen.insert(load.get()).second)
      throw DiagnosticError(
          "repeated-load", "EXCIT names the load " + load->name + " more than once", excitation.span_of("CHARGE"),
          "name it once; where two functions of time shall act on it, add them up (CALC_FONCTION, COMB)");
  }
}

}  // namespace

void take_loads(const Keywords& keywords, solver::StaticProblem& problem) {
  problem.loads.clear();
  problem.followers.clear();
  problem.turning_links.clear();
  problem.driven.clear();
  require_loads_once(keywords);
  for (const Keywords& excitation : keywords.factors("EXCIT")) {
    solver::AppliedLoad applied;
    const auto& load_concept = excitation.data<LoadConcept>("CHARGE");
    if (problem.model)
      require_mesh(excitation, "CHARGE", load_concept.model ? load_concept.model->mesh.get() : nullptr,
                   *problem.model->mesh);
    applied.load = load_concept.load.get();
    applied.differential = excitation.has("TYPE_CHARGE") && excitation.text("TYPE_CHARGE") == "DIDI";
    if (excitation.has("FONC_MULT")) {
      applied.multiplier = time_function(excitation.concept_of("FONC_MULT"), excitation.span_of("FONC_MULT"));
    }
    if (excitation.has("COEF_MULT"))
      applied.multiplier = [factor = excitation.real("COEF_MULT")](double) { return factor; };
    if (excitation.has("TYPE_CHARGE") && excitation.text("TYPE_CHARGE") == "SUIV") {
      add_following(excitation, applied, problem);
      continue;
    }
    require_initial_places(excitation, *applied.load);
    if (excitation.has("TYPE_CHARGE") && excitation.text("TYPE_CHARGE") == "FIXE_PILO") {
      problem.driven.push_back(std::move(applied));
      continue;
    }
    problem.loads.push_back(std::move(applied));
  }
}

void check_multipliers(const Call& call, std::span<const double> instants) {
  for (const Keywords& excitation : call.factors("EXCIT")) {
    if (!excitation.has("FONC_MULT")) continue;
    const auto& handle = excitation.concept_of("FONC_MULT");
    const auto* function = dynamic_cast<const FunctionConcept*>(handle->data.get());
    if (function == nullptr || function->table() == nullptr) continue;
    try {
      for (const double instant : instants) function->evaluate({&instant, 1});
    } catch (const solver::Error& error) {
      throw DiagnosticError(
          error.code(), fmt::format("{}: the multiplier {} of a load: {}", call.command, handle->name, error.what()),
          excitation.span_of("FONC_MULT"), error.hint());
    }
  }
}

solver::StaticProblem static_problem(const Call& call) {
  solver::StaticProblem problem;
  problem.model = call.data<ModelConcept>("MODELE").model;
  take_materials(call, problem);
  if (!problem.materials)
    throw DiagnosticError("missing-keyword", call.command + " needs CHAM_MATER", call.span,
                          "give the materials; a model of discrete elements alone needs none");
  problem.properties = std::make_shared<const solver::ElementProperties>();
  take_properties(call, problem);
  take_loads(call, problem);
  return problem;
}

namespace {

// The problem of a phase, but for what the call gives in its place.
solver::StaticProblem completed(const Call& call, const ResultConcept& source, solver::StaticProblem problem) {
  if (call.has("MODELE")) {
    problem.model = call.data<ModelConcept>("MODELE").model;
    if (source.result.model || source.result.bare_mesh)
      require_mesh(call, "MODELE", problem.model->mesh.get(), source.result.mesh());
  }
  take_materials(call, problem);
  take_properties(call, problem);
  if (call.has("EXCIT")) take_loads(call, problem);
  if (!problem.properties) problem.properties = std::make_shared<const solver::ElementProperties>();
  if (problem.model && problem.materials) return problem;
  const char* missing = problem.model ? "CHAM_MATER" : "MODELE";
  throw interpreter::DiagnosticError(
      "missing-keyword",
      call.command + ": it is not known which " + (problem.model ? "materials" : "model") + " is meant", call.span,
      std::string("give ") + missing);
}

}  // namespace

solver::StaticProblem problem_of_result(const Call& call, const ResultConcept& source, const solver::ResultStep* step) {
  return completed(call, source, step != nullptr ? source.problem_of(*step) : source.problem);
}

std::map<std::string, std::string> numbered_sources(const Call& call) {
  constexpr std::pair<const char*, const char*> names[] = {
      {"MODELE", "MODELE"}, {"CHAM_MATER", "CHAMPMAT"}, {"CARA_ELEM", "CARAELEM"}};
  std::map<std::string, std::string> sources;
  for (const auto& [keyword, name] : names)
    if (call.has(keyword)) sources[name] = fmt::format("{:08x}", call.concept_of(keyword)->id + 1);
  return sources;
}

std::shared_ptr<ResultConcept> to_go_on_with(const Call& call, std::optional<int> last_order) {
  auto product = std::make_shared<ResultConcept>(interpreter::data_of<ResultConcept>(call.result, "reuse"));
  auto& steps = product->result.steps;
  if (last_order) {
    std::erase_if(steps, [&](const solver::ResultStep& step) { return step.order > *last_order; });
    for (std::optional<StepTable>* kept : {&product->computed, &product->observations, &product->modes})
      if (*kept) (*kept)->forget_after(*last_order);
  }
  if (steps.empty()) return product;
  const int last = steps.back().order;
  std::erase_if(product->earlier, [&](const EarlierPhase& phase) { return phase.last_order > last; });
  if (product->earlier.empty() || product->earlier.back().last_order < last)
    product->earlier.push_back({last, product->problem_of(steps.back())});
  return product;
}

FieldsOfSteps::FieldsOfSteps(const Call& call, const ResultConcept& source) : call_(call), source_(source) {
  const auto& steps = source.result.steps;
  std::size_t begin = 0;
  for (const EarlierPhase& phase : source.earlier) {
    const auto after =
        std::ranges::find_if(steps, [&](const solver::ResultStep& step) { return step.order > phase.last_order; });
    const auto end = static_cast<std::size_t>(after - steps.begin());
    phases_.push_back({begin, end, completed(call, source, phase.problem), nullptr});
    begin = end;
  }
  phases_.push_back({begin, steps.size(), completed(call, source, source.problem), nullptr});
}

solver::FieldComputation& FieldsOfSteps::computation_of(std::size_t step) {
  const auto found = std::ranges::find_if(phases_, [&](const Phase& each) { return step < each.end; });
  Phase& own = found == phases_.end() ? phases_.back() : *found;
  if (own.computation) return *own.computation;
  const auto is_other = [&](const Phase& each) {
    return each.begin < own.begin &&
           (each.problem.model != own.problem.model || each.problem.materials != own.problem.materials ||
            each.problem.properties != own.problem.properties);
  };
  solver::OtherPhases others;
  others.begin = own.begin;
  others.end = own.end;
  others.field = [this](const std::string& name, std::size_t index) -> const solver::Field& {
    return computation_of(index).whole(name, index);
  };
  others.stiffness_changes = std::ranges::any_of(phases_, is_other);
  own.computation = std::make_unique<solver::FieldComputation>(own.problem, source_.result, std::move(others));
  return *own.computation;
}

solver::Field FieldsOfSteps::compute(std::string_view name, std::size_t step,
                                     std::optional<std::span<const int>> cells) {
  return computation_of(step).compute(name, step, cells);
}

void FieldsOfSteps::warn_of_other_materials(interpreter::Diagnostics& diagnostics) const {
  const auto differs = [&](const char* keyword, const auto& is_other) {
    if (!call_.has(keyword)) return;
    if (!is_other(source_.problem) &&
        std::ranges::none_of(source_.earlier, [&](const EarlierPhase& each) { return is_other(each.problem); }))
      return;
    diagnostics.alarm(
        "other-materials",
        fmt::format(
            "{}: {} is not what {} was computed with: what follows from displacements is of what is given here, "
            "and stresses, forces and internal variables that the result holds are not",
            call_.command, keyword, call_.concept_of("RESULTAT")->name),
        call_.span_of(keyword), fmt::format("leave out {}, or solve with what it gives", keyword));
  };
  differs("CHAM_MATER", [&](const solver::StaticProblem& problem) {
    const auto& given = call_.data<MaterialFieldConcept>("CHAM_MATER").field;
    if (!problem.materials || given.has_made(problem.materials)) return false;
    return given.get()->by_cell != problem.materials->by_cell || !given.get()->variables.empty() ||
           !problem.materials->variables.empty();
  });
  differs("CARA_ELEM", [&](const solver::StaticProblem& problem) {
    return problem.properties && call_.data<PropertiesConcept>("CARA_ELEM").properties != problem.properties;
  });
}

void FieldsOfSteps::warn_of_limited_sources(interpreter::Diagnostics& diagnostics) const {
  std::set<std::string> limited;
  for (const Phase& phase : phases_)
    if (phase.computation)
      limited.insert(phase.computation->limited_sources().begin(), phase.computation->limited_sources().end());
  warn_of_limited_fields(call_, limited, diagnostics);
}

void warn_of_limited_fields(const Call& call, const std::set<std::string>& fields,
                            interpreter::Diagnostics& diagnostics) {
  if (fields.empty()) return;
  const bool many = fields.size() > 1;
  diagnostics.alarm(
      "limited-field",
      fmt::format("{}: CALC_CHAMP computed {} of {} on some cells only, and what follows from {} lacks the others",
                  call.command, fmt::join(fields, ", "), call.concept_of("RESULTAT")->name, many ? "them" : "it"),
      call.span, fmt::format("compute {} on the whole model first", many ? "them" : "it"));
}

SolverChoice solver_choice(const Call& call) {
  SolverChoice choice;
  if (!call.has("SOLVEUR")) return choice;
  const Keywords& solver = call.factor("SOLVEUR");
  // PETSc is not there: the choice is comma's, as if none had been made.
  if (solver.given("METHODE") && solver.text("METHODE") != "PETSC")
    choice.method = linear_method(solver.text("METHODE"));
  if (solver.text("METHODE") == "GCPC") take_iterations(solver, choice);
  if (solver.has("NPREC")) choice.options.singular_digits = singular_digits(solver);
  constexpr int never_tested = -1;
  if (solver.has("STOP_SINGULIER") && solver.text("STOP_SINGULIER") == "NON")
    choice.options.singular_digits = never_tested;
  return choice;
}

}  // namespace comma::commands
