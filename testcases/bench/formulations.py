"""The formulations of contact that the benches compare, as the keywords of DEFI_CONTACT that they need."""
from __future__ import annotations

from dataclasses import dataclass

# Penalties are this many times the stiffness of a cell: depths then are some 1e-4 of what the body gives way.
PENALTY = 1e4


@dataclass(frozen=True)
class Scale:
    """What penalties and coefficients are made of."""

    young: float  # Pa, of the slave body
    length: float  # m, of the contact
    cell: float  # m, of the slave cells
    solid: bool


@dataclass(frozen=True)
class Formulation:
    """`word` is FORMULATION; `rule` the words of a zone. `penalised` and the like choose what a zone needs beside them."""

    name: str
    word: str
    rule: tuple[tuple[str, object], ...]

    def new_slave_nodes(self, faces: int, in_space: bool) -> int:
        """How many nodes slave faces get (CREA_MAILLAGE/DECOUPE_LAC, QUAD4 and HEXA8)."""
        if self.algorithm != "LAC":
            return 0
        return faces if in_space else 2 * faces

    @property
    def is_discrete(self) -> bool:
        return self.word == "DISCRETE"

    @property
    def algorithm(self) -> str:
        return dict(self.rule).get("ALGO_CONT", "")

    def values(self, scale: Scale, friction: float | None = None) -> dict[str, object]:
        """What goes in front of a command file: formulation, zone and options."""
        return {"formulation": self.word, "zone": self._zone(scale, friction), "options": self._options(scale, friction)}

    def _zone(self, scale: Scale, friction: float | None) -> dict[str, object]:
        zone = dict(self.rule)
        if self.algorithm == "PENALISATION":
            if self.is_discrete:
                zone["E_N"] = PENALTY * scale.young * (scale.cell if scale.solid else 1.0)
            elif self.word == "CONTINUE":
                zone["COEF_PENA_CONT"] = PENALTY * scale.young / scale.length
        if self.algorithm == "STANDARD":
            zone["COEF_CONT"] = scale.young / scale.length
        if friction is not None:
            zone["COULOMB"] = friction
            if self.is_discrete:
                zone["E_T"] = PENALTY * scale.young * (scale.cell if scale.solid else 1.0)
        return zone

    def _options(self, scale: Scale, friction: float | None) -> dict[str, object]:
        if self.word == "LIAISON_UNIL":
            return {}
        options: dict[str, object] = {"REAC_GEOM": "SANS"}
        if self.algorithm == "GCP":
            options |= {"RESI_ABSO": 1e-14 * scale.length, "PRE_COND": "DIRICHLET"}
        if friction is not None:
            options["FROTTEMENT"] = "COULOMB"
        return options


def _discrete(algorithm: str) -> Formulation:
    return Formulation(algorithm, "DISCRETE", (("ALGO_CONT", algorithm),))


def _mixed(rule: str, order: int | None = None) -> Formulation:
    words: tuple[tuple[str, object], ...] = (("ALGO_CONT", "STANDARD"), ("INTEGRATION", rule))
    if order is not None:
        words += (("ORDRE_INT", order),)
    return Formulation(f"CONTINUE {rule}" + ("" if order is None else f" {order}"), "CONTINUE", words)


FORMULATIONS: dict[str, Formulation] = {
    formulation.name: formulation
    for formulation in (
        _discrete("CONTRAINTE"),
        _discrete("GCP"),
        _discrete("PENALISATION"),
        _mixed("AUTO"),
        _mixed("GAUSS", 2),
        _mixed("SIMPSON", 1),
        _mixed("NCOTES", 3),
        Formulation("CONTINUE PENALISATION", "CONTINUE", (("ALGO_CONT", "PENALISATION"),)),
        Formulation("LAC", "CONTINUE", (("ALGO_CONT", "LAC"), ("APPARIEMENT", "MORTAR"))),
        Formulation("LIAISON_UNIL", "LIAISON_UNIL", ()),
    )
}

EXACT = ("CONTRAINTE", "GCP")
MIXED = ("CONTINUE AUTO", "CONTINUE GAUSS 2", "CONTINUE SIMPSON 1", "CONTINUE NCOTES 3")
PENALISED = ("PENALISATION", "CONTINUE PENALISATION")
ALL = (*EXACT, "PENALISATION", *MIXED, "CONTINUE PENALISATION", "LIAISON_UNIL")
BETWEEN_BODIES = tuple(name for name in ALL if name != "LIAISON_UNIL")
# LAC cuts the slave cells: it is run where the mesh may be cut.
WITH_LAC, BETWEEN_BODIES_WITH_LAC = (*ALL, "LAC"), (*BETWEEN_BODIES, "LAC")
# Those that know friction.
RUBBING = (*PENALISED, "CONTINUE AUTO")
