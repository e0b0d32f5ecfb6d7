"""The suite of contact: each formulation on scenes with a closed solution, error against time."""
from __future__ import annotations

import argparse
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

import contact_report
from contact_scenes import ContactScene, nodes_of, scenes
from meshes import write_mail
from run import Measurement, run_comma

TIMEOUT = 300.0  # s, for one run


@dataclass
class ContactRun:
    """One formulation on one mesh of a scene."""

    scene: ContactScene
    formulation: str
    family: str
    size: int
    measured: Measurement

    @property
    def label(self) -> str:
        """The formulation, with the cells where a scene has more than one family of them."""
        return self.formulation if len(self.scene.series) == 1 else f"{self.formulation}, {self.family}"


class Runner:
    """Runs scenes in one folder. A mesh is made once for all formulations."""

    def __init__(self, comma: Path, folder: Path) -> None:
        self.comma, self.folder = comma, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.meshes: dict[tuple[str, str, int], tuple[Path, int, int, int]] = {}

    def mesh(self, scene: ContactScene, family: str, size: int) -> tuple[Path, int, int, int]:
        """The mesh file, its displacements, its slave nodes and its slave faces."""
        key = (scene.name, family, size)
        if key not in self.meshes:
            mesh = scene.mesh(family, size)
            path = self.folder / f"{scene.name}_{family}_{size}.mail"
            write_mail(mesh, path, f"{scene.name} {family} {size}")
            unknowns = len(mesh.coordinates[0]) * len(mesh.coordinates)
            self.meshes[key] = (path, unknowns, len(nodes_of(mesh, "SLAVE")), len(mesh.cell_groups["SLAVE"]))
        return self.meshes[key]

    def run(self, scene: ContactScene, formulation, family: str, size: int) -> ContactRun:
        path, unknowns, slave_nodes, faces = self.mesh(scene, family, size)
        slave_nodes += formulation.new_slave_nodes(faces, in_space=family.startswith("HEXA"))
        shutil.copy(path, self.folder / "case.mail")
        case = scene.case(formulation, family, size, slave_nodes)
        return ContactRun(scene, formulation.name, family, size, run_comma(self.comma, case, unknowns, self.folder, TIMEOUT))


def tell(run: ContactRun) -> None:
    measured = run.measured
    errors = "  ".join(f"{name} {error:.1e}" for name, error in measured.errors.items())
    said = f"  exit {measured.status}: {measured.said[:100]}" if measured.said else ""
    print(f"{run.scene.name:12} {run.label:30} {run.size:4d} {measured.unknowns:8d} unknowns {measured.seconds:7.2f} s  {errors}{said}", flush=True)


def run_scene(runner: Runner, scene: ContactScene, quick: bool) -> list[ContactRun]:
    runs = []
    for formulation, family, size in scene.runs(quick):
        runs.append(runner.run(scene, formulation, family, size))
        tell(runs[-1])
    return runs


def names() -> list[str]:
    return list(scenes())


def run(options: argparse.Namespace, chosen: list[str]) -> None:
    """Runs the scenes of these names; writes contact.md, contact.csv and a chart for each scene."""
    start = time.perf_counter()
    runner = Runner(options.comma, options.output / "work")
    results = [run_scene(runner, scene, options.quick) for name, scene in scenes().items() if name in chosen]
    shutil.rmtree(runner.folder)
    contact_report.write(results, options.output, time.perf_counter() - start, options.quick)
    if options.publish:
        contact_report.publish(options.output)
