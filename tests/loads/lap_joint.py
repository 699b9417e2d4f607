"""Scenes of lap_joint.sh, and what must hold of their results."""
import sys

from summaries import each, load, say, within

PRETENSION, COEFFICIENT = 20000.0, 0.2


def scene(plates, ends, shank, steps, pull):
    """plates, ends, shank: cells of the plates, of head and nut, and of the bolt between them"""
    return f"""units: mm, N, MPa
materials:
  - steel: {{young: 210000, poisson: 0.3}}
bodies:
  - lower: {{material: steel, shape: holed_box, axis: z, lower: [-60, -20, -8], upper: [20, 20, 0], radius: 7,
             cells: {plates}}}
  - upper: {{material: steel, shape: holed_box, axis: z, lower: [-20, -20, 0], upper: [60, 20, 8], radius: 7,
             cells: {plates}}}
  - head: {{material: steel, shape: cylinder, axis: z, radius: 10, extent: [8, 14], cells: {ends}}}
  - nut: {{material: steel, shape: cylinder, axis: z, radius: 10, extent: [-14, -8], cells: {ends}}}
  - shank: {{material: steel, shape: cylinder, axis: z, radius: 6, extent: [-8, 8], cells: {shank}}}
displacements:
  - wall: {{face: lower.xmin, value: [0, 0, 0]}}
  - pull: {{face: upper.xmax, value: [0.2, 0, 0], ramp: pull}}
ties:
  - t1: {{mortar: head.lmin, nonmortar: shank.lmax}}
  - t2: {{mortar: nut.lmax, nonmortar: shank.lmin}}
bolts:
  - b: {{body: shank, point: [0, 0, 0.5], axis: [0, 0, 1], force: {PRETENSION:g}, ramp: tighten}}
contact:
  - lap: {{mortar: lower.zmax, nonmortar: upper.zmin, friction: {COEFFICIENT}}}
  - h: {{mortar: upper.zmax, nonmortar: head.lmin, friction: {COEFFICIENT}}}
  - n: {{mortar: lower.zmin, nonmortar: nut.lmax, friction: {COEFFICIENT}}}
load: {{steps: {steps}}}
ramps:
  - tighten: {{factors: {[1] * steps}}}
  - pull: {{factors: {pull}}}
"""


def write():
    with open("slip.yaml", "w") as file:
        file.write(scene([3, 2, 2], [3, 2, 2], [2, 2, 4], 2, [0, 1]))
    # too large for a factorization of the whole matrix in each system, which no contact makes singular
    with open("tight.yaml", "w") as file:
        file.write(scene([5, 3, 3], [4, 3, 3], [3, 2, 8], 1, [0]))
    # the cold start ends so near the solution that Newton's first step says nothing about the size of the problem
    with open("smooth.yaml", "w") as file:
        file.write(scene([3, 2, 2], [3, 2, 2], [2, 2, 4], 1, [0]).replace(f"friction: {COEFFICIENT}", "friction: 0.1"))


def judge():
    for name, most in ("slip_1", 32), ("tight_1", 32), ("smooth_1", 24):
        run = load(name)
        forces = [bolts[0]["force"] for bolts in each(run, "bolts")]
        tightens = each(run, "ip_iterations")[0]
        say(f"{name}: the bolt has its force", all(within(force, PRETENSION, 1e-7) for force in forces), forces)
        say(f"{name}: few iterations tighten it", tightens <= most, tightens)
        if name == "slip_1":
            pull, _, lift = run["steps"][1]["faces"][1]["reaction"]
            slip = COEFFICIENT * (2 * PRETENSION - lift)  # of the head or the nut, and between the plates
            say(f"{name}: the joint slips", within(pull, slip, 1e-3), (pull, slip))


if sys.argv[1] == "write":
    write()
else:
    judge()
