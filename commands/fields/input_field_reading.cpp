#include "commands/fields/input_field_reading.hpp"

#include "commands/fields/field_types.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/points/input_fields.hpp"

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;

namespace {

// The quantity that TYPE_CHAM names must be the one that NOM_CHAM has.
std::shared_ptr<FieldConcept> checked(const Call& call, const std::string& owner,
                                      std::shared_ptr<const solver::Model> model, solver::ElementField field) {
  const std::string quantity = field_type(call.text("TYPE_CHAM")).quantity_name();
  const std::string& name = call.text("NOM_CHAM");
  if (field.quantity != quantity) {
    throw DiagnosticError("wrong-type",
                          "CREA_CHAMP: " + name + " is a field of " +
                              field.quantity.substr(0, field.quantity.size() - 2) + ", which TYPE_CHAM does not say",
                          call.span_of("TYPE_CHAM"));
  }
  if (field.values.empty()) {
    throw DiagnosticError("unknown-field", "CREA_CHAMP: " + owner + " holds nothing of " + name,
                          call.span_of("NOM_CHAM"));
  }
  auto product = std::make_shared<FieldConcept>();
  product->mesh = model->mesh;
  product->model = std::move(model);
  product->field = std::move(field);
  return product;
}

solver::ElementField forces_named(const std::string& name, const solver::Mesh& mesh, const solver::Load& load) {
  if (name == ".CHME.PRESS") return solver::pressure_data(mesh, load);
  // ".CHME.F1D3D": forces on cells of dimension 1 in a body of dimension 3.
  return solver::force_data(mesh, load, name[7] - '0');
}

// The dimension of the body that forces act on: plane models have forces of ".CHME.F.D2D", the others ".CHME.F.D3D".
bool is_of_dimension(const std::string& name, const solver::Model& model) {
  if (name == ".CHME.PRESS") return true;
  bool plane = false;
  for (const solver::Formulation formulation : model.formulations)
    plane |= solver::continuum_dimension(formulation) == 2;
  return name[9] == (plane ? '2' : '3');
}

}  // namespace

std::shared_ptr<FieldConcept> field_of_characteristics(const Call& call) {
  const auto& data = call.data<PropertiesConcept>("CARA_ELEM");
  auto field = call.text("NOM_CHAM") == ".CARCOQUE" ? solver::plate_data(*data.model->mesh, data.named_plates)
                                                    : solver::layer_counts(*data.model->mesh, data.properties->plates);
  return checked(call, call.concept_of("CARA_ELEM")->name, data.model, std::move(field));
}

std::shared_ptr<FieldConcept> field_of_load(const Call& call) {
  const auto& data = call.data<LoadConcept>("CHARGE");
  const std::string& name = call.text("NOM_CHAM");
  try {
    auto field = is_of_dimension(name, *data.model) ? forces_named(name, *data.model->mesh, *data.load.get())
                                                    : solver::ElementField{"FORC_R", {}, {}, {0}, {}};
    return checked(call, call.concept_of("CHARGE")->name, data.model, std::move(field));
  } catch (const solver::Error& error) {
    throw DiagnosticError(error.code(), std::string("CREA_CHAMP: ") + error.what(), call.span_of("CHARGE"),
                          error.hint());
  }
}

}  // namespace comma::commands
