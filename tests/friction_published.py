"""Scenes with friction whose answers are published or closed, on two meshes each.

python3 friction_published.py scenes writes them; python3 friction_published.py judges the runs that friction_published.sh has made.

GRECO: a plate pressed onto a rigid ground and pushed from the side, tangential displacements of five points of its base (M. Raous, P. Chabrand, F. Lebon, Numerical methods for
frictional contact problems and applications, J. Theor. Appl. Mech. 7, 1988, and the benchmarks that took it up; codes scatter by 5 %).
Torque: a shaft shrunk into a hub and turned, both held by their other faces: Lame's pressure for plane strain, and friction x pressure x 2 pi r^2 L.
Lift: a block that is pushed until half of its base lifts off, on a base that sticks, or has a coefficient so large that it does.
"""
import json
import math
import sys

PUBLISHED = {0: 28.6, 1.25: 27.2, 5: 22.8, 7.5: 19.8, 11.25: 15.0}  # place along the base [mm]: displacement [1e-3 mm]
YOUNG, POISSON, INTERFERENCE, FRICTION, LENGTH = 200000, 0.3, 0.02, 0.12, 2
BORE, FIT, RIM = 15.0, 25.0, 40.0


def greco(cells):
    probes = "".join(f"  - at{x * 100:.0f}: {{point: [{x}, 0, 0], body: plate}}\n" for x in PUBLISHED)
    return f"""problem: greco
bodies:
  - ground: {{lower: [-10, 0, -10], upper: [45, 1, 0], cells: [1, 1, 1], material: rigid}}
  - plate: {{lower: [0, 0, 0], upper: [40, 1, 40], cells: [{cells}, 1, {cells}], young: 130000, poisson: 0.2}}
displacements:
  - fix: {{body: ground, value: [0, 0, 0]}}
pressures:
  - top: {{face: plate.zmax, value: 50}}
  - side: {{face: plate.xmin, value: 150}}
symmetry: [plate.xmax, plate.ymin, plate.ymax]
contact:
  - base: {{mortar: ground.zmax, nonmortar: plate.zmin, friction: 1}}
probes:
{probes}"""


def half(name, inner, outer, start, cells):
    return f"  - {name}: {{shape: tube_arc, axis: z, radii: [{inner}, {outer}], angles: [{start}, {start + 180}], extent: [0, {LENGTH}], cells: [{cells // 7}, {cells}, 1], young: {YOUNG}, poisson: {POISSON}}}\n"


def torque(outside, inside):
    turn = "rotation: [0, 0, 0.03], center: [0, 0, 0], ramp: turn"
    return f"""problem: torque
bodies:
{half("hub", FIT, RIM, 0, outside)}{half("hub2", FIT, RIM, 180, outside)}{half("shaft", BORE, FIT + INTERFERENCE, 0, inside)}{half("shaft2", BORE, FIT + INTERFERENCE, 180, inside)}displacements:
  - hold: {{face: hub.outer, value: [0, 0, 0]}}
  - hold2: {{face: hub2.outer, value: [0, 0, 0]}}
  - turn: {{face: shaft.inner, value: [0, 0, 0], {turn}}}
  - turn2: {{face: shaft2.inner, value: [0, 0, 0], {turn}}}
symmetry: [hub.lmin, hub.lmax, shaft.lmin, shaft.lmax, hub2.lmin, hub2.lmax, shaft2.lmin, shaft2.lmax]
ties:
  - a: {{mortar: hub.amax, nonmortar: hub2.amin}}
  - b: {{mortar: hub.amin, nonmortar: hub2.amax}}
  - c: {{mortar: shaft.amax, nonmortar: shaft2.amin}}
  - d: {{mortar: shaft.amin, nonmortar: shaft2.amax}}
contact:
  - fit: {{mortar: hub.inner, nonmortar: shaft.outer, friction: {FRICTION}, interference: true}}
  - fit2: {{mortar: hub2.inner, nonmortar: shaft2.outer, friction: {FRICTION}, interference: true}}
load: {{steps: 3}}
ramps:
  - turn: {{factors: [0, 0.1, 1]}}
"""


def lift(law):
    return f"""problem: lift
bodies:
  - ground: {{lower: [-0.5, -0.5, -0.5], upper: [2.5, 1.5, 0], cells: [6, 4, 2], young: 1e5, poisson: 0.3}}
  - block: {{lower: [0, 0, 0], upper: [2, 1, 2], cells: [5, 3, 5], young: 1e5, poisson: 0.3}}
displacements:
  - fix: {{face: ground.zmin, value: [0, 0, 0]}}
pressures:
  - press: {{face: block.zmax, value: 300}}
forces:
  - push: {{face: block.zmax, value: [250, 0, 0], ramp: across}}
contact:
  - joint: {{mortar: ground.zmax, nonmortar: block.zmin, {law}}}
load: {{factors: [1, 1, 1]}}
ramps:
  - across: {{factors: [0, 0.5, 1]}}
"""


SCENES = {
    "greco_32": greco(32),
    "greco_64": greco(64),
    "torque_42": torque(28, 21),
    "torque_84": torque(56, 42),
    "lift_rough": lift("stick: true"),
    "lift_100": lift("friction: 100"),
}


def verdict(what, value, limit):
    print(f"{what}: below {limit:g}" if value <= limit else f"{what}: {value:.3g} is above {limit:g}")


def load(name):
    with open(name + ".json") as file:
        return json.load(file)


def tube(bound):
    """Displacement at the fit of a tube held at radius `bound`, under a pressure of 1 on the fit, plane strain: u = A (r - bound^2 / r)"""
    shear = YOUNG / 2 / (1 + POISSON)
    lame = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    return -(FIT - bound**2 / FIT) / 2 / (lame + shear + shear * bound**2 / FIT**2)


def judge_greco():
    for name in "greco_32", "greco_64":
        probes = load(name)["steps"][-1]["probes"]
        found = [1e3 * probe["displacement"][0] for probe in probes]
        verdict(f"{name}, displacements of the base off the published ones", max(abs(u / p - 1) for u, p in zip(found, PUBLISHED.values())), 0.05)
        verdict(f"{name}, the first four of them", max(abs(u / p - 1) for u, p in list(zip(found, PUBLISHED.values()))[:4]), 0.01)


def judge_torque():
    pressure = INTERFERENCE / (tube(RIM) - tube(BORE))
    for name, limit in ("torque_42", 4e-3), ("torque_84", 1e-3):
        pairs = load(name)["steps"][-1]["pairs"]
        torque, normal = FIT * sum(pair["shear_force"] for pair in pairs), sum(pair["normal_force"] for pair in pairs)
        verdict(f"{name}, pressure off Lame's", abs(normal / (2 * math.pi * FIT * LENGTH) / pressure - 1), limit)
        verdict(f"{name}, torque off its closed form", abs(torque / (FRICTION * pressure * 2 * math.pi * FIT**2 * LENGTH) - 1), limit)


def judge_ranks():
    one, three = (load(name)["steps"][-1]["pairs"] for name in ("torque_42", "torque_42_3"))
    verdict("torque_42, 3 ranks against 1", max(abs(a["shear_force"] / b["shear_force"] - 1) for a, b in zip(one, three)), 1e-6)


def judge_lift():
    rough, large = load("lift_rough")["steps"], load("lift_100")["steps"]
    for name, steps in ("lift_rough", rough), ("lift_100", large):
        pair = steps[-1]["pairs"][0]
        print(f"{name}:", "converged" if all(step["converged"] for step in steps) else "not converged", "cuts %d" % sum(step["cuts"] for step in steps), "slip area %g" % pair["slip_area"])
        verdict(f"{name}, part of the base in contact", pair["area"] / 2, 0.5)
        verdict(f"{name}, force off the push", abs(abs(pair["force"][0]) / 250 - 1), 1e-6)
    verdict("lift, sticking against a coefficient of 100", abs(rough[-1]["pairs"][0]["shear_force"] / large[-1]["pairs"][0]["shear_force"] - 1), 1e-6)


if len(sys.argv) > 1 and sys.argv[1] == "scenes":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    judge_greco()
    judge_torque()
    judge_ranks()
    judge_lift()
