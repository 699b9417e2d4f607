"""pressure_finite.py scenes: writes the scenes of pressure_finite.sh; check: reads their summaries"""
import sys

from neo_hookean import uniaxial
from summaries import load, say, within

HEIGHT = 0.5  # of the compressed block, whose sides were 1
YOUNG, POISSON = 3.0, 0.45
BODIES = {
    "planes": """  - low: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - up: {shape: rigid_plane, point: [0, 0, 1], normal: [0, 0, -1]}
""", "plates": """  - low: {lower: [-1, -1, -0.1], upper: [2, 2, 0], cells: [1, 1, 1], material: rigid}
  - up: {lower: [-1, -1, 1], upper: [2, 2, 1.1], cells: [1, 1, 1], material: rigid}
"""
}
FACES = {"planes": ("low.surface", "up.surface"), "plates": ("low.zmax", "up.zmin")}

SCENE = """bodies:
  - block: {{lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: {young},
             poisson: {poisson}}}
{bodies}symmetry: [block.xmin, block.ymin]
displacements:
  - hold: {{body: low, value: [0, 0, 0]}}
  - press: {{body: up, value: [0, 0, {move}]}}
contact:
  - floor: {{mortar: {faces[0]}, nonmortar: block.zmin{gap}}}
  - lid: {{mortar: {faces[1]}, nonmortar: block.zmax{gap}}}
probes:
  - inside: {{point: [0.5, 0.5, 1], body: block}}
"""


def runs():
    yield "planes", "planes", ""
    for gap in "mortar", "node", "dual":
        yield "plates_" + gap, "plates", ", gap: " + gap


def scenes():
    for name, bodies, gap in runs():
        with open(name + ".yaml", "w") as file:
            file.write(
                SCENE.format(young=YOUNG, poisson=POISSON, bodies=BODIES[bodies], faces=FACES[bodies], gap=gap,
                             move=HEIGHT - 1))


def check():
    width, force = uniaxial(HEIGHT, YOUNG, POISSON)
    for name in [name for name, _, _ in runs()] + ["plates_mortar_2", "planes_5"]:
        step = load(name)["steps"][-1]
        for pair in step["pairs"]:
            seen = [pair[key] for key in ("normal_force", "area", "pressure")]
            say(f"{name}, {pair['name']}: force, area and pressure of the deformed block",
                all(within(a, b, 1e-5) for a, b in zip(seen, (force, width**2, force / width**2))),
                (seen, force, width**2, force / width**2))
        probe = step["probes"][0]
        say(f"{name}: pressure at a point equals the stress",
            within(probe["contact_pressure"], -probe["stress_zz"], 1e-4), probe)


if __name__ == "__main__":
    {"scenes": scenes, "check": check}[sys.argv[1]]()
