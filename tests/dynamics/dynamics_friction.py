"""dynamics_friction.py scenes: writes the scenes of dynamics_friction.sh; check: reads their summaries"""
import sys

from summaries import load, say, within

FRICTION, SPEED = 0.3, (2.0, -1.0)  # along the floor, and towards it
MATERIAL = {
    "rigid": "material: rigid",
    "elastic": "young: 1000, poisson: 0.3",
}
GUIDE = {"rigid": "  - guide: {body: block, value: [free, 0, free]}\n", "elastic": ""}

SCENE = """bodies:
  - block: {{lower: [0, 0, 0.01], upper: [1, 1, 1.01], cells: [2, 2, 2], {material}, density: 1,
             initial_velocity: [{speed[0]}, 0, {speed[1]}]}}
  - floor: {{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}}
displacements:
  - hold: {{body: floor, value: [0, 0, 0]}}
{guide}contact:
  - touch: {{mortar: floor.surface, nonmortar: block.zmin, friction: {friction}}}
dynamics: {{time_step: {step}, end_time: 0.2}}
"""


def scenes():
    for name, material in MATERIAL.items():
        with open(name + ".yaml", "w") as file:
            file.write(
                SCENE.format(material=material, speed=SPEED, guide=GUIDE[name], friction=FRICTION,
                             step=0.005 if name == "rigid" else 0.002))


def check():
    for name in MATERIAL:
        steps = load(name)["steps"]
        dissipated = [step["pairs"][0]["dissipated"] for step in steps]
        say(f"{name} block: the work of friction does not decrease",
            all(b >= a - 1e-12 for a, b in zip(dissipated, dissipated[1:])), dissipated)
        say(f"{name} block: work of all contacts is that of friction and of normal forces",
            all(within(step["dissipated"] + step["normal_work"], step["contact_work"], 1e-12) for step in steps),
            [(step["dissipated"], step["normal_work"], step["contact_work"]) for step in steps])
    steps = load("rigid")["steps"]
    before, after = SPEED[0], steps[-1]["motions"][0]["momentum"][0]
    say("rigid block: friction takes the kinetic energy of the motion along the floor",
        within(steps[-1]["dissipated"], (before**2 - after**2) / 2, 1e-6), (steps[-1]["dissipated"], before, after))
    say("rigid block: the impulse of friction is the coefficient times that of the normal force",
        within(before - after, FRICTION * (steps[-1]["motions"][0]["momentum"][2] - SPEED[1]), 1e-6),
        steps[-1]["motions"])


if __name__ == "__main__":
    {"scenes": scenes, "check": check}[sys.argv[1]]()
