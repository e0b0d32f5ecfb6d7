#!/usr/bin/env python3
"""The entry: ./comma bench [NAME...] [--quick] [--output DIR]. README.md says what there is."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

import suites

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="comma bench", description="Measures error against time and memory.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"a suite or one of its benches (statics): {', '.join(suites.names())}")
    parser.add_argument("--quick", action="store_true", help="fewer and coarser meshes: under a minute")
    parser.add_argument("--output", type=Path, default=Path("bench"), metavar="DIR", help="where results go (./bench)")
    parser.add_argument("--publish", action="store_true", help="put the report and some charts into docs/ as well")
    parser.add_argument("--comma", type=Path, default=ROOT / "build/bin/comma", help="the program that is measured")
    parser.add_argument("--sizes", help="block: cells along its short edge, such as 10,20,40")
    parser.add_argument("--repeat", type=int, default=1, help="block: runs of each size; the fastest counts")
    parser.add_argument("--no-peer", action="store_true", help="block: leave CalculiX out")
    parser.add_argument("--families", default="", help="only these families, such as QUAD4,HEXA8")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    unknown = [name for name in options.names if name not in suites.names()]
    if unknown:
        print(f"comma bench: no bench is called {', '.join(unknown)}; there are {', '.join(suites.names())}", file=sys.stderr)
        return 2
    if not options.comma.exists():
        print(f"comma bench: {options.comma} does not exist; build it, or start this by ./comma bench", file=sys.stderr)
        return 2
    options.comma = options.comma.resolve()
    options.output.mkdir(parents=True, exist_ok=True)
    options.output = options.output.resolve()
    suites.run(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
