"""Pages of docs/ made of the reports that benches write."""
from __future__ import annotations

import re
import shutil
from collections.abc import Collection
from pathlib import Path

from run import HERE


def publish(report: Path, page: str, charts: Collection[str]) -> None:
    """Makes docs/`page` of a report, with those of its charts that are named, in docs/bench/; the others are left out."""
    docs = HERE.parent.parent / "docs"
    (docs / "bench").mkdir(exist_ok=True)
    lines = []
    for line in report.read_text(encoding="utf-8").splitlines():
        chart = re.fullmatch(r"!\[(.*)\]\((.*)\.svg\)", line)
        if chart and chart[2] not in charts:
            continue
        if chart:
            shutil.copy(report.parent / f"{chart[2]}.svg", docs / "bench")
            line = f"![{chart[1]}](bench/{chart[2]}.svg)"
        lines.append(line)
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(lines))
    (docs / page).write_text(text + "\n", encoding="utf-8")
