// What moves freely when a stiffness is singular: the part of a scene that nothing holds, and how it moves.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/constraints/elimination.hpp"
#include "solver/error.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/linear/row_matrix.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// One connected part of the scene and the motions that the stiffness and the conditions leave it.
struct FreePart {
  std::vector<int> nodes;            ///< those that move, rising
  std::vector<std::string> motions;  ///< "translation along X", "rotation about Z through (0, 50)", ...
  bool rigid = true;                 ///< false: a mechanism; its one motion names the degrees of freedom that move most
  bool held_weakly = false;          ///< something holds a motion, but by less than the digits that a pivot may lose
  std::string remedy;                ///< "impose DX on one of its nodes, or add a spring"
};

/// The free parts behind the null rows of a reduced stiffness T^T K T (lower triangle). The rigid motions of each
/// connected part of its graph span a space of at most six dimensions; those whose energy is less than
/// 10^-singular_digits of the part's stiffness are free. Where none is, inverse iteration finds the mechanism. At most
/// `most_free_parts` are looked into. `null_rows` empty: every part is tested. `singular_digits` < 0 is taken as 8.
/// `held`: not null: rigid motions alone that these rows of the reduced unknowns leave free as well, each part by
/// itself.
std::vector<FreePart> find_free_parts(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                                      const SymmetricMatrix& reduced_stiffness, std::span<const int> null_rows,
                                      int singular_digits = LinearOptions{}.singular_digits,
                                      const RowMatrix* held = nullptr);

inline constexpr std::size_t most_free_parts = 5;

/// "nothing holds N1, N2 (2 nodes): translation along X; nothing holds ...".
std::string describe(std::span<const FreePart> parts, const Mesh& mesh);

/// The error `singular-matrix` that a factorisation's report calls for: nodes, motions, and in the hint what would hold
/// them.
Error singular_matrix_error(const Mesh& mesh, const DofMap& dofs, const Elimination& elimination,
                            const SymmetricMatrix& reduced_stiffness, const FactorReport& report,
                            int singular_digits = LinearOptions{}.singular_digits);

}  // namespace comma::solver
