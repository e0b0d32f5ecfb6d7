#!/usr/bin/env python3
"""A test: formulations of contact reach the closed solutions, and what goes to an extreme is not wrong without a word.
Use: check_contact.py COMMA"""
from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import suites  # noqa: F401  (it puts the folder of the stability maps on the path)
from contact import Runner, run_scene
from contact_scenes import scenes
from maps import maps
from stability import Outcome, run_map

# What the coarsest two meshes leave of the resultant: by docs/bench_contact.md less than half of it.
BOUNDS = {"hertz_plane": 0.015, "patch_2d": 0.01, "support": 1e-3, "sliding": 1e-3, "mindlin": 0.05, "gap_bar": 1e-3}

# Of these maps every third value.
MAPS = ("penalty", "friction_penalty", "cells", "blocked", "bounds", "floating")


def complaints_of_scenes(comma: Path, folder: Path) -> list[str]:
    found = []
    runner = Runner(comma, folder)
    for name, bound in BOUNDS.items():
        for run in run_scene(runner, scenes()[name], quick=True):
            error = run.measured.errors.get("resultant")
            if error is None:
                found.append(f"{name} {run.label} {run.size}: exit {run.measured.status}: {run.measured.said}")
            elif error > bound:
                found.append(f"{name} {run.label} {run.size}: the resultant is wrong by {error:.1e}, more than {bound:.1e}")
    return found


def complaints_of_maps(comma: Path, folder: Path) -> list[str]:
    found = []
    for name in MAPS:
        cells = run_map(comma, maps()[name], folder, quick=True)
        found += [f"{name} {cell.series} {cell.value}: wrong without a word" for cell in cells if cell.outcome is Outcome.WRONG]
    return found


def main() -> int:
    comma = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        found = complaints_of_scenes(comma, Path(folder) / "scenes") + complaints_of_maps(comma, Path(folder) / "maps")
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
