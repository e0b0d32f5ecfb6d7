#include "commands/alarms/doubt_advice.hpp"

#include <cmath>

#include <fmt/format.h>

namespace comma::commands {

namespace {

std::string how_to_follow(const solver::ContactDefinition& contact) {
  switch (contact.geometry_update) {
    case solver::GeometryUpdate::none:
      return "let the geometry be updated: REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::controlled:
      return "take more updates (NB_ITER_GEOM), or REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::automatic:
      break;
  }
  return "write a smaller RESI_GEOM, which is a share of the displacement of the step, or take smaller steps";
}

/// One function a kind of doubt.
class DoubtTeller {
 public:
  DoubtTeller(const solver::ContactDoubt& doubt, const solver::ContactDefinition& contact, const solver::Mesh& mesh)
      : doubt_(doubt), contact_(contact), mesh_(mesh), zone_(doubt.zone + 1) {}

  DoubtAdvice tell() const {
    switch (doubt_.kind) {
      case solver::DoubtKind::soft_penalty:
        return soft_penalty();
      case solver::DoubtKind::deep_penalty:
        return deep_penalty();
      case solver::DoubtKind::watched_overlap:
        return watched_overlap();
      case solver::DoubtKind::passed_over:
        return passed_over();
      case solver::DoubtKind::soft_bound:
        return soft_bound();
      case solver::DoubtKind::coarse_gradients:
        return coarse_gradients();
      case solver::DoubtKind::coarse_friction:
        return coarse_friction();
      case solver::DoubtKind::soft_friction:
        return soft_friction();
      case solver::DoubtKind::unshared_friction:
        return unshared_friction();
      case solver::DoubtKind::lowered_augmentation:
        return lowered_augmentation();
      case solver::DoubtKind::opening_by_gaps:
        return opening_by_gaps();
      case solver::DoubtKind::bridged_gap:
        return bridged_gap();
      case solver::DoubtKind::held_overlap:
        return held_overlap();
      case solver::DoubtKind::kept_facet:
        return kept_facet();
      case solver::DoubtKind::restless_geometry:
        return restless_geometry();
      case solver::DoubtKind::stale_geometry:
        return stale_geometry();
      case solver::DoubtKind::strong_friction:
        return strong_friction();
      case solver::DoubtKind::weak_friction:
        return weak_friction();
      case solver::DoubtKind::coarse_face:
        return coarse_face();
      case solver::DoubtKind::passed_average:
        return passed_average();
      case solver::DoubtKind::passed_master:
        return passed_master();
    }
    return passed_master();
  }

 private:
  DoubtAdvice soft_penalty() const {
    return {"soft-penalty",
            fmt::format("with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.0f} % of what they would "
                        "without contact: contact forces come out too small by about that share",
                        penalty(), doubt_.penalty, zone_, doubt_.length, 100.0 * doubt_.share),
            fmt::format("take {} = {:.0e}, or an exact method ({})", exact_coefficient(), doubt_.wanted,
                        exact_formulation())};
  }

  DoubtAdvice deep_penalty() const {
    return {
        "soft-penalty",
        fmt::format(
            "with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.2g} times the size of the slave side",
            penalty(), doubt_.penalty, zone_, doubt_.length, doubt_.share),
        fmt::format("take {} = {:.0e}, or an exact method ({})", exact_coefficient(), doubt_.wanted,
                    exact_formulation())};
  }

  DoubtAdvice watched_overlap() const {
    return {"interpenetration",
            fmt::format(
                "node {} lies {:.3g} deep in the other surface of zone {}, where contact is watched and not enforced",
                mesh_.node_name(doubt_.node), doubt_.length, zone_),
            "enforce contact there (RESOLUTION='OUI'), or allow the depth (TOLE_INTERP)"};
  }

  DoubtAdvice passed_over() const {
    return {"passed-over",
            fmt::format("node {} and its like in zone {} stay open {:.3g} deep in the master: ALGO_CONT='CONTRAINTE' "
                        "passes over what overlaps less than where its iteration began, and would be apart without "
                        "contact",
                        mesh_.node_name(doubt_.node), zone_, doubt_.length),
            "take ALGO_CONT='GCP', which closes them; smaller steps or more updates of the geometry may"};
  }

  DoubtAdvice soft_bound() const {
    return {"soft-penalty",
            fmt::format("with COEF_PENA = {:.3g} bounds of zone {} are passed by {:.3g}, {:.0f} % of what they would "
                        "be without them: forces come out too small by about that share",
                        doubt_.penalty, zone_, doubt_.length, 100.0 * doubt_.share),
            fmt::format("take COEF_PENA = {:.0e}, or ALGO_CONT='CONTRAINTE'", doubt_.wanted)};
  }

  DoubtAdvice coarse_gradients() const {
    return {"coarse-gradients",
            fmt::format("projected gradients stop with slave nodes of zone {} {:.3g} inside the master, {:.0f} % of "
                        "what they would be without contact: contact forces are wrong by about that share",
                        zone_, doubt_.length, 100.0 * doubt_.share),
            fmt::format("take a smaller RESI_ABSO than {:.3g}, or ALGO_CONT='CONTRAINTE'", doubt_.penalty)};
  }

  DoubtAdvice coarse_friction() const {
    return {"coarse-friction",
            fmt::format("RESI_FROT = {:.3g} ends the iterations on friction where pressures and friction of zone {} "
                        "still change by {:.2g} % of the largest: figures are those of the last iteration",
                        doubt_.penalty, zone_, 100.0 * doubt_.share),
            "take RESI_FROT = 1e-4, which is the default"};
  }

  DoubtAdvice soft_friction() const {
    return {"soft-friction-penalty",
            fmt::format("with {} = {:.3g} slave nodes of zone {} that stick creep by {:.3g}, {:.0f} % of what they "
                        "would slip without friction: friction comes out too small by about that share",
                        friction_penalty(), doubt_.penalty, zone_, doubt_.length, 100.0 * doubt_.share),
            fmt::format("take {} = {:.0e}, or {}, where what sticks does not creep", friction_penalty(), doubt_.wanted,
                        is_mixed() ? "ALGO_FROT='STANDARD'" : "FORMULATION='CONTINUE'")};
  }

  DoubtAdvice unshared_friction() const {
    return {
        "friction-by-shears",
        fmt::format(
            "no solution was found in which points of zone {} between nodes rub by a share of the limit of friction "
            "(R5.03.52): there friction is by shears interpolated between the nodes, which is another discretisation",
            zone_),
        "put points on the nodes, where both are the same (INTEGRATION='AUTO' on linear faces), or take smaller steps"};
  }

  DoubtAdvice lowered_augmentation() const {
    return {"softer-coefficient",
            fmt::format("with COEF_CONT = {:.3g} no states of the points of zone {} hold the law of contact and "
                        "friction: one of {:.1g} was taken, which is in the solution where faces are partly in contact",
                        doubt_.penalty, zone_, doubt_.wanted),
            fmt::format("take COEF_CONT = {:.0e}, put points on the nodes, where it is not in the solution "
                        "(INTEGRATION='AUTO' on linear faces), or take smaller steps",
                        doubt_.wanted)};
  }

  DoubtAdvice opening_by_gaps() const {
    return {"opening-by-gaps",
            fmt::format("with the penalty no states of the points of zone {} between nodes hold the law of contact: "
                        "there they open by their gaps alone, whatever the pressure of the nodes",
                        zone_),
            "put points on the nodes, where both are the same (INTEGRATION='AUTO' on linear faces), or take "
            "ALGO_CONT='STANDARD'"};
  }

  DoubtAdvice bridged_gap() const {
    return {"bridged-gap",
            fmt::format("GLISSIERE holds the surfaces of zone {} together from the first step on, and pulls node {} "
                        "across a gap of {:.3g}",
                        zone_, mesh_.node_name(doubt_.node), doubt_.length),
            "begin where the surfaces touch, or let contact open (GLISSIERE='NON'); ALARME_JEU is the gap from which "
            "on this is told"};
  }

  DoubtAdvice held_overlap() const {
    return {"held-overlap",
            fmt::format("conditions on displacements hold slave face {} of zone {} inside the master, {:.3g} deep, "
                        "where the penalty gives no force",
                        mesh_.cell_name(doubt_.cell), zone_, doubt_.length),
            "free its nodes along the normal, or take them out of the contact (SANS_GROUP_NO)"};
  }

  DoubtAdvice kept_facet() const {
    return {
        "kept-facet",
        fmt::format(
            "from one update of the geometry to the next points of zone {} hop between two facets, or off the surface, "
            "{} for one: they are left where they were, beside the facet that they face by up to {:.2g} of its size",
            zone_, mesh_.node_name(doubt_.node), doubt_.share),
        "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master"};
  }

  DoubtAdvice restless_geometry() const {
    return {"restless-geometry",
            fmt::format("updates of the contact geometry move it to and fro without coming to rest, by {:.2g} of the "
                        "displacement of a step at most, most at node {}: results are known to about that share",
                        doubt_.share, mesh_.node_name(doubt_.node)),
            "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master, where points hop between two "
            "facets; a smaller penalty where its rounding moves them"};
  }

  DoubtAdvice stale_geometry() const {
    return {"stale-geometry",
            fmt::format("the surfaces of zone {} have moved on since they were paired: the gap at {} is {:.3g} off, "
                        "{:.0f} % of what contact pushes back",
                        zone_, mesh_.node_name(doubt_.node), doubt_.length, 100.0 * doubt_.share),
            how_to_follow(contact_)};
  }

  DoubtAdvice strong_friction() const {
    return {"strong-friction",
            fmt::format("zone {} bears {:.0f} % more friction than COULOMB times what presses on it: the limit of "
                        "points between nodes is that of multipliers which they share with open points",
                        zone_, 100.0 * doubt_.share),
            "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
  }

  DoubtAdvice weak_friction() const {
    return {"weak-friction",
            fmt::format("faces of zone {} are partly in contact, and their points that slide lack {:.0f} % of the "
                        "friction that COULOMB times all that presses would be: the limit there is that of multipliers "
                        "which they share with open points",
                        zone_, 100.0 * doubt_.share),
            "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
  }

  DoubtAdvice coarse_face() const {
    return {
        "coarse-slave",
        fmt::format(
            "where faces of the slave side of zone {} are partly in contact their points overlap the master by {:.3g} "
            "on the mean, {:.0f} % of what contact pushes back: forces come out too small by about that share",
            zone_, doubt_.length, 100.0 * doubt_.share),
        "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
  }

  DoubtAdvice passed_average() const {
    return {"coarse-slave",
            fmt::format("slave nodes of zone {} are inside the master, {:.3g} deep on the mean, {}: the averages over "
                        "patches of ALGO_CONT='LAC' hold it back in the mean alone",
                        zone_, doubt_.length,
                        std::isfinite(doubt_.share)
                            ? fmt::format("{:.0f} % of what contact pushes back", 100.0 * doubt_.share)
                            : "and contact pushes nothing back"),
            "refine the slave side there, or hold each node (ALGO_CONT='STANDARD')"};
  }

  DoubtAdvice passed_master() const {
    const std::string hint = is_mixed()
                                 ? "make the finer side the slave, take more points (INTEGRATION='NCOTES', ORDRE_INT), "
                                   "or averages (ALGO_CONT='LAC')"
                                 : "make the finer side the slave, or take FORMULATION='CONTINUE' with ALGO_CONT='LAC'";
    constexpr double nothing_but_rounding = 1e6;  // of what goes through, beside what is pushed back
    if (!(doubt_.share < nothing_but_rounding))
      return {"coarse-slave",
              fmt::format("master nodes of zone {} have gone through the slave side, {:.3g} deep on the mean, and "
                          "contact pushes nothing back: no slave node has faced the master",
                          zone_, doubt_.length),
              std::string("look which way the normals point (VECT_MAIT, VECT_ESCL, ORIE_PEAU), and what DIST_APPA, "
                          "TOLE_PROJ_EXT and SANS_GROUP_NO leave out; ") +
                  (is_mixed() ? "" : "or ") + hint};
    return {"coarse-slave",
            fmt::format(
                "master nodes of zone {} go through the slave side between its nodes, {:.3g} deep on the mean, {:.0f} "
                "% of what contact pushes back: forces come out too small or motions too large by about that share",
                zone_, doubt_.length, 100.0 * doubt_.share),
            hint};
  }

  bool is_mixed() const { return contact_.formulation == solver::ContactFormulation::mixed; }

  bool is_adapted() const {
    const auto number = static_cast<std::size_t>(doubt_.zone);
    return number < contact_.zones.size() && contact_.zones[number].mixed.adapts_penalty;
  }

  /// The words for what is too soft, and for what to give in its place.
  std::string coefficient() const { return is_mixed() ? "COEF_PENA_CONT" : "E_N"; }
  std::string penalty() const { return is_adapted() ? "an adapted penalty (ADAPTATION)" : coefficient(); }
  std::string exact_coefficient() const {
    return is_adapted() ? "ADAPTATION='NON' and " + coefficient() : coefficient();
  }
  std::string friction_penalty() const { return is_mixed() ? "COEF_PENA_FROT" : "E_T"; }
  std::string exact_formulation() const { return is_mixed() ? "ALGO_CONT='STANDARD'" : "ALGO_CONT='CONTRAINTE'"; }

  const solver::ContactDoubt& doubt_;
  const solver::ContactDefinition& contact_;
  const solver::Mesh& mesh_;
  int zone_;  ///< as the command file counts them, from 1
};

}  // namespace

DoubtAdvice advice_on(const solver::ContactDoubt& doubt, const solver::ContactDefinition& contact,
                      const solver::Mesh& mesh) {
  return DoubtTeller(doubt, contact, mesh).tell();
}

}  // namespace comma::commands
