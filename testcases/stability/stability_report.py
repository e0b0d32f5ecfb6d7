"""What the suite of stability writes: a table of all cells (CSV), a chart for each map, and a page (Markdown)."""
from __future__ import annotations

import csv
import re
import shutil
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import charts
from maps import StabilityMap
from run import HERE, machine

if TYPE_CHECKING:
    from stability import MapCell

Results = list[tuple[StabilityMap, list["MapCell"]]]

OUTCOMES = ("right", "told", "no convergence", "refused", "wrong")
COLOURS = {"right": "#a6dba0", "told": "#fee08b", "no convergence": "#fdae61", "refused": "#d8b365", "wrong": "#d7191c"}
MARKS = {"right": "", "told": "told ", "no convergence": "n.c. ", "refused": "refused ", "wrong": "**wrong** "}


def write(results: Results, folder: Path, seconds: float) -> None:
    """Writes stability.csv, stability.md and the charts."""
    _write_csv(results, folder / "stability.csv")
    for of, cells in results:
        charts.draw_map(of.name, of.title, of.axis, [(cell.series, shown(cell.value), cell.outcome.value, cell.iterations) for cell in cells], COLOURS, folder)
    text = _head(results, seconds) + "".join(_map_part(of, cells) for of, cells in results) + _sayings(results)
    (folder / "stability.md").write_text(text, encoding="utf-8")


def publish(folder: Path) -> None:
    """Makes the page docs/stability.md, with its charts in docs/stability/."""
    docs = HERE.parent.parent / "docs"
    (docs / "stability").mkdir(exist_ok=True)
    text = (folder / "stability.md").read_text(encoding="utf-8")
    for name in re.findall(r"\]\((\w+)\.svg\)", text):
        shutil.copy(folder / f"{name}.svg", docs / "stability")
    (docs / "stability.md").write_text(re.sub(r"\]\((\w+)\.svg\)", r"](stability/\1.svg)", text), encoding="utf-8")


def shown(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _head(results: Results, seconds: float) -> str:
    text = (
        f"# Where contact stops working\n\nWritten by `./comma bench stability` ({seconds:.0f} s, {machine()}). "
        "One parameter of a scene goes to an extreme, by each formulation. Numbers are iterations, Newton's and those on the contact rows. "
        "A cell is\n\n"
        "- *right* when the answer is within the tolerance that [the page on the maps](../testcases/stability/README.md) "
        "gives, or when what has no solution is refused as contradictory;\n"
        "- *told* when it is not, and comma gives an alarm about this very thing;\n"
        "- *no convergence*;\n"
        "- *refused*, with an error about something else;\n"
        "- else *wrong*.\n\n"
        "| map | " + " | ".join(OUTCOMES) + " |\n|---|" + "---|" * len(OUTCOMES) + "\n"
    )
    whole: Counter[str] = Counter()
    for of, cells in results:
        counted = Counter(cell.outcome.value for cell in cells)
        whole += counted
        text += f"| {of.title} | " + " | ".join(str(counted[name]) for name in OUTCOMES) + " |\n"
    return text + "| **all** | " + " | ".join(f"**{whole[name]}**" for name in OUTCOMES) + " |\n\n"


def _map_part(of: StabilityMap, cells: list[MapCell]) -> str:
    values = list(dict.fromkeys(shown(cell.value) for cell in cells))
    text = f"## {of.title}\n\n![{of.title}]({of.name}.svg)\n\n| {of.axis} | " + " | ".join(values) + " |\n|---|" + "---|" * len(values) + "\n"
    for series in of.series:
        its = [f"{MARKS[cell.outcome.value]}{cell.iterations}" for cell in cells if cell.series == series]
        text += f"| {series} | " + " | ".join(its) + " |\n"
    return text + "\n"


def _sayings(results: Results) -> str:
    """What one reads, once for each kind of cell that is not plainly right: messages that differ in numbers alone count as one."""
    kinds: dict[tuple[str, str], tuple[str, str]] = {}
    for of, cells in results:
        for cell in cells:
            if cell.measured.said and (cell.measured.status != 0 or cell.outcome.value != "right"):
                kind = re.sub(r"[A-Z]*[0-9].*", "", cell.measured.said)
                kinds.setdefault((cell.outcome.value, kind), (of.name, f"{cell.measured.said}: {cell.measured.advice}"))
    if not kinds:
        return ""
    text = "## What one reads\n\n| outcome | first seen in | message, and what to try |\n|---|---|---|\n"
    return text + "".join(f"| {outcome} | {name} | {_in_one_line(message)} |\n" for (outcome, _), (name, message) in kinds.items())


def _in_one_line(message: str) -> str:
    """Without the table of iterations that a message may end with."""
    return re.sub(r"\s*\n\s*iteration.*?(?=\(|$)", " ", message, flags=re.S).replace("\n", " ").replace("|", "\\|")


def _write_csv(results: Results, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["map", "formulation", "value", "outcome", "iterations", "exit", "errors", "said"])
        for of, cells in results:
            for cell in cells:
                errors = " ".join(f"{name}={error:.3e}" for name, error in cell.measured.errors.items())
                writer.writerow([of.name, cell.series, shown(cell.value), cell.outcome.value, cell.iterations, cell.measured.status, errors, cell.measured.said])
