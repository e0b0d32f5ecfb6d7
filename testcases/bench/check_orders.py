#!/usr/bin/env python3
"""A test: elements converge at the orders of theory, and the report's memory is that of comma alone. Use: check_orders.py COMMA"""
from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from orders import expected, observed
from run import Case, Measurement
from scenes import scenes
from statics import Runner

# Three meshes each, fine enough for the first term of the error to lead; solid scenes end at 10,000 unknowns.
SERIES = {
    "cylinder_plane": {"TRIA3": (8, 16, 32), "QUAD4": (8, 16, 32), "TRIA6": (4, 8, 16), "QUAD8": (4, 8, 16)},
    "cylinder_3d": {"HEXA8": (4, 8, 16), "TETRA10": (2, 4, 8)},
    "manufactured": {"HEXA8": (4, 8, 12), "HEXA20": (2, 4, 8)},
}

# On meshes as coarse as these the second term of the error still bends the line by up to 0.15.
TOLERANCE = 0.2

# More than comma needs here, less than this process takes before it starts it.
BALLAST, MOST_MEMORY = 300_000_000, 200_000_000


def series(runner: Runner, name: str, family: str, sizes: tuple[int, ...]) -> list[Measurement]:
    scene = scenes()[name]
    cases = [Case(name, scene.folder, family, scene.modelisation, "MULT_FRONT", size, scene.parameters) for size in sizes]
    return [runner.run(case, scene.grid(case.modelisation, case.size)) for case in cases]


def complaints(name: str, family: str, runs: list[Measurement]) -> list[str]:
    """What is wrong with a series: a run that failed, an order that is not that of theory."""
    failed = [f"{name} {family} {run.case.size}: exit {run.status}: {run.said}" for run in runs if not run.errors]
    if failed:
        return failed
    found = []
    for quantity in ("energy", "displacement"):
        order, theory = observed(runs, quantity), expected(family, quantity)
        print(f"{name:15} {family:8} {quantity:13} order {order:.2f}, theory {theory}")
        # At the nodes of regular meshes displacements may converge faster than theory says; the energy may not.
        if order < theory - TOLERANCE or (quantity == "energy" and order > theory + TOLERANCE):
            found.append(f"{name} {family}: the order in the {quantity} is {order:.2f}, not {theory}")
    return found


def main() -> int:
    comma = Path(sys.argv[1]).resolve()
    ballast = bytearray(BALLAST)
    found = []
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(comma, Path(folder))
        for name, families in SERIES.items():
            for family, sizes in families.items():
                runs = series(runner, name, family, sizes)
                found += complaints(name, family, runs)
                found += [f"{name} {family}: {run.memory} bytes are not comma's own" for run in runs if run.memory > MOST_MEMORY]
    del ballast
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
