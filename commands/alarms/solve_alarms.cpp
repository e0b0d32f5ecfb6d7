#include "commands/alarms/solve_alarms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/concepts.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/strains.hpp"

namespace comma::commands {

namespace {

/// A message and what to try.
struct Advice {
  std::string code;
  std::string message;
  std::string hint;
};

std::string exact_formulation(const solver::ContactDefinition& contact) {
  return contact.formulation == solver::ContactFormulation::mixed ? "ALGO_CONT='STANDARD'" : "ALGO_CONT='CONTRAINTE'";
}

std::string how_to_follow(const solver::ContactDefinition& contact) {
  switch (contact.geometry_update) {
    case solver::GeometryUpdate::none:
      return "let the geometry be updated: REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::controlled:
      return "take more updates (NB_ITER_GEOM), or REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::automatic:
      break;
  }
  return "write a smaller RESI_GEOM, which is a share of the displacement of the step, or take smaller steps";
}

Advice advice_on(const solver::ContactDoubt& doubt, const solver::ContactDefinition& contact,
                 const solver::Mesh& mesh) {
  const bool is_mixed = contact.formulation == solver::ContactFormulation::mixed;
  const auto number = static_cast<std::size_t>(doubt.zone);
  const bool is_adapted = number < contact.zones.size() && contact.zones[number].mixed.adapts_penalty;
  const std::string coefficient = is_mixed ? "COEF_PENA_CONT" : "E_N";
  const std::string penalty = is_adapted ? "an adapted penalty (ADAPTATION)" : coefficient;
  const std::string other = is_adapted ? "ADAPTATION='NON' and " + coefficient : coefficient;
  const std::string friction_penalty = is_mixed ? "COEF_PENA_FROT" : "E_T";
  const int zone = doubt.zone + 1;
  switch (doubt.kind) {
    case solver::DoubtKind::soft_penalty:
      return {
          "soft-penalty",
          fmt::format("with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.0f} % of what they would "
                      "without contact: "
                      "contact forces come out too small by about that share",
                      penalty, doubt.penalty, zone, doubt.length, 100.0 * doubt.share),
          fmt::format("take {} = {:.0e}, or an exact method ({})", other, doubt.wanted, exact_formulation(contact))};
    case solver::DoubtKind::deep_penalty:
      return {
          "soft-penalty",
          fmt::format(
              "with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.2g} times the size of the slave side",
              penalty, doubt.penalty, zone, doubt.length, doubt.share),
          fmt::format("take {} = {:.0e}, or an exact method ({})", other, doubt.wanted, exact_formulation(contact))};
    case solver::DoubtKind::watched_overlap:
      return {"interpenetration",
              fmt::format(
                  "node {} lies {:.3g} deep in the other surface of zone {}, where contact is watched and not enforced",
                  mesh.node_name(doubt.node), doubt.length, zone),
              "enforce contact there (RESOLUTION='OUI'), or allow the depth (TOLE_INTERP)"};
    case solver::DoubtKind::soft_bound:
      return {"soft-penalty",
              fmt::format("with COEF_PENA = {:.3g} bounds of zone {} are passed by {:.3g}, {:.0f} % of what they would "
                          "be without them: forces come out too small by about that share",
                          doubt.penalty, zone, doubt.length, 100.0 * doubt.share),
              fmt::format("take COEF_PENA = {:.0e}, or ALGO_CONT='CONTRAINTE'", doubt.wanted)};
    case solver::DoubtKind::coarse_gradients:
      return {
          "coarse-gradients",
          fmt::format("projected gradients stop with slave nodes of zone {} {:.3g} inside the master, {:.0f} % of what "
                      "they would be without contact: contact forces are wrong by about that share",
                      zone, doubt.length, 100.0 * doubt.share),
          fmt::format("take a smaller RESI_ABSO than {:.3g}, or ALGO_CONT='CONTRAINTE'", doubt.penalty)};
    case solver::DoubtKind::coarse_friction:
      return {"coarse-friction",
              fmt::format("RESI_FROT = {:.3g} ends the iterations on friction where pressures and friction of zone {} "
                          "still change by {:.2g} % of the largest: figures are those of the last iteration",
                          doubt.penalty, zone, 100.0 * doubt.share),
              "take RESI_FROT = 1e-4, which is the default"};
    case solver::DoubtKind::soft_friction:
      return {"soft-friction-penalty",
              fmt::format("with {} = {:.3g} slave nodes of zone {} that stick creep by {:.3g}, {:.0f} % of what they "
                          "would slip without friction: "
                          "friction comes out too small by about that share",
                          friction_penalty, doubt.penalty, zone, doubt.length, 100.0 * doubt.share),
              fmt::format("take {} = {:.0e}, or {}, where what sticks does not creep", friction_penalty, doubt.wanted,
                          is_mixed ? "ALGO_FROT='STANDARD'" : "FORMULATION='CONTINUE'")};
    case solver::DoubtKind::unshared_friction:
      return {"friction-by-shears",
              fmt::format("no solution was found in which points of zone {} between nodes rub by a share of the limit "
                          "of friction (R5.03.52): there friction is by shears "
                          "interpolated between the nodes, which is another discretisation",
                          zone),
              "put points on the nodes, where both are the same (INTEGRATION='AUTO' on linear faces), or take smaller "
              "steps"};
    case solver::DoubtKind::lowered_augmentation:
      return {
          "softer-coefficient",
          fmt::format("with COEF_CONT = {:.3g} no states of the points of zone {} hold the law of contact and "
                      "friction: one of {:.1g} was taken, which is in the solution where faces are partly in contact",
                      doubt.penalty, zone, doubt.wanted),
          fmt::format("take COEF_CONT = {:.0e}, put points on the nodes, where it is not in the solution "
                      "(INTEGRATION='AUTO' on linear faces), or take smaller steps",
                      doubt.wanted)};
    case solver::DoubtKind::opening_by_gaps:
      return {"opening-by-gaps",
              fmt::format("with the penalty no states of the points of zone {} between nodes hold the law of contact: "
                          "there they open by their gaps alone, whatever the pressure of the nodes",
                          zone),
              "put points on the nodes, where both are the same (INTEGRATION='AUTO' on linear faces), or take "
              "ALGO_CONT='STANDARD'"};
    case solver::DoubtKind::bridged_gap:
      return {"bridged-gap",
              fmt::format("GLISSIERE holds the surfaces of zone {} together from the first step on, and pulls node {} "
                          "across a gap of {:.3g}",
                          zone, mesh.node_name(doubt.node), doubt.length),
              "begin where the surfaces touch, or let contact open (GLISSIERE='NON'); ALARME_JEU is the gap from which "
              "on this is told"};
    case solver::DoubtKind::held_overlap:
      return {"held-overlap",
              fmt::format("conditions on displacements hold slave face {} of zone {} inside the master, {:.3g} deep, "
                          "where the penalty gives no force",
                          mesh.cell_name(doubt.cell), zone, doubt.length),
              "free its nodes along the normal, or take them out of the contact (SANS_GROUP_NO)"};
    case solver::DoubtKind::kept_facet:
      return {"kept-facet",
              fmt::format("from one update of the geometry to the next points of zone {} hop between two facets, or "
                          "off the surface, {} for one: they are left where they were, beside the facet "
                          "that they face by up to {:.2g} of its size",
                          zone, mesh.node_name(doubt.node), doubt.share),
              "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master"};
    case solver::DoubtKind::restless_geometry:
      return {"restless-geometry",
              fmt::format("updates of the contact geometry move it to and fro without coming to rest, by {:.2g} of the "
                          "displacement of a step at most, most at node {}: results are "
                          "known to about that share",
                          doubt.share, mesh.node_name(doubt.node)),
              "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master, where points hop between two "
              "facets; a smaller penalty where its rounding moves them"};
    case solver::DoubtKind::stale_geometry:
      return {"stale-geometry",
              fmt::format("the surfaces of zone {} have moved on since they were paired: the gap at {} is {:.3g} off, "
                          "{:.0f} % of what contact pushes back",
                          zone, mesh.node_name(doubt.node), doubt.length, 100.0 * doubt.share),
              how_to_follow(contact)};
    case solver::DoubtKind::strong_friction:
      return {"strong-friction",
              fmt::format("zone {} bears {:.0f} % more friction than COULOMB times what presses on it: the limit of "
                          "points between nodes is that of multipliers which they share with open points",
                          zone, 100.0 * doubt.share),
              "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
    case solver::DoubtKind::weak_friction:
      return {"weak-friction",
              fmt::format("faces of zone {} are partly in contact, and their points that slide lack {:.0f} % of the "
                          "friction that COULOMB times all that presses would be: the limit there is that of "
                          "multipliers which they share with open points",
                          zone, 100.0 * doubt.share),
              "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
    case solver::DoubtKind::coarse_face:
      return {
          "coarse-slave",
          fmt::format(
              "where faces of the slave side of zone {} are partly in contact their points overlap the master by "
              "{:.3g} on the mean, {:.0f} % of what contact pushes back: forces come out too small by about that share",
              zone, doubt.length, 100.0 * doubt.share),
          "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
    case solver::DoubtKind::passed_average:
      return {"coarse-slave",
              fmt::format(
                  "slave nodes of zone {} are inside the master, {:.3g} deep on the mean, {}: the averages over "
                  "patches of ALGO_CONT='LAC' hold it back in the mean alone",
                  zone, doubt.length,
                  std::isfinite(doubt.share) ? fmt::format("{:.0f} % of what contact pushes back", 100.0 * doubt.share)
                                             : "and contact pushes nothing back"),
              "refine the slave side there, or hold each node (ALGO_CONT='STANDARD')"};
    case solver::DoubtKind::passed_master:
      break;
  }
  const std::string hint = is_mixed
                               ? "make the finer side the slave, take more points (INTEGRATION='NCOTES', ORDRE_INT), "
                                 "or averages (ALGO_CONT='LAC')"
                               : "make the finer side the slave, or take FORMULATION='CONTINUE' with ALGO_CONT='LAC'";
  constexpr double nothing_but_rounding = 1e6;  // of what goes through, beside what is pushed back
  if (!(doubt.share < nothing_but_rounding))
    return {"coarse-slave",
            fmt::format("master nodes of zone {} have gone through the slave side, {:.3g} deep on the mean, and "
                        "contact pushes nothing back: no slave node has faced "
                        "the master",
                        zone, doubt.length),
            std::string("look which way the normals point (VECT_MAIT, VECT_ESCL, ORIE_PEAU), and what DIST_APPA, "
                        "TOLE_PROJ_EXT and SANS_GROUP_NO leave out; ") +
                (is_mixed ? "" : "or ") + hint};
  return {"coarse-slave",
          fmt::format("master nodes of zone {} go through the slave side between its nodes, {:.3g} deep on the mean, "
                      "{:.0f} % of what contact pushes "
                      "back: forces come out too small or motions too large by about that share",
                      zone, doubt.length, 100.0 * doubt.share),
          hint};
}

}  // namespace

void warn_of_contact(const interpreter::Call& call, const solver::StaticProblem& problem,
                     const solver::ContactDoubts& doubts, Context& context) {
  static const solver::ContactDefinition bounds_alone;
  if (!doubts.loose().empty())
    context.diagnostics.alarm(
        "loose-body",
        fmt::format("{}: beside closed contact {}: how far it has moved so is arbitrary", call.command, doubts.loose()),
        call.span, "hold it by DDL_IMPO, by a weak spring, or by friction");
  for (const solver::ContactDoubt& doubt : doubts.all()) {
    const Advice advice = advice_on(doubt, problem.contact ? *problem.contact : bounds_alone, *problem.model->mesh);
    context.diagnostics.alarm(advice.code, call.command + ": " + advice.message, call.span, advice.hint);
  }
}

void warn_of_used_up_steps(const interpreter::Call& call, const solver::StepPlan& plan, const ResultConcept& product,
                           Context& context) {
  if (!plan.adaptation || !product.problem.driven.empty() || product.result.steps.empty()) return;
  const double reached = product.result.steps.back().instant;
  if (reached >= plan.instants.back()) return;
  context.diagnostics.alarm("steps-used-up",
                            fmt::format("{}: ends at INST={:.6g} of {:.6g}, after {} steps, the most that are allowed",
                                        call.command, reached, plan.instants.back(), plan.adaptation->most_steps),
                            call.span, "raise NB_PAS_MAXI of DEFI_LIST_INST, or let steps grow");
}

void warn_of_unconverged_steps(const interpreter::Call& call, const std::set<double>& instants, Context& context) {
  if (instants.empty()) return;
  constexpr std::size_t most_shown = 6;
  std::vector<double> shown(
      instants.begin(),
      std::next(instants.begin(), static_cast<std::ptrdiff_t>(std::min(instants.size(), most_shown))));
  const std::string more =
      instants.size() > most_shown ? fmt::format(" and {} more", instants.size() - most_shown) : "";
  context.diagnostics.alarm(
      "not-converged",
      fmt::format("{}: the step{} to INST={}{} did not converge within the iterations allowed and stand{} as the "
                  "iterations left {}, out of balance",
                  call.command, instants.size() > 1 ? "s" : "", fmt::join(shown, ", "), more,
                  instants.size() > 1 ? "" : "s", instants.size() > 1 ? "them" : "it"),
      call.span, "allow more iterations (ITER_GLOB_MAXI), or take shorter steps; ARRET='OUI' stops at the first");
}

void warn_of_turns(const interpreter::Call& call, const ResultConcept& product, Context& context) {
  // Beyond, displacements are off in the third digit where a beam is free to change its length, and forces by E A times
  // this where it is not.
  constexpr double noticeable = 1e-3;
  const auto& behaviours = product.problem.behaviours;
  if (!behaviours || product.result.steps.empty()) return;
  const auto found = product.result.steps.back().fields.find("VARI_ELGA");
  if (found == product.result.steps.back().fields.end()) return;
  const auto& variables = std::get<solver::ElementField>(found->second);
  const int column = variables.component("V3");
  double largest = 0.0;
  int worst = 0;
  for (int cell = 0; column >= 0 && cell < static_cast<int>(behaviours->size()); ++cell) {
    if ((*behaviours)[static_cast<std::size_t>(cell)].kinematics != solver::Kinematics::large_rotations ||
        variables.points(cell) == 0)
      continue;
    if (const double left = variables.at(cell, 0, column); left > largest) {
      largest = left;
      worst = cell;
    }
  }
  if (largest <= noticeable) return;
  context.diagnostics.alarm(
      "coarse-turns",
      fmt::format(
          "{}: beams turn so far in a step (DEFORMATION='GROT_GDEP') that {} is taken for {:.2g} % longer than it is",
          call.command, product.result.mesh().cell_name(worst), 100.0 * largest),
      call.span, "take more steps: half as long ones leave half as much");
}

void warn_of_inverted_cells(const interpreter::Call& call, const ResultConcept& product, double from,
                            Context& context) {
  const auto& behaviours = product.problem.behaviours;
  if (!behaviours) return;
  for (const solver::ResultStep& step : product.result.steps) {
    const auto found = step.fields.find("DEPL");
    if (step.instant < from || found == step.fields.end()) continue;
    const auto cell =
        solver::inverted_cell(*product.problem.model, *behaviours, std::get<solver::NodalField>(found->second));
    if (!cell) continue;
    context.diagnostics.alarm(
        "inside-out",
        fmt::format("{}: cell {} is turned inside out at t = {:g}: GREEN_LAGRANGE with ELAS has stresses for that, and "
                    "a body has not",
                    call.command, product.result.mesh().cell_name(*cell), step.instant),
        call.span, "take finer cells there, or a law for such compression (ELAS_HYPER; GDEF_LOG)");
    return;
  }
}

void warn_of_unused_stresses(const interpreter::Call& call, const solver::StaticProblem& problem, int cell,
                             solver::UnusedStresses unused, Context& context) {
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  if (unused == solver::UnusedStresses::mean) {
    context.diagnostics.alarm(
        "unused-stresses",
        fmt::format(
            "{}: the mean of the stresses that ETAT_INIT/SIGM gives cell {} is not its pressure (PRES "
            "of DEPL, else 0), which follows from the change of volume with INCO_UP: of SIGM the deviator alone "
            "has an effect there",
            call.command, problem.model->mesh->cell_name(cell)),
        given.span_of("SIGM"),
        "give the displacements and pressures (DEPL) that have these stresses, or take INCO_UPG, where SIGM counts as "
        "a "
        "whole");
    return;
  }
  const bool by_strains = !problem.behaviours || (*problem.behaviours)[static_cast<std::size_t>(cell)].relation ==
                                                     solver::Relation::hyperelastic;
  context.diagnostics.alarm("unused-stresses",
                            fmt::format("{}: the stresses that ETAT_INIT/SIGM gives cell {} are not those of its {}, "
                                        "which its law takes: SIGM has no effect there",
                                        call.command, problem.model->mesh->cell_name(cell),
                                        by_strains ? "displacements (DEPL)" : "internal variables (VARI)"),
                            given.span_of("SIGM"),
                            by_strains ? "give the displacements that have these stresses"
                                       : "give the internal variables that belong to them (of DEFORMATION='GDEF_LOG' "
                                         "the last six are the stresses)");
}

void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before,
                                  Context& context) {
  if (call.has("PILOTAGE")) return;  // a path goes beyond limit points
  if (context.counters.indefinite_solutions == counters_before.indefinite_solutions) return;
  if (call.has("CONTACT")) {
    context.diagnostics.alarm(
        "indefinite-stiffness",
        fmt::format(
            "{}: without contact the stiffness is not positive definite: where contact lets go, bodies may give way",
            call.command),
        call.span,
        "compare with another formulation of contact, or with smaller steps: there may be several solutions");
    return;
  }
  context.diagnostics.alarm(
      "indefinite-stiffness",
      fmt::format("{}: the stiffness is not positive definite: some motion gives energy instead of taking it, and the "
                  "solution may be "
                  "far from that of the body",
                  call.command),
      call.span, "look for springs of negative stiffness; curved TETRA10 with NU near 0.5 need MODELISATION='3D_SI'");
}

}  // namespace comma::commands
