#include "solver/contact/contact_field.hpp"

#include <array>

namespace comma::solver {
namespace {

enum Column : std::uint8_t {
  cont, jeu, rn, rnx, rny, rnz, glix, gliy, gli, rtax, rtay, rtaz, rtgx, rtgy, rtgz, rx, ry, rz, r, hn, i, ix, iy, iz,
  pt_x, pt_y, pt_z, proj_x, proj_y, proj_z, column_count
};

constexpr std::array<const char*, column_count> names = {
    "CONT", "JEU",  "RN",   "RNX",  "RNY", "RNZ", "GLIX", "GLIY", "GLI", "RTAX", "RTAY", "RTAZ", "RTGX",   "RTGY",   "RTGZ",
    "RX",   "RY",   "RZ",   "R",    "HN",  "I",   "IX",   "IY",   "IZ",  "PT_X", "PT_Y", "PT_Z", "PROJ_X", "PROJ_Y", "PROJ_Z"};

constexpr double not_paired = -1.0;
constexpr double open = 0.0;
constexpr double sliding = 2.0;

}  // namespace

NodalField contact_field(std::span<const ContactPair> pairs, std::span<const double> gaps, const Eigen::VectorXd& multipliers,
                         int node_count, Positions positions) {
  NodalField field;
  field.quantity = "INFC_R";
  field.components.assign(names.begin(), names.end());
  field.values.assign(static_cast<std::size_t>(node_count) * column_count, absent);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ContactPair& pair = pairs[k];
    double* row = field.values.data() + static_cast<std::size_t>(pair.slave) * column_count;
    if (pair.status != PairingStatus::paired && pair.status != PairingStatus::watched) {
      // A node that another zone holds keeps what that zone says.
      if (row[cont] != row[cont]) row[cont] = not_paired;
      continue;
    }
    const double force = multipliers[static_cast<Eigen::Index>(k)];
    row[cont] = pair.status == PairingStatus::watched ? not_paired : force > 0.0 ? sliding : open;
    row[jeu] = gaps[k];
    row[rn] = row[r] = force;
    for (const Column tangential : {rtax, rtay, rtaz, rtgx, rtgy, rtgz}) row[tangential] = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      row[rnx + axis] = row[rx + axis] = force * pair.normal[axis];
      row[pt_x + axis] = positions[pair.slave][axis];
      row[proj_x + axis] = pair.foot[axis];
    }
  }
  return field;
}

}  // namespace comma::solver
