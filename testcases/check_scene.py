#!/usr/bin/env python3
"""A test: a scene ends well, with as many verdicts and the same kinds of alarms as it is to have, and all verdicts hold.

usage: check_scene.py COMMA SCENE.comm     run it here, and compare with scenes.txt
       check_scene.py COMMA --write        run them all, and write scenes.txt anew
"""
from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
EXPECTED = FOLDER / "scenes.txt"
HEADER = "# scene, verdicts, kinds of alarms; written by check_scene.py --write\n"


def scenes() -> list[Path]:
    """As testcases/CMakeLists.txt finds them."""
    return sorted([*FOLDER.glob("*/*.comm"), *FOLDER.glob("contact/*/*.comm")])


def name_of(scene: Path) -> str:
    return scene.resolve().relative_to(FOLDER).with_suffix("").as_posix()


def outcome(comma: str, scene: Path, folder: Path) -> tuple[str, str]:
    """The scene's line of scenes.txt, and what went wrong."""
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    run = subprocess.run([Path(comma).resolve(), "run", str(scene), "--json", str(report)], cwd=folder, capture_output=True, text=True, check=False)
    if not report.exists():
        return "", f"exit {run.returncode}, and no report\n{run.stdout}{run.stderr}"
    found = json.loads(report.read_text())
    tests = found["tests"]
    kinds = sorted({each["code"] for each in found["diagnostics"] if each["severity"] == "alarm"})
    wrong = run.returncode != 0 or not tests or "Sanitizer" in run.stderr
    return " ".join([name_of(scene), str(len(tests)), *kinds]), f"exit {run.returncode}\n{run.stdout}{run.stderr}" if wrong else ""


def write(comma: str) -> int:
    lines = []
    for scene in scenes():
        with tempfile.TemporaryDirectory() as folder:
            line, wrong = outcome(comma, scene, Path(folder))
        if wrong:
            print(f"{scene}: {wrong}", file=sys.stderr)
            return 1
        lines.append(line + "\n")
    EXPECTED.write_text(HEADER + "".join(lines))
    return 0


def check(comma: str, scene: Path) -> int:
    line, wrong = outcome(comma, scene, Path.cwd())
    if wrong:
        print(wrong)
        return 1
    expected = [each for each in EXPECTED.read_text().splitlines() if each.split(" ")[0] == name_of(scene)]
    if expected == [line]:
        return 0
    print(f"expected: {expected[0] if expected else 'no line in scenes.txt (check_scene.py COMMA --write)'}\nfound:    {line}")
    return 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(write(sys.argv[1]) if sys.argv[2] == "--write" else check(sys.argv[1], Path(sys.argv[2])))
