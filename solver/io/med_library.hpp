// The little that the MED reader and writers share: an open file, cell types, node orders, padded names.
#pragma once

// The MED header of a parallel build mentions two types of MPI (Open MPI's definitions) for a function that we do not
// call.
using MPI_Comm = struct ompi_communicator_t*;
using MPI_Info = struct ompi_info_t*;

#include <med.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/cell_type.hpp"

namespace comma::solver {

/// Keeps the HDF5 library from printing its own error stack while it lives: our errors say what is wrong.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t handler_ = nullptr;
  void* client_data_ = nullptr;
};

/// An open MED file, closed at the end of its scope.
class MedFile {
 public:
  /// Throws Error `unreadable-file`: missing, not HDF5, or of a MED version that the library cannot read.
  static MedFile open_for_reading(const std::string& path);
  /// Replaces what is there. Throws Error `unwritable-file`.
  static MedFile create(const std::string& path);
  /// Adds to what is there. Throws Error `unreadable-file`, `unwritable-file`.
  static MedFile open_for_adding(const std::string& path);
  ~MedFile();
  MedFile(const MedFile&) = delete;
  MedFile& operator=(const MedFile&) = delete;

  med_idt id() const { return id_; }
  const std::string& path() const { return path_; }

 private:
  MedFile(std::string path, med_access_mode mode);

  QuietHdf5 quiet_;  ///< from before the file is opened until after it is closed
  med_idt id_ = -1;
  std::string path_;
};

med_geometry_type med_geometry(CellType type);
/// Nothing for the types that the mesh does not know (polygons, polyhedra, OCTA12, structural elements).
std::optional<CellType> cell_type_of(med_geometry_type geometry);

/// Entry i: the place in a MED cell of what Code_Aster's order has at place i. MED sees solids from the other side, so
/// their bases run the other way round, and it lists the middles of the edges of both bases before those of the upright
/// edges. Empty where the two orders are the same (points, lines, faces). Source: the reference elements of the MED
/// manual and of R3.01.01.
std::span<const std::int8_t> med_node_order(CellType type);

/// Cell types in the order in which Code_Aster numbers the cells of a MED file: M1 is the first point if there are
/// points, else the first line, and so on; quadrangles follow triangles, wedges come before pyramids and hexahedra.
std::span<const CellType> numbering_order();

/// The text of a fixed-width field, without the blanks and zeros that pad it.
std::string trimmed(std::string_view padded);
/// The names one after the other, each padded with blanks to `width`.
std::string padded(std::span<const std::string> names, std::size_t width);

}  // namespace comma::solver
