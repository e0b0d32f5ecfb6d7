#include "solver/contact/contact_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace comma::solver {
namespace {

enum Column : std::uint8_t {
  cont,
  jeu,
  rn,
  rnx,
  rny,
  rnz,
  glix,
  gliy,
  gli,
  rtax,
  rtay,
  rtaz,
  rtgx,
  rtgy,
  rtgz,
  rx,
  ry,
  rz,
  r,
  hn,
  i,
  ix,
  iy,
  iz,
  pt_x,
  pt_y,
  pt_z,
  proj_x,
  proj_y,
  proj_z,
  column_count
};

constexpr std::array<const char*, column_count> contact_names = {
    "CONT", "JEU",  "RN",   "RNX",  "RNY",  "RNZ",  "GLIX", "GLIY",   "GLI",    "RTAX",
    "RTAY", "RTAZ", "RTGX", "RTGY", "RTGZ", "RX",   "RY",   "RZ",     "R",      "HN",
    "I",    "IX",   "IY",   "IZ",   "PT_X", "PT_Y", "PT_Z", "PROJ_X", "PROJ_Y", "PROJ_Z"};

constexpr double not_paired = -1.0;
constexpr double open = 0.0;
constexpr double sticking = 1.0;
constexpr double sliding = 2.0;
constexpr double overlapping = 3.0;

/// Bodies that touch overlap by rounding of where they are; that is no overlap.
constexpr double touching_share = 1e-12;

double status_of(const NodeContact& contact, const Eigen::Vector3d& place) {
  if (contact.pair.status == PairingStatus::watched)
    return contact.gap < -touching_share * (place.norm() + contact.pair.foot.norm()) ? overlapping : not_paired;
  if (contact.sticking) return sticking;
  return contact.closed ? sliding : open;
}

void write_places(const NodeContact& contact, Positions positions, double* row) {
  for (int axis = 0; axis < 3; ++axis) {
    row[pt_x + axis] = positions[contact.pair.slave][axis];
    row[proj_x + axis] = contact.has_foot ? contact.pair.foot[axis] : 0.0;
  }
}

void write_state(const NodeContact& contact, Positions positions, double* row) {
  row[cont] = status_of(contact, positions[contact.pair.slave]);
  row[jeu] = contact.gap;
  write_places(contact, positions, row);
  row[glix] = contact.slip[0];
  row[gliy] = contact.slip[1];
  row[gli] = contact.slip.norm();
}

/// Of a node that faces nothing: how far it is from the nearest place, if that is known. One that counts as open tells
/// nothing.
void write_apart(const NodeContact& contact, Positions positions, Unpaired unpaired, double* row) {
  row[cont] = static_cast<double>(unpaired);
  row[jeu] = unpaired == Unpaired::open ? 0.0 : contact.gap;
  if (contact.has_foot) write_places(contact, positions, row);
}

/// To those of other zones at the node. Contact pulls at a node that it holds (MixedZone::bilateral): RN is a size.
void add_forces(const NodeContact& contact, double duration, double* row) {
  row[rn] += std::abs(contact.normal_force);
  for (int axis = 0; axis < 3; ++axis) {
    const double normal = -contact.normal_force * contact.pair.normal[axis], shear = -contact.shear_force[axis];
    row[rnx + axis] += normal;
    row[(contact.sticking ? rtax : rtgx) + axis] += shear;
    row[rx + axis] += normal + shear;
    row[ix + axis] += duration * (normal + shear);
  }
  row[r] = std::hypot(row[rx], row[ry], row[rz]);
  row[i] = duration * row[r];
}

NodalField empty_field(int node_count) {
  NodalField field;
  field.quantity = "INFC_R";
  field.components.assign(contact_names.begin(), contact_names.end());
  field.values.assign(static_cast<std::size_t>(node_count) * column_count, absent);
  return field;
}

bool is_faced(const ContactPair& pair) {
  return pair.status == PairingStatus::paired || pair.status == PairingStatus::watched;
}

/// What has been written of a node.
enum class Written : std::uint8_t { nothing, not_paired, state };

}  // namespace

NodalField untouched_field(std::span<const int> slave_nodes, int node_count) {
  NodalField field = empty_field(node_count);
  for (const int node : slave_nodes)
    std::fill_n(field.values.begin() + static_cast<std::ptrdiff_t>(node) * column_count, std::size_t{column_count},
                0.0);
  return field;
}

NodalField contact_field(std::span<const NodeContact> contacts, int node_count, Positions positions, double duration,
                         Unpaired unpaired) {
  NodalField field = empty_field(node_count);
  std::vector<Written> written(static_cast<std::size_t>(node_count), Written::nothing);
  for (const NodeContact& contact : contacts) {
    const ContactPair& pair = contact.pair;
    double* row = field.values.data() + static_cast<std::size_t>(pair.slave) * column_count;
    Written& known = written[static_cast<std::size_t>(pair.slave)];
    if (row[cont] != row[cont]) std::fill_n(row, std::size_t{column_count}, 0.0);
    if (!is_faced(pair)) {
      // A node that another zone holds keeps what that zone says.
      if (known == Written::nothing) write_apart(contact, positions, unpaired, row);
      known = std::max(known, Written::not_paired);
      continue;
    }
    if (contact.has_point &&
        (known != Written::state || (pair.status == PairingStatus::paired && contact.gap < row[jeu]))) {
      write_state(contact, positions, row);
      known = Written::state;
    }
    add_forces(contact, duration, row);
  }
  return field;
}

NodalField contact_field(std::span<const ContactPair> pairs, std::span<const double> gaps,
                         const Eigen::VectorXd& multipliers, int node_count, Positions positions, double duration) {
  std::vector<NodeContact> contacts;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    contacts.push_back(
        {.pair = pairs[k],
         .gap = gaps[k],
         .normal_force = multipliers[static_cast<Eigen::Index>(k)],
         .closed = multipliers[static_cast<Eigen::Index>(k)] > 0.0,
         .has_foot = pairs[k].status == PairingStatus::watched || multipliers[static_cast<Eigen::Index>(k)] > 0.0});
  return contact_field(contacts, node_count, positions, duration, Unpaired::open);
}

}  // namespace comma::solver
