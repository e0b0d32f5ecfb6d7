#include "solver/nonlinear/contact/resumed_contact.hpp"

#include <algorithm>
#include <utility>

namespace comma::solver {
namespace {

/// How zones are defined, without points.
std::vector<ZoneMemory> zone_definitions(const ContactDefinition& definition) {
  std::vector<ZoneMemory> zones;
  for (const ContactZone& zone : definition.zones) {
    const MixedZone& mixed = zone.mixed;
    std::vector<int> slave_cells = zone.slave_cells;
    std::ranges::sort(slave_cells);
    zones.push_back({mixed.bilateral,
                     {mixed.penalised ? mixed.augmentation : 0.0,
                      mixed.friction_penalised ? mixed.friction_penalty : 0.0, mixed.adapts_penalty ? 1.0 : 0.0,
                      mixed.largest_slip ? 1.0 : 0.0, definition.formulation == ContactFormulation::mixed ? 1.0 : 0.0},
                     std::move(slave_cells)});
  }
  return zones;
}

/// How a point of the contact is known again; whether it is closed counts in what is left to a later computation.
RememberedPoint place_of(const FacedContact& contact, std::size_t p) {
  return {contact.points()[p].cell, initial_place(contact.points()[p], contact.mesh), false};
}

}  // namespace

std::shared_ptr<const ContactMemory> contact_memory(const FacedContact& contact, const RaisedPenalties& penalties) {
  const bool is_bilateral =
      std::ranges::any_of(contact.definition.zones, [](const ContactZone& zone) { return zone.mixed.bilateral; });
  if (!is_bilateral && !penalties.are_raised()) return nullptr;
  std::vector<ZoneMemory> zones = zone_definitions(contact.definition);
  for (std::size_t p = 0; p < contact.points().size() && is_bilateral; ++p) {
    RememberedPoint point = place_of(contact, p);
    point.closed = contact.is_closed(p);
    zones[static_cast<std::size_t>(contact.points()[p].zone)].points.push_back(point);
  }
  return std::make_shared<const ContactMemory>(ContactMemory{std::move(zones), penalties});
}

void resume_penalties(const ContactDefinition& definition, const ContactMemory& memory, RaisedPenalties& penalties) {
  const std::vector<ZoneMemory> now = zone_definitions(definition);
  for (std::size_t zone = 0; zone < now.size(); ++zone) {
    const auto before = memory.zone_like(now[zone], zone);
    if (before && now[zone].penalties == memory.zones[*before].penalties)
      penalties.go_on_from(memory.penalties, *before, zone);
  }
}

std::vector<char> held_points(const FacedContact& contact, const ContactMemory& memory) {
  std::vector<char> held(contact.points().size(), 0);
  const std::vector<ZoneMemory> zones = zone_definitions(contact.definition);
  for (std::size_t zone = 0; zone < zones.size(); ++zone) {
    if (!zones[zone].bilateral) continue;
    std::vector<std::size_t> own;
    std::vector<RememberedPoint> of_zone;
    std::vector<double> reach;
    for (std::size_t p = 0; p < contact.points().size(); ++p) {
      if (contact.points()[p].zone != static_cast<int>(zone)) continue;
      own.push_back(p);
      of_zone.push_back(place_of(contact, p));
      reach.push_back(contact.size_at(p));
    }
    const std::vector<char> was_held = memory.held(of_zone, zones[zone], reach);
    for (std::size_t k = 0; k < own.size(); ++k) held[own[k]] = was_held[k];
  }
  return held;
}

}  // namespace comma::solver
