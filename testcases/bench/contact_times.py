"""What contact costs: scenes of the kinds that another program was timed on (`peer`), and one of 200,000 unknowns (`large`)."""
from __future__ import annotations

import argparse
import math
import shutil
import statistics
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from formulations import FORMULATIONS, Scale
from meshes import Grid, at, build_mesh, merged, on, write_mail
from run import HERE, Case, Measurement, machine, run_comma

YOUNG = 2.0e11
TIMEOUT = 3600.0  # s, for one run

# Whole processes of Code_Aster 17.3 on scenes of these kinds, one thread, on a machine like the one these pages are measured on (s).
PEER = {"LIAISON_UNIL": 60.0, "CONTRAINTE": 185.0, "GCP": 98.0, "PENALISATION": 148.0}


@dataclass(frozen=True)
class TimedScene:
    """`counts`: cells of the block (width, height) and of the wider one beneath it; (0, 0) where there is none."""

    name: str
    block: tuple[int, int]
    base: tuple[int, int]
    height: float = 1.0  # of the block; both are 1 wide, the base is 1.4

    @property
    def folder(self) -> str:
        return "two_blocks" if self.base[0] else "block_on_support"


@dataclass
class TimedRuns:
    """The same run, several times over."""

    scene: TimedScene
    label: str
    runs: list[Measurement] = field(default_factory=list)

    @property
    def friction(self) -> str:
        return self.label.partition("COULOMB=")[2]

    @property
    def wall(self) -> float:
        return statistics.median(run.wall for run in self.runs)

    @property
    def processor(self) -> float:
        return statistics.median(run.processor for run in self.runs)

    @property
    def force(self) -> float | None:
        """The force through the contact, to compare formulations by."""
        return self.runs[0].errors.get("force")


SMALL, BLOCK = TimedScene("6^3", (6, 6), (8, 4)), TimedScene("20^3", (20, 20), (17, 8))
SUPPORTED = TimedScene("20^3 on a support", (20, 20), (0, 0))
LARGE = TimedScene("large", (71, 7), (61, 6), height=0.4)
FRICTION = 0.3
BETWEEN = ("CONTRAINTE", "GCP", "PENALISATION", "CONTINUE AUTO")


def write_mesh(scene: TimedScene, path: Path) -> int:
    """Writes the mesh. Returns the number of displacements."""
    width, height = scene.block
    sides = {"SLAVE": on(2, 0.0), "TOP": on(2, 1.0), "LEFT": on(0, 0.0), "FRONT": on(1, 0.0)}
    points = {"BASE": on(2, 0.0), "CORNER": at(1.0, 1.0, 1.0)}
    block = build_mesh(Grid((width, width, height), lambda p: (p[0], p[1], scene.height * p[2]), sides, points), "HEXA8")
    mesh = block
    if scene.base[0]:
        across, deep = scene.base
        shape = lambda p: (1.4 * p[0] - 0.2, 1.4 * p[1] - 0.2, 0.5 * scene.height * (p[2] - 1.0))
        wider = build_mesh(Grid((across, across, deep), shape, {"MASTER": on(2, 1.0), "BASE": on(2, 0.0)}, {"BASE_NODES": on(2, 0.0)}), "HEXA8")
        mesh = merged([("U_", block), ("L_", wider)])
    write_mail(mesh, path, scene.name)
    return 3 * len(mesh.coordinates)


def _mesh_apart(scene: TimedScene, path: Path) -> int:
    """In a process of its own: what a large process starts counts the memory of the latter as its own (Linux, ru_maxrss)."""
    words = [scene.name, *map(str, scene.block), *map(str, scene.base), repr(scene.height), str(path)]
    return int(subprocess.run([sys.executable, __file__, *words], capture_output=True, text=True, check=True).stdout)


def _case(scene: TimedScene, values: dict[str, object]) -> Case:
    return Case(scene.name, scene.folder, "HEXA8", "3D", "MULT_FRONT", scene.block[0], values, None)


def variants(scene: TimedScene, names: tuple[str, ...], rubbing: tuple[str, ...]) -> list[tuple[str, dict[str, object]]]:
    """The runs of a scene: its formulations, without friction and with it, or the two ways to impose the displacement of the block on a support."""
    if not scene.base[0]:
        return [(f"LIAISON_UNIL, by {by}", {"imposed_by": by}) for by in ("DDL_IMPO", "CINE")]
    scale = Scale(YOUNG, 1.0, 1.0 / scene.block[0], solid=True)
    smooth = [(name, FORMULATIONS[name].values(scale)) for name in names]
    return smooth + [(f"{name}, COULOMB={FRICTION}", FORMULATIONS[name].values(scale, FRICTION)) for name in rubbing]


def time_scene(
    options: argparse.Namespace, scene: TimedScene, names: tuple[str, ...], repeat: int, rubbing: tuple[str, ...] = ()
) -> list[TimedRuns]:
    folder = options.output / "work"
    folder.mkdir(parents=True, exist_ok=True)
    unknowns = _mesh_apart(scene, folder / "case.mail")
    results = []
    for label, values in variants(scene, names, rubbing):
        timed = TimedRuns(scene, label)
        for _ in range(repeat):
            timed.runs.append(run_comma(options.comma, _case(scene, values), unknowns, folder, TIMEOUT))
            if timed.runs[-1].status != 0:
                break
        results.append(timed)
        _tell(timed)
    return results


def time_bare(options: argparse.Namespace, scene: TimedScene) -> Measurement:
    """The same bodies, each held and pushed by itself: reading, assembling, one factorisation, one solution."""
    folder = options.output / "work"
    folder.mkdir(parents=True, exist_ok=True)
    unknowns = _mesh_apart(scene, folder / "case.mail")
    return run_comma(options.comma, Case(scene.name, "bare", "HEXA8", "3D", "MULT_FRONT", 0, {}, None), unknowns, folder, TIMEOUT)


def _tell(timed: TimedRuns) -> None:
    run = timed.runs[0]
    counted = "  ".join(f"{name} {value}" for name, value in run.counters.items())
    print(f"{timed.scene.name:20} {timed.label:24} {run.unknowns:8d} unknowns {timed.wall:8.2f} s  processor {timed.processor:8.2f} s {run.memory / 1e6:6.0f} MB  {counted}"
          + (f"  exit {run.status}: {run.said[:300]}" if run.status else ""), flush=True)


def names() -> list[str]:
    return ["peer", "large"]


def run(options: argparse.Namespace, chosen: list[str]) -> None:
    """Writes peer.md and large.md."""
    if "peer" in chosen:
        scenes = [(SUPPORTED, ()), (SMALL, BETWEEN)] + ([] if options.quick else [(BLOCK, BETWEEN)])
        results = [timed for scene, its in scenes for timed in time_scene(options, scene, its, max(3, options.repeat))]
        (options.output / "peer.md").write_text(_peer_page(results), encoding="utf-8")
    if "large" in chosen:
        bare = time_bare(options, LARGE)
        results = time_scene(options, LARGE, ("CONTRAINTE", "GCP", "CONTINUE AUTO"), options.repeat, rubbing=("CONTINUE AUTO",))
        (options.output / "large.md").write_text(_large_page(bare, results), encoding="utf-8")
    shutil.rmtree(options.output / "work")
    if options.publish:
        _publish(options.output, chosen)


def _publish(folder: Path, chosen: list[str]) -> None:
    docs = HERE.parent.parent / "docs"
    for name in chosen:
        shutil.copy(folder / f"{name}.md", docs / f"bench_contact_{name}.md")


def _difference(timed: TimedRuns, results: list[TimedRuns]) -> str:
    """Of the force through the contact, from that of the first run of the scene with as much friction."""
    first = next(other for other in results if other.scene == timed.scene and other.friction == timed.friction).force
    if first is None or timed.force is None or timed.force == first:
        return ""
    return f"{abs(timed.force / first - 1.0):.0e}"


def _row(timed: TimedRuns, results: list[TimedRuns]) -> str:
    run = timed.runs[0]
    counted = [str(run.counters.get(name, "")) for name in ("factorisations", "solves", "newton_iterations", "contact_iterations", "pairings")]
    wall = f"{timed.wall:.2f}" if run.status == 0 else f"exit {run.status}: {run.said}"
    return f"| {timed.scene.name} | {timed.label} | {run.unknowns} | {wall} | {timed.processor:.2f} | {run.memory / 1e6:.0f} | " + " | ".join(counted) + f" | {_difference(timed, results)} |"


COLUMNS = "| block | formulation | unknowns | time (s) | processor (s) | memory (MB) | factorisations | solves | Newton | contact iterations | pairings | difference |"
SHARED = "Elapsed times are those of a machine that other work may have shared, several times over."
RULE = "|---|---|---|---|---|---|---|---|---|---|---|---|"


def _peer_page(results: list[TimedRuns]) -> str:
    text = (
        "# Contact: scenes that another program was timed on\n\nWritten by `./comma bench peer`. A block of HEXA8 whose top corner is pushed down on a support "
        "that cannot pull (441 conditions), and a block on a wider one whose mesh does not match ([the page on the benches](../testcases/bench/README.md)). "
        f"10 steps, RESI_GLOB_RELA 1e-10; medians of {len(results[0].runs)} whole processes, {machine()}.\n\n"
        "- **Difference**: of the force through the contact, from the first formulation's. Discrete formulations face the geometry with which each step begins, "
        "the mixed one that of the mesh (REAC_GEOM='SANS'), 2e-4 apart here.\n"
        "- **Peer**: what Code_Aster 17.3 was measured to take on scenes of these kinds with one thread on a machine like this one. "
        "Its scenes are not these very ones.\n"
        "- **Ratio**: how many times comma's processor time that is, which counts all threads and suffers less from other work on the machine than elapsed time.\n"
        f"- {SHARED}\n\n"
    )
    text += COLUMNS + " peer (s) | ratio |\n" + RULE + "---|---|\n"
    for timed in results:
        peer = PEER.get(timed.label.split(",")[0]) if timed.scene.block[0] == 20 else None
        ratio = " | |" if peer is None or timed.runs[0].status else f" {peer:.0f} | {peer / timed.processor:.0f} |"
        text += _row(timed, results) + ratio + "\n"
    return text


def _large_page(bare: Measurement, results: list[TimedRuns]) -> str:
    factorising = bare.phases.get("factorising", math.nan)
    text = (
        "# Contact: a large scene\n\nWritten by `./comma bench large`. A block of 71 x 71 x 7 HEXA8 with 5,184 slave nodes, on a wider one of 61 x 61 x 6 whose mesh "
        f"does not match, 10 steps, RESI_GLOB_RELA 1e-10; whole processes, {machine()}.\n\nWithout contact, the same bodies take {bare.wall:.1f} s ({bare.processor:.1f} s of "
        f"the processor) and {bare.memory / 1e6:.0f} MB, one factorisation {factorising:.1f} s of it. *Times*: the processor time over that of this whole run. {SHARED}\n\n"
    )
    text += COLUMNS + " times |\n" + RULE + "---|\n"
    for timed in results:
        text += _row(timed, results) + f" {timed.processor / bare.processor:.1f} |\n"
    return text


if __name__ == "__main__":
    print(write_mesh(TimedScene(sys.argv[1], (int(sys.argv[2]), int(sys.argv[3])), (int(sys.argv[4]), int(sys.argv[5])), float(sys.argv[6])),
                     Path(sys.argv[7])))
