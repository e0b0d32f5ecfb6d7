"""One table of all runs (CSV) and a page (Markdown) with the observed orders and what failed."""
from __future__ import annotations

import csv
import re
from pathlib import Path

import pages
from charts import series_of
from limits import Limit
from orders import expected, falls_short, observed
from run import Measurement, machine
from scenes import Scene

SceneRuns = list[tuple[Scene, list[Measurement]]]
LimitRuns = list[tuple[Limit, list[tuple[str, float, Measurement]]]]

PUBLISHED = ("cylinder_3d", "plate_with_hole", "manufactured", "solvers", "locking", "slender", "aspect", "stiff_held", "stiff_pulled")

# An error that a user would take for an answer: a tenth, or where elements have the solution exactly, a millionth.
WRONG, WRONG_IF_EXACT = 0.1, 1e-6


def write(scene_runs: SceneRuns, limit_runs: LimitRuns, folder: Path, seconds: float, quick: bool) -> None:
    """Writes runs.csv and report.md."""
    _write_csv(scene_runs, limit_runs, folder / "runs.csv")
    parts = [_head(seconds, quick)]
    parts += [_scene_part(scene, runs) for scene, runs in scene_runs]
    if limit_runs:
        parts.append("## Where a choice fails\n")
        parts += [_limit_part(limit, rows) for limit, rows in limit_runs]
    (folder / "report.md").write_text("\n".join(parts), encoding="utf-8")


def publish(folder: Path) -> None:
    """Makes the report docs/bench.md, with the charts that say most."""
    pages.publish(folder / "report.md", "bench.md", PUBLISHED)


def _head(seconds: float, quick: bool) -> str:
    mode = "quick mode, " if quick else ""
    return (
        f"# Error against time and memory\n\nWritten by `./comma bench{' --quick' if quick else ''}` ({mode}{seconds:.0f} s, "
        f"{machine()}). Every run is a whole process; its time leaves out the commands that measure the error.\n\n"
        "- **Errors** are relative; that in the energy norm is the root of the relative error of the energy.\n"
        "- **An order** is the slope over the three finest meshes, that of theory in brackets; in bold where it is more than 1/4 under it.\n"
        "- **Times** are those of a machine that other work may have shared.\n\n"
        "[The page on the benches](../testcases/bench/README.md) says what the scenes are and what the figures show.\n"
    )


def _columns(scene_runs: SceneRuns, limit_runs: LimitRuns) -> list[str]:
    every = [run for _, runs in scene_runs for run in runs] + [row[2] for _, rows in limit_runs for row in rows]
    return list(dict.fromkeys(name for run in every for name in run.errors))


def _write_csv(scene_runs: SceneRuns, limit_runs: LimitRuns, path: Path) -> None:
    quantities = _columns(scene_runs, limit_runs)
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["bench", "family", "modelisation", "solver", "size", "parameter", "unknowns", "exit", "wall_s", "seconds",
                         "peak_memory_bytes", *(f"error_{name}" for name in quantities), "said"])
        rows = [(run, "") for _, runs in scene_runs for run in runs]
        rows += [(run, f"{value:.6g}") for _, its in limit_runs for _, value, run in its]
        for run, parameter in rows:
            case = run.case
            writer.writerow([case.scene, case.family, case.modelisation, case.solver, case.size, parameter, run.unknowns, run.status,
                             f"{run.wall:.4f}", f"{run.seconds:.4f}", run.memory,
                             *(f"{run.errors[name]:.6e}" if name in run.errors else "" for name in quantities), run.said])


def _scene_part(scene: Scene, runs: list[Measurement]) -> str:
    text = f"## {scene.title}\n\n![{scene.title}]({scene.name}.svg)\n\n"
    if scene.note:
        text += scene.note + "\n\n"
    by_solver = len(scene.solvers) > 1
    quantities = _columns([(scene, runs)], [])
    text += "| elements | unknowns | time (s) | memory (MB) |"
    text += "".join(f" {name}: error | order |" for name in quantities) + "\n|---|---|---|---|" + "---|---|" * len(quantities) + "\n"
    for label, its in series_of(runs, by_solver).items():
        text += _series_row(scene, label, its, quantities)
    return text


def _series_row(scene: Scene, label: str, its: list[Measurement], quantities: list[str]) -> str:
    good = [run for run in its if run.errors]
    if not good:
        return f"| {label} | no answer: {its[-1].said} |\n"
    finest = good[-1]
    row = f"| {label} | {finest.unknowns} | {finest.seconds:.2f} | {finest.memory / 1e6:.0f} |"
    for name in quantities:
        row += f" {finest.errors[name]:.1e} | {order_text(scene, good, name)} |"
    return row + "\n"


def order_text(scene: Scene, its: list[Measurement], quantity: str) -> str:
    """The observed order, beside that of theory where a smooth solution has one."""
    order, family = observed(its, quantity), its[0].case.family
    if order is None:
        return "exact"
    theory = None if scene.singular else expected(family, quantity)
    if theory is None:
        return f"{order:.2f}"
    shown = f"**{order:.2f}**" if falls_short(family, quantity, order) else f"{order:.2f}"
    return f"{shown} ({theory})"


def silent_errors(limit: Limit, rows: list[tuple[str, float, Measurement]]) -> list[tuple[str, float, Measurement]]:
    """Runs that ended well, said nothing, and are wrong."""
    bound = WRONG_IF_EXACT if limit.exact else WRONG
    return [row for row in rows if not row[2].said and row[2].status == 0 and row[2].errors.get(limit.quantity, 0.0) > bound]


def _limit_part(limit: Limit, rows: list[tuple[str, float, Measurement]]) -> str:
    text = f"### {limit.title}\n\n![{limit.title}]({limit.name}.svg)\n\n"
    values = list(dict.fromkeys(value for _, value, _ in rows))
    text += f"Relative error of the {limit.quantity} by {limit.axis}:\n\n| | " + " | ".join(f"{value:.3g}" for value in values) + " |\n"
    text += "|---|" + "---|" * len(values) + "\n"
    for label in dict.fromkeys(row[0] for row in rows):
        cells = [_cell(limit, run) for name, _, run in rows if name == label]
        text += f"| {label} | " + " | ".join(cells) + " |\n"
    said = _different_sayings(rows)
    text += "".join(f"\nExit {status}{'*' if status == 0 else ''}: \"{message}\"\n" for status, message in said)
    silent = silent_errors(limit, rows)
    bound = WRONG_IF_EXACT if limit.exact else WRONG
    return text + f"\nWrong by more than {bound:g} without a word: {len(silent)} of {len(rows)}.\n"


def _different_sayings(rows: list[tuple[str, float, Measurement]]) -> list[tuple[int, str]]:
    """Exit status and message, one of each kind: those that differ in numbers and names alone count as one."""
    kinds: dict[tuple[int, str], str] = {}
    for _, _, run in rows:
        if run.said:
            kinds.setdefault((run.status, re.sub(r"[A-Z]*[0-9].*", "", run.said)), run.said)
    return [(status, message) for (status, _), message in kinds.items()]


def _cell(limit: Limit, run: Measurement) -> str:
    if not run.errors:
        return f"exit {run.status}"
    return f"{run.errors.get(limit.quantity, 0.0):.1e}" + ("*" if run.said else "")
