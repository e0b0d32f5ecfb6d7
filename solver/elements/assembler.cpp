#include "solver/elements/assembler.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "solver/elements/assembler_blocks.hpp"
#include "solver/elements/block_fields.hpp"
#include "solver/elements/discrete/discrete_forces.hpp"
#include "solver/elements/element_block.hpp"
#include "solver/elements/external_forces.hpp"
#include "solver/elements/geometric_stiffness.hpp"
#include "solver/elements/naming_cell.hpp"
#include "solver/elements/slender/inelastic_bar.hpp"
#include "solver/elements/slender/rotating_beam.hpp"
#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/elements/sparse_pattern.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/stresses/plate_stresses.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

/// Cells with stiffness, gathered by what they share; each group's cells keep the order of the mesh.
using CellGroups = std::map<std::tuple<Formulation, CellType, CellBehaviour>, std::vector<int>>;

std::vector<int> stiff_cells(const Model& model) {
  std::vector<int> cells;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (model.components_of(cell) != 0 && !model.is_skin(cell)) cells.push_back(cell);
  }
  return cells;
}

CellGroups group_cells(const BlockInput& input, const std::vector<int>& cells) {
  CellGroups groups;
  for (const int cell : cells)
    groups[{input.model.formulations[cell], input.model.mesh->cell_types[cell], input.behaviour_of(cell)}].push_back(
        cell);
  return groups;
}

bool is_of_springs(Relation relation) {
  return relation == Relation::contact_spring || relation == Relation::bilinear_spring ||
         relation == Relation::hardening_spring;
}

std::unique_ptr<ElementBlock> make_block(const BlockInput& input, std::vector<int> cells) {
  const Formulation formulation = input.model.formulations[cells.front()];
  const bool is_discrete = discrete_components(formulation) > 0;
  if (is_of_springs(input.behaviour_of(cells.front()).relation) && !is_discrete)
    throw Error(
        "unsupported",
        fmt::format("cell {}: laws of springs, and of contact and friction inside them, are for discrete elements",
                    input.model.mesh->cell_name(cells.front())),
        "give RELATION='DIS_...' to the groups of discrete elements alone");
  if (continuum_dimension(formulation) > 0) return make_continuum_block(input, std::move(cells));
  const Relation relation = input.behaviour_of(cells.front()).relation;
  if (relation == Relation::contact_spring && is_discrete) return make_discrete_contact_block(input, std::move(cells));
  if (is_of_springs(relation)) return make_discrete_law_block(input, std::move(cells));
  const bool flows = relation != Relation::elastic;
  const Kinematics kinematics = input.behaviour_of(cells.front()).kinematics;
  const bool adds_up =
      flows || input.behaviour_of(cells.front()).from_initial_state || kinematics == Kinematics::updated;
  if (adds_up && is_bar(formulation)) return make_inelastic_bar_block(input, std::move(cells));
  if (flows)
    throw Error(
        "unsupported",
        fmt::format("cell {}: springs, beams and plates are elastic", input.model.mesh->cell_name(cells.front())),
        "give these cells RELATION='ELAS'");
  if (is_discrete) return make_discrete_block(input, std::move(cells));
  if (is_rotating_beam(formulation, kinematics)) return make_rotating_beam_block(input, std::move(cells));
  if (kinematics != Kinematics::small)
    throw Error("unsupported",
                fmt::format("cell {}: plates know small displacements only, bars besides those that add up on the "
                            "geometry of the moment (DEFORMATION='PETIT_REAC'), beams large rotations ('GROT_GDEP')",
                            input.model.mesh->cell_name(cells.front())),
                "give these cells small strains (DEFORMATION='PETIT')");
  if (is_plate(formulation)) return make_plate_block(input, std::move(cells));
  return make_slender_block(input, std::move(cells));
}

/// Of a solid; more of them are no stresses.
constexpr std::size_t solid_stress_count = 6;

}  // namespace

Assembler::Assembler(const Model& model, const MaterialField& materials, const ElementProperties& properties,
                     const DofMap& dofs, const BehaviourOfCells* behaviours)
    : model_(model), materials_(materials), properties_(properties), dofs_(dofs) {
  const std::vector<int> cells = stiff_cells(model);
  blocks_.reset(new Blocks{SparsePattern(*model.mesh, cells, dofs), {}});
  const BlockInput input{model_, materials_, properties_, dofs_, blocks_->pattern, behaviours};
  for (auto& [kind, group] : group_cells(input, cells)) blocks_->list.push_back(make_block(input, std::move(group)));
}

Assembler::~Assembler() = default;

void Assembler::set_time(double time) {
  state_ = VariableState(*model_.mesh, materials_.variables, time);
  const bool constant =
      std::all_of(blocks_->list.begin(), blocks_->list.end(), [](const auto& block) { return block->is_constant(); });
  if (constant) return;
  ++version_;
  sum_initial_forces();
}

void Assembler::impose_strains(std::span<const AppliedLoad> loads, double time) {
  auto strains = std::make_unique<const ImposedStrains>(model_, loads, time);
  if (strains->empty()) strains.reset();
  for (const auto& block : blocks_->list) block->impose(strains.get());
  imposed_ = std::move(strains);
}

SymmetricMatrix Assembler::stiffness(const Eigen::VectorXd& u) const {
  return blocks_->sum(&ElementBlock::add_stiffness, u, state_);
}

SymmetricMatrix Assembler::symmetric_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->sum(&ElementBlock::add_symmetric_stiffness, u, state_);
}

SymmetricMatrix Assembler::elastic_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->sum(&ElementBlock::add_elastic_stiffness, u, state_);
}

SymmetricMatrix Assembler::initial_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->sum(&ElementBlock::add_initial_stiffness, u, state_);
}

SymmetricMatrix Assembler::starting_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->sum(&ElementBlock::add_starting_stiffness, u, state_);
}

SymmetricMatrix Assembler::geometric_stiffness(const Eigen::VectorXd& u) const {
  SymmetricMatrix matrix = blocks_->pattern.zero_matrix();
  const auto starts = blocks_->pattern.column_starts();
  for (const auto& block : blocks_->list) {
    const int cell = block->cells().front();
    const Formulation formulation = model_.formulations[cell];
    if (continuum_dimension(formulation) == 0 || mixed_field_count(formulation) > 0) {
      naming_cell(*model_.mesh, cell, [&] {
        block->add_geometric_stiffness(stresses_in(*block, u, imposed_.get()), state_, starts, matrix.valuePtr());
      });
      continue;
    }
    if (block->stress_names().size() > solid_stress_count)
      throw Error(
          "unsupported",
          fmt::format("cell {}: the stiffness that stresses add is not known of cells with one point of integration",
                      model_.mesh->cell_name(cell)));
    const int nodes = static_cast<int>(model_.mesh->cell(cell).size());
    const ElementMap map(blocks_->pattern, dofs_, model_.components_of(cell), nodes,
                         gather_nodes(*model_.mesh, block->cells()));
    add_continuum_geometric_stiffness(*model_.mesh, formulation, block->cells(), map,
                                      stresses_of(*block, u, state_, imposed_.get()), starts, matrix.valuePtr());
  }
  return matrix;
}

bool Assembler::is_symmetric() const {
  return std::all_of(blocks_->list.begin(), blocks_->list.end(),
                     [](const auto& block) { return block->is_symmetric(); });
}

bool Assembler::has_symmetric_linear_part() const {
  return std::all_of(blocks_->list.begin(), blocks_->list.end(),
                     [](const auto& block) { return block->is_symmetric() || !block->is_linear(); });
}

SkewMatrix Assembler::skew_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->skew_sum(u, state_, [](const ElementBlock& block) { return !block.is_symmetric(); });
}

SkewMatrix Assembler::elastic_skew_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->skew_sum(u, state_, [](const ElementBlock& block) { return !block.is_elastically_symmetric(); });
}

SkewMatrix Assembler::initial_skew_stiffness(const Eigen::VectorXd& u) const {
  return blocks_->skew_sum(u, state_, [](const ElementBlock& block) { return !block.is_initially_symmetric(); });
}

Eigen::VectorXd Assembler::internal_forces(const Eigen::VectorXd& u) const {
  return with_initial(blocks_->sum(&ElementBlock::add_internal_forces, u, state_));
}

Eigen::VectorXd Assembler::starting_forces(const Eigen::VectorXd& u) const {
  return with_initial(blocks_->sum(&ElementBlock::add_starting_forces, u, state_));
}

Eigen::VectorXd Assembler::variable_forces() const {
  if (state_.empty() && !imposed_) return {};
  return blocks_->sum(&ElementBlock::add_variable_forces, Eigen::VectorXd::Zero(dofs_.size()), state_);
}

Eigen::VectorXd Assembler::residual_weights() const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(dofs_.size());
  for (const auto& block : blocks_->list)
    block->weigh_rows(state_, {weights.data(), static_cast<std::size_t>(weights.size())});
  if (weights.isZero(0.0)) return {};
  return (weights.array() > 0.0).select(weights, 1.0);
}

bool Assembler::has_memory() const {
  return std::ranges::any_of(blocks_->list, [](const auto& block) { return block->has_memory(); });
}

void Assembler::extrapolate(std::optional<double> ratio) {
  for (const auto& block : blocks_->list) block->extrapolate(ratio);
}

void Assembler::accept(const Eigen::VectorXd& u) {
  for (const auto& block : blocks_->list) block->accept(u, state_);
}

ElementField Assembler::internal_variables(const Eigen::VectorXd& u) const {
  int most = 1;
  for (const auto& block : blocks_->list) most = std::max(most, block->variable_count());
  ElementField field = field_at_points("VARI_R", variable_names(most));
  for (const auto& block : blocks_->list) {
    std::vector<double> values(block->cells().size() *
                               static_cast<std::size_t>(block->point_count() * block->variable_count()));
    block->variables(u, state_, values);
    write_block(*block, variable_names(block->variable_count()), values, field);
  }
  return field;
}

ElementField Assembler::energy_densities(const Eigen::VectorXd& u, const ElementField& stresses,
                                         const ElementField& variables) const {
  ElementField field = field_at_points("ENER_R", {"TOTALE"});
  for (const auto& block : blocks_->list) {
    if (!block->has_memory()) continue;
    std::vector<double> values(block->cells().size() * static_cast<std::size_t>(block->point_count()));
    block->energy_densities(u, state_, read_stresses(*block, &stresses, *model_.mesh),
                            read_block(*block, variable_names(block->variable_count()), &variables, *model_.mesh),
                            values);
    write_block(*block, field.components, values, field);
  }
  return field;
}

Eigen::VectorXd Assembler::external_forces(std::span<const AppliedLoad> loads, double time) const {
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  add_external_forces({model_, materials_, properties_, dofs_, &state_}, loads, time, sums);
  const ImposedStrains imposed(model_, loads, time);
  if (!imposed.empty()) {
    for (const auto& block : blocks_->list) block->add_imposed_strain_forces(imposed, state_, sums);
  }
  add_initial_stress_forces(loads, time, sums);
  return rounded(sums);
}

void Assembler::add_initial_stress_forces(std::span<const AppliedLoad> loads, double time,
                                          std::span<long double> sums) const {
  for (const AppliedLoad& applied : loads) {
    const double factor = applied.multiplier ? applied.multiplier(time) : 1.0;
    for (const auto& field : applied.load->initial_stress_fields) {
      for (const auto& block : blocks_->list) {
        std::vector<double> values = read_initial_stresses(*block, *field, *model_.mesh);
        for (double& value : values) value *= factor;
        block->add_initial_stress_forces(values, sums);
      }
    }
  }
}

Eigen::VectorXd Assembler::initial_strain_forces(std::span<const AppliedLoad> loads, double time) const {
  std::vector<long double> sums(static_cast<std::size_t>(dofs_.size()), 0.0L);
  const ImposedStrains imposed(model_, loads, time);
  for (const auto& block : blocks_->list)
    if (!block->shows_imposed_strains()) block->add_imposed_strain_forces(imposed, state_, sums);
  return rounded(sums);
}

bool Assembler::is_linear() const {
  return std::all_of(blocks_->list.begin(), blocks_->list.end(), [](const auto& block) { return block->is_linear(); });
}

bool Assembler::is_initially_linear() const {
  return std::ranges::all_of(blocks_->list, [](const auto& block) { return block->is_initially_linear(); });
}

ElementField Assembler::stresses(const Eigen::VectorXd& u) const { return stresses(u, nullptr); }

ElementField Assembler::stresses(const Eigen::VectorXd& u, std::span<const AppliedLoad> loads, double time) const {
  const ImposedStrains imposed(model_, loads, time);
  return stresses(u, &imposed);
}

ElementField Assembler::stresses(const Eigen::VectorXd& u, const ImposedStrains* imposed) const {
  std::vector<std::string> components;
  for (const auto& block : blocks_->list) {
    for (const auto name : block->stress_names()) {
      if (std::ranges::find(components, name) == components.end()) components.emplace_back(name);
    }
  }
  ElementField field = field_at_points("SIEF_R", std::move(components));
  for (const auto& block : blocks_->list)
    write_block(*block, stress_names(*block), stresses_in(*block, u, imposed), field);
  if (!has_plates()) return field;
  const ElementField forces = with_initial(plate_forces(u, PlatePlaces::integration_points, imposed));
  return side_by_side(field, plate_stresses(model_, properties_, forces));
}

bool Assembler::has_plates() const {
  return std::ranges::any_of(blocks_->list,
                             [](const auto& block) { return block->force_point_count(PlatePlaces::corners) > 0; });
}

ElementField Assembler::plate_forces(const Eigen::VectorXd& u, PlatePlaces places, std::span<const AppliedLoad> loads,
                                     double time) const {
  const ImposedStrains imposed(model_, loads, time);
  return plate_forces(u, places, &imposed);
}

ElementField Assembler::plate_forces(const Eigen::VectorXd& u, PlatePlaces places,
                                     const ImposedStrains* imposed) const {
  ElementField field{"SIEF_R", Support::gauss_point, {plate_force_names.begin(), plate_force_names.end()}, {}, {}};
  std::vector<int> counts(static_cast<std::size_t>(model_.mesh->cell_count()), 0);
  for (const auto& block : blocks_->list)
    for (const int cell : block->cells()) counts[static_cast<std::size_t>(cell)] = block->force_point_count(places);
  field.starts = starts_of(counts);
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * field.components.size(), absent);
  for (const auto& block : blocks_->list) {
    if (block->force_point_count(places) == 0) continue;
    std::vector<double> values(block->cells().size() * static_cast<std::size_t>(block->force_point_count(places)) *
                               field.components.size());
    block->forces(places, u, imposed, state_, values);
    write_block(*block, field.components, values, field);
  }
  return field;
}

ElementField Assembler::field_at_points(std::string quantity, std::vector<std::string> components) const {
  ElementField field;
  field.quantity = std::move(quantity);
  field.support = Support::gauss_point;
  field.components = std::move(components);
  std::vector<int> counts(static_cast<std::size_t>(model_.mesh->cell_count()), 0);
  for (const auto& block : blocks_->list) {
    for (const int cell : block->cells()) counts[static_cast<std::size_t>(cell)] = block->point_count();
  }
  field.starts = starts_of(counts);
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * field.components.size(), absent);
  return field;
}

ElementField Assembler::elastic_energies(const Eigen::VectorXd& u) const {
  ElementField field;
  field.quantity = "ENER_R";
  field.components = {"TOTALE"};
  field.starts.assign(static_cast<std::size_t>(model_.mesh->cell_count()) + 1, 0);
  for (const auto& block : blocks_->list) {
    for (const int cell : block->cells()) field.starts[cell + 1] = 1;
    for (const std::string_view name : block->energy_names())
      if (field.component(name) < 0) field.components.emplace_back(name);
  }
  for (std::size_t cell = 1; cell < field.starts.size(); ++cell) field.starts[cell] += field.starts[cell - 1];
  const std::size_t width = field.components.size();
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * width, absent);
  std::vector<double> values;
  for (const auto& block : blocks_->list) {
    const auto cells = block->cells();
    const auto slot = [&](std::size_t i) { return static_cast<std::size_t>(field.starts[cells[i]]) * width; };
    values.resize(cells.size());
    block->energies(u, state_, values);
    for (std::size_t i = 0; i < cells.size(); ++i) field.values[slot(i)] = values[i];
    const auto names = block->energy_names();
    values.resize(cells.size() * names.size());
    block->energy_parts(u, state_, values);
    for (std::size_t part = 0; part < names.size(); ++part) {
      const auto column = static_cast<std::size_t>(field.component(names[part]));
      for (std::size_t i = 0; i < cells.size(); ++i) field.values[slot(i) + column] = values[i * names.size() + part];
    }
  }
  return field;
}

NodalField to_field(const Eigen::VectorXd& values, const DofMap& dofs, std::string quantity) {
  ComponentMask present = 0;
  for (int node = 0; node < dofs.node_count(); ++node) present |= dofs.components(node);
  NodalField field{std::move(quantity), {}, {}};
  std::vector<Component> components;
  for (int c = 0; c < component_count; ++c) {
    const auto component = static_cast<Component>(c);
    if (!contains(present, component)) continue;
    components.push_back(component);
    field.components.emplace_back(name_of(component));
  }
  field.values.reserve(static_cast<std::size_t>(dofs.node_count()) * components.size());
  for (int node = 0; node < dofs.node_count(); ++node) {
    for (const Component component : components) {
      const int dof = dofs.dof(node, component);
      field.values.push_back(dof < 0 ? absent : values[dof]);
    }
  }
  return field;
}

}  // namespace comma::solver
