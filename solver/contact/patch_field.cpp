#include "solver/contact/patch_field.hpp"

#include <array>

namespace comma::solver {
namespace {

constexpr std::array<const char*, 5> patch_names = {"CONT", "JEU", "PRES", "COEFSURF", "PRESCOOR"};

}  // namespace

ElementField patch_field(std::span<const std::pair<std::vector<int>, PatchContact>> patches, int cell_count) {
  std::vector<const PatchContact*> of_cell(static_cast<std::size_t>(cell_count), nullptr);
  for (const auto& [faces, contact] : patches)
    for (const int face : faces) of_cell[static_cast<std::size_t>(face)] = &contact;
  ElementField field;
  field.quantity = "CONT_R";
  field.support = Support::cell;
  field.components.assign(patch_names.begin(), patch_names.end());
  field.starts = {0};
  for (const PatchContact* contact : of_cell) {
    field.starts.push_back(field.starts.back() + (contact != nullptr ? 1 : 0));
    if (contact == nullptr) continue;
    const double stress = contact->is_closed ? -contact->pressure : 0.0;
    for (const double value :
         {contact->is_closed ? 1.0 : 0.0, contact->gap, stress, contact->covered, stress * contact->covered})
      field.values.push_back(value);
  }
  return field;
}

}  // namespace comma::solver
