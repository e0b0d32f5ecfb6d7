#include "solver/linear/linear_solver.hpp"

#include "solver/error.hpp"
#include "solver/linear/cholmod_solver.hpp"
#include "solver/linear/conjugate_gradient_solver.hpp"
#include "solver/linear/eigen_ldlt_solver.hpp"
#include "solver/linear/multigrid_solver.hpp"
#include "solver/linear/mumps_solver.hpp"

namespace comma::solver {

std::string_view name_of(LinearMethod method) {
  switch (method) {
    case LinearMethod::mumps:
      return "MUMPS";
    case LinearMethod::cholmod:
      return "CHOLMOD";
    case LinearMethod::eigen_ldlt:
      return "LDLT";
    case LinearMethod::conjugate_gradient:
      return "GCPC";
    case LinearMethod::multigrid:
      return "multigrid";
  }
  return "";
}

std::unique_ptr<LinearSolver> make_linear_solver(LinearMethod method, const LinearOptions& options) {
  switch (method) {
    case LinearMethod::mumps:
      return make_mumps_solver(options);
    case LinearMethod::cholmod:
      return make_cholmod_solver(options);
    case LinearMethod::eigen_ldlt:
      return make_eigen_ldlt_solver(options);
    case LinearMethod::conjugate_gradient:
      return make_conjugate_gradient_solver(options);
    case LinearMethod::multigrid:
      return make_multigrid_solver(options);
  }
  throw Error("unsupported", "no such linear solver");
}

LinearMethod choose_method(const SymmetricMatrix& matrix) {
  const Eigen::VectorXd diagonal = matrix.diagonal();
  if ((diagonal.array() <= 0.0).any()) return LinearMethod::mumps;
  return matrix.rows() <= small_system ? LinearMethod::eigen_ldlt : LinearMethod::cholmod;
}

}  // namespace comma::solver
