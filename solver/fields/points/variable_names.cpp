#include "solver/fields/points/variable_names.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, 6> directions = {"XX", "YY", "ZZ", "XY", "XZ", "YZ"};

void add_tensor(std::vector<std::string>& names, std::string_view name) {
  for (const auto direction : directions) names.push_back(fmt::format("{}{}", name, direction));
}

std::vector<std::string> names_of_relation(const CellBehaviour& behaviour) {
  switch (behaviour.relation) {
    case Relation::elastic:
    case Relation::hyperelastic:
      return {"VIDE"};
    case Relation::isotropic_linear:
    case Relation::isotropic_traction:
    case Relation::isotropic_power:
      return {"EPSPEQ", "INDIPLAS"};
    case Relation::reversible_linear:
    case Relation::reversible_traction:
    case Relation::reversible_power:
      return {"EPSPEQ"};
    case Relation::isotropic_nonlinear: {
      std::vector<std::string> names = {"EPSPEQ", "INDIPLAS"};
      if (behaviour.kinematics != Kinematics::multiplicative) add_tensor(names, "EPSP");
      return names;
    }
    case Relation::kinematic_linear: {
      std::vector<std::string> names;
      add_tensor(names, "XCIN");
      names.emplace_back("INDIPLAS");
      return names;
    }
    case Relation::mixed_linear:
    case Relation::mixed_traction: {
      std::vector<std::string> names = {"EPSPEQ", "INDIPLAS"};
      add_tensor(names, "XCIN");
      return names;
    }
    case Relation::asymmetric_linear:
    case Relation::contact_spring:
    case Relation::bilinear_spring:
    case Relation::hardening_spring:
      break;
  }
  return {};
}

const CellBehaviour& behaviour_of(const BehaviourOfCells* behaviours, std::size_t cell) {
  static const CellBehaviour elastic;
  return behaviours == nullptr || behaviours->empty() ? elastic : (*behaviours)[cell];
}

/// All names, in the order in which cells bring them.
std::vector<std::string> names_in(const BehaviourOfCells* behaviours, std::size_t cells) {
  std::vector<std::string> names;
  CellBehaviour last{Kinematics::small, Relation::contact_spring};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const CellBehaviour& behaviour = behaviour_of(behaviours, cell);
    if (behaviour == last) continue;
    last = behaviour;
    for (const std::string& name : variable_names(behaviour))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

template <class AnyField>
int number_of(const AnyField& field, std::size_t variable) {
  return field.component(fmt::format("V{}", variable + 1));
}

Field named(const ElementField& field, const BehaviourOfCells* behaviours) {
  const std::size_t cells = field.starts.size() - 1;
  ElementField result{field.quantity, field.support, names_in(behaviours, cells), field.starts, {}};
  const std::size_t width = result.components.size();
  result.values.assign(static_cast<std::size_t>(field.starts.back()) * width, absent);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto own = variable_names(behaviour_of(behaviours, cell));
    for (std::size_t v = 0; v < own.size(); ++v) {
      const int source = number_of(field, v), target = result.component(own[v]);
      for (int row = field.starts[cell]; row < field.starts[cell + 1] && source >= 0; ++row)
        result.values[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(target)] =
            field.values[static_cast<std::size_t>(row) * field.components.size() + static_cast<std::size_t>(source)];
    }
  }
  return result;
}

Field named(const NodalField& field, const BehaviourOfCells* behaviours) {
  std::map<std::string, int> numbers;  // -1: not the same everywhere
  const std::size_t cells = behaviours == nullptr || behaviours->empty() ? 1 : behaviours->size();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto own = variable_names(behaviour_of(behaviours, cell));
    for (std::size_t v = 0; v < own.size(); ++v) {
      const int number = number_of(field, v);
      const auto [known, is_new] = numbers.emplace(own[v], number);
      if (!is_new && known->second != number) known->second = -1;
    }
  }
  NodalField result{field.quantity, {}, {}};
  std::vector<int> sources;
  for (const auto& [name, number] : numbers) {
    if (number < 0) continue;
    result.components.push_back(name);
    sources.push_back(number);
  }
  const std::size_t width = field.components.size();
  for (std::size_t row = 0; row < field.values.size() / width; ++row)
    for (const int source : sources)
      result.values.push_back(field.values[row * width + static_cast<std::size_t>(source)]);
  return result;
}

}  // namespace

std::vector<std::string> variable_names(const CellBehaviour& behaviour) {
  // What beams that turn keep has no names in the pages at hand.
  if (behaviour.kinematics == Kinematics::large_rotations) return {};
  std::vector<std::string> names = names_of_relation(behaviour);
  if (behaviour.kinematics == Kinematics::logarithmic && !names.empty()) add_tensor(names, "T");
  if (behaviour.kinematics == Kinematics::multiplicative && !names.empty())
    for (int i = 1; i <= 6; ++i) names.push_back(fmt::format("SM{}", i));
  if (behaviour.restores_hardening) names.emplace_back("ECROINIT");
  return names;
}

Field by_variable_names(const Field& field, const BehaviourOfCells* behaviours) {
  const auto rename = [&](const auto& any) {
    if (any.component("V1") < 0) throw Error("incompatible-field", "the field has no internal variables V1, V2 ...");
    return named(any, behaviours);
  };
  return std::visit(rename, field);
}

}  // namespace comma::solver
