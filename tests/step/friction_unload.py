"""friction_unload.py scenes: writes the scenes of friction_unload.sh; check: reads their summaries"""
import sys

from summaries import load, say

SCENES = {
    "block": """units: mm, N, MPa
bodies:
  - rail: {lower: [-10, -10, -5], upper: [30, 10, 0], cells: [8, 4, 2], young: 210000, poisson: 0.3}
  - shoe: {lower: [0, -5, 0], upper: [10, 5, 6], cells: [4, 4, 3], young: 3000, poisson: 0.35}
displacements:
  - base: {face: rail.zmin, value: [0, 0, 0]}
  - drag: {face: shoe.zmax, value: [2, 0, free], ramp: along}
pressures:
  - press: {face: shoe.zmax, value: 5, ramp: down}
ramps:
  - down: {factors: [1, 1, 0, 1, 0]}
  - along: {factors: [0, 0.5, 0.5, 0.5, 0]}
contact:
  - pad: {mortar: rail.zmax, nonmortar: shoe.zmin, friction: 0.35}
""",
    "die": """bodies:
  - slab: {lower: [0, 0, -1], upper: [3, 3, 0], cells: [8, 8, 3], young: 1000, poisson: 0.3}
  - die: {lower: [1, 1, 0.1], upper: [2, 2, 0.6], cells: [4, 4, 2], young: 5000, poisson: 0.3}
displacements:
  - base: {face: slab.zmin, value: [0, 0, 0]}
  - move: {face: die.zmax, value: [0, 0, -1]}
load: {factors: [0.15, 0, -0.5, 0.05, 0.15]}
contact:
  - hit: {mortar: slab.zmax, nonmortar: die.zmin, friction: 0.2}
""",
    "ball": """bodies:
  - ball: {shape: ball, octant: [2, 1, -1], center: [0, 0, 10], radius: 10, patches: [8, 8, 3], grading: [4, 4, 1],
           layers: 6, layer_grading: 0.3, young: 1000, poisson: 0}
  - flat: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
symmetry: [ball.y0]
displacements:
  - fix: {body: flat, value: [0, 0, 0]}
  - press: {face: ball.z0, value: [0, 0, -0.1], ramp: press}
  - shear: {face: ball.z0, value: [0.02, 0, 0], ramp: shear}
ramps:
  - press: {factors: [1, 1, 0, 0, 1]}
  - shear: {factors: [0, 0.5, 0, 0, 0]}
contact:
  - c: {mortar: flat.surface, nonmortar: ball.surface, friction: 0.3}
""",
}
JAMMED = """bodies:
  - left: {shape: rigid_plane, point: [0, 0, 0], normal: [0.9781476007338057, 0, 0.20791169081775934]}
  - right: {shape: rigid_plane, point: [0, 0, 0], normal: [-0.9781476007338057, 0, 0.20791169081775934]}
  - key: {shape: wedge, axis: y, corners: [0, 0, 1, -0.21255656167002213, 1, 0.21255656167002213], extent: [0, 0.5],
          side_cells: 4, length_cells: 2, young: 1e4, poisson: 0.3}
displacements:
  - fl: {body: left, value: [0, 0, 0]}
  - fr: {body: right, value: [0, 0, 0]}
symmetry: [key.lmin]
forces:
  - push: {face: key.side2, value: [0, 0, -100]}
load: {factors: [0.5, 1, 0.5, 0]}
contact:
  - l: {mortar: left.surface, nonmortar: key.side1, friction: 0.4}
  - r: {mortar: right.surface, nonmortar: key.side3, friction: 0.4}
"""
UNLOADED = {"block": [2, 4], "die": [1], "ball": [2]}  # load steps, from 0, that end without load
AGAIN = {"block": 3, "die": 4, "ball": 4}  # load steps that end as the first one


def scenes():
    for name, text in (SCENES | {"key": JAMMED}).items():
        with open(name + ".yaml", "w") as file:
            file.write(text)


def normal_force(step):
    return step["pairs"][0]["normal_force"] if step["pairs"] else 0.0


def check_run(file, name):
    run = load(file)
    steps = run["steps"]
    done = run["exit_code"] == 0
    energy, force = max(step["energy"] for step in steps), max(map(normal_force, steps))
    say(f"{file}: all load steps converge", done, run["reason"])
    say(
        f"{file}: no energy and no force without load", done
        and all(steps[k]["energy"] < 1e-12 * energy and normal_force(steps[k]) < 1e-9 * force for k in UNLOADED[name]),
        [(step["energy"], normal_force(step)) for step in steps])
    say(f"{file}: the same force when pressed again", done
        and abs(normal_force(steps[AGAIN[name]]) / normal_force(steps[0]) - 1) < 5e-3,
        [normal_force(step) for step in steps])
    if name == "die":
        iterations = [step["ip_iterations"] for step in steps]
        say(f"{file}: to zero load in few iterations", max(iterations) <= 30, iterations)


if __name__ == "__main__":
    if sys.argv[1] == "scenes":
        scenes()
    else:
        for file in (*SCENES, sys.argv[2] + "_2"):
            check_run(file, file.split("_")[0])
        # without load the block may lie at an angle: of all positions without penetration it takes the nearest one
        if sys.argv[2] == "block":
            forces = [[step["pairs"][0]["force"][0] for step in load(file)["steps"]] for file in ("block", "block_2")]
            say("a body that has lost contact rests at the same place on one and on two ranks: pressed again, it has "
                "the same friction force", abs(forces[0][3] / forces[1][3] - 1) < 1e-5, forces)
        run = load("key")
        # ten load steps lead to 10.56
        say("a wedge that friction holds keeps its force without load", run["exit_code"] == 0
            and abs(normal_force(run["steps"][-1]) / 10.56 - 1) < 0.05, [normal_force(step) for step in run["steps"]])
