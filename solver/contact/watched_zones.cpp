#include "solver/contact/watched_zones.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"

namespace comma::solver {

std::map<std::size_t, ContactPair> watched_pairs(const ContactDefinition& contact, const Mesh& mesh, Positions now,
                                                 double instant) {
  std::map<std::size_t, ContactPair> watched;
  if (std::ranges::all_of(contact.zones, [](const ContactZone& zone) { return zone.resolved; })) return watched;
  const auto pairs = pair_surfaces(contact, mesh, now, instant);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].status == PairingStatus::watched) watched.emplace(k, pairs[k]);
  }
  return watched;
}

namespace {

struct Overlap {
  ContactPair pair;
  double depth = 0.0;
};

/// Deeper than the zone allows, and than rounding.
std::vector<Overlap> overlaps(const ContactDefinition& contact, const Mesh& mesh, Positions now, double instant) {
  std::vector<Overlap> found;
  for (const auto& [k, pair] : watched_pairs(contact, mesh, now, instant)) {
    const double depth = -gap_at(pair, mesh, now);
    if (depth > contact.zones[static_cast<std::size_t>(pair.zone)].interpenetration_tolerance &&
        depth > rounding_of_place * extent(mesh, pair.facet))
      found.push_back({pair, depth});
  }
  return found;
}

}  // namespace

void note_interpenetration(const ContactDefinition& contact, const Mesh& mesh, Positions now, double instant,
                           ContactDoubts& doubts) {
  for (const auto& [pair, depth] : overlaps(contact, mesh, now, instant))
    doubts.note({.kind = DoubtKind::watched_overlap, .zone = pair.zone, .length = depth, .node = pair.slave});
}

void require_no_interpenetration(const ContactDefinition& contact, const Mesh& mesh, Positions now, double instant) {
  const std::vector<Overlap> found = overlaps(contact, mesh, now, instant);
  if (found.empty()) return;
  const auto& [pair, depth] = found.front();
  throw Error("contact-interpenetration",
              fmt::format("at INST={:g} node {} lies {:.4g} deep in facet {}, in zone {} where contact is not enforced",
                          instant, mesh.node_name(pair.slave), depth, mesh.cell_name(pair.facet), pair.zone + 1),
              "enforce contact there (RESOLUTION='OUI'), or allow the depth (TOLE_INTERP)");
}

}  // namespace comma::solver
