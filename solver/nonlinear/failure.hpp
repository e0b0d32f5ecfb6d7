// Why a step failed, in words.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/constraints/elimination.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// "DY at N12": where a reduced residual is largest.
std::string worst_place(const Eigen::VectorXd& residual, const Elimination& elimination, const DofMap& dofs,
                        const Mesh& mesh);

/// Of the code of an error: what a shorter step may overcome.
bool is_failure_of_step(std::string_view code);

/// The same codes, and those of the events of a plan, in a word or two.
std::string_view short_cause(std::string_view code);

/// The error of a step that has been cut so many times, and may not be again.
Error cut_no_further(const Error& error, int times);

/// An error as it is, but of a singular stiffness with what helps bodies that only inequalities hold: these are solved
/// on the compliance of bodies that stand without them; and of a step that fails with what nothing but contact holds
/// (`unheld`, in words, or empty).
Error advised(const Error& error, const StaticProblem& problem, const std::string& unheld);

/// Whether a step whose iterations are spent stands all the same, which is noted then: where the options say so and it
/// has finite residuals.
bool stands_unconverged(const NewtonOptions& options, std::span<const IterationReport> history);

/// What iterations were about.
struct IteratedProblem {
  bool is_linear = false;    ///< the tangent is the same for every displacement
  bool is_elastic = false;   ///< iterations correct by the elastic stiffness (MATRICE='ELASTIQUE')
  bool has_contact = false;  ///< or other conditions that may open
  std::string unheld{};      ///< in words, what nothing but contact holds, or empty
};

/// Error `no-convergence` of Newton's iterations: the history, the worst place, the likely cause.
[[noreturn]] void throw_no_convergence(double time, std::span<const IterationReport> history,
                                       const NewtonOptions& options, const IteratedProblem& problem);

/// Error `no-convergence`: a body that contact alone was to hold has moved by so many sizes of the mesh. `unheld`: as
/// above.
[[noreturn]] void throw_lost_body(double time, double sizes, const std::string& unheld);

/// Error `contact-cycling`: the active set needed more changes than allowed.
[[noreturn]] void throw_active_set_limit(int limit, bool by_gradients);

/// Error `contact-cycling`: the statuses of points did not settle. `has_negative_weight`: of a point, by its rule of
/// integration. `unheld`: in words, what nothing but contact holds, or empty.
[[noreturn]] void throw_condensed_limit(int limit, const ContactDefinition& contact, bool has_negative_weight,
                                        const std::string& unheld);

/// How far the geometry moved at each update, relative (RESI_GEOM), and whether pairings came back.
struct GeometryHistory {
  std::vector<double> changes;
  bool cycles = false;
  std::string worst;  ///< the node that moved most
};

/// Error `contact-cycling` when pairings return in turn, else `no-convergence` of the geometry updates.
[[noreturn]] void throw_geometry_failure(double time, const GeometryHistory& history, const ContactDefinition& contact);

}  // namespace comma::solver
