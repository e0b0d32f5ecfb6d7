#include "solver/contact/contact_field.hpp"

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

void write_state(const NodeContact& contact, Positions positions, double* row) {
  const ContactPair& pair = contact.pair;
  row[cont] = status_of(contact, positions[pair.slave]);
  row[jeu] = contact.gap;
  for (int axis = 0; axis < 3; ++axis) {
    row[pt_x + axis] = positions[pair.slave][axis];
    row[proj_x + axis] = pair.foot[axis];
  }
  row[glix] = contact.slip[0];
  row[gliy] = contact.slip[1];
  row[gli] = contact.slip.norm();
}

/// To those of other zones at the node.
void add_forces(const NodeContact& contact, double* row) {
  const auto add = [row](int column, double force) {
    row[column] = (row[column] == row[column] ? row[column] : 0.0) + force;
  };
  add(rn, contact.normal_force);
  for (int axis = 0; axis < 3; ++axis) {
    const double normal = contact.normal_force * contact.pair.normal[axis], shear = contact.shear_force[axis];
    add(rnx + axis, normal);
    add(rtax + axis, contact.sticking ? shear : 0.0);
    add(rtgx + axis, contact.sticking ? 0.0 : shear);
    add(rx + axis, normal + shear);
  }
  row[r] = std::hypot(row[rx], row[ry], row[rz]);
}

}  // namespace

NodalField contact_field(std::span<const NodeContact> contacts, int node_count, Positions positions) {
  NodalField field;
  field.quantity = "INFC_R";
  field.components.assign(contact_names.begin(), contact_names.end());
  field.values.assign(static_cast<std::size_t>(node_count) * column_count, absent);
  for (const NodeContact& contact : contacts) {
    const ContactPair& pair = contact.pair;
    double* row = field.values.data() + static_cast<std::size_t>(pair.slave) * column_count;
    if (pair.status != PairingStatus::paired && pair.status != PairingStatus::watched) {
      // A node that another zone holds keeps what that zone says.
      if (row[cont] == row[cont]) continue;
      row[cont] = not_paired;
      for (const Column force : {rn, rnx, rny, rnz, rtax, rtay, rtaz, rtgx, rtgy, rtgz, rx, ry, rz, r})
        if (std::isnan(row[force])) row[force] = 0.0;
      continue;
    }
    if (!contact.has_point) {
      add_forces(contact, row);
      continue;
    }
    const bool is_shared = row[jeu] == row[jeu];
    if (!is_shared || (pair.status == PairingStatus::paired && contact.gap < row[jeu]))
      write_state(contact, positions, row);
    add_forces(contact, row);
  }
  return field;
}

NodalField contact_field(std::span<const ContactPair> pairs, std::span<const double> gaps,
                         const Eigen::VectorXd& multipliers, int node_count, Positions positions) {
  std::vector<NodeContact> contacts;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    contacts.push_back({.pair = pairs[k],
                        .gap = gaps[k],
                        .normal_force = multipliers[static_cast<Eigen::Index>(k)],
                        .closed = multipliers[static_cast<Eigen::Index>(k)] > 0.0});
  return contact_field(contacts, node_count, positions);
}

}  // namespace comma::solver
