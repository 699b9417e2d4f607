"""compression.py scenes: writes the scenes of compression.sh; check: reads their summaries"""
import sys

from neo_hookean import uniaxial
from summaries import load, say, within

HEIGHT, STEPS, YOUNG = 0.56, 4, 3
BLOCKS = {
    "bbar": (0.3, "element: bbar"),
    "full": (0.3, "element: full"),
    "auto_0.45": (0.45, "element: auto"),
    "auto_0.49": (0.49, "element: auto"),
}
SCENE = """bodies:
  - block: {{lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], material: neohookean, young: {young},
             poisson: {poisson}, order: 2, {element}}}
  - plate: {{shape: rigid_plane, point: [0, 0, 1], normal: [0, 0, -1]}}
symmetry: [block.xmin, block.ymin, block.zmin]
displacements: [press: {{body: plate, value: [0, 0, {move}]}}]
contact: [lid: {{mortar: plate.surface, nonmortar: block.zmax}}]
load: {{steps: {steps}}}
"""


def scenes():
    for name, (poisson, element) in BLOCKS.items():
        with open(name + ".yaml", "w") as file:
            file.write(SCENE.format(young=YOUNG, poisson=poisson, element=element, move=HEIGHT - 1, steps=STEPS))


def check():
    for name, (poisson, _) in BLOCKS.items():
        steps = load(name)["steps"]
        seen = [step["pairs"][0]["normal_force"] for step in steps]
        forces = [uniaxial(1 - (1 - HEIGHT) * (k + 1) / STEPS, YOUNG, poisson)[1] for k in range(STEPS)]
        say(f"{name}: forces of a uniform strain",
            len(seen) == STEPS and all(within(a, b, 1e-5) for a, b in zip(seen, forces)), (seen, forces))


if __name__ == "__main__":
    {"scenes": scenes, "check": check}[sys.argv[1]]()
