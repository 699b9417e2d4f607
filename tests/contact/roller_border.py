"""A rigid roller on a free slab that ends where the roller ends, and one on facets as large as the contact, and a block
beside whose edge the vertices of a coarse face stand: contact updates converge.

python3 roller_border.py scenes writes the scenes; python3 roller_border.py judges the runs that roller_border.sh has
made.
"""
import sys

from summaries import load, say

ROLLER = """problem: roller
bodies:
  - slab: {{lower: [-{long}, 0, -2], upper: [{long}, {wide}, 0], cells: {cells}, young: 1000, poisson: {poisson}}}
  - roller: {{shape: tube_arc, axis: y, center: [0, 0, 1.003], radii: [0.8, 1], angles: [110, 250], extent: [0, {wide}],
             cells: [1, {facets}, 1], material: rigid}}
load_steps: {steps}
{symmetry}
displacements:
  - ground: {{face: slab.zmin, value: [0, 0, 0]}}
  - press: {{body: roller, value: [0, 0, {down}], ramp: down}}
  - slide: {{body: roller, value: [1.4, 0, 0], ramp: along}}
ramps:
  - down: {{factors: {downs}}}
  - along: {{factors: {alongs}}}
contact:
  - touch: {{mortar: roller.outer, nonmortar: slab.zmax, gap: {gap}}}
"""
BESIDE = """problem: beside
bodies:
  - slab: {lower: [-0.75, -0.75, 0], upper: [0.75, 0.75, 0.733], cells: [4, 2, 3], young: 1, poisson: 0, element: full}
  - block: {lower: [-0.512, -0.5366, 0.733], upper: [0.561, 0.5366, 1.414], cells: [3, 3, 2], young: 5.8, poisson: 0.45,
            element: bbar}
displacements:
  - ground: {face: slab.zmin, value: [0, 0, 0]}
  - press: {face: block.zmax, value: [0.01, 0, -0.035]}
contact:
  - touch: {mortar: block.zmin, nonmortar: slab.zmax, gap: node, friction: 0.5}
"""
PRESS = dict(long=5, wide=2, facets=20, steps=2, downs=[0.5, 1], alongs=[0, 0], symmetry="")
SLIDE = dict(long=3.985, wide=1.328, facets=15, steps=6, down=-0.18, downs=[0.5, 1, 1, 1, 1, 1],
             alongs=[0, 0, 0.25, 0.5, 0.75, 1], symmetry="symmetry: [slab.ymin, slab.ymax]")
SCENES = {
    "flush_mortar": ROLLER.format(cells=[11, 4, 2], down=-0.335, poisson=0, gap="mortar", **PRESS),
    "flush_dual": ROLLER.format(cells=[11, 4, 2], down=-0.335, poisson=0.3, gap="dual", **PRESS),
    "flush_node": ROLLER.format(cells=[14, 4, 2], down=-0.25, poisson=0.3, gap="node",
                                **PRESS), "large_facets": ROLLER.format(cells=[12, 2, 4], poisson=0, gap="mortar",
                                                                        **SLIDE), "beside": BESIDE
}

if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for name in SCENES:
        run = load(name)
        damped = sum(step["gap_damped"] for step in run["steps"])
        most = max(step["contact_updates"] for step in run["steps"])
        say(f"{name}: contact updates converge", run["converged"] and damped == 0 and most <= 10,
            (run["reason"], damped, most))
