"""Observed orders of convergence, and what theory expects."""
from __future__ import annotations

import math

from elements import FAMILIES
from run import Measurement

# Below these an error is rounding, not discretisation. That of the energy is the root of a difference of two nearly equal
# energies: some 1e-11 of them is what rounding of the stiffness leaves.
FLOORS = {"energy": 5e-6}
OTHER_FLOOR = 1e-11

# How far an observed order may lie under theory before it counts as a shortfall: on these sizes the next term of the error
# expansion still bends the line by a tenth or so.
MARGIN = 0.25


def slope(points: list[tuple[float, float]]) -> float | None:
    """The slope of the line of least squares through the logarithms of points (x, y)."""
    if len(points) < 2:
        return None
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    spread = sum((x - mean_x) ** 2 for x, _ in logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / spread if spread else None


def observed(runs: list[Measurement], quantity: str) -> float | None:
    """The order of a series of runs of growing size, on its three finest meshes whose error is more than rounding."""
    floor = FLOORS.get(quantity, OTHER_FLOOR)
    points = [(1.0 / run.case.size, run.errors[quantity]) for run in runs if run.errors.get(quantity, 0.0) > floor]
    return slope(points[-3:])


def expected(family: str, quantity: str) -> int | None:
    """p in the energy norm, p + 1 in the displacement, for a smooth solution."""
    order = FAMILIES[family].order
    return {"energy": order, "displacement": order + 1}.get(quantity)


def falls_short(family: str, quantity: str, order: float | None) -> bool:
    theory = expected(family, quantity)
    return theory is not None and order is not None and order < theory - MARGIN
