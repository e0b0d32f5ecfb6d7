#include "commands/model/section_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <utility>

#include "commands/concepts.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/slender/section_shapes.hpp"
#include "solver/elements/slender/varying_section.hpp"
#include "solver/error.hpp"
#include "solver/mesh/place.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::BeamSection;
using solver::Formulation;

namespace {

// The values of VALE by the names of CARA.
class Characteristics {
 public:
  explicit Characteristics(const Keywords& assignment) : assignment_(assignment) {
    if (assignment.given("TABLE_CARA")) {
      take_row();
      return;
    }
    const auto names = assignment.texts("CARA");
    const auto values = assignment.reals("VALE");
    if (names.size() != values.size()) {
      throw DiagnosticError("wrong-count",
                            fmt::format("VALE gives {} values to the {} names of CARA", values.size(), names.size()),
                            assignment.span_of("VALE"), "give one value a name");
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (values_.emplace(names[i], values[i]).second) continue;
      throw DiagnosticError("duplicate-characteristic", "CARA names " + names[i] + " twice",
                            assignment.span_of("CARA"));
    }
  }

  bool has(const std::string& name) const { return values_.contains(name); }
  double get(const std::string& name, double otherwise) const { return has(name) ? values_.at(name) : otherwise; }

  // One end of a beam whose section varies: names without the suffix of that end; those without any suffix belong to
  // both. Names of the other end are left out.
  Characteristics at_end(const std::string& suffix, const std::string& other) const {
    Characteristics result = *this;
    result.values_.clear();
    result.suffix_ = suffix;
    for (const auto& [name, value] : values_) {
      if (name.ends_with(suffix))
        result.values_[name.substr(0, name.size() - suffix.size())] = value;
      else if (!name.ends_with(other))
        result.values_[name] = value;
    }
    return result;
  }

  // All of these names, or an error that lists those that lack.
  void require(std::initializer_list<const char*> names) const {
    std::vector<std::string> missing;
    for (const char* name : names) {
      if (!has(name)) missing.emplace_back(name + suffix_);
    }
    if (missing.empty()) return;
    throw DiagnosticError("missing-characteristic", fmt::format("the section lacks {}", fmt::join(missing, ", ")),
                          assignment_.span_of("CARA"),
                          fmt::format("name {} in CARA and give the value in VALE", missing.front()));
  }

  void exclude(const std::string& name, std::initializer_list<const char*> others) const {
    if (!has(name)) return;
    for (const char* other : others) {
      if (!has(other)) continue;
      throw DiagnosticError(
          "excluded-characteristic", fmt::format("CARA names both {0}{2} and {1}{2}", name, other, suffix_),
          assignment_.span_of("CARA"), fmt::format("{}{} stands for the sizes along y and z alike", name, suffix_));
    }
  }

 private:
  // The row of TABLE_CARA whose LIEU (or first column) is NOM_SEC, the only one without (U4.42.01): its numbers by the
  // names of their columns.
  void take_row() {
    const Table& table = assignment_.data<TableConcept>("TABLE_CARA").table;
    const int names = std::max(0, table.column("LIEU"));
    const auto is_meant = [&](const std::vector<Cell>& row) {
      const auto* name = std::get_if<std::string>(&row[static_cast<std::size_t>(names)]);
      return !assignment_.given("NOM_SEC") || (name != nullptr && *name == assignment_.text("NOM_SEC"));
    };
    const auto found = std::ranges::find_if(table.rows, is_meant);
    if (found == table.rows.end() || std::find_if(found + 1, table.rows.end(), is_meant) != table.rows.end()) {
      throw DiagnosticError(
          "unknown-section",
          fmt::format("TABLE_CARA has {} row for the section", found == table.rows.end() ? "no" : "more than one"),
          assignment_.span_of(assignment_.given("NOM_SEC") ? "NOM_SEC" : "TABLE_CARA"),
          "name the row by NOM_SEC, as its column LIEU has it");
    }
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (const auto* real = std::get_if<double>(&(*found)[c])) values_[table.columns[c]] = *real;
      if (const auto* count = std::get_if<std::int64_t>(&(*found)[c]))
        values_[table.columns[c]] = static_cast<double>(*count);
    }
  }

  const Keywords& assignment_;
  std::map<std::string, double> values_;
  std::string suffix_;  // what CARA has behind each name here
};

BeamSection general_section(const Characteristics& given, bool bends) {
  given.require({"A"});
  if (bends) given.require({"IY", "IZ", "JX"});
  BeamSection section;
  section.area = given.get("A", 0.0);
  section.inertia_y = given.get("IY", 0.0);
  section.inertia_z = given.get("IZ", 0.0);
  section.torsion = given.get("JX", 0.0);
  section.shear_y = given.get("AY", section.shear_y);
  section.shear_z = given.get("AZ", section.shear_z);
  section.centre_y = -given.get("EY", 0.0);  // EY, EZ lead from the centre of torsion to the centroid
  section.centre_z = -given.get("EZ", 0.0);
  section.reach_y = given.get("RY", section.reach_y);
  section.reach_z = given.get("RZ", section.reach_z);
  section.torsion_reach = given.get("RT", section.torsion_reach);
  return section;
}

BeamSection rectangle_of(const Characteristics& given) {
  given.exclude("H", {"HY", "HZ"});
  given.exclude("EP", {"EPY", "EPZ"});
  if (!given.has("H")) given.require({"HY", "HZ"});
  const double side = given.get("H", 0.0);
  const double wall = given.get("EP", 0.0);
  return solver::rectangular_section(
      {given.get("HY", side), given.get("HZ", side), given.get("EPY", wall), given.get("EPZ", wall)});
}

BeamSection circle_of(const Characteristics& given) {
  given.require({"R"});
  const double radius = given.get("R", 0.0);
  return solver::circular_section(radius, given.get("EP", radius));
}

BeamSection shaped_section(const std::string& shape, const Characteristics& given, bool bends) {
  return shape == "GENERALE"    ? general_section(given, bends)
         : shape == "RECTANGLE" ? rectangle_of(given)
                                : circle_of(given);
}

// VARI_SECT="AFFINE": the sizes along y stay, those along z change (U4.42.01).
void check_affine(const Keywords& assignment, const Characteristics& given) {
  given.require({"HY", "HZ1", "HZ2"});
  for (const char* name : {"H1", "H2", "HY1", "HY2", "EP1", "EP2", "EPY1", "EPY2"}) {
    if (!given.has(name)) continue;
    throw DiagnosticError("excluded-characteristic",
                          fmt::format("CARA names {}, but with VARI_SECT=\"AFFINE\" only sizes along z change", name),
                          assignment.span_of("CARA"),
                          "name HY, HZ1, HZ2 and, for walls, EPY, EPZ1, EPZ2; or use VARI_SECT=\"HOMOTHETIQUE\"");
  }
}

// The section that a beam has over the given share of what CARA and VALE say.
BeamSection part_of_section(const Keywords& assignment, const Characteristics& given, std::pair<double, double> share) {
  const auto at = [&](double place) {
    const auto first = given.at_end("_DEBUT", "_FIN"), last = given.at_end("_FIN", "_DEBUT");
    first.require({"R"});
    last.require({"R"});
    const auto size = [&](const char* name, double otherwise_first, double otherwise_last) {
      return (1.0 - place) * first.get(name, otherwise_first) + place * last.get(name, otherwise_last);
    };
    const double radius = size("R", 0.0, 0.0);
    return solver::circular_section(radius, first.has("EP") || last.has("EP") ? size("EP", 0.0, 0.0) : radius);
  };
  try {
    return solver::varying_section(at(share.first), at(share.second), solver::all_sizes_vary);
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), error.what(), assignment.span_of("VALE"), error.hint());
  }
}

double length_of(const solver::Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  return (solver::place(mesh, nodes.back()) - solver::place(mesh, nodes.front())).norm();
}

// Where a cell begins and ends on the line that its group makes.
std::map<int, std::pair<double, double>> shares_of_line(const Keywords& assignment, const solver::Mesh& mesh,
                                                        const std::string& group) {
  const std::vector<int>& cells = mesh.cell_group(group);
  std::map<int, std::pair<double, double>> shares;
  double length = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0 && mesh.cell(cells[i])[0] != mesh.cell(cells[i - 1])[1])
      throw DiagnosticError(
          "not-a-line",
          fmt::format("the radius varies along group {}, and its cell {} does not go on where {} ends", group,
                      mesh.cell_name(cells[i]), mesh.cell_name(cells[i - 1])),
          assignment.span, "order the cells of the group along the line, or name a group a cell");
    const double begin = length;
    length += length_of(mesh, cells[i]);
    shares[cells[i]] = {begin, length};
  }
  for (auto& [cell, share] : shares) share = {share.first / length, share.second / length};
  return shares;
}

// A circular section that varies does so along the whole line of each group, as in Code_Aster.
void add_tapered_line(const Keywords& assignment, const std::vector<int>& beams, const solver::Mesh& mesh,
                      solver::ElementProperties& properties) {
  const Characteristics given(assignment);
  std::map<int, std::pair<double, double>> shares;
  for (const std::string& group : assignment.texts("GROUP_MA"))
    for (const auto& [cell, share] : shares_of_line(assignment, mesh, group)) shares[cell] = share;
  for (const int cell : beams) {
    const auto found = shares.find(cell);
    properties.sections[cell] =
        part_of_section(assignment, given, found == shares.end() ? std::pair(0.0, 1.0) : found->second);
  }
}

bool is_tapered_circle(const Keywords& assignment) {
  return assignment.text("SECTION") == "CERCLE" && assignment.has("VARI_SECT") &&
         assignment.text("VARI_SECT") != "CONSTANT";
}

BeamSection section_of(const Keywords& assignment, bool bends) {
  const Characteristics given(assignment);
  const std::string& shape = assignment.text("SECTION");
  const std::string variation = assignment.has("VARI_SECT") ? assignment.text("VARI_SECT") : "CONSTANT";
  try {
    if (variation == "CONSTANT") return shaped_section(shape, given, bends);
    if (variation == "AFFINE") check_affine(assignment, given);
    return solver::varying_section(shaped_section(shape, given.at_end("1", "2"), bends),
                                   shaped_section(shape, given.at_end("2", "1"), bends),
                                   variation == "AFFINE" ? solver::one_size_varies : solver::all_sizes_vary);
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), error.what(), assignment.span_of("VALE"), error.hint());
  }
}

// Shear deforms Timoshenko's beams: without shear factors they would silently be Euler's.
void check_shear(const Keywords& assignment, const BeamSection& section) {
  if (assignment.text("SECTION") != "GENERALE") return;
  const Characteristics given(assignment);
  if (section.end)
    given.require({"AY1", "AZ1", "AY2", "AZ2"});
  else
    given.require({"AY", "AZ"});
}

// The cells named that carry an element of the kind; at least one must.
std::vector<int> carriers(const Keywords& assignment, const solver::Model& model, bool (*carries)(Formulation),
                          const char* kind, const char* hint) {
  std::vector<int> cells;
  for (const int cell : selected_cells(assignment, *model.mesh)) {
    if (carries(model.formulations[cell])) cells.push_back(cell);
  }
  if (cells.empty()) {
    throw DiagnosticError("no-element", fmt::format("none of these cells is a {}", kind), assignment.span, hint);
  }
  return cells;
}

std::vector<int> beams_of(const Keywords& assignment, const solver::Model& model) {
  return carriers(assignment, model, solver::is_beam, "beam",
                  "give them MODELISATION=\"POU_D_E\" or \"POU_D_T\" in AFFE_MODELE");
}

// COUDE alone: a factor for each plane of bending, or one for both.
void soften_elbow(const Keywords& elbow, int cell, solver::ElementProperties& properties) {
  const double both = elbow.has("COEF_FLEX") ? elbow.real("COEF_FLEX") : 1.0;
  const double xy = elbow.has("COEF_FLEX_XY") ? elbow.real("COEF_FLEX_XY") : both;
  const double xz = elbow.has("COEF_FLEX_XZ") ? elbow.real("COEF_FLEX_XZ") : both;
  const auto found = properties.sections.find(cell);
  if (found == properties.sections.end()) {
    throw DiagnosticError("missing-characteristic", "an elbow (COUDE) stands on beams that have no section", elbow.span,
                          "give the section of the pipe too, by another POUTRE on the same cells");
  }
  found->second = solver::softened(found->second, xy, xz);
}

}  // namespace

void add_beam_sections(const std::vector<Keywords>& assignments, const solver::Model& model,
                       solver::ElementProperties& properties) {
  std::map<int, const Keywords*> elbows;  // of a cell, the last one
  for (const Keywords& assignment : assignments) {
    if (assignment.text("SECTION") == "COUDE") {
      for (const int cell : beams_of(assignment, model)) elbows[cell] = &assignment;
      continue;
    }
    if (is_tapered_circle(assignment)) {
      add_tapered_line(assignment, beams_of(assignment, model), *model.mesh, properties);
      continue;
    }
    const BeamSection section = section_of(assignment, true);
    for (const int cell : beams_of(assignment, model)) {
      if (model.formulations[cell] == Formulation::timoshenko_beam) check_shear(assignment, section);
      properties.sections[cell] = section;
    }
  }
  for (const auto& [cell, elbow] : elbows) soften_elbow(*elbow, cell, properties);
}

void add_bar_sections(const Keywords& assignment, const solver::Model& model, solver::ElementProperties& properties) {
  const BeamSection section = section_of(assignment, false);
  for (const int cell :
       carriers(assignment, model, solver::is_bar, "bar", "give them MODELISATION=\"BARRE\" in AFFE_MODELE")) {
    properties.sections[cell] = section;
  }
}

}  // namespace comma::commands
