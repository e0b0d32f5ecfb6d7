// Errors of materials and elements that say in which cell they are.
#pragma once

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// What compute() returns; an Error that it throws names the cell.
template <class Compute>
auto naming_cell(const Mesh& mesh, int cell, Compute&& compute) {
  try {
    return compute();
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{} (cell {})", error.what(), mesh.cell_name(cell)), error.hint());
  }
}

}  // namespace comma::solver
