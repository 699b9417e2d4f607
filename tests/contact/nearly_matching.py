"""nearly_matching.py scenes: writes the scenes of nearly_matching.sh; check: reads their summaries"""
import itertools
import sys

from summaries import load, say

SHIFTS = ["0", "1e-5", "1e-4", "1e-3"]
PRESSED = {4: 0.2, 6: 0.15}  # cells along the edge of an octant, and approach

BALLS = """bodies:
  - low: {{shape: ball, octant: [1, 1, 1], radius: 1, patches: [{n}, {n}, {n}], layers: 3, young: 1000, poisson: 0.3,
          density: 1}}
  - top: {{shape: ball, octant: [1, 1, -1], center: [{x}, {y}, {z}], radius: 1, patches: [{n}, {n}, {n}], layers: 3,
          young: 1000, poisson: 0.3, density: 1{more}}}
symmetry: [low.x0, low.y0, top.x0, top.y0]
contact: [touch: {{mortar: low.surface, nonmortar: top.surface}}]
displacements:
  - floor: {{face: low.z0, value: [free, free, 0]}}
"""

GASKET = """bodies:
  - low: {shape: tube_arc, axis: z, radii: [20, 40], angles: [0, 360], extent: [0, 10], cells: [4, 24, 2], young: 2.1e5,
          poisson: 0.3}
  - gasket: {shape: tube_arc, axis: z, radii: [20, 35], angles: [0, 360], extent: [10, 12], cells: [3, 24, 1],
             young: 200, poisson: 0.45}
  - up: {shape: tube_arc, axis: z, radii: [20, 40], angles: [0, 360], extent: [12, 22], cells: [4, 24, 2],
         young: 2.1e5, poisson: 0.3}
displacements: [hold: {face: low.lmin, value: [0, 0, 0]}]
pressures: [bolts: {face: up.lmax, value: 5}]
contact: [auto: {friction: 0.2}]
load: {steps: 1}
"""


def balls(n, shift, z, more=""):
    return BALLS.format(n=n, x=shift, y=0.7 * float(shift), z=z, more=more)


def pressed(n, shift):
    return balls(n, shift,
                 2) + f"  - press: {{face: top.z0, value: [free, free, -{PRESSED[n]}]}}\nload: {{steps: 10}}\n"


def collision(shift):
    return balls(4, shift, 2.02, ", initial_velocity: [0, 0, -1]") + "dynamics: {time_step: 0.01, end_time: 0.2}\n"


def scenes():
    files = {f"pressed_{n}_{shift}": pressed(n, shift) for n, shift in itertools.product(PRESSED, SHIFTS)}
    files |= {f"collision_{shift}": collision(shift) for shift in SHIFTS[::2]}
    files["gasket"] = GASKET
    for name, text in files.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)


def force(step):
    return step["pairs"][0]["force"][2] if step["pairs"] else 0.0


def check_runs(title, names, updates):
    """All runs converge in a few updates, and their forces agree"""
    runs = [load(name) for name in names]
    say(f"{title}: all load steps converge", all(run["exit_code"] == 0 for run in runs),
        [run["reason"] for run in runs])
    counts = [[step["contact_updates"] for step in run["steps"]] for run in runs]
    say(
        f"{title}: {updates} contact updates at most, none damped, no load step cut",
        all(max(count) <= updates for count in counts)
        and not any(step["cuts"] + step["gap_damped"] for run in runs for step in run["steps"]), counts)
    forces = [[force(step) for step in run["steps"]] for run in runs]
    say(
        f"{title}: forces within 1 %",
        all(
            len(f) == len(forces[0]) and max(abs(a - b)
                                             for a, b in zip(f, forces[0])) < 0.01 * max(forces[0])
            for f in forces), forces)


def check():
    for n in PRESSED:
        check_runs(f"{n} cells", [f"pressed_{n}_{shift}" for shift in SHIFTS], 6)
    check_runs("gasket that slides radially", ["gasket"], 6)
    check_runs("collision", [f"collision_{shift}" for shift in SHIFTS[::2]], 6)


if __name__ == "__main__":
    {"scenes": scenes, "check": check}[sys.argv[1]]()
