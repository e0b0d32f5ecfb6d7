// Finding a step, a field and a component in a result by the keywords of post-processing commands.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// The steps that NUME_ORDRE, LIST_ORDRE, INST (with PRECISION and CRITERE) or TOUT_ORDRE name; those of LIST_INST that
/// the result has; all when none is given. Throws DiagnosticError `unknown-step` listing the steps there are.
std::vector<const solver::ResultStep*> selected_steps(const interpreter::Keywords& keywords,
                                                      const solver::Result& result);

/// A list of instants is one of computations as a rule: alarm `unknown-step` where RESULTAT, if that is given, has no
/// step at some of LIST_INST.
void warn_of_missing_instants(const char* command, const interpreter::Keywords& keywords,
                              interpreter::Diagnostics& diagnostics);

/// What `keywords` say of a value's place within a cell counts for nothing where the field is one at nodes: alarm
/// `idle-keyword` for each of `idle` that is given.
void warn_of_idle_places(const char* command, const interpreter::Keywords& keywords, std::span<const char* const> idle,
                         interpreter::Diagnostics& diagnostics);

/// How near a stored instant must lie to the one asked for; see nearest_step.
struct InstantTolerance {
  double precision = 1e-6;
  bool relative = true;

  double reach(double instant) const { return relative && instant != 0.0 ? precision * std::abs(instant) : precision; }
  /// Whether a step that stands there is the one `wanted`.
  bool meets(double wanted, double stands) const { return std::abs(wanted - stands) <= reach(wanted); }
};

/// Index of the step that stands nearest to an instant, of those within the tolerance, the first of equals; the number
/// of steps where none does.
std::size_t nearest_step(const solver::Result& result, double instant, const InstantTolerance& tolerance);

/// PRECISION and CRITERE, but in TEST_* the second values of TOLE_MACHINE and CRITERE, whose first ones are the
/// verdict's (U4.92.01).
InstantTolerance instant_tolerance(const interpreter::Keywords& keywords);

/// How far from `instant` a step may stand to be meant (see instant_tolerance).
double instant_reach(const interpreter::Keywords& keywords, double instant);

/// Of `wanted` instants those between the first and the last of `computed`, rising, at which none of these stands.
std::vector<double> missed_instants(const InstantTolerance& tolerance, std::span<const double> wanted,
                                    std::span<const double> computed);

/// The one step that the keywords name. Throws DiagnosticError `wrong-count` with the reason for one alone when they
/// name several.
const solver::ResultStep& only_step(const interpreter::Keywords& keywords, const solver::Result& result,
                                    const char* reason);

/// Of the selected steps those that hold the field NOM_CHAM: a file that names no step, or a list of instants, means
/// all that have it (the initial state has no contact field, say). Throws as selected_steps and field_of where a step
/// is named, or none has the field.
std::vector<const solver::ResultStep*> steps_with_field(const interpreter::Keywords& keywords,
                                                        const solver::Result& result);

/// The field of a step. Throws DiagnosticError `unknown-field` at NOM_CHAM listing the fields there are,
/// `layered-field` where plates have several values a point.
const solver::Field& field_of(const interpreter::Keywords& keywords, const solver::ResultStep& step);
/// The same, whatever number of values its points have; `name`: one of those that NOM_CHAM gives.
const solver::Field& layered_field_of(const interpreter::Keywords& keywords, const solver::ResultStep& step,
                                      const std::string& name);
/// Whether some points have several values, one for each place in the thickness of a plate.
bool is_layered(const solver::Field& field);
/// Throws DiagnosticError `layered-field` where they have.
void require_one_value_a_point(const std::string& name, const solver::Field& field, const interpreter::Span& span);

/// Which of the values of a point of the cell SOUS_POINT names, from 0. Throws DiagnosticError `missing-keyword` where
/// there are several and it names none, `out-of-bounds`.
int sub_point(const interpreter::Keywords& keywords, const solver::ElementField& field, int cell,
              const solver::Mesh& mesh);

/// The multipliers of AFFE_CHAR_MECA that stand among the values of DEPL (ssnp140a); none without a computation behind
/// the result.
std::vector<double> multipliers_of(const ResultConcept& data, const solver::ResultStep& step);

/// A field of internal variables with their names as components, for NOM_VARI. Throws DiagnosticError
/// `incompatible-field` at NOM_CHAM for another field.
solver::Field by_variable_names(const interpreter::Keywords& keywords, const solver::Field& field,
                                const solver::BehaviourOfCells* behaviours);

/// Index of a component among a field's names. Throws DiagnosticError `unknown-component` at the keyword, listing them.
int component_of(const interpreter::Keywords& keywords, const std::vector<std::string>& components,
                 const std::string& name, const char* keyword = "NOM_CMP");

/// What a command that computes fields of RESULTAT gives back: with reuse= nothing, for `add` then works on that result
/// itself; else a new result with the fields of RESULTAT and those that `add` puts beside them.
Product result_with(const interpreter::Call& call, const std::function<void(ResultConcept&)>& add);

}  // namespace comma::commands
