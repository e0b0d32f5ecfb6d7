// What the concepts of a command file hold: thin handles on the solver's data.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "commands/analysis/renewed.hpp"
#include "commands/functions/functions.hpp"
#include "commands/loads/multiplier_sum.hpp"
#include "commands/tables/table.hpp"
#include "interpreter/graph/concept.hpp"
#include "solver/contact/definition.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/fields/points/input_fields.hpp"
#include "solver/functions/function.hpp"
#include "solver/loads/load.hpp"
#include "solver/materials/material.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

using interpreter::ConceptData;
using interpreter::Value;

struct MeshConcept : ConceptData {
  std::shared_ptr<solver::Mesh> mesh;

  /// LIST_GROUP_NO(), LIST_GROUP_MA(): tuples of a group's name and its number of members (as Code_Aster 17.3 has them;
  /// U1.03.02 knows the largest dimension of cells besides); getGroupsOfNodes(), getGroupsOfCells(): names;
  /// hasGroupOfNodes(), hasGroupOfCells();
  /// getNodes(), getCells(): numbers from 0, of groups or all; getNumberOfNodes(), getNumberOfCells(), getDimension();
  /// getConnectivity(): the nodes of each cell, from 0; getCoordinates(), which has getValues() and toNumpy().
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
};

struct ModelConcept : ConceptData {
  std::shared_ptr<solver::Model> model;
};

struct MaterialConcept : ConceptData {
  std::shared_ptr<const solver::Material> material;
  std::vector<std::string> laws;  ///< the factor keywords of DEFI_MATERIAU that gave it something
};

struct MaterialFieldConcept : ConceptData {
  Renewed<solver::MaterialField> field;  ///< of materials and of fields of command variables
  std::shared_ptr<const solver::Mesh> mesh;
};

struct PropertiesConcept : ConceptData {
  std::shared_ptr<const solver::ElementProperties> properties;
  std::shared_ptr<const solver::Model> model;
  solver::PlateSections named_plates;  ///< of all cells that COQUE names, whether they are plates or not
};

/// AFFE_CHAR_MECA and AFFE_CHAR_CINE alike: conditions are eliminated whichever command wrote them.
struct LoadConcept : ConceptData {
  Renewed<solver::Load> load;  ///< of the fields that hold forces (VECT_ASSE, EVOL_CHAR)
  std::shared_ptr<const solver::Model> model;
};

struct ListConcept : ConceptData {
  std::vector<double> values;
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(values.size()); }
  /// Valeurs() and getValues(): the numbers as a list.
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override { return {"Valeurs", "getValues"}; }
};

struct IntegerListConcept : ConceptData {
  std::vector<std::int64_t> values;
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(values.size()); }
  /// Valeurs() and getValues(): the numbers as a list.
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override { return {"Valeurs", "getValues"}; }
};

/// Instants with rules on how steps are cut and adapted.
struct StepPlanConcept : ConceptData {
  solver::StepPlan plan;
};

struct ContactConcept : ConceptData {
  std::shared_ptr<const solver::Model> model;
  std::variant<solver::ContactDefinition, std::vector<solver::UnilateralCondition>> conditions;
};

/// What the first steps of a result were computed from, where a later command has gone on with others (reuse=).
struct EarlierPhase {
  int last_order = 0;  ///< of its steps
  solver::StaticProblem problem;
};

/// A table that grows with the steps of a result, and shrinks with them.
struct StepTable {
  Table table;
  std::map<int, std::size_t> ends = {};  ///< how many rows there were when a step had left its own, by its order

  void end_step(int order) { ends[order] = table.rows.size(); }
  /// Takes away what later steps have left.
  void forget_after(int order);
};

/// A result and what CALC_CHAMP needs to go on from it; `problem` has no model when the result lies on a mesh alone.
struct ResultConcept : ConceptData {
  solver::Result result;
  solver::StaticProblem problem;      ///< of the steps after the earlier phases
  std::vector<EarlierPhase> earlier;  ///< in order

  /// MODELE, CHAMPMAT, CARAELEM: the numbers of these concepts in the file, eight hexadecimal digits.
  std::map<std::string, std::string> sources;

  /// What a step was computed from.
  const solver::StaticProblem& problem_of(const solver::ResultStep& step) const;
  std::optional<StepTable> observations;  ///< what OBSERVATION followed through the steps
  std::optional<StepTable> computed;      ///< PARA_CALC: every step of STAT_NON_LINE, those not kept included
  std::optional<StepTable> modes;         ///< the eigenvalues that CRIT_STAB asked for

  /// getTable("PARA_CALC"): a table that the result keeps, None for a name that it does not have. Dicts of lists, one
  /// value a step: LIST_VARI_ACCES() and getAccessParameters() (NUME_ORDRE, INST), LIST_PARA() (these and the
  /// parameters); LIST_CHAMPS(): the orders that have each field. getIndexes(), getNumberOfIndexes(), getFirstIndex(),
  /// getLastIndex(); getTime(index), getLastTime(); getFieldsNames(); getField(name, index), or getField(name,
  /// value=..., para="INST").
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
};

/// A field of its own (CREA_CHAMP) and what it lies on; `model` is null for a field that knows its mesh alone.
struct FieldConcept : ConceptData {
  solver::Field field;
  std::shared_ptr<const solver::Mesh> mesh;
  std::shared_ptr<const solver::Model> model;
  /// Of a field of functions (TYPE_CHAM='..._F'): its values are then indices into this list.
  std::vector<std::shared_ptr<const FunctionConcept>> functions;
  /// Of a result from which the field was taken: they name internal variables.
  std::shared_ptr<const solver::BehaviourOfCells> behaviours = {};
  /// The multipliers of relations that stand beside displacements taken of a result, computed when asked for; null
  /// where there are none.
  std::shared_ptr<const MultiplierSum> multipliers = {};

  /// EXTR_COMP(comp, groups, topo): an object with valeurs (an array, values at nodes or points in turn, components
  /// within), and with topo > 0 comp and noeud, or maille, point and sous_point, numbers from 1 (U1.03.02);
  /// norm("NORM_1", components), NORM_2, NORM_INFINITY: of the values of components, multipliers not among them;
  /// copy(); getValues(): all values; getValuesWithDescription(components, groups): values and where they lie, numbers
  /// from 0; getComponents(). A sum, a difference, and a number times the field.
  std::shared_ptr<ConceptData> combined(interpreter::Operator op, const Value& other, bool reversed) const override;
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
};

struct TableConcept : ConceptData {
  Table table;

  Value subscript(const Value& key) const override;
  /// EXTR_TABLE(): what extracted_table() gives; get_nom_para() and getParameters(): the names of its columns;
  /// getNumberOfLines().
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override;
  std::vector<std::string> method_names() const override;
};

/// What a command function returns; null for a command that produces nothing.
using Product = std::shared_ptr<ConceptData>;

}  // namespace comma::commands
