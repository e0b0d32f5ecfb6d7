#include "solver/io/med_sanity.hpp"

#include <fmt/format.h>

#include <array>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// The roots under which meshes keep their arrays, and families their groups.
constexpr std::array<const char*, 2> roots = {"/ENS_MAA", "/FAS"};

/// Value of an integer attribute of a dataset or group, -1 where there is none.
long long attribute_value(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return -1;
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  if (attribute < 0) return -1;
  long long value = -1;
  const hid_t space = H5Aget_space(attribute);
  const bool single = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
  if (!single || H5Aread(attribute, H5T_NATIVE_LLONG, &value) < 0) value = -1;
  if (space >= 0) H5Sclose(space);
  H5Aclose(attribute);
  return value;
}

struct ArraySize {
  long long values = -1;  ///< values of the element type
  long long bytes = -1;
};

ArraySize size_of(hid_t dataset) {
  ArraySize size;
  const hid_t space = H5Dget_space(dataset);
  const hid_t type = H5Dget_type(dataset);
  if (space >= 0 && type >= 0) {
    size.values = H5Sget_simple_extent_npoints(space);
    size.bytes = size.values * static_cast<long long>(H5Tget_size(type));
  }
  if (space >= 0) H5Sclose(space);
  if (type >= 0) H5Tclose(type);
  return size;
}

std::string last_word(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

/// MED's three-letter codes of the cell types, which name the groups that hold their arrays.
long long nodes_of_code(std::string_view code) {
  struct Entry {
    std::string_view code;
    long long nodes;
  };
  static constexpr std::array<Entry, 21> entries = {
      {{"PO1", 1}, {"SE2", 2},  {"SE3", 3},  {"SE4", 4}, {"TR3", 3},  {"TR6", 6},  {"TR7", 7},
       {"QU4", 4}, {"QU8", 8},  {"QU9", 9},  {"TE4", 4}, {"T10", 10}, {"PY5", 5},  {"P13", 13},
       {"PE6", 6}, {"P15", 15}, {"P18", 18}, {"HE8", 8}, {"H20", 20}, {"H27", 27}, {"OCT", 12}}};
  for (const Entry& entry : entries) {
    if (entry.code == code) return entry.nodes;
  }
  return -1;
}

struct Visit {
  long long largest = 0;  ///< bytes that an array of this file can have
  std::string damage;     ///< what is wrong, empty as long as nothing is
};

/// Compressed arrays unfold, but deflate makes nothing smaller than by this factor (zlib's technical details).
constexpr long long most_unfolding = 1032;

/// What HDF5 fills up with zeros was never written. Arrays that are larger than all that the file could hold would
/// take the memory of the machine.
long long largest_array(const MedFile& file) {
  hsize_t bytes = 0;
  if (H5Fget_filesize(file.id(), &bytes) < 0) return 0;
  return static_cast<long long>(bytes) * most_unfolding;
}

/// The number of values that an array must have so that the MED library fills the caller's buffer exactly; -1: not
/// checked.
long long expected_values(hid_t root, std::string_view path, hid_t dataset) {
  const std::string name = last_word(path);
  const std::string parent(path.substr(0, path.size() - name.size() - 1));
  const long long entries = attribute_value(dataset, "NBR");
  if (name == "FAM" || name == "NUM") return entries;
  if (name == "NOD") {
    const long long nodes = nodes_of_code(last_word(parent));
    return nodes < 0 || entries < 0 ? -1 : nodes * entries;
  }
  if (name != "COO") return -1;
  const std::string mesh(path.substr(0, path.find('/')));
  const hid_t group = H5Gopen2(root, mesh.c_str(), H5P_DEFAULT);
  if (group < 0) return -1;
  long long dimension = attribute_value(group, "ESP");  // absent in old files
  if (dimension < 0) dimension = attribute_value(group, "DIM");
  H5Gclose(group);
  return dimension < 0 || entries < 0 ? -1 : dimension * entries;
}

/// Group names lie in <family>/GRO/NOM: as many blocks of 80 bytes as GRO's attribute says, and a zero in old files.
bool group_names_fit(hid_t root, std::string_view path, hid_t dataset) {
  const std::string parent(path.substr(0, path.rfind('/')));
  const hid_t group = H5Gopen2(root, parent.c_str(), H5P_DEFAULT);
  if (group < 0) return false;
  const long long names = attribute_value(group, "NBR");
  H5Gclose(group);
  const long long bytes = size_of(dataset).bytes;
  return names >= 0 && bytes >= names * MED_LNAME_SIZE && bytes <= names * MED_LNAME_SIZE + 1;
}

void check_dataset(hid_t root, std::string_view path, Visit& visit) {
  const hid_t dataset = H5Dopen2(root, std::string(path).c_str(), H5P_DEFAULT);
  if (dataset < 0) {
    visit.damage = fmt::format("array {} cannot be opened", path);
    return;
  }
  const long long expected = expected_values(root, path, dataset);
  const auto [values, bytes] = size_of(dataset);
  if (bytes > visit.largest) {
    visit.damage = fmt::format("array {} has {} values, which is more than the file can hold", path, values);
  } else if (expected >= 0 && values != expected) {
    visit.damage = fmt::format("array {} has {} values instead of {}", path, values, expected);
  } else if (path.ends_with("/GRO/NOM") && !group_names_fit(root, path, dataset)) {
    visit.damage = fmt::format("the group names in {} do not fit their number", path);
  }
  H5Dclose(dataset);
}

herr_t visit_object(hid_t root, const char* name, const H5O_info_t* info, void* data) {
  Visit& visit = *static_cast<Visit*>(data);
  if (info->type == H5O_TYPE_DATASET) check_dataset(root, name, visit);
  return visit.damage.empty() ? 0 : 1;
}

}  // namespace

void check_med_arrays(const MedFile& file) {
  for (const char* name : roots) {
    if (H5Lexists(file.id(), name, H5P_DEFAULT) <= 0) continue;
    const hid_t root = H5Oopen(file.id(), name, H5P_DEFAULT);
    Visit visit{.largest = largest_array(file), .damage = {}};
    const bool broken =
        root < 0 || H5Ovisit2(root, H5_INDEX_NAME, H5_ITER_NATIVE, visit_object, &visit, H5O_INFO_BASIC) < 0;
    if (root >= 0) H5Oclose(root);
    if (!visit.damage.empty()) throw Error("damaged-mesh", fmt::format("{}: {}", file.path(), visit.damage));
    if (broken) throw Error("damaged-mesh", fmt::format("{}: the contents of {} cannot be listed", file.path(), name));
  }
}

}  // namespace comma::solver
