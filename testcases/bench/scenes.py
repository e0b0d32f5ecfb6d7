"""The scenes with a known solution: body, families of elements, sizes, and the orders that theory gives."""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from elements import FAMILIES
from meshes import Grid, Point, at, on
from run import Case

PLANE = ("TRIA3", "TRIA6", "QUAD4", "QUAD8", "QUAD9")
SOLID = ("TETRA4", "TETRA10", "PYRAM5", "PYRAM13", "PENTA6", "PENTA15", "PENTA18", "HEXA8", "HEXA20", "HEXA27")
SOLVERS = ("MUMPS", "MULT_FRONT", "LDLT", "GCPC/LDLT_INC")

# Cells along an edge, by dimension and order: four sizes, so that quadratic elements end with as many nodes as linear ones.
SIZES = {(2, 1): (8, 16, 32, 64), (2, 2): (4, 8, 16, 32), (3, 1): (4, 8, 16, 24), (3, 2): (2, 4, 8, 12)}
QUICK_SIZES = {(2, 1): (8, 16, 32), (2, 2): (4, 8, 16), (3, 1): (4, 6, 8), (3, 2): (2, 3, 4)}


@dataclass(frozen=True)
class Scene:
    """A body with a known solution. `grid(modelisation, n)` is its mesh with n cells along an edge."""

    name: str
    title: str
    folder: str
    modelisation: str
    families: tuple[str, ...]
    grid: Callable[[str, int], Grid]
    reduced: tuple[str, ...] = ()  # families that are also run with the modelisation's _SI
    solvers: tuple[str, ...] = ("MULT_FRONT",)
    parameters: dict[str, float] = field(default_factory=lambda: {"poisson": 0.3})
    measured_by: str | None = "measure.comm"
    singular: bool = False  # a corner limits the orders: those of smooth solutions are not expected
    note: str = ""

    def cases(self, quick: bool, only: tuple[str, ...] = ()) -> list[Case]:
        """All runs of the scene, or of some of its families."""
        sizes = QUICK_SIZES if quick else SIZES
        variants = [(family, self.modelisation) for family in self.families]
        variants += [(family, self.modelisation + "_SI") for family in self.reduced]
        return [
            Case(self.name, self.folder, family, modelisation, solver, size, self.parameters, self.measured_by)
            for family, modelisation in variants
            if not only or family in only
            for solver in self.solvers
            for size in self._sizes(sizes[FAMILIES[family].dimension, FAMILIES[family].order], solver)
        ]

    @staticmethod
    def _sizes(sizes: tuple[int, ...], solver: str) -> tuple[int, ...]:
        """LDLT is meant for small scenes; on the finest mesh it would take longer than all the rest together."""
        return sizes[:-1] if solver == "LDLT" else sizes


# --- bodies ---------------------------------------------------------------------------------------------------------------


def cylinder_grid(modelisation: str, n: int) -> Grid:
    """Radii 1 to 2; a quarter turn, with a height of 1/2 in 3D; a height of 1/2 as a body of revolution."""
    sides = {"INNER": on(0, 0.0), "BOTTOM": on(1, 0.0), "TOP": on(1, 1.0)}
    if modelisation.startswith("AXIS"):
        return Grid((n, max(1, n // 2)), lambda p: (1.0 + p[0], 0.5 * p[1]), sides, {"POINT": at(0.0, 0.0)})

    def turned(p: Point) -> Point:
        radius, angle = 1.0 + p[0], 0.5 * math.pi * p[1]
        return (radius * math.cos(angle), radius * math.sin(angle), *(0.5 * z for z in p[2:]))

    if modelisation.startswith("3D"):
        sides |= {"BACK": on(2, 0.0), "FRONT": on(2, 1.0)}
        return Grid((n, n, max(1, n // 2)), turned, sides, {"POINT": at(0.0, 0.0, 0.0)})
    return Grid((n, n), turned, sides, {"POINT": at(0.0, 0.0)})


def sphere_grid(modelisation: str, n: int) -> Grid:
    """Radii 1 to 2; the upper half of the meridian, or the part 0 <= x <= z, 0 <= y <= z."""
    if modelisation.startswith("AXIS"):
        sides = {"INNER": on(0, 0.0), "BOTTOM": on(1, 0.0), "AXIS": on(1, 1.0)}

        def turned(p: Point) -> Point:
            radius, angle = 1.0 + p[0], 0.5 * math.pi * p[1]
            return (radius * math.cos(angle) if p[1] < 1.0 else 0.0, radius * math.sin(angle))

        return Grid((n, n), turned, sides, {"POINT": at(0.0, 0.0)})

    def gnomonic(p: Point) -> Point:
        x, y = math.tan(0.25 * math.pi * p[0]), math.tan(0.25 * math.pi * p[1])
        radius = (1.0 + p[2]) / math.sqrt(1.0 + x * x + y * y)
        return (x * radius, y * radius, radius)

    sides = {"INNER": on(2, 0.0), "X0": on(0, 0.0), "XZ": on(0, 1.0), "Y0": on(1, 0.0), "YZ": on(1, 1.0)}
    return Grid((n, n, n), gnomonic, sides, {"POINT": at(0.0, 0.0, 0.0)})


PLATE_EDGE = 4.0  # half the side of the plate, in radii of the hole


def plate_grid(_: str, n: int) -> Grid:
    """From a quarter of the circle to two edges of the square, finer towards the circle."""

    def blended(p: Point) -> Point:
        angle, weight = 0.5 * math.pi * p[1], p[0] * (0.4 + 0.6 * p[0])
        far = (1.0, 2.0 * p[1]) if p[1] <= 0.5 else (2.0 - 2.0 * p[1], 1.0)
        near = (math.cos(angle) if p[1] < 1.0 else 0.0, math.sin(angle))
        return tuple((1.0 - weight) * a + weight * PLATE_EDGE * b for a, b in zip(near, far))

    sides = {
        "BOTTOM": on(1, 0.0),
        "LEFT": on(1, 1.0),
        "RIGHT": lambda p: p[0] == 1.0 and p[1] <= 0.5,
        "TOP": lambda p: p[0] == 1.0 and p[1] >= 0.5,
    }
    return Grid((n, n), blended, sides, {"POINT": at(0.0, 1.0)})


def kirsch_energy(poisson: float) -> float:
    """Elastic energy of the quarter plate for a pull and a modulus of 1: half of traction times displacement along the outer edge,
    by Simpson's rule with 2000 intervals an edge (its error is below 1e-12)."""
    kappa, factor = (3.0 - poisson) / (1.0 + poisson), (1.0 + poisson) / 4.0

    def density(x: float, y: float, across: int) -> float:
        r, t = math.hypot(x, y), math.atan2(y, x)
        c1, s1, c2, s2 = math.cos(t), math.sin(t), math.cos(2 * t), math.sin(2 * t)
        c3, s3, c4, s4 = math.cos(3 * t), math.sin(3 * t), math.cos(4 * t), math.sin(4 * t)
        xx = 1.0 - (1.5 * c2 + c4) / r**2 + 1.5 * c4 / r**4
        yy = -(0.5 * c2 - c4) / r**2 - 1.5 * c4 / r**4
        xy = -(0.5 * s2 + s4) / r**2 + 1.5 * s4 / r**4
        u = factor * ((kappa + 1) * r * c1 + 2 * ((1 + kappa) * c1 + c3) / r - 2 * c3 / r**3)
        v = factor * ((kappa - 3) * r * s1 + 2 * ((1 - kappa) * s1 + s3) / r - 2 * s3 / r**3)
        return xx * u + xy * v if across == 0 else xy * u + yy * v

    steps, total = 2000, 0.0
    for i in range(steps + 1):
        weight = 1.0 if i in (0, steps) else 4.0 if i % 2 else 2.0
        place = PLATE_EDGE * i / steps
        total += weight * (density(PLATE_EDGE, place, 0) + density(place, PLATE_EDGE, 1))
    return 0.5 * total * PLATE_EDGE / steps / 3.0


def beam_panel_grid(length: float) -> Callable[[str, int], Grid]:
    """A rectangle of the length and a depth of 1 about the X axis, n cells both ways."""

    def grid(_: str, n: int) -> Grid:
        sides = {"LEFT": on(0, 0.0), "RIGHT": on(0, 1.0)}
        return Grid((n, n), lambda p: (length * p[0], p[1] - 0.5), sides, {"POINT": at(1.0, 0.5)})

    return grid


def cook_grid(_: str, n: int) -> Grid:
    """The panel (0, 0), (48, 44), (48, 60), (0, 44)."""
    sides = {"LEFT": on(0, 0.0), "RIGHT": on(0, 1.0)}
    shape: Callable[[Point], Point] = lambda p: (48.0 * p[0], 44.0 * p[0] + p[1] * (44.0 - 28.0 * p[0]))
    return Grid((n, n), shape, sides, {"POINT": at(1.0, 0.5)})


def cube_grid(_: str, n: int) -> Grid:
    """The unit cube, its inside moved by a smooth map so that no cell is a cube."""

    def warped(p: Point) -> Point:
        bulge = 0.06 * math.sin(math.pi * p[0]) * math.sin(math.pi * p[1]) * math.sin(math.pi * p[2])
        swirl = 0.06 * math.sin(2 * math.pi * p[0]) * math.sin(math.pi * p[1]) * math.sin(math.pi * p[2])
        inside = all(0.0 < x < 1.0 for x in p) and p != (0.5, 0.5, 0.5)
        return (p[0] + swirl, p[1] + bulge * (2 * p[1] - 1), p[2] + bulge * (1 - 2 * p[2])) if inside else p

    sides = {f"SIDE{axis}{end}": on(axis, float(end)) for axis in range(3) for end in (0, 1)}
    return Grid((n, n, n), warped, sides, {"POINT": at(0.5, 0.5, 0.5)})


# No closed solution: QUAD9 meshes of 32, 64 and 128 cells an edge give the energies 12.016937, 12.019350, 12.020247 and the
# deflections 23.960775, 23.965040, 23.966682, whose limits by Aitken's extrapolation these are. The literature has 23.96.
COOK = {"poisson": 1.0 / 3.0, "exact_energy": 12.02078, "exact_deflection": 23.9677}


def scenes() -> dict[str, Scene]:
    """All of them, by name."""
    listed = (
        Scene(
            "cylinder_plane", "Lamé's thick cylinder, plane strain", "lame_cylinder", "D_PLAN", PLANE, cylinder_grid, ("QUAD8",)
        ),
        Scene("cylinder_axis", "Lamé's thick cylinder, axisymmetric", "lame_cylinder", "AXIS", PLANE, cylinder_grid, ("QUAD8",)),
        Scene("cylinder_3d", "Lamé's thick cylinder, 3D", "lame_cylinder", "3D", SOLID, cylinder_grid, ("HEXA20",)),
        Scene("sphere_axis", "Lamé's thick sphere, axisymmetric", "lame_sphere", "AXIS", PLANE, sphere_grid, ("QUAD8",)),
        Scene("sphere_3d", "Lamé's thick sphere, 3D", "lame_sphere", "3D", SOLID, sphere_grid, ("HEXA20",)),
        Scene(
            "plate_with_hole", "Plate with a hole (Kirsch), plane stress", "plate_with_hole", "C_PLAN", PLANE, plate_grid,
            ("QUAD8",), parameters={"poisson": 0.3, "exact_energy": kirsch_energy(0.3)},
        ),
        Scene(
            "cantilever", "Cantilever (Timoshenko), plane stress", "cantilever", "C_PLAN", PLANE, beam_panel_grid(4.0),
            ("QUAD8",), parameters={"poisson": 0.3, "length": 4.0},
        ),
        Scene(
            "cook", "Cook's membrane, plane stress", "cook", "C_PLAN", PLANE, cook_grid, ("QUAD8",), parameters=COOK,
            measured_by=None, singular=True, note="The clamped corner (0, 44) is singular and limits the orders.",
        ),
        Scene("manufactured", "Smooth manufactured solution, 3D", "manufactured", "3D", SOLID, cube_grid, ("HEXA20",)),
        Scene(
            "solvers", "Linear solvers, manufactured solution, 3D", "manufactured", "3D", ("HEXA8", "HEXA20"), cube_grid,
            solvers=SOLVERS, note="LDLT stops at the third mesh: the fourth takes it minutes.",
        ),
    )
    return {scene.name: scene for scene in listed}
