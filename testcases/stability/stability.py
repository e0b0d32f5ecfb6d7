"""The suite of stability: where each formulation stops working, cell by cell."""
from __future__ import annotations

import argparse
import enum
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

import stability_report
from contact_scenes import nodes_of
from formulations import FORMULATIONS
from maps import StabilityMap, maps
from meshes import write_mail
from run import Measurement, run_comma

TIMEOUT = 60.0  # s, for one run

# Alarms that say that the very answer of a cell may be wrong.
TELLING = ("soft-penalty", "soft-friction-penalty", "held-overlap", "coarse-slave", "stale-geometry")
UNSETTLED = ("no-convergence", "contact-cycling")


class Outcome(enum.Enum):
    RIGHT = "right"
    TOLD = "told"  # wrong, and an alarm says so
    UNSETTLED = "no convergence"
    REFUSED = "refused"  # an error about something else
    WRONG = "wrong"


@dataclass
class MapCell:
    """A run of a map, and what came of it."""

    series: str
    value: object
    measured: Measurement
    outcome: Outcome

    @property
    def iterations(self) -> int:
        """Of Newton's method and on the contact rows."""
        return self.measured.counters.get("newton_iterations", 0) + self.measured.counters.get("contact_iterations", 0)


def judge(of: StabilityMap, value: object, measured: Measurement) -> Outcome:
    """Right: the tolerances of the map hold, or what has no solution is refused as contradictory."""
    if measured.status != 0:
        if value in of.contradictory and "contradictory-conditions" in measured.codes:
            return Outcome.RIGHT
        return Outcome.UNSETTLED if set(measured.codes) & set(UNSETTLED) else Outcome.REFUSED
    good = value not in of.contradictory and all(measured.errors.get(name, 1.0) <= bound for name, bound in of.tolerances.items())
    if good:
        return Outcome.RIGHT
    return Outcome.TOLD if set(measured.codes) & set(TELLING) else Outcome.WRONG


def run_map(comma: Path, of: StabilityMap, folder: Path, quick: bool) -> list[MapCell]:
    folder.mkdir(parents=True, exist_ok=True)
    cells = []
    unknowns = slave_nodes = faces = 0
    in_space = False
    meshed: object = None
    for value in of.values[:: 3 if quick else 1]:
        if meshed is None or of.mesh_key(value) is not None:
            mesh = of.mesh(value)
            write_mail(mesh, folder / "case.mail", f"{of.name} {value}")
            unknowns, slave_nodes = len(mesh.coordinates[0]) * len(mesh.coordinates), len(nodes_of(mesh, "SLAVE"))
            faces, in_space = len(mesh.cell_groups["SLAVE"]), len(mesh.coordinates[0]) == 3
            meshed = value
        for series in of.series:
            formulation = FORMULATIONS.get(series.split(",")[0])
            cut = formulation.new_slave_nodes(faces, in_space) if formulation else 0
            measured = run_comma(comma, of.case(series, value, slave_nodes + cut), unknowns, folder, TIMEOUT)
            cells.append(MapCell(series, value, measured, judge(of, value, measured)))
            _tell(of, cells[-1])
    return cells


def _tell(of: StabilityMap, cell: MapCell) -> None:
    if cell.outcome is Outcome.RIGHT:
        return
    errors = "  ".join(f"{name} {error:.1e}" for name, error in cell.measured.errors.items())
    print(f"{of.name:16} {cell.series:32} {cell.value!s:>20} {cell.outcome.value:15} {errors}  {cell.measured.said[:160]}", flush=True)


def names() -> list[str]:
    return list(maps())


def run(options: argparse.Namespace, chosen: list[str]) -> None:
    """Runs the maps of these names; writes stability.md, stability.csv and a chart for each."""
    start = time.perf_counter()
    folder = options.output / "work"
    results = [(of, run_map(options.comma, of, folder, options.quick)) for name, of in maps().items() if name in chosen]
    shutil.rmtree(folder)
    stability_report.write(results, options.output, time.perf_counter() - start)
    if options.publish:
        stability_report.publish(options.output)
