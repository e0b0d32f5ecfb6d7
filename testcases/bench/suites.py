"""What `comma bench` can run: suites of benches, each with its own module. A further suite is a further line of the table."""
from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import block
import contact
import contact_times
import statics

sys.path.append(str(Path(__file__).resolve().parent.parent / "stability"))
import stability  # noqa: E402


@dataclass(frozen=True)
class Suite:
    """A name that stands for all its benches; `run(options, benches)` runs some of them and writes what they gave."""

    name: str
    benches: tuple[str, ...]
    run: Callable[[argparse.Namespace, list[str]], None]
    by_default: bool


SUITES = (
    Suite("statics", tuple(statics.names()), statics.run, by_default=True),
    Suite("contact", tuple(contact.names()), contact.run, by_default=False),
    Suite("contact_times", tuple(contact_times.names()), contact_times.run, by_default=False),
    Suite("stability", tuple(stability.names()), stability.run, by_default=False),
    Suite("block", ("block",), block.run, by_default=False),
)


def names() -> list[str]:
    """All that may be asked for: suites, and single benches."""
    return list(dict.fromkeys(name for suite in SUITES for name in (suite.name, *suite.benches)))


def run(options: argparse.Namespace) -> None:
    """Runs what the options name; nothing named: the suites that run by default."""
    for suite in SUITES:
        whole = suite.name in options.names or (not options.names and suite.by_default)
        chosen = [bench for bench in suite.benches if whole or bench in options.names]
        if chosen:
            suite.run(options, chosen)
