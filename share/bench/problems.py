"""The problems of the bench: their meshes, what is measured on them, and the answers they are held against."""
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
    unknowns: int  # about
    edits: tuple = ()


# As published, and as the runs of the other configurations are measured: the gap is not linearized again
SINGLE = ((r"^load:", "contact_updates: 1\nload:"), )
# The contact problem of small displacements: the gap is linearized once, about the state without load. The scene names
# no element
SMALL = ((r"steps: 2", "steps: 1"), (r"^ *element: full\n", ""))


def last(summary):
    return summary["steps"][-1]


def force(summary):
    return sum(f**2 for f in last(summary)["contact_force"])**0.5


class Problem:
    """A scene of share/scenes, whose reference is extrapolated from its meshes"""

    quantities = ("energy", "contact force")
    fields = False  # whether a run must write its fields to be measured

    def __init__(self, name, levels, title=None):
        self.name = name
        self.title = title or name.replace("_", " ")
        self.levels = {level.name: level for level in levels}

    def scene(self, level, body=()):
        """The text of the scene on a mesh; body: keys and values that every body gets, or with friction every contact
        pair"""
        text = edited(self.name, self.levels[level].edits)
        for key, value in body:
            if key == "friction":
                text = re.sub(r"(nonmortar: [\w.]+)", rf"\1, {key}: {value}", text)
                continue
            text = re.sub(rf"^ *{key}:.*\n", "", text, flags=re.M)
            text = re.sub(r"^( *)(poisson:.*)$", rf"\1\2\n\1{key}: {value}", text, flags=re.M)
        return text

    def measure(self, base, summary):
        """What is compared with the reference; base: of the fields, where the problem asks for them"""
        return {"energy": last(summary)["energy"], "contact force": force(summary)}

    def exact(self, references):
        """None: known only once its meshes have been run"""
        return references.get(self.name)


class Cantilever(Problem):
    quantities = ("energy", )

    def measure(self, base, summary):
        return {"energy": last(summary)["energy"]}


class Hertz(Problem):
    """Peak pressure and radius (half-width) at the computed force, force and energy at the prescribed approach"""

    quantities = ("peak pressure", "contact radius", "contact force", "energy")
    fields = True

    def __init__(self, name, levels, solution, title):
        super().__init__(name, levels, title=title)
        self.solution = solution

    def measure(self, base, summary):
        errors = hertz_solution.measure(self.solution, base)["errors"]
        return {
            "peak pressure": 1 + errors["peak pressure"], "contact radius": 1 + errors["contact radius"],
            "contact force": force(summary), "energy": last(summary)["energy"]
        }

    def exact(self, references):
        whole, energy = self.solution.loaded()
        return {
            "peak pressure": 1.0, "contact radius": 1.0, "contact force": self.solution.share * whole,
            "energy": self.solution.share * energy
        }


def two_block_level(factor):
    """The two-block mesh, every box with `factor` times as many cells along each axis as the scene has: by refinement
    where that makes so many, as the published meshes are made (the AMG coarsens by the numbering, and needs fewer
    applications on them)"""
    unknowns = 3 * ((20 * factor + 1) * (6 * factor + 1) * (3 * factor + 1) + (4 * factor + 1)**3)
    if factor & (factor - 1) == 0:
        return Level(str(factor), factor.bit_length() - 1, unknowns, SMALL)
    cells = ((r"cells: \[%d, %d, %d\]" % count, "cells: [%d, %d, %d]" % tuple(factor * n
                                                                              for n in count))
             for count in ((20, 6, 3), (4, 4, 4)))
    return Level(str(factor), 0, unknowns, (*cells, *SMALL))


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
        Hertz(
            "hertz_sphere",
            [
                Level("coarse", 0, 5397, MESHES["hertz_sphere"]["coarse"]),
                Level("medium", 0, 11800, MESHES["hertz_sphere"]["medium"]),
                Level("0", 0, 29805),
                Level("1", 1, 222660),
            ],
            hertz_solution.Sphere(),
            title="Hertz sphere",
        ),
        Hertz(
            "hertz_cylinder",
            [
                Level("coarse", 0, 3456, MESHES["hertz_cylinder"]["coarse"]),
                Level("medium", 0, 6030, MESHES["hertz_cylinder"]["medium"]),
                Level("0", 0, 11058),
                Level("1", 1, 64000),
                Level("2", 2, 420000),
            ],
            hertz_solution.Cylinder(),
            title="Hertz cylinder",
        ),
        Problem("two_block", [two_block_level(factor)
                              for factor in (1, 2, 3, 4, 8)], title="two-block, one linearization"),
        Problem("beam_sphere_linear",
                [Level("0", 0, 7902, SINGLE),
                 Level("1", 1, 53547, SINGLE),
                 Level("2", 2, 392661, SINGLE)], title="beam-sphere"),
        Problem("beam_sphere_neo_hookean",
                [Level("0", 0, 7902, SINGLE), Level("1", 1, 53547, SINGLE)], title="beam-sphere, neo-Hookean"),
        Problem("ironing", [Level("1", 1, 12876, SINGLE), Level("2", 2, 89370, SINGLE)]),
        Cantilever("cantilever",
                   [Level("0", 0, 3075),
                    Level("1", 1, 19683),
                    Level("2", 2, 140000),
                    Level("3", 3, 1050000)]),
    )
}
