"""Charts as SVG and PNG, drawn by gnuplot."""
from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

from limits import Limit
from run import Measurement
from scenes import Scene

# One colour a shape, one mark a number of nodes, so that TETRA4 and TETRA10 are told apart and yet go together.
COLOURS = {"TRIA": "#1b9e77", "QUAD": "#d95f02", "TETRA": "#1b9e77", "PYRAM": "#e7298a", "PENTA": "#7570b3", "HEXA": "#d95f02"}
MARKS = {"TRIA3": 6, "TRIA6": 7, "QUAD4": 4, "QUAD8": 5, "QUAD9": 9, "TETRA4": 6, "TETRA10": 7, "PYRAM5": 12, "PYRAM13": 13,
         "PENTA6": 8, "PENTA15": 9, "PENTA18": 11, "HEXA8": 4, "HEXA20": 5, "HEXA27": 15}
SOLVER_COLOURS = {"MUMPS": "#1b9e77", "MULT_FRONT": "#d95f02", "LDLT": "#7570b3", "GCPC/LDLT_INC": "#e7298a"}
LEAST = 1e-17  # an error of zero has no place on a logarithmic axis
OTHERS = ("#1b9e77", "#d95f02", "#7570b3", "#e7298a", "#66a61e", "#a6761d")

NAMES = {"energy": "energy norm", "displacement": "displacement", "stress": "stress at the rim", "deflection": "deflection",
         "centre": "displacement of the centre", "elongation": "elongation"}


def series_of(runs: list[Measurement], by_solver: bool) -> dict[str, list[Measurement]]:
    """Runs by label, in the order of the first of each."""
    found: dict[str, list[Measurement]] = {}
    for run in runs:
        label = f"{run.case.label} {run.case.solver}" if by_solver else run.case.label
        found.setdefault(label, []).append(run)
    return found


def _style(run: Measurement, by_solver: bool) -> str:
    family = run.case.family
    colour = SOLVER_COLOURS[run.case.solver] if by_solver else COLOURS[family.rstrip("0123456789")]
    dash = 2 if run.case.modelisation.endswith("_SI") else 1
    return f"with linespoints lc rgb '{colour}' lw 1.4 dt {dash} pt {MARKS[family]} ps 0.8"


def draw_scene(scene: Scene, runs: list[Measurement], folder: Path) -> None:
    """Rows of panels, one a quantity: error against the size of the cells, time and memory."""
    good = [run for run in runs if run.errors]
    if not good:
        return
    by_solver = len(scene.solvers) > 1
    series = series_of(good, by_solver)
    quantities = list(good[0].errors)[: 1 if by_solver else None]  # solvers differ in time and memory, not in error
    blocks, lines = [], []
    for number, (label, its) in enumerate(series.items()):
        rows = [
            f"{1.0 / run.case.size!r} {run.seconds!r} {run.memory / 1e6!r} " + " ".join(repr(run.errors[q] or LEAST) for q in quantities)
            for run in its
        ]
        blocks.append(f"$D{number} << END\n" + "\n".join(rows) + "\nEND\n")
        lines.append((label, _style(its[0], by_solver)))
    ranges = ([1.0 / run.case.size for run in good], [run.seconds for run in good], [run.memory / 1e6 for run in good])
    panels = []
    for row, quantity in enumerate(quantities):
        for column, what in enumerate(("size of the cells, as part of the edge", "time (s)", "peak memory (MB)")):
            key = row == 0 and column == 2
            panels.append(_axis(what, ranges[column], column == 0))
            panels.append(_panel(row, column, len(quantities), NAMES.get(quantity, quantity), lines, key))
    _gnuplot(folder / scene.name, 1500, 100 + 380 * len(quantities), scene.title, "".join(blocks), "".join(panels))


def _ticks(values: list[float], as_part: bool) -> str:
    """Labels at the values themselves: 1/8 for the size of cells; else at 1, 2 and 5 of each decade within their range."""
    if as_part:
        return ", ".join(f"'1/{round(1.0 / value)}' {value!r}" for value in sorted(set(values)))
    low, high = min(values), max(values)
    steps = [factor * 10.0**power for power in range(-3, 7) for factor in (1, 2, 5)]
    shown = [step for step in steps if 0.8 * low <= step <= 1.25 * high]
    if len(shown) > 8:
        shown = [step for step in shown if f"{step:e}"[0] == "1"]
    return ", ".join(f"'{step:g}' {step!r}" for step in shown)


def _panel(row: int, column: int, rows: int, quantity: str, lines: list[tuple[str, str]], key: bool) -> str:
    left = 0.06 + 0.285 * column
    bottom = 1.0 - (0.06 + (row + 1) * 0.94 / rows) + 0.20 / rows
    top = 1.0 - (0.06 + row * 0.94 / rows) - 0.02 / rows
    text = f"set lmargin at screen {left}; set rmargin at screen {left + 0.23}\n"
    text += f"set bmargin at screen {bottom}; set tmargin at screen {top}\n"
    text += f"set ylabel 'relative error: {quantity}'\n"
    text += "set key at screen 0.995, screen 0.93 right top vertical Left reverse samplen 2 spacing 1.2\n" if key else "unset key\n"
    text += "plot " + ", ".join(
        f"$D{number} using {column + 1}:{row + 4} {style} title '{label.replace('_', chr(92) + '_')}'"
        for number, (label, style) in enumerate(lines)
    )
    return text + "\n"


def _axis(what: str, values: list[float], as_part: bool) -> str:
    return (f"set xlabel '{what}'; set xrange [{0.8 * min(values)!r}:{1.25 * max(values)!r}]\n"
            f"unset xtics; set xtics ({_ticks(values, as_part)})\n")


def draw_limit(limit: Limit, rows: list[tuple[str, float, Measurement]], folder: Path) -> None:
    """The error against the parameter; a run that ended with an error message is a cross near the upper edge."""
    labels = list(dict.fromkeys(label for label, _, _ in rows))
    alike = len({run.case.family for _, _, run in rows}) == 1
    blocks, plots, refused = [], [], []
    for number, label in enumerate(labels):
        its = [(value, run) for name, value, run in rows if name == label]
        good = [f"{value!r} {max(run.errors[limit.quantity], LEAST)!r}" for value, run in its if run.errors]
        bad = [f"{value!r} {10.0 * 0.4**number!r}" for value, run in its if not run.errors]
        blocks.append(f"$D{number} << END\n" + "\n".join(good) + f"\nEND\n$F{number} << END\n" + "\n".join(bad) + "\nEND\n")
        colour = OTHERS[number % len(OTHERS)]
        mark = 4 + number if alike else MARKS[its[0][1].case.family]
        style = f"lc rgb '{colour}' lw 1.4 dt {1 + number // len(OTHERS)} pt {mark} ps 0.8"
        title = label.replace("_", "\\_")
        if good:
            plots.append(f"$D{number} using 1:2 with linespoints {style} title '{title}'")
        if bad:
            refused.append(f"$F{number} using 1:2 with points lc rgb '{colour}' pt 2 ps 1.2 notitle")
    if refused:
        refused.append("NaN with points lc rgb '#000000' pt 2 ps 1.2 title 'x: an error message'")
    panel = "set lmargin at screen 0.09; set rmargin at screen 0.76; set bmargin at screen 0.12; set tmargin at screen 0.91\n"
    panel += f"set xlabel '{limit.axis}'; set ylabel 'relative error: {NAMES.get(limit.quantity, limit.quantity)}'\n"
    panel += "set yrange [*:30]\nset key at screen 0.99, screen 0.91 right top Left reverse samplen 2 spacing 1.2\n"
    _gnuplot(folder / limit.name, 1100, 560, limit.title, "".join(blocks), panel + "plot " + ", ".join(plots + refused) + "\n")


def draw_block(runs: list, folder: Path) -> None:
    """Time by phase and memory against the number of unknowns, a column for each family."""
    good = [run for run in runs if run.status == 0]
    if not good:
        return
    families = list(dict.fromkeys(run.family for run in good))
    names = list(dict.fromkeys(name for run in good for name in run.phases))
    axis = _axis("unknowns", [float(run.unknowns) for run in good], False)
    blocks, panels = [], []
    for column, family in enumerate(families):
        rows = [
            " ".join(str(value) for value in (run.unknowns, run.wall, run.memory / 1e6, run.peer_wall or "NaN",
                                              (run.peer_memory or float("nan")) / 1e6, *(run.phases.get(name) or "NaN" for name in names)))
            for run in good if run.family == family
        ]
        blocks.append(f"$B{column} << END\n" + "\n".join(rows) + "\nEND\n")
        left = 0.07 + 0.40 * column
        place = f"set lmargin at screen {left}; set rmargin at screen {left + 0.33}\n"
        key = "set key at screen 0.995, screen 0.93 right top Left reverse samplen 2 spacing 1.2\n" if column == 0 else "unset key\n"
        times = [f"$B{column} using 1:2 with linespoints lw 2 lc rgb '#000000' pt 7 title 'comma, whole'",
                 f"$B{column} using 1:4 with linespoints lw 2 dt 2 lc rgb '#000000' pt 6 title 'CalculiX, whole'"]
        times += [f"$B{column} using 1:{6 + i} with linespoints lc rgb '{OTHERS[i % len(OTHERS)]}' pt {5 + i} title '{name}'"
                  for i, name in enumerate(names)]
        panels.append(f"{axis}{place}{key}set label 1 '{family}' at screen {left + 0.15}, screen 0.94\nset tmargin at screen 0.92; "
                      f"set bmargin at screen 0.55; set ylabel 'time (s)'\nplot {', '.join(times)}\n")
        memory = [f"$B{column} using 1:3 with linespoints lw 2 lc rgb '#000000' pt 7 notitle",
                  f"$B{column} using 1:5 with linespoints lw 2 dt 2 lc rgb '#000000' pt 6 notitle"]
        panels.append(f"unset label 1\nset tmargin at screen 0.45; set bmargin at screen 0.08; set ylabel 'peak memory (MB)'\n"
                      f"plot {', '.join(memory)}\n")
    _gnuplot(folder / "block", 1300, 800, "The elastic block", "".join(blocks), "".join(panels))


def _gnuplot(path: Path, width: int, height: int, title: str, data: str, panels: str) -> None:
    gnuplot = shutil.which("gnuplot")
    if gnuplot is None:
        print("comma bench: gnuplot is not there (Debian package gnuplot-nox), so there are no charts", file=sys.stderr)
        return
    common = "set logscale xy; set format xy '10^{%L}'; set grid lc rgb '#dddddd' lt 1\nset tics scale 0.6\n"
    script = data
    for terminal, suffix in ((f"svg size {width},{height} font 'Helvetica,13' background '#ffffff'", "svg"),
                             (f"pngcairo size {width},{height} font 'Sans,10' background '#ffffff'", "png")):
        script += f"reset\nset terminal {terminal}\nset output '{path.name}.{suffix}'\n{common}"
        script += f"set multiplot title '{title.replace(chr(39), chr(39) * 2)}' font ',16'\n{panels}unset multiplot\nunset output\n"
    done = subprocess.run([gnuplot], input=script, cwd=path.parent, capture_output=True, text=True)
    if done.returncode != 0 or "error" in done.stderr.lower():
        print(f"comma bench: gnuplot could not draw {path.name}: {done.stderr[-300:]}", file=sys.stderr)


def draw_contact(name: str, title: str, series: dict[str, list], quantities: list[str], folder: Path) -> None:
    """A panel for each quantity: error against time, a line for each formulation. `series`: runs by label."""
    blocks, styles = [], []
    times: list[float] = []
    for number, (label, runs) in enumerate(series.items()):
        good = [run.measured for run in runs if run.measured.errors]
        if not good:
            continue
        times += [run.seconds for run in good]
        rows = [f"{run.seconds!r} " + " ".join(repr(max(run.errors.get(q, 0.0), LEAST)) for q in quantities) for run in good]
        blocks.append(f"$D{number} << END\n" + "\n".join(rows) + "\nEND\n")
        colour = OTHERS[number % len(OTHERS)]
        styles.append((number, label.replace("_", "\\_"), f"with linespoints lc rgb '{colour}' lw 1.4 dt {1 + number // len(OTHERS)} pt {4 + number} ps 0.8"))
    if not times:
        return
    panels = []
    width = 0.80 / len(quantities)
    for column, quantity in enumerate(quantities):
        left = 0.06 + width * column
        panels.append(_axis("time (s)", times, False))
        panels.append(f"set lmargin at screen {left}; set rmargin at screen {left + width - 0.055}\n"
                      "set bmargin at screen 0.13; set tmargin at screen 0.90\n"
                      f"set ylabel 'relative error: {quantity}'; set yrange [*:*]\n")
        panels.append("set key at screen 0.995, screen 0.90 right top vertical Left reverse samplen 2 spacing 1.2\n" if column == 0 else "unset key\n")
        panels.append("plot " + ", ".join(f"$D{number} using 1:{column + 2} {style} title '{label}'" for number, label, style in styles) + "\n")
    _gnuplot(folder / name, 1500, 480, title, "".join(blocks), "".join(panels))


def draw_map(name: str, title: str, axis: str, cells: list[tuple[str, str, str, int]], colours: dict[str, str], folder: Path) -> None:
    """A coloured box for each (series, value), with its iterations. `colours`: by outcome."""
    series = list(dict.fromkeys(cell[0] for cell in cells))
    values = list(dict.fromkeys(cell[1] for cell in cells))
    rows = [f"{values.index(value)} {len(series) - 1 - series.index(row)} {int(colours[outcome][1:], 16)} {count}"
            for row, value, outcome, count in cells]
    data = "$D << END\n" + "\n".join(rows) + "\nEND\n"
    panel = "unset logscale; set format xy '%g'; unset grid; set style fill solid 1.0 border rgb '#ffffff'; set boxwidth 1\n"
    panel += "set xtics rotate by 30 right\nset xtics (" + ", ".join(f"'{value}' {i}" for i, value in enumerate(values)) + ")\n"
    panel += "set ytics (" + ", ".join(f"'{label.replace('_', chr(92) + '_')}' {len(series) - 1 - i}" for i, label in enumerate(series)) + ")\n"
    panel += f"set xrange [-0.5:{len(values) - 0.5}]; set yrange [-0.5:{len(series) - 0.5}]; set xlabel '{axis}'\n"
    height = 200 + 34 * len(series)
    top = 1.0 - 52 / height  # below the title
    panel += f"set lmargin at screen 0.27; set rmargin at screen 0.86; set tmargin at screen {top}\n"
    panel += f"set key at screen 0.995, screen {top} right top Left reverse samplen 1 spacing 1.3\n"
    keys = [f"NaN with boxes lc rgb '{colour}' title '{outcome}'" for outcome, colour in colours.items()]
    boxes = "$D using 1:2:(0.48):(0.46):3 with boxxyerrorbars lc rgb variable notitle, $D using 1:2:4 with labels font ',9' notitle"
    _gnuplot(folder / name, 1100, height, title, data, panel + "plot " + ", ".join([boxes, *keys]) + "\n")
