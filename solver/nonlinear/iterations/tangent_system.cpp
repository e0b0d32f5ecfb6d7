#include "solver/nonlinear/iterations/tangent_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/constraints/rigid_motion.hpp"
#include "solver/constraints/solid_unknowns.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/mesh/disjoint_sets.hpp"
#include "solver/stopwatch.hpp"

namespace comma::solver {

namespace {

/// Beyond, the rounding of squares hides what holds a body.
constexpr int most_gram_digits = 15;
/// A support whose pivot has lost more digits counts as none, where contact is to hold the body.
constexpr int weak_support_digits = 4;
/// Of displacements that a correction is added to, in |K| |u|: less than what counts as rounding of a residual.
constexpr double rounding_of_state = 4e-15;
/// And no more than this share of the load: what is itself rounding is to vanish where nothing else acts.
constexpr double negligible_residual = 1e-10;

bool has_pivots(LinearMethod method) {
  return method != LinearMethod::conjugate_gradient && method != LinearMethod::multigrid;
}

/// From the lower triangle of a matrix whose pattern has room for it.
void subtract_symmetric_half(const Eigen::SparseMatrix<double>& change, SymmetricMatrix& matrix) {
  for (int column = 0; column < change.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(change, column); it; ++it) {
      const int row = static_cast<int>(it.row());
      matrix.coeffRef(std::max(row, column), std::min(row, column)) -= (row == column ? 1.0 : 0.5) * it.value();
    }
  }
}

bool is_elastic(TangentKind kind) { return kind == TangentKind::elastic || kind == TangentKind::unloading; }

}  // namespace

bool is_tangent_due(const TangentPolicy& policy, const TangentSystem& tangent, int iteration, int steps) {
  if (!tangent.is_ready() || tangent.is_constant()) return true;
  if (iteration == 1) return policy.steps > 0 && steps % policy.steps == 0;
  return policy.iterations > 0 && (iteration - 1) % policy.iterations == 0;
}

TangentSystem::TangentSystem(const Model& model, const DofMap& dofs, const Assembler& assembler,
                             const Elimination& elimination, const NewtonOptions& options, Counters& counters)
    : model_(model),
      dofs_(dofs),
      assembler_(assembler),
      elimination_(elimination),
      options_(options),
      counters_(counters),
      is_saddle_(model.is_mixed()),
      linear_(options.linear) {}

bool TangentSystem::is_known(TangentKind kind) const {
  if (!factorised_ || version_ != assembler_.stiffness_version()) return false;
  return is_constant() ||
         (!followers_ && kind == TangentKind::elastic && kind_ == kind && assembler_.is_initially_linear());
}

bool TangentSystem::refresh(const Eigen::VectorXd& u, TangentKind kind) {
  if (is_known(kind) || (elimination_.reduced_size() == 0 && is_constant())) return false;
  version_ = assembler_.stiffness_version();
  kind_ = kind;
  factorised_ = false;
  const SkewMatrix skew_half = is_symmetric() ? SkewMatrix() : skew(u, kind);
  SymmetricMatrix reduced = assembled_anew(u, kind, skew_half);
  if (reduced.rows() == 0) return false;
  try {
    if (is_symmetric())
      factorise(std::move(reduced));
    else
      factorise(reduced, elimination_.reduce_skew(skew_half));
  } catch (const Error& error) {
    if (error.code() == "singular-matrix" && !is_elastic(kind) && is_held_elastically(u))
      throw Error(
          error.code(),
          std::string("the bodies are held, but flow so that nothing resists the loads any more; ") + error.what(),
          "the loads may be more than the bodies can bear (look at the instant before); else take smaller steps, or "
          "drive by displacements (DDL_IMPO, PILOTAGE)");
    throw;
  }
  return true;
}

/// Whether the elastic stiffness has a factor where the tangent has none.
bool TangentSystem::is_held_elastically(const Eigen::VectorXd& u) {
  if (assembler_.is_linear() || !solver_ || !has_pivots(solver_->method())) return false;
  return factorise_with(solver_->method(), assembled(u, TangentKind::unloading)).verdict != FactorVerdict::singular;
}

void TangentSystem::forget() {
  factorised_ = false;
  solver_.reset();
  unsymmetric_.reset();
  known_.forget();
}

bool TangentSystem::spring_weak_supports() {
  if (!may_add_springs_ || linear_.singular_digits == weak_support_digits || !solver_ ||
      !has_pivots(solver_->method()) || lost_digits_ <= weak_support_digits)
    return false;
  linear_.singular_digits = weak_support_digits;
  forget();
  return true;
}

SymmetricMatrix TangentSystem::stiffness(const Eigen::VectorXd& u, TangentKind kind) const {
  const auto of_bodies = [&] {
    switch (kind) {
      case TangentKind::elastic:
        return assembler_.initial_stiffness(u);
      case TangentKind::unloading:
        return assembler_.elastic_stiffness(u);
      case TangentKind::starting:
        return assembler_.starting_stiffness(u);
      case TangentKind::tangent:
        break;
    }
    return stays_symmetric_ ? assembler_.symmetric_stiffness(u) : assembler_.stiffness(u);
  };
  SymmetricMatrix whole = of_bodies();
  if (followers_) subtract_symmetric_half(followers_->tangent(u), whole);
  return whole;
}

Eigen::VectorXd TangentSystem::reduced_forces(const Eigen::VectorXd& u, const Eigen::VectorXd& d,
                                              TangentKind kind) const {
  const Eigen::VectorXd all = is_constant() ? Eigen::VectorXd(forces(u, d, kind)) : Eigen::VectorXd(held_columns_ * d);
  return elimination_.transformation().transpose() * all;
}

Eigen::MatrixXd TangentSystem::forces(const Eigen::VectorXd& u, const Eigen::MatrixXd& d, TangentKind kind) const {
  const Stopwatch stopwatch(counters_.assembling);
  const SymmetricMatrix matrix = stiffness(u, kind);
  Eigen::MatrixXd forces = matrix.selfadjointView<Eigen::Lower>() * d;
  if (!is_symmetric()) {
    const SkewMatrix lower = skew(u, kind);
    forces += lower * d - lower.transpose() * d;
  }
  return forces;
}

double TangentSystem::largest_term(const Eigen::VectorXd& u) const {
  const SymmetricMatrix whole = stiffness(u, TangentKind::tangent);
  double largest = 0.0;
  for (int column = 0; column < whole.outerSize(); ++column)
    for (SymmetricMatrix::InnerIterator it(whole, column); it; ++it) largest = std::max(largest, std::abs(it.value()));
  return largest;
}

SymmetricMatrix TangentSystem::assembled(const Eigen::VectorXd& u, TangentKind kind) const {
  const Stopwatch stopwatch(counters_.assembling);
  return reduce(stiffness(u, kind));
}

/// To be factorised: held_forces() are those of this one. Empty where nothing is free.
SymmetricMatrix TangentSystem::assembled_anew(const Eigen::VectorXd& u, TangentKind kind, const SkewMatrix& skew_half) {
  const Stopwatch stopwatch(counters_.assembling);
  SymmetricMatrix whole = stiffness(u, kind);
  if (!is_constant()) take_held_rows(whole, skew_half);
  return elimination_.reduced_size() == 0 ? SymmetricMatrix() : reduce(std::move(whole));
}

SymmetricMatrix TangentSystem::reduce(SymmetricMatrix whole) const {
  SymmetricMatrix reduced = elimination_.reduce(std::move(whole));
  for (const auto& [row, stiffness] : springs_) reduced.coeffRef(row, row) += stiffness;
  return reduced;
}

void TangentSystem::take_held_rows(const SymmetricMatrix& whole, const SkewMatrix& skew_half) {
  std::vector<char> held(static_cast<std::size_t>(dofs_.size()), 1);
  for (const int dof : elimination_.kept()) held[static_cast<std::size_t>(dof)] = 0;
  std::vector<Eigen::Triplet<double>> rows, columns;
  const auto take_term = [&](int i, int j, double value) {
    if (held[static_cast<std::size_t>(i)] != 0) rows.emplace_back(i, j, value);
    if (held[static_cast<std::size_t>(j)] != 0) columns.emplace_back(i, j, value);
  };
  const auto take = [&](const auto& lower, double across) {
    for (int column = 0; column < lower.outerSize(); ++column)
      for (typename std::decay_t<decltype(lower)>::InnerIterator it(lower, column); it; ++it) {
        const auto i = static_cast<int>(it.row()), j = static_cast<int>(it.col());
        take_term(i, j, it.value());
        if (i != j) take_term(j, i, across * it.value());
      }
  };
  take(whole, 1.0);
  take(skew_half, -1.0);
  held_rows_.resize(dofs_.size(), dofs_.size());
  held_rows_.setFromTriplets(rows.begin(), rows.end());
  held_columns_.resize(dofs_.size(), dofs_.size());
  held_columns_.setFromTriplets(columns.begin(), columns.end());
}

std::string TangentSystem::unheld() const { return springs_.empty() ? std::string() : parts_on_springs(nullptr); }

std::string TangentSystem::unheld_beside(const RowMatrix& held) const {
  return springs_.empty() || !is_constant() ? std::string() : parts_on_springs(&held);
}

std::string TangentSystem::parts_on_springs(const RowMatrix* held) const {
  std::vector<int> rows;
  for (const auto& spring : springs_) rows.push_back(spring.first);
  const TangentKind kind = is_constant() ? TangentKind::tangent : TangentKind::unloading;
  const SymmetricMatrix reduced = elimination_.reduce(stiffness(Eigen::VectorXd::Zero(dofs_.size()), kind));
  return describe(find_free_parts(*model_.mesh, dofs_, elimination_, reduced, rows, linear_.singular_digits, held),
                  *model_.mesh);
}

/// The skew half of the tangent, by its strictly lower triangle.
SkewMatrix TangentSystem::skew(const Eigen::VectorXd& u, TangentKind kind) const {
  SkewMatrix matrix = kind == TangentKind::elastic     ? assembler_.initial_skew_stiffness(u)
                      : kind == TangentKind::unloading ? assembler_.elastic_skew_stiffness(u)
                                                       : assembler_.skew_stiffness(u);
  if (!followers_) return matrix;
  const SkewMatrix change = followers_->tangent(u);
  const SkewMatrix transposed = change.transpose();
  const SkewMatrix half = 0.5 * (change - transposed);
  const SkewMatrix lower = half.triangularView<Eigen::StrictlyLower>();
  return matrix - lower;
}

/// Springs at the rows without a pivot, as stiff as the bodies are there. Whether there were any to add.
bool TangentSystem::add_springs(const FactorReport& report, SymmetricMatrix& reduced) {
  if (!may_add_springs_ || report.null_rows.empty()) return false;
  const Eigen::VectorXd diagonal = reduced.diagonal();
  const double otherwise = largest_component(diagonal);
  for (const int row : report.null_rows) {
    const double own = diagonal[row];
    springs_.emplace_back(row, own > 0.0 ? own : otherwise);
    reduced.coeffRef(row, row) += springs_.back().second;
  }
  return true;
}

/// Multigrid where it is the fastest and safe, else what suits the matrix.
LinearMethod TangentSystem::chosen_method(const SymmetricMatrix& reduced) {
  if (options_.method) return *options_.method;
  const LinearMethod direct = choose_method(reduced);
  if (direct == LinearMethod::mumps || multigrid_failed_ || !options_.few_solutions || !is_constant() ||
      reduced.rows() < large_solid)
    return direct;
  linear_.solid = solid_unknowns(model_, dofs_, elimination_);
  return linear_.solid ? LinearMethod::multigrid : direct;
}

FactorReport TangentSystem::factorise_with(LinearMethod method, const SymmetricMatrix& reduced) {
  const Stopwatch stopwatch(counters_.factorising);
  if (!solver_ || solver_->method() != method) {
    solver_ = make_linear_solver(method, linear_);
    solver_->analyse(reduced);
  }
  ++counters_.factorisations;
  known_.forget();
  return solver_->factorise(reduced);
}

void TangentSystem::factorise(SymmetricMatrix reduced) {
  // One round a rigid motion is enough: each takes at least one away.
  constexpr int most_rounds = 12;
  FactorReport report = factorise_with(solver_ ? solver_->method() : chosen_method(reduced), reduced);
  if (report.verdict == FactorVerdict::indefinite && !options_.method && solver_->method() != LinearMethod::mumps) {
    // The choice was ours and it does not pivot: the solver that does takes over.
    report = factorise_with(LinearMethod::mumps, reduced);
  }
  if (report.verdict == FactorVerdict::singular && choose_method(reduced) == LinearMethod::mumps &&
      solver_->method() != LinearMethod::mumps) {
    // Of a matrix with zeros on its diagonal a method without interchanges may lose a pivot that is there.
    report = factorise_with(LinearMethod::mumps, reduced);
  }
  for (int round = 0; round < most_rounds && report.verdict == FactorVerdict::singular && add_springs(report, reduced);
       ++round) {
    report = factorise_with(solver_->method(), reduced);
  }
  // Iterations have no pivots: what moves freely is looked for before they start.
  const int digits = linear_.singular_digits;
  const bool pivots = has_pivots(solver_->method());
  if (!pivots && !find_free_parts(*model_.mesh, dofs_, elimination_, reduced, {}, digits).empty()) {
    report.verdict = FactorVerdict::singular;
  }
  if (report.verdict == FactorVerdict::singular) {
    throw singular_matrix_error(*model_.mesh, dofs_, elimination_, reduced, report, digits);
  }
  is_indefinite_ = report.verdict == FactorVerdict::indefinite && !is_saddle_;
  if (is_indefinite_) ++counters_.indefinite_factorisations;
  lost_digits_ = pivots ? report.lost_digits : std::numeric_limits<double>::digits10;
  measure_rows(reduced);
  factorised_ = true;
}

void TangentSystem::factorise(const SymmetricMatrix& reduced, const SkewMatrix& skew) {
  if (options_.method == LinearMethod::conjugate_gradient) {
    throw Error("unsupported",
                "conjugate gradients need a symmetric stiffness, and here an element has an unsymmetric one",
                "choose a direct solver");
  }
  if (!unsymmetric_) unsymmetric_ = std::make_unique<UnsymmetricSolver>(options_.linear);
  ++counters_.factorisations;
  const FactorReport report = [&] {
    const Stopwatch stopwatch(counters_.factorising);
    return unsymmetric_->factorise(reduced, skew);
  }();
  if (report.verdict == FactorVerdict::singular) {
    // Energies are those of K^T K, where a support's digits count twice.
    const int digits = std::min(2 * std::max(0, options_.linear.singular_digits), most_gram_digits);
    throw singular_matrix_error(*model_.mesh, dofs_, elimination_, gram_matrix(full_matrix(reduced, skew)), report,
                                digits);
  }
  measure_rows(reduced);
  factorised_ = true;
}

void TangentSystem::measure_rows(const SymmetricMatrix& reduced) {
  row_sizes_ = rotation_sizes_ = Eigen::VectorXd::Zero(reduced.rows());
  const std::span<const int> kept = elimination_.kept();
  const auto add = [&](Eigen::Index row, Eigen::Index column, double size) {
    row_sizes_[row] += size;
    if (is_rotation(dofs_.component_of(kept[static_cast<std::size_t>(column)]))) rotation_sizes_[row] += size;
  };
  for (int column = 0; column < reduced.outerSize(); ++column)
    for (SymmetricMatrix::InnerIterator it(reduced, column); it; ++it) {
      add(it.row(), column, std::abs(it.value()));
      if (it.row() != column) add(column, it.row(), std::abs(it.value()));
    }
}

/// The number of each node's body.
std::vector<int> TangentSystem::bodies() const {
  const Mesh& mesh = *model_.mesh;
  DisjointSets sets(mesh.node_count());
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (model_.formulations[static_cast<std::size_t>(cell)] == Formulation::none) continue;
    for (const int node : mesh.cell(cell)) sets.join(mesh.cell(cell).front(), node);
  }
  const Eigen::SparseMatrix<double>& transformation = elimination_.transformation();
  for (int column = 0; column < transformation.outerSize(); ++column) {
    const int kept = dofs_.node_of(elimination_.kept()[static_cast<std::size_t>(column)]);
    for (Eigen::SparseMatrix<double>::InnerIterator it(transformation, column); it; ++it)
      sets.join(kept, dofs_.node_of(static_cast<int>(it.row())));
  }
  std::vector<int> body(static_cast<std::size_t>(mesh.node_count()));
  for (int node = 0; node < mesh.node_count(); ++node) body[static_cast<std::size_t>(node)] = sets.root(node);
  return body;
}

double& TangentSystem::Largest::of(Component component) {
  return component <= Component::dz ? translation : is_rotation(component) ? rotation : other;
}

std::vector<TangentSystem::Largest> TangentSystem::largest_of_bodies(const Eigen::VectorXd& u) const {
  if (body_of_node_.empty()) body_of_node_ = bodies();
  std::vector<Largest> largest(body_of_node_.size());
  for (int dof = 0; dof < dofs_.size(); ++dof) {
    double& most = largest[body_of(dof)].of(dofs_.component_of(dof));
    most = std::max(most, std::abs(u[dof]));
  }
  return largest;
}

Eigen::VectorXd TangentSystem::magnitudes(const Eigen::VectorXd& u) const {
  std::vector<Largest> largest = largest_of_bodies(u);
  Eigen::VectorXd result(dofs_.size());
  for (int dof = 0; dof < dofs_.size(); ++dof) result[dof] = largest[body_of(dof)].of(dofs_.component_of(dof));
  return result;
}

Eigen::VectorXd TangentSystem::sizes_times(const Eigen::VectorXd& u) const {
  const std::vector<Largest> largest = largest_of_bodies(u);
  Eigen::VectorXd result(row_sizes_.size());
  for (Eigen::Index row = 0; row < result.size(); ++row) {
    const Largest& own = largest[body_of(elimination_.kept()[static_cast<std::size_t>(row)])];
    result[row] = std::max(own.translation, own.other) * (row_sizes_[row] - rotation_sizes_[row]) +
                  own.rotation * rotation_sizes_[row];
  }
  return result;
}

Eigen::MatrixXd TangentSystem::compliance(const RowMatrix& rows) {
  if (!gives_compliance()) return {};
  if (solver_->factorises_for_compliance()) ++counters_.factorisations;
  const Stopwatch stopwatch(counters_.factorising);
  return solver_->compliance(rows);
}

void TangentSystem::solve_correction(Eigen::Ref<Eigen::MatrixXd> column, const Eigen::VectorXd& u) {
  Eigen::VectorXd rounding;
  if (row_sizes_.size() == column.rows() && loses_few_digits())
    rounding = (rounding_of_state * sizes_times(u)).cwiseMin(negligible_residual * largest_component(column.col(0)));
  solve_once(column, rounding);
}

void TangentSystem::solve_once(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::VectorXd& rounding) {
  if (unsymmetric_ || !has_factor()) {
    solve(columns);
    return;
  }
  if (columns.rows() == 0) return;
  const Stopwatch stopwatch(counters_.solving);
  const bool may_be_known = columns.cols() == 1 && !is_saddle_;
  if (may_be_known && known_.take(columns.col(0), row_sizes_, rounding)) return;
  counters_.solves += columns.cols();
  Eigen::VectorXd load;
  if (may_be_known) load = columns.col(0);
  solver_->solve_once(columns);
  if (may_be_known) known_.add(std::move(load), columns.col(0));
}

void TangentSystem::solve(Eigen::Ref<Eigen::MatrixXd> columns) {
  if (columns.rows() == 0) return;
  counters_.solves += columns.cols();
  if (unsymmetric_) {
    const Stopwatch stopwatch(counters_.solving);
    unsymmetric_->solve(columns);
    return;
  }
  const Eigen::MatrixXd loads = has_factor() ? Eigen::MatrixXd() : Eigen::MatrixXd(columns);
  try {
    const Stopwatch stopwatch(counters_.solving);
    solver_->solve(columns);
  } catch (const Error& error) {
    if (has_factor() || error.code() != "no-convergence") throw;
    // Multigrid was our choice: what it cannot solve goes to the method that needs more time and memory.
    columns = loads;
    solver_.reset();
    linear_.solid.reset();
    multigrid_failed_ = true;
    factorise(assembled(Eigen::VectorXd::Zero(elimination_.full_size()), kind_));
    const Stopwatch stopwatch(counters_.solving);
    solver_->solve(columns);
  }
}

}  // namespace comma::solver
