#include "solver/nonlinear/failure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace comma::solver {
namespace {

std::string table(std::span<const IterationReport> history) {
  std::string text = "\n  iteration  relative    absolute    largest at          active  changed";
  for (const IterationReport& line : history)
    text += fmt::format("\n  {:9}  {:<10.3e}  {:<10.3e}  {:<18}  {:6}  {:7}", line.iteration, line.relative_residual,
                        line.absolute_residual, line.worst, line.active_conditions, line.contact_changes);
  return text;
}

/// Of a linear problem, a residual beyond this share of the loads is not what rounding leaves.
constexpr double unbalanced_share = 1e-2;

/// Of a nonlinear one, a residual below the first share of the loads is; below the second, one that iterations no
/// longer shrink.
constexpr double residual_rounding_share = 1e-12, resting_share = 1e-8;

bool is_unbalanced(std::span<const IterationReport> history, bool is_linear) {
  return is_linear && std::ranges::any_of(history, [](const IterationReport& each) {
           return each.relative_residual > unbalanced_share;
         });
}

/// The later half of the iterations has not brought a tenth of what the earlier one left.
bool is_at_rest(std::span<const IterationReport> history) {
  constexpr std::size_t enough = 8;
  if (history.size() < enough) return false;
  const auto least = [](std::span<const IterationReport> part) {
    return std::ranges::min(part, {}, &IterationReport::absolute_residual).absolute_residual;
  };
  const std::size_t half = history.size() / 2;
  return least(history.subspan(half)) > 0.1 * least(history.first(half));
}

bool is_rounding(std::span<const IterationReport> history) {
  const IterationReport& last = history.back();
  if (last.relative_residual < 0.0 || last.contact_changes > 0) return false;
  return last.relative_residual < residual_rounding_share ||
         (last.relative_residual < resting_share && is_at_rest(history));
}

constexpr std::string_view hold_it =
    "hold by DDL_IMPO what contact does not; a body that begins with a gap is closed by CONTACT_INIT='OUI' (ZONE, "
    "FORMULATION='CONTINUE'); else look at which way the loads push and the normals point, and whether friction can "
    "bear them";

constexpr std::string_view smaller_steps_may_not_help =
    "hold by DDL_IMPO what contact does not: where nothing balances the loads, smaller steps do not help";

/// The residual is the same as so many iterations before, in the last ones.
bool comes_again(std::span<const IterationReport> history, std::size_t period) {
  constexpr std::size_t enough = 6;
  constexpr double same = 1e-3;
  if (history.size() < enough) return false;
  const auto last = history.last(enough);
  for (std::size_t k = period; k < enough; ++k)
    if (std::abs(last[k].absolute_residual - last[k - period].absolute_residual) > same * last[k].absolute_residual)
      return false;
  return true;
}

bool stands_still(std::span<const IterationReport> history) { return comes_again(history, 1); }
/// More iterations bring no other residuals.
bool goes_to_and_fro(std::span<const IterationReport> history) { return comes_again(history, 2); }

struct Diagnosis {
  std::string_view cause, remedy;
};

Diagnosis diagnosis_of_unbalanced(const IterationReport& last, const IteratedProblem& problem) {
  if (!problem.unheld.empty())
    return {"nothing balances the loads: a body moves along what neither supports nor contact hold", hold_it};
  if (!problem.has_contact)
    return {"the loads are lost in the rounding of larger forces, such as those of displacements that are imposed",
            "say how much may be left of them (RESI_GLOB_MAXI, a force)"};
  return {last.active_conditions == 0
              ? "nothing balances the loads: no condition of contact holds the body, and nothing else does"
              : "the conditions of contact do not balance the loads: the body moves along them",
          "look at which surfaces face each other (GROUP_MA_MAIT, GROUP_MA_ESCL, their normals, what is excluded) and "
          "where the loads push, or hold the body by DDL_IMPO"};
}

/// Whether a residual was so much larger than the first that no step could have meant it.
bool has_run_away(std::span<const IterationReport> history) {
  constexpr double far = 1e6;
  return std::ranges::any_of(history, [&](const IterationReport& each) {
    return each.absolute_residual > far * history.front().absolute_residual;
  });
}

Diagnosis likely_cause(std::span<const IterationReport> history, const IteratedProblem& problem) {
  constexpr std::string_view raise_limit = "raise RESI_GLOB_MAXI or RESI_GLOB_RELA",
                             iterate_more = "take smaller steps, or allow more iterations (ITER_GLOB_MAXI)";
  const IterationReport& last = history.back();
  if (!std::isfinite(last.absolute_residual) && has_run_away(history))
    return {"iterations diverge, until forces are beyond what numbers hold",
            "take smaller steps, search along the corrections (RECH_LINEAIRE), or write MATRICE='TANGENTE' where it is "
            "'ELASTIQUE'"};
  if (!std::isfinite(last.absolute_residual))
    return {"the residual is not a number: forces or properties are unbounded",
            "check the materials, sections and load functions"};
  if (is_unbalanced(history, problem.is_linear)) return diagnosis_of_unbalanced(last, problem);
  if (problem.is_linear)
    return {"the limit asks for more than rounding allows: the problem is linear and solved as well as it can be",
            raise_limit};
  if (is_rounding(history))
    return {"the limit asks for more than rounding allows: of the loads, hardly a share is left", raise_limit};
  if (stands_still(history))
    return {"the residual falls no more",
            "more iterations do not help: where a material flows without hardening the loads may be more than the "
            "bodies can bear (look at the instant before); else take smaller steps, or search along the correction "
            "(RECH_LINEAIRE)"};
  if (goes_to_and_fro(history))
    return {"the iterations go to and fro between the same states",
            "take smaller steps, or search along the correction (RECH_LINEAIRE): more iterations do not help"};
  if (last.contact_changes > 0)
    return {"the contact status still changes from one iteration to the next", iterate_more};
  if (history.size() > 1 && last.absolute_residual > history.front().absolute_residual)
    return {"the residual grows: the step is too large for Newton's method", iterate_more};
  if (problem.is_elastic)
    return {
        "the residual shrinks too slowly for the iterations allowed: the elastic stiffness, which knows "
        "neither flow nor large displacements, is far from the tangent",
        "write MATRICE='TANGENTE', take smaller steps, or allow more iterations (ITER_GLOB_MAXI)"};
  return {"the residual shrinks too slowly for the iterations allowed", iterate_more};
}

std::string but_for_contact(const std::string& unheld) { return unheld.empty() ? "" : "; but for contact " + unheld; }

/// Where statuses do not.
std::string way_to_settle(const ContactDefinition& contact) {
  const bool is_mixed = contact.formulation == ContactFormulation::mixed;
  const auto any = [&](const auto& is) {
    return std::ranges::any_of(contact.zones, [&](const ContactZone& zone) { return is(zone.mixed); });
  };
  std::string way = "take smaller steps";
  if (any([](const MixedZone& zone) { return zone.penalised; }))
    way += is_mixed ? ", or a smaller penalty (COEF_PENA_CONT)" : ", or a smaller penalty (E_N)";
  if (any([](const MixedZone& zone) { return zone.friction_penalised && zone.friction > 0.0; }))
    way += is_mixed ? ", or a smaller one of friction (COEF_PENA_FROT), or none (ALGO_FROT='STANDARD')"
                    : ", or a smaller one of friction (E_T)";
  if (any([](const MixedZone& zone) { return zone.rule != ContactRule::automatic; }))
    way += ", or another integration rule (INTEGRATION='AUTO' puts points at the nodes)";
  const auto has_slave_normals = [](const ContactZone& zone) {
    return zone.normal_side != NormalSide::master && zone.mixed.friction > 0.0;
  };
  // Faces that meet in a node push it along a normal each.
  if (is_mixed && !contact.smooth_normals && std::ranges::any_of(contact.zones, has_slave_normals))
    way += ", or one normal a node (LISSAGE='OUI')";
  return way;
}

}  // namespace

std::string worst_place(const Eigen::VectorXd& residual, const Elimination& elimination, const DofMap& dofs,
                        const Mesh& mesh) {
  if (!residual.size()) return {};
  Eigen::Index row = 0;
  residual.cwiseAbs().maxCoeff(&row);
  const int dof = elimination.kept()[static_cast<std::size_t>(row)];
  return fmt::format("{} at {}", name_of(dofs.component_of(dof)), mesh.node_name(dofs.node_of(dof)));
}

bool is_failure_of_step(std::string_view code) {
  return code == "no-convergence" || code == "contact-cycling" || code == "singular-matrix" ||
         code == "integration-failure";
}

std::string_view short_cause(std::string_view code) {
  static constexpr std::pair<std::string_view, std::string_view> causes[] = {
      {"no-convergence", "no convergence"},
      {"contact-cycling", "contact unsettled"},
      {"singular-matrix", "singular"},
      {"integration-failure", "a law fails"},
      {"residual-diverges", "residual diverges"},
      {"residual-too-large", "residual too large"},
      {"increment-too-large", "change too large"},
      {"contact-too-deep", "contact too deep"}};
  const auto found = std::ranges::find(causes, code, &std::pair<std::string_view, std::string_view>::first);
  return found == std::end(causes) ? code : found->second;
}

Error cut_no_further(const Error& error, int times) {
  if (times == 0) return error;
  std::string message = error.what();
  message.insert(
      std::min(message.find('\n'), message.size()),
      fmt::format("; the step has been cut {} time{}, and may not be cut again", times, times == 1 ? "" : "s"));
  if (error.hint().find(smaller_steps_may_not_help) != std::string::npos)
    return Error(error.code(), message, error.hint());
  return Error(error.code(), message,
               error.hint() + (error.hint().empty() ? "" : "; or ") +
                   "let steps be cut further (SUBD_NIVEAU, SUBD_PAS_MINI of ECHEC, PAS_MINI)");
}

Error advised(const Error& error, const StaticProblem& problem, const std::string& unheld) {
  const std::string note = but_for_contact(unheld), message = error.what();
  const bool is_told = error.code() == "singular-matrix" || error.hint().find("hold by DDL_IMPO") != std::string::npos;
  if (is_failure_of_step(error.code()) && !unheld.empty() && !is_told) {
    const bool is_noted = message.find(note) != std::string::npos;
    const std::size_t end = std::min(message.find('\n'), message.size());
    return Error(error.code(), message.substr(0, end) + (is_noted ? "" : note) + message.substr(end),
                 error.hint() + (error.hint().empty() ? "" : "; or ") + std::string(smaller_steps_may_not_help));
  }
  const bool has_inequalities = !problem.unilateral.empty() || (problem.contact && !is_condensed(*problem.contact));
  if (error.code() != "singular-matrix" || !has_inequalities) return error;
  const std::string otherwise =
      problem.contact
          ? "if contact is to hold it, take FORMULATION='CONTINUE' or ALGO_CONT='PENALISATION', which do without; else "
          : "bounds alone cannot hold it: ";
  return Error(error.code(), error.what(), otherwise + error.hint());
}

bool stands_unconverged(const NewtonOptions& options, std::span<const IterationReport> history) {
  if (!options.note_unconverged || history.empty() || !std::isfinite(history.back().absolute_residual)) return false;
  options.note_unconverged(history.back().instant);
  return true;
}

void throw_no_convergence(double time, std::span<const IterationReport> history, const NewtonOptions& options,
                          const IteratedProblem& problem) {
  const IterationReport& last = history.back();
  const Diagnosis diagnosis = likely_cause(history, problem);
  throw Error(
      "no-convergence",
      fmt::format("no convergence at t = {:.6g} after {} of {} iterations: {}{}, largest residual {:.3e} ({}){}", time,
                  last.iteration, std::max(last.iteration, options.max_iterations), diagnosis.cause,
                  but_for_contact(problem.unheld), last.absolute_residual, last.worst, table(history)),
      std::string(diagnosis.remedy));
}

void throw_lost_body(double time, double sizes, const std::string& unheld) {
  throw Error("no-convergence",
              fmt::format("no convergence at t = {:.6g}: nothing balances the loads: a body has moved by {:.2g} sizes "
                          "of the mesh, along what neither supports nor contact hold{}",
                          time, sizes, but_for_contact(unheld)),
              std::string(hold_it));
}

void throw_active_set_limit(int limit, bool by_gradients) {
  if (by_gradients)
    throw Error("contact-cycling",
                fmt::format("projected conjugate gradients did not find the contact forces within {} iteration{}",
                            limit, limit == 1 ? "" : "s"),
                "raise ITER_GCP_MAXI or RESI_ABSO, or take ALGO_CONT='CONTRAINTE'");
  throw Error("contact-cycling", fmt::format("the contact status did not settle within {} changes", limit),
              "raise ITER_CONT_MULT, or check that the bodies are held without contact");
}

void throw_condensed_limit(int limit, const ContactDefinition& contact, bool has_negative_weight,
                           const std::string& unheld) {
  const std::string message = fmt::format(
      "the contact status did not settle within {} iterations on the contact rows{}", limit, but_for_contact(unheld));
  if (has_negative_weight)
    throw Error(
        "contact-cycling",
        message + "; a point of negative weight pulls where it is closed, and no set of statuses need hold",
        "take another rule: on triangles GAUSS of ORDRE_INT=3 and NCOTES of 4 have such points, GAUSS of 2 and 4 "
        "and SIMPSON have not");
  constexpr double strong_friction = 1.0;
  double friction = 0.0;
  for (const ContactZone& zone : contact.zones) friction = std::max(friction, zone.mixed.friction);
  if (friction < strong_friction || !unheld.empty())
    throw Error(
        "contact-cycling", message,
        unheld.empty()
            ? way_to_settle(contact)
            : "hold by DDL_IMPO what contact does not, look which way the loads push and the normals point; or " +
                  way_to_settle(contact));
  throw Error("contact-cycling",
              fmt::format("{}; with COULOMB = {:g} friction is stronger than the pressure that causes it, and a state "
                          "of rest need not exist, "
                          "or be the only one",
                          message, friction),
              "take a smaller COULOMB, or another number of steps");
}

void throw_geometry_failure(double time, const GeometryHistory& history, const ContactDefinition& contact) {
  constexpr std::size_t most_shown = 10;
  const std::size_t left_out = history.changes.size() - std::min(history.changes.size(), most_shown);
  std::string changes = left_out > 0 ? fmt::format("{} more, then ", left_out) : "";
  changes += fmt::format("{:.3e}", fmt::join(std::span(history.changes).subspan(left_out), ", "));
  const std::string tail = fmt::format(
      "at t = {:.6g}; change of the contact geometry at each update: {} (RESI_GEOM = {:.3g}); "
      "node {} moved most",
      time, changes, contact.geometry_tolerance, history.worst);
  if (history.cycles)
    throw Error("contact-cycling", "contact pairings return in turn without settling " + tail,
                "take smaller steps, or fix the number of updates (REAC_GEOM='CONTROLE')");
  throw Error(
      "no-convergence",
      fmt::format("the contact geometry did not settle within {} updates {}", contact.max_geometry_updates, tail),
      contact.restless_tolerance > 0.0
          ? "take smaller steps, smooth the normals (LISSAGE='OUI'), or take ALGO_RESO_GEOM='POINT_FIXE'"
          : "take smaller steps, raise ITER_GEOM_MAXI, or fix the number of updates (REAC_GEOM='CONTROLE'); where "
            "nodes slide off the end of the master surface, "
            "lengthen it, or take another TOLE_PROJ_EXT");
}

}  // namespace comma::solver
