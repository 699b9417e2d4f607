"""compression.py scenes: writes the scenes of compression.sh; check: reads their summaries"""
import sys

from summaries import load, say, within

HEIGHT, STEPS = 0.56, 4
BLOCKS = {
    "bbar": (0.3, "element: bbar"),
    "full": (0.3, "element: full"),
    "auto_0.45": (0.45, "element: auto"),
    "auto_0.49": (0.49, "element: auto"),
}
SCENE = """bodies:
  - block: {{lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], material: neohookean, young: 3, poisson: {poisson},
             order: 2, {element}}}
  - plate: {{shape: rigid_plane, point: [0, 0, 1], normal: [0, 0, -1]}}
symmetry: [block.xmin, block.ymin, block.zmin]
displacements: [press: {{body: plate, value: [0, 0, {move}]}}]
contact: [lid: {{mortar: plate.surface, nonmortar: block.zmax}}]
load: {{steps: {steps}}}
"""


def scenes():
    for name, (poisson, element) in BLOCKS.items():
        with open(name + ".yaml", "w") as file:
            file.write(SCENE.format(poisson=poisson, element=element, move=HEIGHT - 1, steps=STEPS))


def exact(height, poisson):
    """Force on a unit cross-section. The width of the block minimizes its energy."""
    mu, kappa, step = 3 / 2 / (1 + poisson), 1 / (1 - 2 * poisson), 1e-6

    def energy(height, width):
        volume = height * width**2
        return mu / 2 * (volume**(-2 / 3) * (height**2 + 2 * width**2) - 3) + kappa / 2 * (volume - 1)**2

    low, high = 0.5, 3.0
    for _ in range(60):
        width = (low + high) / 2
        if energy(height, width + step) > energy(height, width - step):
            high = width
        else:
            low = width
    return (energy(height - step, width) - energy(height + step, width)) / (2 * step)


def check():
    for name, (poisson, _) in BLOCKS.items():
        steps = load(name)["steps"]
        seen = [step["pairs"][0]["normal_force"] for step in steps]
        forces = [exact(1 - (1 - HEIGHT) * (k + 1) / STEPS, poisson) for k in range(STEPS)]
        say(f"{name}: forces of a uniform strain",
            len(seen) == STEPS and all(within(a, b, 1e-5) for a, b in zip(seen, forces)), (seen, forces))


if __name__ == "__main__":
    {"scenes": scenes, "check": check}[sys.argv[1]]()
