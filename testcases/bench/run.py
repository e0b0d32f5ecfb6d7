"""Runs comma as a whole process on one case, and reads what it measured."""
from __future__ import annotations

import json
import math
import os
import resource
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent

# What comes after the solution measures the error, which a user would not do: its time is left out.
SOLVING = {"MECA_STATIQUE", "STAT_NON_LINE"}


@dataclass(frozen=True)
class Case:
    """One run: the files it is made of, the values in front of them, and where it stands in its bench."""

    scene: str
    folder: str  # of the command file of the same name, from here
    family: str
    modelisation: str
    solver: str  # METHODE, or METHODE/PRE_COND
    size: int  # cells along an edge of the grid
    parameters: dict[str, float]
    measured_by: str | None = "measure.comm"

    @property
    def label(self) -> str:
        return self.family + (" SI" if self.modelisation.endswith("_SI") else "")


@dataclass
class Measurement:
    """What a run gave. `errors` are relative; that of the energy is its square root, an error in the energy norm."""

    case: Case
    unknowns: int
    status: int
    wall: float  # s, the whole process
    seconds: float  # s, the same without the commands that measure the error
    memory: int  # bytes, the largest resident size
    processor: float = 0.0  # s, of all threads, which other work on the machine does not lengthen as much as `wall`
    errors: dict[str, float] = field(default_factory=dict)
    phases: dict[str, float] = field(default_factory=dict)
    counters: dict[str, int] = field(default_factory=dict)
    said: str = ""  # the first error, or all alarms
    advice: str = ""  # what to write or try instead
    codes: list[str] = field(default_factory=list)  # of all errors and alarms


def command_file(case: Case) -> str:
    """The text of the command file: the values, the scene, and the file that measures."""
    method, _, preconditioner = case.solver.partition("/")
    solver = f'METHODE="{method}"'
    if method == "GCPC":
        solver += f', PRE_COND="{preconditioner or "LDLT_INC"}", RESI_RELA=1.0e-12'
    values = {"modelisation": f'"{case.modelisation}"', "solver": f"_F({solver})"}
    values |= {name: repr(value) for name, value in case.parameters.items()}
    text = "".join(f"{name} = {value}\n" for name, value in values.items())
    text += (HERE / case.folder / f"{Path(case.folder).name}.comm").read_text(encoding="utf-8")
    if case.measured_by:
        text += (HERE / "shared" / case.measured_by).read_text(encoding="utf-8")
    return text


def run_comma(comma: Path, case: Case, unknowns: int, folder: Path, timeout: float) -> Measurement:
    """Runs the case, whose mesh lies as case.mail in the folder."""
    (folder / "case.comm").write_text(command_file(case), encoding="utf-8")
    report_path = folder / "report.json"
    for left in (report_path, folder / "case.resu"):
        left.unlink(missing_ok=True)
    start, before = time.perf_counter(), _processor_seconds()
    try:
        process = subprocess.run(
            [comma, "run", "case.comm", "-q", "--json", report_path], cwd=folder, capture_output=True, text=True, timeout=timeout
        )
    except subprocess.TimeoutExpired:
        return Measurement(case, unknowns, 4, timeout, timeout, 0, said=f"no answer in {timeout:.0f} s")
    wall = time.perf_counter() - start
    if not report_path.exists():
        return Measurement(case, unknowns, process.returncode, wall, wall, 0, said=process.stderr.strip()[-200:])
    report = json.loads(report_path.read_text(encoding="utf-8"))
    measurement = Measurement(
        case, unknowns, process.returncode, wall, wall - _measuring_seconds(report), report["peak_memory_bytes"]
    )
    measurement.processor = _processor_seconds() - before
    measurement.phases = report.get("phases", {})
    measurement.counters = report["counters"]
    measurement.said = _said(report)
    measurement.codes = [diagnostic["code"] for diagnostic in report["diagnostics"]]
    measurement.advice = next((diagnostic.get("hint") or "" for diagnostic in report["diagnostics"]), "")
    table = folder / "case.resu"
    if process.returncode == 0 and table.exists():
        measurement.errors = _errors(table.read_text(encoding="utf-8"))
    return measurement


def _processor_seconds() -> float:
    """Of all processes that this one has waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _measuring_seconds(report: dict) -> float:
    commands = report["commands"]
    last = max((i for i, command in enumerate(commands) if command["name"] in SOLVING), default=len(commands))
    return sum(command["seconds"] for command in commands[last + 1 :])


def _said(report: dict) -> str:
    """The first error; where there is none, all alarms."""
    errors = [diagnostic["message"] for diagnostic in report["diagnostics"] if diagnostic["severity"] == "error"]
    alarms = [diagnostic["message"] for diagnostic in report["diagnostics"] if diagnostic["severity"] == "alarm"]
    return errors[0] if errors else "; ".join(alarms)


def _errors(table: str) -> dict[str, float]:
    rows = [line.split() for line in table.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    start = next(i for i, row in enumerate(rows) if row[0] == "QUANTITY")
    errors = {}
    for name, computed, exact, scale in rows[start + 1 :]:
        error = abs(float(computed) - float(exact)) / float(scale)
        errors[name] = math.sqrt(error) if name == "energy" else error
    return errors


def machine() -> str:
    """What the times depend on, for the report."""
    return f"{os.cpu_count()} cores"
