"""The suite of linear statics: scenes with a known solution, and limits where a choice fails."""
from __future__ import annotations

import argparse
import shutil
import time
from pathlib import Path

import charts
import report
from limits import Limit, limits
from meshes import Grid, build_mesh, write_mail
from run import Case, Measurement, run_comma
from scenes import Scene, scenes

TIMEOUT = 300.0  # s, for one run of a scene


class Runner:
    """Runs cases one after the other in one folder, whose mesh is kept while it stays the same."""

    def __init__(self, comma: Path, folder: Path) -> None:
        self.comma, self.folder = comma, folder
        self.folder.mkdir(parents=True, exist_ok=True)
        self.meshed: tuple | None = None
        self.unknowns = 0

    def run(self, case: Case, grid: Grid) -> Measurement:
        key = (case.scene, case.family, case.size, case.parameters.get("length"))
        if key != self.meshed:
            mesh = build_mesh(grid, case.family)
            write_mail(mesh, self.folder / "case.mail", f"{case.scene} {case.family} {case.size}")
            per_node = 6 if case.modelisation.startswith("POU") else len(mesh.coordinates[0])
            self.unknowns = per_node * len(mesh.coordinates)
            self.meshed = key
        return run_comma(self.comma, case, self.unknowns, self.folder, TIMEOUT)


def tell(measurement: Measurement, more: str = "") -> None:
    case = measurement.case
    errors = "  ".join(f"{name} {error:.1e}" for name, error in measurement.errors.items())
    said = f"  exit {measurement.status}: {measurement.said[:70]}" if measurement.status else ""
    print(
        f"{case.scene:16} {case.label:10} {case.solver:13} {case.size:4d} {more:8} {measurement.unknowns:8d} unknowns "
        f"{measurement.seconds:7.2f} s {measurement.memory / 1e6:6.0f} MB  {errors}{said}",
        flush=True,
    )


def run_scene(runner: Runner, scene: Scene, options: argparse.Namespace) -> list[Measurement]:
    only = tuple(options.families.split(",")) if options.families else ()
    measurements = []
    for case in scene.cases(options.quick, only):
        measurements.append(runner.run(case, scene.grid(case.modelisation, case.size)))
        tell(measurements[-1])
    return measurements


def run_limit(runner: Runner, limit: Limit, options: argparse.Namespace) -> list[tuple[str, float, Measurement]]:
    rows = []
    for series, value, case in limit.cases(options.quick):
        measurement = runner.run(case, limit.grid(case))
        tell(measurement, f"{value:g}")
        rows.append((series.label, limit.abscissa(value), measurement))
    return rows


def names() -> list[str]:
    return [*scenes(), *limits()]


def run(options: argparse.Namespace, chosen: list[str]) -> None:
    """Runs the scenes and limits of these names; writes charts, runs.csv and report.md."""
    start = time.perf_counter()
    runner = Runner(options.comma, options.output / "work")
    scene_runs = [(scene, run_scene(runner, scene, options)) for name, scene in scenes().items() if name in chosen]
    limit_runs = [(limit, run_limit(runner, limit, options)) for name, limit in limits().items() if name in chosen]
    shutil.rmtree(runner.folder)
    for scene, runs in scene_runs:
        charts.draw_scene(scene, runs, options.output)
    for limit, rows in limit_runs:
        charts.draw_limit(limit, rows, options.output)
    seconds = time.perf_counter() - start
    report.write(scene_runs, limit_runs, options.output, seconds, options.quick)
    if options.publish:
        report.publish(options.output)
    print(f"{options.output}/report.md, runs.csv and charts, after {seconds:.0f} s")
