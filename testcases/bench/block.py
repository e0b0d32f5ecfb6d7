"""The elastic block: what a large linear run costs, phase by phase, by size; and the same block in CalculiX where that is there.

A block 1 x 1 x 2 of N x N x 2N cells, clamped below, pressed above, under gravity; displacements and nodal stresses.
"""
from __future__ import annotations

import argparse
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import charts
from meshes import Grid, Mesh, Point, build_mesh, on, write_mail
from orders import slope
from run import HERE, machine

FAMILIES = ("HEXA8", "TETRA10")
QUICK_SIZES = {"HEXA8": (6, 9, 12), "TETRA10": (3, 4, 6)}
# About 10,000, 30,000 and 100,000 unknowns; --sizes takes larger ones.
SIZES = {"HEXA8": (11, 16, 24), "TETRA10": (5, 8, 11)}

# Displacements of the two programs may differ by this much of the largest one.
AGREEMENT = 1e-6


@dataclass
class BlockRun:
    """One size: the fastest whole process of each program, and its phases."""

    family: str
    size: int
    unknowns: int
    status: int
    wall: float = math.inf  # s
    memory: int = 0  # bytes
    phases: dict[str, float] = field(default_factory=dict)
    said: str = ""
    peer_wall: float | None = None
    peer_memory: int | None = None
    difference: float | None = None  # of the displacements, relative to the largest


def watched(place: Point) -> bool:
    """Where the displacements of the two programs are compared: on two sides of the block."""
    return place[0] == 1.0 or place[2] == 1.0


def block_grid(n: int) -> Grid:
    sides = {"BASE": on(2, 0.0), "TOP": on(2, 1.0)}
    return Grid((n, n, 2 * n), lambda p: (p[0], p[1], 2.0 * p[2]), sides, {"WATCHED": watched})


# --- comma ----------------------------------------------------------------------------------------------------------------


def run_comma(comma: Path, folder: Path, run: BlockRun) -> None:
    """Runs the block once; keeps its figures if it was the fastest."""
    start = time.perf_counter()
    process = subprocess.run(
        [comma, "run", "block.comm", "-q", "--json", "report.json"], cwd=folder, capture_output=True, text=True
    )
    wall = time.perf_counter() - start
    run.status = process.returncode
    if process.returncode != 0:
        run.said = (process.stdout + process.stderr).strip()[:200]
    elif wall < run.wall:
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        run.wall, run.memory = wall, report["peak_memory_bytes"]
        run.phases = _phases(report)


def _phases(report: dict) -> dict[str, float]:
    """Reading and post-processing by their commands, the phases of the linear system between them."""
    seconds: dict[str, float] = {}
    for command in report["commands"]:
        seconds[command["name"]] = seconds.get(command["name"], 0.0) + command["seconds"]
    between = report.get("phases") or {"solving, all": seconds.get("MECA_STATIQUE", 0.0)}
    return {"reading": seconds.get("LIRE_MAILLAGE", 0.0), **between, "post-processing": seconds.get("CALC_CHAMP", 0.0)}


def read_displacements(path: Path) -> list[tuple[float, ...]]:
    """The displacements of a file of IMPR_RESU FORMAT='RESULTAT', in the order of the nodes."""
    found = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if len(words) == 4 and words[0].startswith("N") and words[0][1:].isdigit():
            found[int(words[0][1:])] = tuple(float(word) for word in words[1:])
    return [found[number] for number in sorted(found)]


# --- CalculiX -------------------------------------------------------------------------------------------------------------

# Code_Aster's nodes are in CalculiX's order for these two.
PEER_CELLS = {"HEXA8": "C3D8", "TETRA10": "C3D10"}

def write_peer(mesh: Mesh, family: str, path: Path) -> None:
    """The same block as an input file of CalculiX, which prints the displacements of the group WATCHED as text (.dat)."""
    body = mesh.cells[family]
    with path.open("w", encoding="ascii") as out:
        out.write("*NODE, NSET=ALL\n")
        for number, point in enumerate(mesh.coordinates, 1):
            out.write(f"{number}," + ",".join(repr(value) for value in point) + "\n")
        out.write(f"*ELEMENT, TYPE={PEER_CELLS[family]}, ELSET=BODY\n")
        for number, nodes in enumerate(body, 1):
            out.write(f"{number}," + ",".join(str(node + 1) for node in nodes) + "\n")
        base = [number for number, point in enumerate(mesh.coordinates, 1) if point[2] == 0.0]
        out.write("*NSET, NSET=BASE\n" + ",\n".join(map(str, base)) + "\n")
        out.write("*NSET, NSET=WATCHED\n" + ",\n".join(str(node + 1) for node in mesh.node_groups["WATCHED"]) + "\n")
        out.write("*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11,0.3\n*DENSITY\n7800.\n*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n")
        out.write("*BOUNDARY\nBASE,1,3\n*STEP\n*STATIC\n*DLOAD\n")
        for number, nodes in enumerate(body, 1):
            out.writelines(f"{number},{face},1e6\n" for face in _loaded_faces(mesh, nodes, family))
        out.write("BODY,GRAV,9.81,0.,0.,-1.\n*NODE PRINT, NSET=WATCHED\nU\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n")


# CalculiX's names of faces, by their corners.
PEER_FACES = {
    "HEXA8": {"P2": (4, 5, 6, 7)},  # the upper one, the only one that can lie on top
    "TETRA10": {"P1": (0, 1, 2), "P2": (0, 3, 1), "P3": (1, 3, 2), "P4": (2, 3, 0)},
}


def _loaded_faces(mesh: Mesh, nodes: list[int], family: str) -> list[str]:
    on_top = [mesh.coordinates[node][2] == 2.0 for node in nodes]
    return [name for name, corners in PEER_FACES[family].items() if all(on_top[i] for i in corners)]


def run_peer(folder: Path, run: BlockRun) -> None:
    """Runs CalculiX once on one thread a core, as its Debian package does by default."""
    before = time.perf_counter()
    process = subprocess.Popen(["ccx", "peer"], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - before
    process.returncode = status
    if status != 0:
        return
    if run.peer_wall is None or wall < run.peer_wall:
        run.peer_wall, run.peer_memory = wall, usage.ru_maxrss * 1024


def read_peer_displacements(path: Path) -> list[tuple[float, ...]]:
    found = []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            found.append(tuple(float(word) for word in words[1:]))
    return found


def relative_difference(ours: list[tuple[float, ...]], theirs: list[tuple[float, ...]]) -> float | None:
    if not ours or len(ours) != len(theirs):
        return None
    largest = max(abs(value) for point in theirs for value in point)
    return max(abs(a - b) for p, q in zip(ours, theirs) for a, b in zip(p, q)) / largest


# --- the bench ------------------------------------------------------------------------------------------------------------


def run(options: argparse.Namespace, _: list[str]) -> None:
    """All families and sizes; writes block.csv, block.md and the chart block."""
    runs = []
    for family in options.families.split(",") if options.families else FAMILIES:
        sizes = (QUICK_SIZES if options.quick else SIZES)[family]
        if options.sizes:
            sizes = tuple(int(word) for word in options.sizes.split(","))
        for size in sizes:
            runs.append(_one(options, family, size))
            _tell(runs[-1])
    _write(runs, options.output)
    charts.draw_block(runs, options.output)


def _one(options: argparse.Namespace, family: str, size: int) -> BlockRun:
    folder = options.output / "block"
    folder.mkdir(parents=True, exist_ok=True)
    peer = shutil.which("ccx") is not None and not options.no_peer
    # In a process of its own: what a large process starts counts the memory of the latter as its own (Linux, ru_maxrss).
    made = subprocess.run([sys.executable, __file__, family, str(size), folder], capture_output=True, text=True, check=True)
    run = BlockRun(family, size, int(made.stdout), 0)
    shutil.copy(HERE / "block" / "block.comm", folder / "block.comm")
    for _ in range(options.repeat):
        run_comma(options.comma, folder, run)
        if peer:
            run_peer(folder, run)
    if peer and run.peer_wall is not None and run.status == 0:
        run.difference = relative_difference(
            read_displacements(folder / "block.resu"), read_peer_displacements(folder / "peer.dat")
        )
    shutil.rmtree(folder)
    return run


def _tell(run: BlockRun) -> None:
    phases = "  ".join(f"{name} {seconds:.2f}" for name, seconds in run.phases.items())
    peer = ""
    if run.peer_wall is not None:
        peer = f"  CalculiX {run.peer_wall:.2f} s {run.peer_memory / 1e6:.0f} MB, {run.peer_wall / run.wall:.1f} times"
        peer += "" if run.difference is None else f", displacements differ by {run.difference:.1e}"
    print(f"block {run.family:8} {run.size:4d} {run.unknowns:8d} unknowns {run.wall:8.2f} s {run.memory / 1e6:7.0f} MB  {phases}{peer}"
          + (f"  exit {run.status}: {run.said}" if run.status else ""), flush=True)


def exponents(runs: list[BlockRun], family: str) -> dict[str, float | None]:
    """How wall time, memory and each phase grow: the exponent of the number of unknowns."""
    good = [run for run in runs if run.family == family and run.status == 0]
    found = {"wall": slope([(run.unknowns, run.wall) for run in good]),
             "memory": slope([(run.unknowns, run.memory) for run in good])}
    for name in good[-1].phases if good else ():
        found[name] = slope([(run.unknowns, run.phases[name]) for run in good if run.phases.get(name, 0.0) > 0.0])
    return found


def _write(runs: list[BlockRun], folder: Path) -> None:
    names = list(dict.fromkeys(name for run in runs for name in run.phases))
    with (folder / "block.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["family", "size", "unknowns", "exit", "wall_s", "peak_memory_bytes", *names, "calculix_wall_s",
                         "calculix_memory_bytes", "ratio", "difference"])
        for run in runs:
            ratio = None if run.peer_wall is None else run.peer_wall / run.wall
            writer.writerow([run.family, run.size, run.unknowns, run.status, run.wall, run.memory,
                             *(run.phases.get(name, "") for name in names), run.peer_wall, run.peer_memory, ratio, run.difference])
    (folder / "block.md").write_text(_page(runs, names), encoding="utf-8")


def _page(runs: list[BlockRun], names: list[str]) -> str:
    text = f"# The elastic block\n\n{__doc__.split(chr(10) * 2)[1]}Whole processes, {machine()}; times in s, memory in MB.\n\n"
    text += "![The elastic block](block.svg)\n\n"
    text += "| cells | N | unknowns | whole | memory | " + " | ".join(names) + " | CalculiX | memory | ratio | difference |\n"
    text += "|---|" + "---|" * (8 + len(names)) + "\n"
    for run in runs:
        phases = " | ".join(f"{run.phases[name]:.2f}" if name in run.phases else "" for name in names)
        peer = " | | | |"
        if run.peer_wall is not None:
            agrees = "" if run.difference is None else f"{run.difference:.0e}" + ("" if run.difference < AGREEMENT else " **apart**")
            peer = f" {run.peer_wall:.2f} | {run.peer_memory / 1e6:.0f} | {run.peer_wall / run.wall:.1f} | {agrees} |"
        whole = f"{run.wall:.2f}" if run.status == 0 else f"exit {run.status}: {run.said}"
        text += f"| {run.family} | {run.size} | {run.unknowns} | {whole} | {run.memory / 1e6:.0f} | {phases} |{peer}\n"
    for family in dict.fromkeys(run.family for run in runs):
        fitted = ", ".join(f"{name} {value:.2f}" for name, value in exponents(runs, family).items() if value is not None)
        text += f"\nExponents of the number of unknowns, {family}: {fitted}.\n"
    return text


def write_files(family: str, size: int, folder: Path) -> int:
    """Writes the meshes of both programs. Returns the number of displacements."""
    mesh = build_mesh(block_grid(size), family)
    write_mail(mesh, folder / "block.mail", f"block {family} {size}")
    write_peer(mesh, family, folder / "peer.inp")
    return 3 * len(mesh.coordinates)


if __name__ == "__main__":
    print(write_files(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3])))
