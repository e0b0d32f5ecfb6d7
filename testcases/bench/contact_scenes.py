"""The scenes of contact with a closed solution: their meshes, the formulations that know them, sizes."""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import formulations as f
from formulations import FORMULATIONS, Formulation, Scale
from meshes import Grid, Mesh, Point, at, build_mesh, merged, on
from run import Case

TOLERANCE = 1e-9  # of places in the unit square, where sides are not at 0, 1/2 or 1


@dataclass(frozen=True)
class ContactScene:
    """`mesh(family, n)` has the slave side SLAVE and, where one node is watched, the node POINT."""

    name: str
    title: str
    folder: str
    modelisation: str
    mesh: Callable[[str, int], Mesh]
    cell: Callable[[str, int], float]  # size of the slave cells, m
    sizes: tuple[int, ...]
    series: tuple[tuple[str, tuple[str, ...]], ...]  # families of cells, and the formulations each is run with
    young: float
    pressure: str  # "force": by the force on POINT; "stress": by the stress of the slave side; "": not measured
    penetration: bool = True
    friction: float | None = None
    parameters: dict[str, object] = field(default_factory=dict)
    note: str = ""

    @property
    def solid(self) -> bool:
        return self.modelisation == "3D"

    def runs(self, quick: bool) -> list[tuple[Formulation, str, int]]:
        sizes = self.sizes[:2] if quick else self.sizes
        return [(FORMULATIONS[name], family, size) for family, names in self.series for name in names for size in sizes]

    def case(self, formulation: Formulation, family: str, size: int, slave_nodes: int) -> Case:
        cell = self.cell(family, size)
        values: dict[str, object] = {
            "cell": cell,
            "slave_nodes": slave_nodes,
            "quadratic": family in ("QUAD8", "QUAD9", "HEXA27"),
            "measured": {"penetration": self.penetration, "pressure": self.pressure},
        }
        if self.friction is not None:
            values["friction"] = self.friction
        values |= formulation.values(Scale(self.young, 1.0, cell, self.solid), self.friction) | self.parameters
        return Case(self.name, self.folder, family, self.modelisation, "MULT_FRONT", size, values, "contact.comm")


def nodes_of(mesh: Mesh, group: str) -> set[int]:
    """The nodes of a group of cells."""
    cells = [nodes for of_type in mesh.cells.values() for nodes in of_type]
    return {node for member in mesh.cell_groups[group] for node in cells[member]}


# --- half-spaces ----------------------------------------------------------------------------------------------------------

RADIUS = 1.0e4  # of the obstacle or the relative curvature, in radii of contact


def spread(width: float, part: float) -> Callable[[float], float]:
    """From the unit interval: even up to the width, which `part` of it fills; then growing as an exponential, without a kink."""
    return lambda t: width * t / part if t <= part + TOLERANCE else width * math.exp(t / part - 1.0)


@dataclass(frozen=True)
class HalfSpace:
    """A box under a surface, finest where it is touched: on `width` along each axis, which `part` of the cells fill."""

    width: float
    part: float

    @property
    def far(self) -> float:
        return self.place(1.0)

    @property
    def place(self) -> Callable[[float], float]:
        return spread(self.width, self.part)

    def cell(self, _: str, n: int) -> float:
        return self.width / self.part / n

    def touched(self, value: float) -> bool:
        return value <= self.part + TOLERANCE

    def section(self, family: str, n: int) -> Mesh:
        """Half of a section, the axis on its left."""
        place = self.place
        sides = {
            "SLAVE": lambda p: p[1] == 1.0 and self.touched(p[0]),
            "LEFT": on(0, 0.0),
            "FAR": on(1, 0.0),
            "FAR_RIGHT": on(0, 1.0),
        }
        mesh = build_mesh(Grid((n, n), lambda p: (place(p[0]), -place(1.0 - p[1])), sides, {"POINT": at(0.0, 1.0)}), family)
        mesh.cell_groups["FAR"] += mesh.cell_groups.pop("FAR_RIGHT")
        return mesh

    def quarter(self, family: str, n: int) -> Mesh:
        place = self.place
        sides = {
            "SLAVE": lambda p: p[2] == 1.0 and self.touched(p[0]) and self.touched(p[1]),
            "LEFT": on(0, 0.0),
            "FRONT": on(1, 0.0),
            "FAR": on(2, 0.0),
            "FAR_X": on(0, 1.0),
            "FAR_Y": on(1, 1.0),
        }
        grid = Grid((n, n, n), lambda p: (place(p[0]), place(p[1]), -place(1.0 - p[2])), sides, {"POINT": at(0.0, 0.0, 1.0)})
        mesh = build_mesh(grid, family)
        mesh.cell_groups["FAR"] += mesh.cell_groups.pop("FAR_X") + mesh.cell_groups.pop("FAR_Y")
        return mesh


def obstacle(width: float, curvature: float, solid: bool) -> Mesh:
    """A sheet of rigid quadratic cells over 0 <= x (and y) <= width, whose lower side is x**2 / 2 times the curvature: exactly."""
    count = 7
    if solid:
        shape = lambda p: (width * p[0], width * p[1], 0.5 * curvature * width**2 * (p[0] ** 2 + p[1] ** 2) + 0.2 * p[2])
        sheet = build_mesh(Grid((count, count, 1), shape, {"MASTER": on(2, 0.0)}), "HEXA20")
    else:
        shape = lambda p: (width * p[0], 0.5 * curvature * (width * p[0]) ** 2 + 0.2 * p[1])
        sheet = build_mesh(Grid((count, 1), shape, {"MASTER": on(1, 0.0)}), "QUAD8")
    sheet.cell_groups["OBSTACLE"] = sheet.cell_groups.pop("BODY")
    sheet.node_groups.clear()
    return sheet


PLANE, SOLID = HalfSpace(1.5, 0.3), HalfSpace(1.5, 0.4)
UNDER_PUNCH = HalfSpace(1.0, 0.25)


def hertz_section(family: str, n: int) -> Mesh:
    return merged([("", PLANE.section(family, n)), ("", obstacle(1.1 * PLANE.width, 1.0 / RADIUS, False))])


def hertz_quarter(family: str, n: int) -> Mesh:
    return merged([("", SOLID.quarter(family, n)), ("", obstacle(1.1 * SOLID.width, 1.0 / RADIUS, True))])


def punched_section(family: str, n: int) -> Mesh:
    return merged([("", UNDER_PUNCH.section(family, n)), ("", obstacle(1.1 * UNDER_PUNCH.width, 0.0, False))])


def two_cylinders(family: str, n: int) -> Mesh:
    """The whole section of both bodies; the lower one has all the curvature where they may touch."""
    place = PLANE.place

    def across(t: float) -> float:
        return math.copysign(place(abs(2.0 * t - 1.0)), 2.0 * t - 1.0)

    def touched(t: float) -> bool:
        return PLANE.touched(abs(2.0 * t - 1.0))

    def low(p: Point) -> Point:
        x = across(p[0])
        return (x, -0.5 * x**2 / RADIUS if p[1] == 1.0 and touched(p[0]) else -place(1.0 - p[1]))

    far = {"FAR_LEFT": on(0, 0.0), "FAR_RIGHT": on(0, 1.0)}
    upper = build_mesh(
        Grid((2 * n, n), lambda p: (across(p[0]), place(p[1])), {"SLAVE": lambda p: p[1] == 0.0 and touched(p[0]), "FAR": on(1, 1.0)} | far,
             {"POINT": at(0.5, 0.0)}), family)
    lower = build_mesh(
        Grid((2 * n, n), low, {"MASTER": lambda p: p[1] == 1.0 and touched(p[0]), "FAR": on(1, 0.0)} | far), family)
    for body in (upper, lower):
        body.cell_groups["FAR"] += body.cell_groups.pop("FAR_LEFT") + body.cell_groups.pop("FAR_RIGHT")
    whole = merged([("U_", upper), ("L_", lower)])
    whole.cell_groups["SLAVE"] = whole.cell_groups.pop("U_SLAVE")
    whole.node_groups["POINT"] = whole.node_groups.pop("U_POINT")
    return whole


# --- blocks ---------------------------------------------------------------------------------------------------------------


def stacked(family: str, n: int, solid: bool) -> Mesh:
    """Two blocks, 1 wide and 1/2 high, of n and of n + 1 cells in the width."""
    high = 2 if solid else 1

    def block(count: int, base: float, sides: dict) -> Mesh:
        sides = {"LEFT": on(0, 0.0)} | ({"FRONT": on(1, 0.0)} if solid else {}) | sides
        counts = (count,) * high + (max(1, count // 2),)
        return build_mesh(Grid(counts, lambda p: (*p[:high], base + 0.5 * p[high]), sides), family)

    upper = block(n, 0.0, {"SLAVE": on(high, 0.0), "TOP": on(high, 1.0)})
    lower = block(n + 1, -0.5, {"MASTER": on(high, 1.0), "BASE": on(high, 0.0)})
    whole = merged([("U_", upper), ("L_", lower)])
    whole.cell_groups["SLAVE"] = whole.cell_groups.pop("U_SLAVE")
    return whole


def standing_block(family: str, n: int, solid: bool) -> Mesh:
    """A cube or square of edge 1 on a flat obstacle that is wider on all sides."""
    high = 2 if solid else 1
    sides = {"SLAVE": on(high, 0.0), "TOP": on(high, 1.0), "LEFT": on(0, 0.0)} | ({"FRONT": on(1, 0.0)} if solid else {})
    block = build_mesh(Grid((n,) * (high + 1), lambda p: p, sides, {"POINT": at(*(0.0,) * (high + 1))}), family)
    if solid:
        shape = lambda p: (1.2 * p[0] - 0.1, 1.2 * p[1] - 0.1, 0.2 * p[2] - 0.2)
    else:
        shape = lambda p: (1.2 * p[0] - 0.1, 0.2 * p[1] - 0.2)
    table = build_mesh(Grid((3,) * high + (1,), shape, {"MASTER": on(high, 1.0)}), "HEXA8" if solid else "QUAD4")
    table.cell_groups["OBSTACLE"] = table.cell_groups.pop("BODY")
    table.node_groups.clear()
    return merged([("", block), ("", table)])


def bars(family: str, n: int) -> Mesh:
    """Two bars of 1 x 1/5, the second one 1/1000 behind the first."""
    first = build_mesh(Grid((5 * n, n), lambda p: (p[0] - 1.0, 0.2 * p[1]), {"END": on(0, 0.0), "SLAVE": on(0, 1.0), "SIDE": on(1, 0.0)}), family)
    second = build_mesh(
        Grid((5 * n, n), lambda p: (p[0] + 1.0e-3, 0.2 * p[1]), {"MASTER": on(0, 0.0), "END": on(0, 1.0), "SIDE": on(1, 0.0)}), family)
    whole = merged([("U_", first), ("L_", second)])
    whole.cell_groups["SLAVE"] = whole.cell_groups.pop("U_SLAVE")
    return whole


# --- the list -------------------------------------------------------------------------------------------------------------

QUADRATIC = ("CONTRAINTE", "CONTINUE AUTO", "CONTINUE GAUSS 2")


def scenes() -> dict[str, ContactScene]:
    """All of them, by name."""
    of_cube = lambda _, n: 1.0 / n
    listed = (
        ContactScene(
            "hertz_plane", "Hertz: cylinder on a half-space, plane strain", "hertz", "D_PLAN", hertz_section, PLANE.cell, (20, 40, 80, 160),
            (("QUAD4", f.WITH_LAC), ("QUAD8", QUADRATIC)), 2.0e11, "force", parameters={"far": PLANE.far, "steps": 1}),
        ContactScene(
            "hertz_axis", "Hertz: sphere on a half-space, axisymmetric", "hertz", "AXIS", hertz_section, PLANE.cell, (20, 40, 80, 160),
            (("QUAD4", f.ALL),), 2.0e11, "force", parameters={"far": PLANE.far, "steps": 1},
            note="The force on the node at the axis stands for so little surface that the pressure there converges with order 1 only. "
                 "With a penalty of the mixed formulation that node bears next to nothing and overlaps, as in Code_Aster 17.3 "
                 "([mixed contact](conformance/mixed_contact.md)): the error of 1 is there."),
        ContactScene(
            "hertz_3d", "Hertz: sphere on a half-space, 3D", "hertz", "3D", hertz_quarter, SOLID.cell, (5, 10, 15, 20), (("HEXA8", f.WITH_LAC),), 2.0e11,
            "force", parameters={"far": SOLID.far, "steps": 1},
            note="The sphere has 7 by 7 faces of 8 nodes. The discrete formulation takes their corners alone, as Code_Aster 17.3 does: that is their error."),
        ContactScene(
            "punch", "Flat punch on a half-plane", "punch", "D_PLAN", punched_section, UNDER_PUNCH.cell, (20, 40, 80, 160), (("QUAD4", f.WITH_LAC),), 2.0e11,
            "force", parameters={"far": UNDER_PUNCH.far},
            note="The pressure has no bound at the edge of the punch, which limits all orders to 1."),
        ContactScene(
            "patch_2d", "Patch test on meshes that do not match, plane stress", "patch", "C_PLAN", lambda family, n: stacked(family, n, False),
            of_cube, (4, 8, 16, 32), (("QUAD4", f.BETWEEN_BODIES_WITH_LAC), ("QUAD8", QUADRATIC)), 1.0e9, "stress"),
        ContactScene(
            "patch_3d", "Patch test on meshes that do not match, 3D", "patch", "3D", lambda family, n: stacked(family, n, True), of_cube,
            (2, 4, 6, 8), (("HEXA8", f.BETWEEN_BODIES_WITH_LAC),), 1.0e9, "stress"),
        ContactScene(
            "support", "Heavy block on a unilateral support", "support", "3D", lambda family, n: standing_block(family, n, True), of_cube,
            (2, 4, 6, 8), (("HEXA8", f.ALL),), 1.0e7, "force"),
        ContactScene(
            "sliding", "Coulomb: a block that is pulled along", "sliding", "D_PLAN", lambda family, n: standing_block(family, n, False), of_cube,
            (4, 8, 16, 32), (("QUAD4", f.RUBBING),), 1.0e9, "", friction=0.3, parameters={"steps": 10, "angle": 0.0}),
        ContactScene(
            "mindlin", "Cattaneo and Mindlin: partial slip", "mindlin", "D_PLAN", two_cylinders, PLANE.cell, (10, 20, 40, 80),
            (("QUAD4", f.RUBBING),), 2.0e11, "force", penetration=False, friction=0.3, parameters={"far": PLANE.far, "steps": 1}),
        ContactScene(
            "gap_bar", "A bar that closes a gap", "gap_bar", "C_PLAN", bars, lambda _, n: 0.2 / n, (1, 2, 4, 8), (("QUAD4", f.BETWEEN_BODIES_WITH_LAC),), 2.0e11,
            "stress", parameters={"first": 2.0e11, "second": 1.0e11, "gap": 1.0e-3, "push": 2.0e-3},
            note="Discrete formulations face the bars as each of the ten steps begins, as Code_Aster 17.3 does, and not as the mesh has them."),
    )
    return {scene.name: scene for scene in listed}
