// Meshes and fields as text to be read (IMPR_RESU, FORMAT="RESULTAT"; U4.91.01).
#pragma once

#include <limits>
#include <string>

#include "commands/tables/fortran_format.hpp"
#include "solver/fields/data/field.hpp"

namespace comma::commands {

struct ListingStyle {
  RealFormat reals;
  bool coordinates = false;  ///< X Y Z before the values of a node
  /// Values outside are left out.
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
};

/// One line a node, with its coordinates.
std::string listing(const solver::Mesh& mesh, const ListingStyle& style);

/// One line a node, or a point of a cell, that has any value; "-" for a component that it does not have.
std::string listing(const solver::Field& field, const solver::Mesh& mesh, const ListingStyle& style);

enum class Extremum : std::uint8_t { least, greatest };

/// For each component the extreme value within the bounds, and where it is.
std::string extreme_listing(const solver::Field& field, const solver::Mesh& mesh, const ListingStyle& style,
                            std::span<const Extremum> wanted);

}  // namespace comma::commands
