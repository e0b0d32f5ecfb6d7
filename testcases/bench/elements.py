"""The cell types of the benches: how each cuts the cell of a grid, and where its nodes and faces lie.

Places inside a cell of the grid are triples (or pairs) of integers from 0 to 4, so that corners, middles of edges, centres of
faces and the quarter points that pyramids need are all exact. Order of nodes: Code_Aster's (R3.01.01).
"""
from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations

Place = tuple[int, ...]

EDGES: dict[str, tuple[tuple[int, int], ...]] = {
    "SEG": ((0, 1),),
    "TRIA": ((0, 1), (1, 2), (2, 0)),
    "QUAD": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "TETRA": ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
    "PYRAM": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "PENTA": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (5, 3)),
    "HEXA": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)),
}

# Corners of each face, so that its normal points outwards; for edges of plane cells, so that the body lies on the left.
FACES: dict[str, tuple[tuple[int, ...], ...]] = {
    "TRIA": EDGES["TRIA"],
    "QUAD": EDGES["QUAD"],
    "TETRA": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "PYRAM": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "PENTA": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "HEXA": ((0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)),
}

# Groups of corners whose centre is a node of the richest cell of each shape, in the order of the nodes.
CENTRES: dict[str, tuple[tuple[int, ...], ...]] = {
    "QUAD9": ((0, 1, 2, 3),),
    "PENTA18": ((0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "HEXA27": (*FACES["HEXA"], tuple(range(8))),
}

_CUBE: tuple[Place, ...] = (
    (0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4),
)


def _tetrahedra() -> tuple[tuple[Place, ...], ...]:
    """Six tetrahedra about the diagonal of the cube, one for each way to walk along its edges (Kuhn's triangulation)."""
    cells = []
    for first, second, third in permutations(range(3)):
        corners = [(0, 0, 0)]
        for axis in (first, second, third):
            corners.append(tuple(4 if i == axis else value for i, value in enumerate(corners[-1])))
        if (first, second, third) not in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):  # an odd walk: turn the cell right side out
            corners[1], corners[2] = corners[2], corners[1]
        cells.append(tuple(corners))
    return tuple(cells)


def _pyramids() -> tuple[tuple[Place, ...], ...]:
    """Six pyramids on the faces of the cube, with their tops in its centre."""
    return tuple((*(_CUBE[corner] for corner in reversed(face)), (2, 2, 2)) for face in FACES["HEXA"])


# How the cell of a grid is cut into cells of each shape.
CUTS: dict[str, tuple[tuple[Place, ...], ...]] = {
    "SEG": (((0,), (4,)),),
    "TRIA": (((0, 0), (4, 0), (4, 4)), ((0, 0), (4, 4), (0, 4))),
    "QUAD": (((0, 0), (4, 0), (4, 4), (0, 4)),),
    "TETRA": _tetrahedra(),
    "PYRAM": _pyramids(),
    "PENTA": (
        ((0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 0, 4), (4, 0, 4), (4, 4, 4)),
        ((0, 0, 0), (4, 4, 0), (0, 4, 0), (0, 0, 4), (4, 4, 4), (0, 4, 4)),
    ),
    "HEXA": (_CUBE,),
}


@dataclass(frozen=True)
class Family:
    """A cell type: its shape, the order p of its polynomials, the cell types of its faces by their number of corners."""

    name: str
    shape: str
    dimension: int
    order: int
    faces: dict[int, str]


def _family(name: str, dimension: int, order: int, *faces: str) -> tuple[str, Family]:
    corners = {"SEG": 2, "TRIA": 3, "QUAD": 4}
    by_corners = {corners[face.rstrip("0123456789")]: face for face in faces}
    return name, Family(name, name.rstrip("0123456789"), dimension, order, by_corners)


FAMILIES: dict[str, Family] = dict(
    (
        _family("SEG2", 1, 1),
        _family("TRIA3", 2, 1, "SEG2"),
        _family("TRIA6", 2, 2, "SEG3"),
        _family("QUAD4", 2, 1, "SEG2"),
        _family("QUAD8", 2, 2, "SEG3"),
        _family("QUAD9", 2, 2, "SEG3"),
        _family("TETRA4", 3, 1, "TRIA3"),
        _family("TETRA10", 3, 2, "TRIA6"),
        _family("PYRAM5", 3, 1, "TRIA3", "QUAD4"),
        _family("PYRAM13", 3, 2, "TRIA6", "QUAD8"),
        _family("PENTA6", 3, 1, "TRIA3", "QUAD4"),
        _family("PENTA15", 3, 2, "TRIA6", "QUAD8"),
        _family("PENTA18", 3, 2, "TRIA6", "QUAD9"),
        _family("HEXA8", 3, 1, "QUAD4"),
        _family("HEXA20", 3, 2, "QUAD8"),
        _family("HEXA27", 3, 2, "QUAD9"),
    )
)

_LINEAR = {"SEG2", "TRIA3", "QUAD4", "TETRA4", "PYRAM5", "PENTA6", "HEXA8"}


def _middle(places: list[Place]) -> Place:
    return tuple(sum(values) // len(places) for values in zip(*places))


def cell_places(cell_type: str, corners: list[Place]) -> list[Place]:
    """The places of all nodes of a cell, from those of its corners."""
    if cell_type in _LINEAR:
        return corners
    shape = cell_type.rstrip("0123456789")
    places = corners + [_middle([corners[i], corners[j]]) for i, j in EDGES[shape]]
    return places + [_middle([corners[i] for i in group]) for group in CENTRES.get(cell_type, ())]
