"""gap_cycle.py write N: a ring of hexahedra, N around, as a Gmsh file, and a scene that presses it between two plates;
judge: what the runs of gap_cycle.sh say."""
import functools
import math
import re
import sys

from summaries import load, say

ACROSS, INNER, OUTER, PUSH = 3, 4.0, 10.0, 4.0  # cells, radii, how far the upper plate moves

SCENE = f"""bodies:
  - ring: {{mesh: ring.msh, volume: ring, material: neohookean, young: 1000, poisson: 0.3}}
  - lower: {{lower: [-15, 0, -2], upper: [15, 1, 0], cells: [30, 1, 2], young: 1000, poisson: 0.3}}
  - upper: {{lower: [-15, 0, {2 * OUTER}], upper: [15, 1, {2 * OUTER + 2}], cells: [30, 1, 2], young: 1000,
            poisson: 0.3}}
faces:
  - foot: {{of: ring.inner, lower: [-1.5, -inf, -inf], upper: [1.5, inf, {OUTER}]}}
  - head: {{of: ring.inner, lower: [-1.5, -inf, {OUTER}], upper: [1.5, inf, inf]}}
displacements:
  - foot: {{face: ring.foot, value: [0, free, free]}}
  - head: {{face: ring.head, value: [0, free, free]}}
  - bottom: {{face: lower.zmin, value: [0, 0, 0]}}
  - top: {{face: upper.zmax, value: [0, 0, {-PUSH}]}}
symmetry: [lower.ymin, lower.ymax, upper.ymin, upper.ymax, front: {{face: ring.front, normal: y}},
    back: {{face: ring.back, normal: y}}]
contact:
  - below: {{mortar: lower.zmax, nonmortar: ring.outer}}
  - above: {{mortar: upper.zmin, nonmortar: ring.outer}}
"""


def node(around, y, r, a):
    return 1 + (y * (ACROSS + 1) + r) * around + a % around


def cells(around):
    """Physical name -> its cells, quadrangles from outside"""
    found = {name: [] for name in ("outer", "inner", "front", "back", "ring")}
    at = functools.partial(node, around)
    for r in range(ACROSS):
        for a in range(around):
            front, back = ([at(y, r, a), at(y, r + 1, a), at(y, r + 1, a + 1), at(y, r, a + 1)] for y in (0, 1))
            found["ring"].append(back + front)
            found["front"].append(front)
            found["back"].append(back)
            for name, layer in (("inner", 0), ("outer", ACROSS)):
                if layer in (r, r + 1) and layer - r == (name == "outer"):
                    found[name].append([at(0, layer, a), at(0, layer, a + 1), at(1, layer, a + 1), at(1, layer, a)])
    return found


def write(around):
    groups = cells(around)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(groups)]
    lines += [f'{3 if name == "ring" else 2} {tag} "{name}"'
              for tag, name in enumerate(groups, 1)] + ["$EndPhysicalNames", "$Nodes", 2 * (ACROSS + 1) * around]
    for y in range(2):
        for r in range(ACROSS + 1):
            for a in range(around):
                radius, angle = INNER + (OUTER - INNER) * r / ACROSS, 2 * math.pi * (a + 0.5) / around
                lines.append(f"{node(around, y, r, a)} {radius * math.cos(angle):.17g} {y} "
                             f"{OUTER + radius * math.sin(angle):.17g}")
    lines += ["$EndNodes", "$Elements", sum(map(len, groups.values()))]
    elements = ((tag, cell) for tag, name in enumerate(groups, 1) for cell in groups[name])
    lines += [
        f"{number} {5 if len(cell) == 8 else 3} 2 {tag} {tag} {' '.join(map(str, cell))}"
        for number, (tag, cell) in enumerate(elements, 1)
    ]
    with open("ring.msh", "w") as file:
        print(*lines, "$EndElements", sep="\n", file=file)
    with open("ring.yaml", "w") as file:
        file.write(SCENE)


def sideways(step):
    return abs(step["reaction"][0]) + abs(step["contact_force"][0])


def warnings(run):
    """Without those of a face of few facets, which this ring has"""
    return [
        text for text in run["warnings"]
        if "penetrates the other body" not in text and "times as large as those of the mortar face" not in text
    ]


def judge():
    runs = {name: load(name) for name in ("smooth", "facets", "corner", "circle", "single")}
    last = {name: run["steps"][-1] for name, run in runs.items()}
    smooth, facets = last["smooth"], last["facets"]
    say("between smooth faces the gap is true after 12 linearizations at most", runs["smooth"]["converged"]
        and smooth["gap_change"] <= 1e-6 * PUSH and smooth["contact_updates"] <= 12, smooth)
    say("none is damped", smooth["gap_damped"] == 0 and not warnings(runs["smooth"]), runs["smooth"]["warnings"])
    say("smooth, no force to the side",
        sideways(smooth) < 1e-6 * abs(smooth["reaction"][2]), (smooth["reaction"], smooth["contact_force"]))
    say(
        "between facets the updates end with a true gap", runs["facets"]["converged"] and not facets["gap_unconverged"]
        and facets["gap_change"] <= 1e-5 * PUSH and facets["gap_true"] > -1e-5 * PUSH, facets["gap_change"])
    size = abs(facets["reaction"][2])
    say("no force to the side", size > 1 and sideways(facets) < 1e-6 * size,
        (facets["reaction"], facets["contact_force"]))
    corner = last["corner"]
    say(
        "a corner first, the updates end with a true gap", runs["corner"]["converged"] and not corner["gap_unconverged"]
        and corner["gap_damped"] == 0 and sideways(corner) < 1e-5 * abs(corner["reaction"][2]), corner)
    say("updates are damped, and the reason says what helps",
        last["circle"]["gap_damped"] > 0 and "use smaller load steps" in runs["circle"]["reason"],
        (last["circle"]["gap_damped"], runs["circle"]["reason"]))
    say("a gap that is not true is no convergence", not runs["circle"]["converged"]
        and last["circle"]["gap_unconverged"] and last["circle"]["gap_change"] > 1e-4, runs["circle"]["reason"])
    say(
        "the sentence names pair, vertex and face",
        re.search(r'contact pair "(below|above)", .*vertex \(\S+, [01]\.?, \S+\) .* face ring.outer',
                  runs["circle"]["reason"]) is not None, runs["circle"]["reason"])
    say("updates in a circle end before the limit", last["circle"]["contact_updates"] < 20,
        last["circle"]["contact_updates"])
    say("one linearization converges, its gap is not true", runs["single"]["converged"]
        and last["single"]["gap_unconverged"] and last["single"]["gap_change"] > 1e-2, runs["single"]["reason"])


if __name__ == "__main__":
    {"write": lambda: write(int(sys.argv[2])), "judge": judge}[sys.argv[1]]()
