"""The stability maps: what goes to an extreme, in which scene, by which formulations, and what counts as right."""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import formulations as f
from contact_scenes import PLANE, bars, hertz_section, stacked, standing_block
from formulations import FORMULATIONS, Scale
from meshes import Grid, Mesh, at, build_mesh, merged, on
from run import Case

# Largest relative error of an answer that counts as right, where the scene's elements have the solution exactly: what a penalty
# may give way.
TOLERANCE = 0.01
# Where the mesh has its say too: the resultant of Hertz on 20 cells has 0.2 to 0.6 %, of the patch test on a few cells up to 5 %.
MESHED = 0.05

Values = dict[str, object]


@dataclass(frozen=True)
class StabilityMap:
    """A row for each series, a column for each value. `setting(series, value)` gives mesh, formulation and what differs from the usual."""

    name: str
    title: str
    axis: str
    values: tuple[object, ...]
    series: tuple[str, ...]
    folder: str
    modelisation: str
    mesh: Callable[[object], Mesh]
    formulation: Callable[[str, object], Values]
    parameters: Callable[[str, object], Values]
    tolerances: dict[str, float] = field(default_factory=lambda: {"resultant": TOLERANCE})
    pressure: str = ""
    contradictory: tuple[object, ...] = ()  # values without a solution: an error that says so is right
    own_measure: bool = False
    mesh_key: Callable[[object], object] = lambda value: None  # which values have a mesh of their own
    family: str = "QUAD4"

    def case(self, series: str, value: object, slave_nodes: int) -> Case:
        values: Values = {"slave_nodes": slave_nodes, "measured": {"penetration": "penetration" in self.tolerances, "pressure": self.pressure}}
        values |= self.formulation(series, value) | self.parameters(series, value)
        return Case(self.name, self.folder, self.family, self.modelisation, "MULT_FRONT", 0, values, None if self.own_measure else "contact.comm")


SCENES = "../stability/scenes/"
STEEL, RUBBER = 2.0e11, 1.0e9
BARS = {"first": STEEL, "second": STEEL, "gap": 1.0e-3, "push": 2.0e-3}


def usual(young: float, cell: float = 0.1, friction: float | None = None, solid: bool = False) -> Callable[[str, object], Values]:
    """The formulation that the series is named by, with the penalties of formulations.py."""
    return lambda series, _: FORMULATIONS[series].values(Scale(young, 1.0, cell, solid), friction)


def changed(formulation: str, young: float, keyword: str, value: object, friction: float | None = None) -> Values:
    """The same with one keyword of the zone changed."""
    values = FORMULATIONS[formulation].values(Scale(young, 1.0, 0.1, solid=False), friction)
    return values | {"zone": {**values["zone"], keyword: value}}


def decades(low: int, high: int) -> tuple[float, ...]:
    return tuple(10.0**power for power in range(low, high + 1))


# --- meshes ---------------------------------------------------------------------------------------------------------------


def short_bars(gap: float) -> Mesh:
    """The bars of contact_scenes.py, the second one behind another gap."""
    mesh = bars("QUAD4", 2)
    mesh.coordinates = [(x + gap - 1.0e-3, y) if x > 1.0e-4 else (x, y) for x, y in mesh.coordinates]
    return mesh


def flat_block(_: object, solid: bool = False) -> Mesh:
    """A block 1/10 high and 1 wide (and deep) that does not tip over, whatever the friction."""
    mesh = standing_block("HEXA8", 4, True) if solid else standing_block("QUAD4", 8, False)
    mesh.coordinates = [(*point[:-1], 0.1 * point[-1]) if point[-1] > 0.0 else point for point in mesh.coordinates]
    return mesh


def raised_block(gap: float) -> Mesh:
    mesh = standing_block("QUAD4", 4, solid=False)
    table = {node for cell in mesh.cell_groups["OBSTACLE"] for node in [nodes for of_type in mesh.cells.values() for nodes in of_type][cell]}
    mesh.coordinates = [point if node in table else (point[0], point[1] + gap) for node, point in enumerate(mesh.coordinates)]
    return mesh


def matching_blocks(_: object) -> Mesh:
    """Two blocks of 1 x 1/2 with four cells along the contact; POINT and OTHER are slave nodes, FACING lies under POINT."""
    upper = build_mesh(Grid((4, 2), lambda p: (p[0], 0.5 * p[1]), {"SLAVE": on(1, 0.0), "TOP": on(1, 1.0), "LEFT": on(0, 0.0)},
                            {"POINT": at(0.5, 0.0), "OTHER": at(1.0, 0.0)}), "QUAD4")
    lower = build_mesh(Grid((4, 2), lambda p: (p[0], 0.5 * p[1] - 0.5), {"MASTER": on(1, 1.0), "BASE": on(1, 0.0), "LEFT": on(0, 0.0)},
                            {"FACING": at(0.5, 1.0)}), "QUAD4")
    whole = merged([("U_", upper), ("L_", lower)])
    whole.cell_groups["SLAVE"] = whole.cell_groups.pop("U_SLAVE")
    for name in ("U_POINT", "U_OTHER", "L_FACING"):
        whole.node_groups[name[2:]] = whole.node_groups.pop(name)
    return whole


def unequal_blocks(ratio: float, finest: int = 32, solid: bool = False) -> Mesh:
    """Two blocks 1 wide (and deep) and 1/2 high; slave cells are `ratio` times as long as master cells, the finer side has `finest`."""
    slave, master = (round(finest / ratio), finest) if ratio >= 1.0 else (finest, round(finest * ratio))
    high = 2 if solid else 1

    def block(count: int, base: float, sides: dict) -> Mesh:
        sides |= {"LEFT": on(0, 0.0)} | ({"FRONT": on(1, 0.0)} if solid else {})
        counts = (count,) * high + (max(2, count // 2),)
        return build_mesh(Grid(counts, lambda p: (*p[:high], base + 0.5 * p[high]), sides), "HEXA8" if solid else "QUAD4")

    upper = block(slave, 0.0, {"SLAVE": on(high, 0.0), "TOP": on(high, 1.0)})
    lower = block(master, -0.5, {"MASTER": on(high, 1.0), "BASE": on(high, 0.0)})
    whole = merged([("U_", upper), ("L_", lower)])
    whole.cell_groups["SLAVE"] = whole.cell_groups.pop("U_SLAVE")
    return whole


WAVY_LENGTH, WAVY_HEIGHT = 40.0, 1.0e-2


def strip(waves: int) -> Mesh:
    """A strip of 40 x 1 on a table with nodes beneath each of its own, but for the cells at its ends."""
    count = 320
    shape = lambda p: (WAVY_LENGTH * p[0], p[1])
    inner = lambda p: p[1] == 0.0 and 0.5 / count < p[0] < 1.0 - 0.5 / count
    body = build_mesh(Grid((count, 2), shape, {"SLAVE": inner, "TOP": on(1, 1.0), "LEFT": on(0, 0.0), "RIGHT": on(0, 1.0)}), "QUAD4")

    def wavy(p: tuple[float, ...]) -> tuple[float, float]:
        x = WAVY_LENGTH * p[0]
        return (x, 0.5 * WAVY_HEIGHT * (math.cos(2.0 * math.pi * waves * x / WAVY_LENGTH) - 1.0) + 0.2 * (p[1] - 1.0))

    table = build_mesh(Grid((count, 1), wavy, {"MASTER": on(1, 1.0)}), "QUAD4")
    table.cell_groups["OBSTACLE"] = table.cell_groups.pop("BODY")
    table.node_groups.clear()
    return merged([("", body), ("", table)])


THRESHOLD, SLOPE = 0.05, (1.0, 1.5)


def block_before_threshold(_: object) -> Mesh:
    """A block of 1/2 x 1/2 on a floor that rises by 1/20 between x = 1 and 1.5."""
    block = build_mesh(Grid((4, 4), lambda p: (0.5 * p[0], 0.5 * p[1]), {"SLAVE": on(1, 0.0), "TOP": on(1, 1.0)}, {"LEADER": at(0.5, 1.0)}), "QUAD4")

    def uneven(p: tuple[float, ...]) -> tuple[float, float]:
        x = 6.0 * p[0] - 1.0
        share = min(1.0, max(0.0, (x - SLOPE[0]) / (SLOPE[1] - SLOPE[0])))
        return (x, THRESHOLD * share + 0.2 * (p[1] - 1.0))

    floor = build_mesh(Grid((60, 1), uneven, {"MASTER": on(1, 1.0), "FLOOR_BASE": on(1, 0.0)}), "QUAD4")
    floor.cell_groups["FLOOR"] = floor.cell_groups.pop("BODY")
    floor.node_groups.clear()
    return merged([("", block), ("", floor)])


# --- the list -------------------------------------------------------------------------------------------------------------


def _penalties() -> StabilityMap:
    keywords = {"PENALISATION: E_N": ("PENALISATION", "E_N"), "CONTINUE PENALISATION: COEF_PENA_CONT": ("CONTINUE PENALISATION", "COEF_PENA_CONT"),
                "CONTINUE AUTO: COEF_CONT": ("CONTINUE AUTO", "COEF_CONT"), "CONTINUE GAUSS 2: COEF_CONT": ("CONTINUE GAUSS 2", "COEF_CONT")}
    return StabilityMap(
        "penalty", "Penalty or augmentation over the modulus", "coefficient / E (1/m)", decades(-6, 6), tuple(keywords), "gap_bar", "C_PLAN",
        lambda _: short_bars(1.0e-3), lambda series, value: changed(keywords[series][0], STEEL, keywords[series][1], value * STEEL),
        lambda series, value: BARS, pressure="stress", tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE})


def _friction_penalties() -> StabilityMap:
    keywords = {"PENALISATION: E_T": ("PENALISATION", "E_T"), "CONTINUE AUTO: COEF_FROT": ("CONTINUE AUTO", "COEF_FROT"),
                "CONTINUE PENALISATION: COEF_FROT": ("CONTINUE PENALISATION", "COEF_FROT")}
    return StabilityMap(
        "friction_penalty", "Penalty or augmentation of friction over the modulus (a block that slides)", "coefficient / E (1/m)", decades(-6, 6),
        tuple(keywords), "sliding", "D_PLAN", flat_block,
        lambda series, value: changed(keywords[series][0], RUBBER, keywords[series][1], value * RUBBER, 0.3),
        lambda series, value: {"friction": 0.3, "steps": 10, "angle": 0.0})


def _stiffness() -> StabilityMap:
    def scaled(series: str, value: object) -> Values:
        return usual(min(STEEL, STEEL / value))(series, value)

    return StabilityMap(
        "stiffness", "Moduli of slave over master (a bar that closes a gap)", "E slave / E master", decades(-8, 8), f.BETWEEN_BODIES_WITH_LAC, "gap_bar", "C_PLAN",
        lambda _: short_bars(1.0e-3), scaled, lambda series, value: BARS | {"second": STEEL / value}, pressure="stress",
        tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE})


def _friction() -> StabilityMap:
    return StabilityMap(
        "friction", "Friction coefficient (a block that slides)", "COULOMB", (0.0, 0.01, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0), f.RUBBING, "sliding",
        "D_PLAN", flat_block, lambda series, value: usual(RUBBER, friction=value)(series, value),
        lambda series, value: {"friction": value, "steps": 10, "angle": 0.0})


def _threshold() -> StabilityMap:
    updates = {"AUTOMATIQUE": {"REAC_GEOM": "AUTOMATIQUE"}, "CONTROLE 2": {"REAC_GEOM": "CONTROLE", "NB_ITER_GEOM": 2}, "SANS": {"REAC_GEOM": "SANS"}}
    series = {f"{name}, AUTOMATIQUE": (name, "AUTOMATIQUE") for name in f.BETWEEN_BODIES_WITH_LAC}
    series |= {f"{name}, {update}": (name, update) for name in ("CONTRAINTE", "CONTINUE AUTO") for update in ("CONTROLE 2", "SANS")}

    def updated(which: str, value: object) -> Values:
        name, update = series[which]
        values = usual(RUBBER)(name, value)
        return values | {"options": {**values["options"], **updates[update]}}

    return StabilityMap(
        "threshold", "Number of load steps (a block led over a threshold, the geometry being updated)", "steps", STEPS, tuple(series), SCENES + "threshold",
        "D_PLAN", block_before_threshold, updated, lambda series, value: {"steps": value})


STEPS = (1, 2, 3, 5, 10, 20, 50, 100)


def _steps() -> StabilityMap:
    return StabilityMap(
        "steps", "Number of load steps (Hertz in the plane)", "steps", STEPS, f.ALL, "hertz", "D_PLAN", lambda _: hertz_section("QUAD4", 20),
        usual(STEEL, PLANE.cell("", 20)),
        lambda series, value: {"steps": value, "far": PLANE.far, "cell": PLANE.cell("", 20), "quadratic": False},
        {"resultant": MESHED, "pressure": MESHED, "penetration": MESHED}, "force")


def _friction_steps() -> StabilityMap:
    return StabilityMap(
        "friction_steps", "Number of load steps (a block that slides)", "steps", STEPS, f.RUBBING, "sliding", "D_PLAN", flat_block,
        usual(RUBBER, friction=0.3), lambda series, value: {"friction": 0.3, "steps": value, "angle": 0.0})


def _gaps() -> StabilityMap:
    starts = tuple(f"CONTINUE AUTO, CONTACT_INIT={word}" for word in ("OUI", "NON"))

    def formulation(series: str, value: object) -> Values:
        if series in starts:
            return changed("CONTINUE AUTO", STEEL, "CONTACT_INIT", series.rpartition("=")[2])
        return usual(STEEL)(series, value)

    return StabilityMap(
        "gap", "Initial gap, or overlap where negative (bars, one pushed by 0.002)", "gap (m)",
        (-0.1, -1e-2, -1e-3, -1e-5, 0.0, 1e-9, 1e-5, 1e-3, 1.999e-3, 2.001e-3, 1e-2, 0.1), (*f.BETWEEN_BODIES_WITH_LAC, *starts), "gap_bar", "C_PLAN",
        lambda value: short_bars(value), formulation, lambda series, value: BARS | {"gap": value}, pressure="stress",
        tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE, "penetration": TOLERANCE}, mesh_key=lambda value: value)


def _cells() -> StabilityMap:
    return StabilityMap(
        "cells", "Length of slave cells over that of master cells (patch test)", "slave / master", (1 / 16, 1 / 8, 1 / 4, 1 / 2, 1.0, 2.0, 4.0, 8.0, 16.0),
        f.BETWEEN_BODIES_WITH_LAC, "patch", "C_PLAN", unequal_blocks, usual(RUBBER), lambda series, value: {}, {"resultant": MESHED}, "stress",
        mesh_key=lambda value: value)


def _solid_cells() -> StabilityMap:
    return StabilityMap(
        "solid_cells", "Length of slave cells over that of master cells, in space (patch test)", "slave / master", (1 / 8, 1 / 4, 1 / 3, 1 / 2, 1.0, 2.0, 3.0, 4.0, 8.0),
        f.BETWEEN_BODIES_WITH_LAC, "patch", "3D", lambda value: unequal_blocks(value, 8, solid=True), usual(RUBBER, 0.125, solid=True), lambda series, value: {},
        {"resultant": MESHED}, "stress", mesh_key=lambda value: value, family="HEXA8")


def _directions() -> StabilityMap:
    return StabilityMap(
        "directions", "Direction of a slide over the mesh (a block that is pulled, in space)", "degrees", (0.0, 10.0, 22.5, 30.0, 45.0, 60.0, 75.0, 90.0),
        f.RUBBING, "sliding", "3D", lambda _: flat_block(_, solid=True), usual(RUBBER, 0.25, 0.3, solid=True),
        lambda series, value: {"friction": 0.3, "steps": 5, "angle": value}, family="HEXA8")


def _blocked() -> StabilityMap:
    return StabilityMap(
        "blocked", "Slave nodes that other conditions hold too", "condition",
        ("along", "one node down", "all nodes down", "level", "two tied", "tied to the master", "across the master"), f.BETWEEN_BODIES,
        SCENES + "blocked", "C_PLAN", matching_blocks, usual(RUBBER), lambda series, value: {"blocking": value}, pressure="stress",
        tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE, "penetration": TOLERANCE}, contradictory=("across the master",))


def _bounds() -> StabilityMap:
    return StabilityMap(
        "bounds", "Bounds that repeat, follow from or contradict others", "further bound",
        ("the same again", "seven times it", "with DX, which is held", "a looser one", "both ways", "on nodes held within it", "against it",
         "against nodes held"), ("LIAISON_UNIL",), SCENES + "bounds", "C_PLAN", lambda _: standing_block("QUAD4", 4, solid=False), usual(RUBBER),
        lambda series, value: {"bounding": value}, pressure="stress",
        tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE, "penetration": TOLERANCE}, contradictory=("against it", "against nodes held"))


def _floating() -> StabilityMap:
    return StabilityMap(
        "floating", "A block that nothing but contact holds up", "gap (m)", (0.0, 1e-6, 1e-4, 1e-2, 1.0), f.ALL, SCENES + "floating", "D_PLAN",
        raised_block, usual(RUBBER), lambda series, value: {"gap": value}, pressure="stress",
        tolerances={"resultant": TOLERANCE, "pressure": TOLERANCE, "penetration": TOLERANCE}, mesh_key=lambda value: value)


def _waves() -> StabilityMap:
    return StabilityMap(
        "waves", "Many places that act on each other (a strip on a wavy table)", "waves", (1, 2, 4, 8, 16, 20, 32, 40),
        ("CONTRAINTE", "GCP", "PENALISATION", "CONTINUE AUTO", "CONTINUE PENALISATION", "LIAISON_UNIL"), SCENES + "waves", "D_PLAN", strip,
        usual(RUBBER, WAVY_LENGTH / 320), lambda series, value: {"length": WAVY_LENGTH, "height": WAVY_HEIGHT, "waves": value},
        {"penetration": TOLERANCE, "pull": TOLERANCE, "distant": TOLERANCE}, own_measure=True, mesh_key=lambda value: value)


def maps() -> dict[str, StabilityMap]:
    """All of them, by name."""
    listed = (_penalties(), _friction_penalties(), _stiffness(), _friction(), _steps(), _friction_steps(), _gaps(), _cells(), _solid_cells(), _directions(), _blocked(), _bounds(),
              _floating(), _waves(), _threshold())
    return {each.name: each for each in listed}
