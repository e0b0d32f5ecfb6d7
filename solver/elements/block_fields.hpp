// Between the values that blocks of like cells have at their points (cells x points x names) and fields on all cells.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/elements/element_block.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// V1, V2 ... of internal variables.
std::vector<std::string> variable_names(int count);
std::vector<std::string> stress_names(const ElementBlock& block);

/// Where the points of each cell start, from how many each has.
std::vector<int> starts_of(const std::vector<int>& counts);

/// Values of one block into a field whose components are those of all blocks.
void write_block(const ElementBlock& block, const std::vector<std::string>& names, const std::vector<double>& values,
                 ElementField& field);

/// The way back; empty without a field. Throws Error `incompatible-field` where the field lacks a cell, a point or a
/// component.
std::vector<double> read_block(const ElementBlock& block, const std::vector<std::string>& names,
                               const ElementField* field, const Mesh& mesh);
/// The same of stresses. A cell without stress is one whatever points and components the zeros stand for: what made the
/// field knew the model alone, and how many points springs and plates have depends on their stiffness and layers.
std::vector<double> read_stresses(const ElementBlock& block, const ElementField* field, const Mesh& mesh);

/// Stresses of a load: what a cell that has some does not carry is zero; a cell without, with zeros, or with those of
/// other elements alone, has none.
std::vector<double> read_initial_stresses(const ElementBlock& block, const ElementField& field, const Mesh& mesh);

/// The stresses of a field on some cells, point after point, in the order of the components of `layout`, which has as
/// many values a cell, or all are zero; NaN without one.
std::vector<double> values_on(std::span<const int> cells, const ElementField& layout, const ElementField& field,
                              const Mesh& mesh);

}  // namespace comma::solver
