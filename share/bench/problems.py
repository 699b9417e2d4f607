"""The problems of the bench and their meshes."""
import os
import re
import sys
from dataclasses import dataclass

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# what the tests hold Hertz's contacts against is what the bench holds them against
sys.path.insert(0, os.path.join(TOP, "share", "scenes"))
import hertz_solution  # noqa: E402
from meshes import MESHES, edited  # noqa: E402


@dataclass(frozen=True)
class Level:
    """A mesh: edits of the scene's text, pattern and replacement, and uniform refinements of what results"""

    name: str
    refine: int
    edits: tuple = ()


# The contact problem of small displacements: the gap is linearized once, about the state without load. The scene names
# no element
SMALL = ((r"steps: 2", "steps: 1"), (r"^ *element: full\n", ""))


class Problem:
    """A scene of share/scenes"""

    def __init__(self, name, levels, title=None):
        self.name = name
        self.title = title or name.replace("_", " ")
        self.levels = {level.name: level for level in levels}

    def scene(self, level, body=()):
        """The text of the scene on a mesh; body: keys and values that every body gets"""
        text = edited(self.name, self.levels[level].edits)
        for key, value in body:
            text = re.sub(rf"^ *{key}:.*\n", "", text, flags=re.M)
            text = re.sub(r"^( *)(poisson:.*)$", rf"\1\2\n\1{key}: {value}", text, flags=re.M)
        return text


class Hertz(Problem):

    def __init__(self, name, solution, title):
        super().__init__(name, [Level(mesh, 0, edits) for mesh, edits in MESHES[name].items()] + [Level("0", 0)], title)
        self.solution = solution


def two_block_level(factor):
    """The two-block mesh, every box with `factor` times as many cells along each axis as the scene has: by refinement
    where that makes so many, as the published meshes are made (the AMG coarsens by the numbering, and needs fewer
    applications on them)"""
    if factor & (factor - 1) == 0:
        return Level(str(factor), factor.bit_length() - 1, SMALL)
    cells = ((r"cells: \[%d, %d, %d\]" % count, "cells: [%d, %d, %d]" % tuple(factor * n
                                                                              for n in count))
             for count in ((20, 6, 3), (4, 4, 4)))
    return Level(str(factor), 0, (*cells, *SMALL))


# The block's foot
FOOT = (-3.5, -2.5, -0.5, 0.5, -1.5)


def two_block_zones(levels, wide=1, width=0.15):
    """Local refinement of two_block: `wide` levels about the block's foot, and `levels` more at the edges of the foot,
    each within half the distance of the one before"""
    zones = [f"  - foot: {{lower: [-4.2, -1.2, -2.4], upper: [-1.8, 1.2, -1.2], levels: {wide}}}"]
    x0, x1, y0, y1, z = FOOT
    for level in range(1, levels + 1):
        w = width / 2**(level - 1)
        for name, (a, b, c, d) in {
                "left": (x0, x0, y0, y1), "right": (x1, x1, y0, y1), "front": (x0, x1, y0, y0), "back": (x0, x1, y1, y1)
        }.items():
            zones.append(f"  - {name}_{level}: "
                         f"{{lower: [{a - w:g}, {c - w:g}, {z - w:g}], upper: [{b + w:g}, {d + w:g}, {z + w:g}], "
                         f"levels: {level + wide}}}")
    return "refinements:\n" + "\n".join(zones) + "\n"


PROBLEMS = {
    problem.name: problem
    for problem in (
        Hertz("hertz_sphere", hertz_solution.Sphere(), "Hertz sphere"),
        Hertz("hertz_cylinder", hertz_solution.Cylinder(), "Hertz cylinder"),
        Problem("two_block", [two_block_level(factor) for factor in (1, 2, 3, 4)], "two-block, one linearization"),
        Problem("cantilever", [Level("0", 0), Level("1", 1), Level("2", 2)]),
    )
}
