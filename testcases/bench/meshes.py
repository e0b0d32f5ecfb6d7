"""Structured meshes: a grid of cells, a family of elements, a map from the unit square or cube to the body; text in Code_Aster's
own mesh format (.mail)."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

from elements import CUTS, FACES, FAMILIES, Place, cell_places

Point = tuple[float, ...]
Chooses = Callable[[Point], bool]  # of a place in the unit square or cube


@dataclass(frozen=True)
class Grid:
    """What is meshed: `counts` cells along each axis of the unit square or cube, which `shape` maps to the body.

    `sides` names groups of boundary cells, `points` groups of nodes, both by where they lie in the unit square or cube;
    coordinates 0, 1/2 and 1 are exact there.
    """

    counts: tuple[int, ...]
    shape: Callable[[Point], Point]
    sides: dict[str, Chooses] = field(default_factory=dict)
    points: dict[str, Chooses] = field(default_factory=dict)
    parts: dict[str, Chooses] = field(default_factory=dict)  # groups of body cells, by their centre


@dataclass
class Mesh:
    """Nodes from 0 in the order of `coordinates`; cells by type, from 0 in the order of all types."""

    coordinates: list[Point]
    cells: dict[str, list[list[int]]]
    cell_groups: dict[str, list[int]]
    node_groups: dict[str, list[int]]


def on(axis: int, value: float) -> Chooses:
    """Chooses the places whose coordinate along an axis has a value."""
    return lambda place: place[axis] == value


def at(*values: float) -> Chooses:
    """Chooses one place."""
    return lambda place: place == values


class _Builder:
    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        self.numbers: dict[Place, int] = {}
        self.units: list[Point] = []

    def unit(self, place: Place) -> Point:
        return tuple(value / (4 * count) for value, count in zip(place, self.grid.counts))

    def node(self, place: Place) -> int:
        number = self.numbers.get(place)
        if number is None:
            number = self.numbers[place] = len(self.units)
            self.units.append(self.unit(place))
        return number

    def nodes(self, cell_type: str, corners: list[Place]) -> list[int]:
        return [self.node(place) for place in cell_places(cell_type, corners)]

    def all_on(self, chooses: Chooses, corners: list[Place]) -> bool:
        return all(chooses(self.unit(place)) for place in corners)


def build_mesh(grid: Grid, family_name: str) -> Mesh:
    """Meshes the grid by cells of a family. All body cells form the group BODY, all nodes the group ALL."""
    family = FAMILIES[family_name]
    builder = _Builder(grid)
    body: list[list[int]] = []
    parts: dict[str, list[int]] = {name: [] for name in grid.parts}
    faces: list[tuple[str, str, list[int]]] = []
    for origin in product(*(range(0, 4 * count, 4) for count in reversed(grid.counts))):
        for cut in CUTS[family.shape]:
            corners = [tuple(a + b for a, b in zip(reversed(origin), place)) for place in cut]
            centre = builder.unit(tuple(a + 2 for a in reversed(origin)))
            for name, chooses in grid.parts.items():
                if chooses(centre):
                    parts[name].append(len(body))
            body.append(builder.nodes(family_name, corners))
            faces += _faces_of(builder, family_name, corners)
    cells = {family_name: body}
    groups: dict[str, list[int]] = {"BODY": list(range(len(body))), **parts}
    _append_faces(cells, groups, faces, tuple(family.faces.values()))
    points = {
        name: [number for number, unit in enumerate(builder.units) if chooses(unit)] for name, chooses in grid.points.items()
    }
    points["ALL"] = list(range(len(builder.units)))
    return Mesh([grid.shape(unit) for unit in builder.units], cells, groups, points)


def _faces_of(builder: _Builder, family_name: str, corners: list[Place]) -> list[tuple[str, str, list[int]]]:
    """The faces of a cell that lie on a side: (side, cell type, nodes)."""
    found = []
    family = FAMILIES[family_name]
    for face in FACES.get(family.shape, ()):
        face_corners = [corners[i] for i in face]
        for side, chooses in builder.grid.sides.items():
            if builder.all_on(chooses, face_corners):
                face_type = family.faces[len(face)]
                found.append((side, face_type, builder.nodes(face_type, face_corners)))
    return found


def _append_faces(
    cells: dict[str, list[list[int]]],
    groups: dict[str, list[int]],
    faces: list[tuple[str, str, list[int]]],
    face_types: tuple[str, ...],
) -> None:
    number = sum(len(of_type) for of_type in cells.values())
    for face_type in face_types:
        for side, its_type, nodes in faces:
            if its_type == face_type:
                cells.setdefault(face_type, []).append(nodes)
                groups.setdefault(side, []).append(number)
                number += 1


def merged(bodies: list[tuple[str, Mesh]]) -> Mesh:
    """Several bodies as one mesh, which share no node. A body's prefix goes in front of the names of its groups."""
    types = list(dict.fromkeys(cell_type for _, body in bodies for cell_type in body.cells))
    whole = Mesh([], {cell_type: [] for cell_type in types}, {}, {})
    numbers: list[dict[tuple[str, int], int]] = [{} for _ in bodies]
    first_nodes = [sum(len(before.coordinates) for _, before in bodies[:k]) for k in range(len(bodies))]
    count = 0
    for cell_type in types:
        for (_, body), first, its in zip(bodies, first_nodes, numbers):
            for i, nodes in enumerate(body.cells.get(cell_type, [])):
                whole.cells[cell_type].append([first + node for node in nodes])
                its[cell_type, i] = count
                count += 1
    for (prefix, body), first, its in zip(bodies, first_nodes, numbers):
        own = [its[cell_type, i] for cell_type, cells in body.cells.items() for i in range(len(cells))]
        for name, members in body.cell_groups.items():
            whole.cell_groups.setdefault(prefix + name, []).extend(own[member] for member in members)
        for name, members in body.node_groups.items():
            whole.node_groups.setdefault(prefix + name, []).extend(first + member for member in members)
        whole.coordinates += body.coordinates
    return whole


def write_mail(mesh: Mesh, path: Path, title: str) -> None:
    """Writes the mesh in Code_Aster's format (U3.01.00)."""
    with path.open("w", encoding="ascii") as out:
        out.write(f"TITRE\n{title}\nFINSF\nCOOR_{max(2, len(mesh.coordinates[0]))}D\n")
        for number, point in enumerate(mesh.coordinates, 1):
            out.write(f"N{number} " + " ".join(repr(value) for value in point) + "\n")
        out.write("FINSF\n")
        number = 0
        for cell_type, of_type in mesh.cells.items():
            out.write(f"{cell_type}\n")
            for nodes in of_type:
                number += 1
                out.write(f"M{number} " + _lines([f"N{node + 1}" for node in nodes]) + "\n")
            out.write("FINSF\n")
        for keyword, letter, groups in (("GROUP_MA", "M", mesh.cell_groups), ("GROUP_NO", "N", mesh.node_groups)):
            for name, members in groups.items():
                out.write(f"{keyword}\n{name}\n" + _lines([f"{letter}{member + 1}" for member in members]) + "\nFINSF\n")
        out.write("FIN\n")


def _lines(words: list[str]) -> str:
    return "\n".join(" ".join(words[start : start + 8]) for start in range(0, len(words), 8))
