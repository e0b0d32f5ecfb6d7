"""What the suite of contact writes: a table of all runs (CSV), a chart for each scene, and a page (Markdown)."""
from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import charts
import pages
from orders import slope
from run import HERE, machine

if TYPE_CHECKING:
    from contact import ContactRun

# Errors below this are rounding of a solution that the elements have exactly.
ROUNDING = 1e-9
GOALS = (1e-2, 1e-3)
QUANTITIES = {"pressure": "pressure", "resultant": "resultant", "penetration": "penetration"}
PUBLISHED = ("hertz_plane", "hertz_3d", "patch_2d", "mindlin")


def by_label(runs: list[ContactRun]) -> dict[str, list[ContactRun]]:
    """Runs by formulation, each from coarse to fine."""
    found: dict[str, list[ContactRun]] = {}
    for run in runs:
        found.setdefault(run.label, []).append(run)
    return found


def write(results: list[list[ContactRun]], folder: Path, seconds: float, quick: bool) -> None:
    """Writes contact.csv, contact.md and the charts."""
    _write_csv([run for runs in results for run in runs], folder / "contact.csv")
    for runs in results:
        charts.draw_contact(runs[0].scene.name, runs[0].scene.title, by_label(runs), measured_quantities(runs), folder)
    text = _head(seconds, quick) + "".join(_scene_part(runs) for runs in results)
    text += (HERE / "contact_conclusion.md").read_text(encoding="utf-8")
    (folder / "contact.md").write_text(text, encoding="utf-8")


def publish(folder: Path) -> None:
    """Makes the page docs/bench_contact.md, with some of the charts."""
    pages.publish(folder / "contact.md", "bench_contact.md", PUBLISHED)


def measured_quantities(runs: list[ContactRun]) -> list[str]:
    measured = {name for run in runs for name in run.measured.errors}
    return [name for name in QUANTITIES if name in measured]


def _head(seconds: float, quick: bool) -> str:
    return (
        f"# Contact: error against time, by formulation\n\nWritten by `./comma bench contact{' --quick' if quick else ''}` ({seconds:.0f} s, "
        f"{machine()}). Every run is a whole process with RESI_GLOB_RELA 1e-10; its time leaves out the commands that measure the error.\n\n"
        "- **Errors** are relative to the closed solution; *exact* is less than 1e-9. Each cell gives the error on the finest mesh and, in brackets, "
        "the order over the four meshes.\n"
        "- **Within**: unknowns and time of the coarsest mesh from which on the pressure (of the sliding block, the resultant) has no larger error.\n"
        "- **Names**: discrete formulations and LIAISON_UNIL are named by ALGO_CONT, CONTINUE by INTEGRATION and ORDRE_INT.\n\n"
        "[The page on the benches](../testcases/bench/README.md) says what the scenes are and how pressure, resultant and penetration are measured.\n\n"
    )


def _scene_part(runs: list[ContactRun]) -> str:
    scene, quantities = runs[0].scene, measured_quantities(runs)
    text = f"## {scene.title}\n\n![{scene.title}]({scene.name}.svg)\n\n" + (scene.note + "\n\n" if scene.note else "")
    text += "| formulation | unknowns | time (s) | " + " | ".join(QUANTITIES[name] for name in quantities) + " | "
    text += " | ".join(f"within {goal:.0e}" for goal in GOALS) + " |\n" + "|---|---|---|" + "---|" * (len(quantities) + len(GOALS)) + "\n"
    for label, its in by_label(runs).items():
        text += _row(label, its, quantities)
    return text + "\n"


def _row(label: str, its: list[ContactRun], quantities: list[str]) -> str:
    finest = its[-1].measured
    if not finest.errors:
        return f"| {label} | {finest.unknowns} | exit {finest.status}: {finest.said} |" + " |" * (len(quantities) + len(GOALS)) + "\n"
    cells = [f"{finest.errors[name]:.1e}{_order(its, name)}" if finest.errors[name] > ROUNDING else "exact" for name in quantities]
    cells += [_cost(its, goal) for goal in GOALS]
    return f"| {label} | {finest.unknowns} | {finest.seconds:.2f} | " + " | ".join(cells) + " |\n"


def _order(its: list[ContactRun], quantity: str) -> str:
    points = [(1.0 / run.size, run.measured.errors[quantity]) for run in its if run.measured.errors.get(quantity, 0.0) > ROUNDING]
    order = slope(points)
    return "" if order is None or len(points) < 3 else f" ({order:.1f})"


def first_within(its: list[ContactRun], goal: float) -> ContactRun | None:
    """The coarsest mesh from which on the error stays within the goal: of the pressure, or of the resultant where that is not measured."""
    found = None
    for run in reversed(its):
        error = run.measured.errors.get("pressure", run.measured.errors.get("resultant"))
        if error is None or error > goal:
            break
        found = run
    return found


def _cost(its: list[ContactRun], goal: float) -> str:
    run = first_within(its, goal)
    return "-" if run is None else f"{run.measured.unknowns}, {run.measured.seconds:.2f} s"


def _write_csv(runs: list[ContactRun], path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["scene", "formulation", "cells", "size", "unknowns", "exit", "wall_s", "seconds", "peak_memory_bytes",
                         *(f"error_{name}" for name in QUANTITIES), "said"])
        for run in runs:
            its = run.measured
            errors = (f"{its.errors[name]:.6e}" if name in its.errors else "" for name in QUANTITIES)
            writer.writerow([run.scene.name, run.formulation, run.family, run.size, its.unknowns, its.status, f"{its.wall:.4f}",
                             f"{its.seconds:.4f}", its.memory, *errors, its.said])
