"""Where a choice fails: one parameter goes to an extreme on a fixed mesh; the error, and what comma says then."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from meshes import Grid, at, on
from run import Case
from scenes import SOLVERS, beam_panel_grid, cylinder_grid


@dataclass(frozen=True)
class Series:
    """A line of the chart: a family with a modelisation and a solver."""

    label: str
    family: str
    modelisation: str
    size: int
    solver: str = "MULT_FRONT"


@dataclass(frozen=True)
class Limit:
    """One parameter over a range. `parameters(value)` are the values in front of the command file."""

    name: str
    title: str
    axis: str
    quantity: str
    folder: str
    values: tuple[float, ...]
    abscissa: Callable[[float], float]  # of the chart
    series: tuple[Series, ...]
    parameters: Callable[[Series, float], dict[str, float]]
    grid: Callable[[Case], Grid]
    measured_by: str | None = "measure.comm"
    exact: bool = False  # the elements have the solution exactly: any error is a loss in solving

    def cases(self, quick: bool) -> list[tuple[Series, float, Case]]:
        values = self.values[:: 3 if quick else 1]
        return [(series, value, self._case(series, value)) for series in self.series for value in values]

    def _case(self, series: Series, value: float) -> Case:
        return Case(
            self.name, self.folder, series.family, series.modelisation, series.solver, series.size,
            self.parameters(series, value), self.measured_by,
        )


def beam_grid(case: Case) -> Grid:
    length = case.parameters["length"]
    return Grid(
        (case.size,), lambda p: (length * p[0], 0.0, 0.0), points={"START": at(0.0), "POINT": at(1.0)}
    )


def bar_grid(case: Case) -> Grid:
    """A square bar of length 2, whose halves are the parts HELD and PULLED."""
    n = case.size
    return Grid(
        (2 * n, n, n),
        lambda p: (2.0 * p[0], p[1], p[2]),
        {"LEFT": on(0, 0.0), "RIGHT": on(0, 1.0)},
        {"POINT": at(1.0, 0.0, 0.0)},
        {"HELD": lambda p: p[0] < 0.5, "PULLED": lambda p: p[0] > 0.5},
    )


def _locking() -> Limit:
    plane = [Series(family, family, "D_PLAN", size) for family, size in
             (("TRIA3", 16), ("QUAD4", 16), ("TRIA6", 8), ("QUAD8", 8), ("QUAD9", 8))]
    solid = [Series(family, family, "3D", size) for family, size in
             (("TETRA4", 6), ("HEXA8", 6), ("TETRA10", 4), ("HEXA20", 4), ("HEXA27", 4))]
    reduced = [Series("QUAD8 SI", "QUAD8", "D_PLAN_SI", 8), Series("TETRA10 SI", "TETRA10", "3D_SI", 4),
               Series("HEXA20 SI", "HEXA20", "3D_SI", 4)]
    return Limit(
        "locking", "Locking as NU goes to 1/2 (Lamé's cylinder)", "1/2 - NU", "displacement", "lame_cylinder",
        (0.3, 0.49, 0.499, 0.4999, 0.49999, 0.499999, 0.4999999), lambda value: 0.5 - value,
        tuple(plane + solid + reduced), lambda series, value: {"poisson": value},
        lambda case: cylinder_grid(case.modelisation, case.size),
    )


def _slender() -> Limit:
    series = [
        Series(f"{modelisation}, {size} element{'s' if size > 1 else ''}", "SEG2", modelisation, size)
        for modelisation in ("POU_D_E", "POU_D_T") for size in (1, 10, 100)
    ]
    return Limit(
        "slender", "Slender beams (cantilever, its own theory)", "length / depth", "deflection", "beam",
        tuple(10.0**i for i in range(7)), lambda value: value, tuple(series),
        lambda series, value: {"poisson": 0.3, "length": value}, beam_grid, None, exact=True,
    )


def _aspect() -> Limit:
    series = [Series(family, family, "C_PLAN", 8) for family in ("TRIA3", "TRIA6", "QUAD4", "QUAD8", "QUAD9")]
    series.append(Series("QUAD8 SI", "QUAD8", "C_PLAN_SI", 8))
    return Limit(
        "aspect", "Long cells (Timoshenko's cantilever on 8 x 8 cells)", "length / width of the cells", "displacement", "cantilever",
        tuple(10.0**i for i in range(7)), lambda value: value, tuple(series),
        lambda series, value: {"poisson": 0.3, "length": value},
        lambda case: beam_panel_grid(case.parameters["length"])(case.modelisation, case.size),
    )


def _stiffness(name: str, title: str, held: bool) -> Limit:
    moduli = lambda value: {"held": 1e9 if held else 1e9 * value, "pulled": 1e9 * value if held else 1e9}
    return Limit(
        name, title, "ratio of the moduli", "elongation", "bar", tuple(10.0**i for i in range(17)), lambda value: value,
        tuple(Series(solver, "HEXA8", "3D", 4, solver) for solver in SOLVERS),
        lambda series, value: moduli(value), bar_grid, None, exact=True,
    )


def limits() -> dict[str, Limit]:
    """All of them, by name."""
    listed = (
        _locking(),
        _slender(),
        _aspect(),
        _stiffness("stiff_held", "Soft half pulled, stiff half held", held=False),
        _stiffness("stiff_pulled", "Stiff half pulled, soft half held", held=True),
    )
    return {limit.name: limit for limit in listed}
