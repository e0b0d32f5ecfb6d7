#include "solver/nonlinear/tangent_system.hpp"

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

TangentSystem::TangentSystem(const Model& model, const DofMap& dofs, const Assembler& assembler,
                             const Elimination& elimination, const NewtonOptions& options, Counters& counters)
    : model_(model), dofs_(dofs), assembler_(assembler), elimination_(elimination), options_(options), counters_(counters) {}

bool TangentSystem::refresh(const Eigen::VectorXd& u) {
  if (factorised_ && assembler_.is_linear()) return false;
  if (elimination_.reduced_size() == 0) return false;
  factorise(elimination_.reduce(assembler_.stiffness(u)));
  return true;
}

void TangentSystem::factorise(const SymmetricMatrix& reduced) {
  if (!solver_) solver_ = make_linear_solver(options_.method.value_or(choose_method(reduced)), options_.linear);
  if (!analysed_) solver_->analyse(reduced);
  analysed_ = true;
  FactorReport report = solver_->factorise(reduced);
  ++counters_.factorisations;
  if (report.verdict == FactorVerdict::indefinite && !options_.method && solver_->method() != LinearMethod::mumps) {
    // The choice was ours and it does not pivot: the solver that does takes over.
    solver_ = make_linear_solver(LinearMethod::mumps, options_.linear);
    solver_->analyse(reduced);
    report = solver_->factorise(reduced);
    ++counters_.factorisations;
  }
  if (report.verdict == FactorVerdict::singular) throw_singular(reduced, report);
  factorised_ = true;
}

void TangentSystem::throw_singular(const SymmetricMatrix&, const FactorReport& report) const {
  std::string places;
  for (const int row : report.null_rows) {
    const int dof = elimination_.kept()[static_cast<std::size_t>(row)];
    places += fmt::format("{}{} at {}", places.empty() ? "" : ", ", name_of(dofs_.component_of(dof)),
                          model_.mesh->node_name(dofs_.node_of(dof)));
  }
  throw Error("singular-matrix", "the stiffness is singular: nothing holds " + places,
              "impose displacements there, or tie the body to one that is held");
}

void TangentSystem::solve(Eigen::Ref<Eigen::MatrixXd> columns) const {
  if (columns.rows() == 0) return;
  solver_->solve(columns);
  counters_.solves += columns.cols();
}

}  // namespace comma::solver
