// Some eigenvalues of sparse matrices.
#pragma once

#include <vector>

#include "solver/linear/linear_solver.hpp"
#include "solver/linear/unsymmetric_solver.hpp"

namespace comma::solver {

/// A x = value B x. A is symmetric plus, where it is not null, skew; B symmetric of any signature.
struct Pencil {
  const SymmetricMatrix& a;
  const SkewMatrix* skew;
  const SymmetricMatrix& b;
};

struct EigenPairs {
  std::vector<double> values;  ///< rising
  Eigen::MatrixXd vectors;     ///< a column each, the largest entry 1
};

/// The `count` real eigenvalues of the smallest magnitude, or all if there are fewer. Complex ones, which unsymmetric
/// pencils have, are left out. Arnoldi's method on A^-1 B, implicitly restarted (R. B. Lehoucq, D. C. Sorensen, C.
/// Yang, ARPACK Users' Guide, 1998), by Spectra; all eigenvalues of a dense matrix where the system is small. Throws
/// Error `singular-matrix` where A is, `no-convergence`.
EigenPairs smallest_eigenvalues(const Pencil& pencil, int count);

/// The real eigenvalues from `first` to `last`, by the same method on (A - s B)^-1 B with s in the middle.
EigenPairs eigenvalues_between(const Pencil& pencil, double first, double last);

}  // namespace comma::solver
