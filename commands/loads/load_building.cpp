#include "commands/loads/load_building.hpp"
#include "commands/model/angles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "commands/concepts.hpp"
#include "commands/functions/functions.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/mesh/axes.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::Component;

const std::array<NamedComponent, 6> displacement_keywords = {{{"DX", Component::dx},
                                                              {"DY", Component::dy},
                                                              {"DZ", Component::dz},
                                                              {"DRX", Component::drx},
                                                              {"DRY", Component::dry},
                                                              {"DRZ", Component::drz}}};
const std::array<NamedComponent, 6> force_keywords = {{{"FX", Component::dx},
                                                       {"FY", Component::dy},
                                                       {"FZ", Component::dz},
                                                       {"MX", Component::drx},
                                                       {"MY", Component::dry},
                                                       {"MZ", Component::drz}}};

solver::Origin origin_of(const Keywords& keywords, const std::string& keyword) {
  if (!keywords.span) return std::make_shared<const std::string>(keyword);
  const auto& file = *keywords.span.file;
  return std::make_shared<const std::string>(fmt::format("{}:{}, {}",
                                                         std::filesystem::path(file.path()).filename().string(),
                                                         file.position(keywords.span.begin).line, keyword));
}

Amount amount_of(const Keywords& keywords, const std::string& name) {
  if (!keywords.has(name)) return {};
  if (!keywords.at(name).value.is_concept()) return {keywords.real(name), {}};
  return {0.0, field_function(keywords.concept_of(name), keywords.span_of(name))};
}

Component component_named(const Keywords& keywords, const std::string& keyword, const std::string& name) {
  if (const auto component = solver::component_named(name)) return *component;
  throw DiagnosticError("unknown-component", keyword + ": there is no component " + name, keywords.span_of(keyword),
                        "a displacement has DX, DY, DZ, DRX, DRY, DRZ, and PRES, GONF where the volume hardly changes");
}

bool is_plate(const LoadedModel& target, int cell) {
  return solver::is_plate(target.model.formulations[cell]) && !target.model.is_skin(cell);
}

bool is_surface(const LoadedModel& target, int cell) {
  if (solver::is_plate(target.model.formulations[cell])) return is_plate(target, cell);
  return target.model.is_skin(cell) && solver::dimension(target.mesh.cell_types[cell]) ==
                                           solver::continuum_dimension(target.model.formulations[cell]) - 1;
}

std::vector<int> carriers(const Keywords& keywords, const NamedComponent& named, const std::vector<int>& nodes,
                          const solver::DofMap& dofs) {
  std::vector<int> found;
  for (const int node : nodes) {
    if (dofs.dof(node, named.component) >= 0) found.push_back(node);
  }
  if (found.empty()) {
    throw DiagnosticError(
        "unknown-component",
        fmt::format("{}: none of these nodes carries {}", named.keyword, solver::name_of(named.component)),
        keywords.at(named.keyword).name_span, "the elements of the model around them have no such component");
  }
  return found;
}

std::vector<solver::LinearRelation::Term> terms_of_field(const Keywords& keywords, const LoadedModel& target) {
  const auto& given = keywords.data<FieldConcept>("CHAM_NO");
  const auto* field = std::get_if<solver::NodalField>(&given.field);
  if (field == nullptr)
    throw DiagnosticError("wrong-concept-type", "CHAM_NO wants a field on nodes", keywords.span_of("CHAM_NO"));
  if (given.mesh.get() != &target.mesh)
    throw DiagnosticError("incompatible-field", "CHAM_NO: the field lies on another mesh than the model",
                          keywords.span_of("CHAM_NO"));
  std::vector<solver::LinearRelation::Term> terms;
  for (std::size_t c = 0; c < field->components.size(); ++c) {
    const Component component = component_named(keywords, "CHAM_NO", field->components[c]);
    for (int node = 0; node < target.mesh.node_count(); ++node) {
      const double value = field->at(node, static_cast<int>(c));
      if (!std::isnan(value) && target.dofs.dof(node, component) >= 0) terms.push_back({node, component, value});
    }
  }
  return terms;
}

Eigen::Matrix3d axes_of_angles(const std::vector<double>& degrees) {
  std::array<double, 3> radians{};
  for (std::size_t i = 0; i < degrees.size(); ++i) radians[i] = degrees[i] * degree;
  return solver::nautical_axes(radians[0], radians[1], radians[2]);
}

}  // namespace comma::commands
