"""Scenes with friction whose answers are published or closed, on two meshes each.

`friction_published.py scenes` writes them. Without an argument it judges the runs of friction_published.sh, on coarse
meshes; with `long` those of friction_published_long.sh, on fine ones.

GRECO: a plate pressed onto a rigid ground and pushed from the side, tangential displacements of five points of its base
(M. Raous, P. Chabrand, F. Lebon, Numerical methods for frictional contact problems and applications, J. Theor. Appl.
Mech. 7, 1988, and the benchmarks that took it up; codes scatter by 5 %).
Torque: a shaft shrunk into a hub and turned, both held by their other faces: Lame's pressure for plane strain, and
friction x pressure x 2 pi r^2 L.
The same without friction is what its AMG applications are held against.
Capstan: a belt laid around a quarter and a half of a rigid pulley, tightened by both ends, then the pulley turns;
tensions T2 / T1 = exp(friction x angle), of a belt of a thickness by the radius that friction acts at over that of the
tension. Another belt is pulled over a pulley by one end, against a dead load at the other, and again with friction
alone to hold it sideways.
Cattaneo and Mindlin: two equal cylinders pressed together and shifted; far from each other's size, as the theory has
it: strains of the size of the half-width over the radius change it.
Roller: NAFEMS contact benchmark 1 with friction (A. Konter, Advanced finite element contact benchmarks, 2006), a
cylinder on a block in plane strain, displacement and pressure at the middle; its codes have large displacements, and so
have these scenes.
Lift: a block that is pushed until half of its base lifts off, on a base that sticks, or has a coefficient so large that
it does.
"""
import json
import math
import sys

import h5py
import numpy as np

PUBLISHED = {0: 28.6, 1.25: 27.2, 5: 22.8, 7.5: 19.8, 11.25: 15.0}  # place along the base [mm]: displacement [1e-3 mm]
YOUNG, POISSON, INTERFERENCE, FRICTION, LENGTH = 200000, 0.3, 0.02, 0.12, 2
BORE, FIT, RIM = 15.0, 25.0, 40.0
PULLEY = 50
HALF_WIDTH, WIDTH, GROWTH = 0.0025, 0.000245, 1.2


def greco(cells):
    probes = "".join(f"  - at{x * 100:.0f}: {{point: [{x}, 0, 0], body: plate}}\n" for x in PUBLISHED)
    return f"""problem: greco
bodies:
  - ground: {{lower: [-10, 0, -10], upper: [45, 1, 0], cells: [1, 1, 1], material: rigid}}
  - plate: {{lower: [0, 0, 0], upper: [40, 1, 40], cells: [{cells}, 1, {cells}], young: 130000, poisson: 0.2,
            element: full}}
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
    return (f"  - {name}: "
            f"{{shape: tube_arc, axis: z, radii: [{inner}, {outer}], angles: [{start}, {start + 180}], "
            f"extent: [0, {LENGTH}], cells: [{cells // 7}, {cells}, 1], young: {YOUNG}, poisson: {POISSON}}}\n")


def torque(outside, inside):
    turn = "rotation: [0, 0, 0.03], center: [0, 0, 0], ramp: turn"
    return f"""problem: torque
bodies:
{half("hub", FIT, RIM, 0, outside)}{half("hub2", FIT, RIM, 180, outside)}\
{half("shaft", BORE, FIT + INTERFERENCE, 0, inside)}{half("shaft2", BORE, FIT + INTERFERENCE, 180, inside)}\
displacements:
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


def pulley(angle):
    return (f"  - pulley: "
            f"{{shape: tube_arc, axis: z, radii: [40, {PULLEY}], angles: [-20, {angle + 20}], extent: [-0.5, 1.5], "
            f"cells: [1, {(angle + 40) // 5}, 1], material: rigid}}\n")


def belt(angle, cells, thickness, layers):
    return (
        f"  - belt: "
        f"{{shape: tube_arc, axis: z, radii: [{PULLEY}, {PULLEY + thickness}], angles: [0, {angle}], extent: [0, 1], "
        f"cells: [{layers}, {cells}, 1], young: 1000, poisson: 0, element: incompatible}}\n")


def capstan(angle, cells, thickness):
    tight = "[-0.1, free, free]" if angle == 90 else "[free, -0.1, free]"
    return f"""problem: capstan
bodies:
{pulley(angle)}{belt(angle, cells, thickness, 1)}displacements:
  - turn: {{body: pulley, value: [0, 0, 0], rotation: [0, 0, 0.5], center: [0, 0, 0], ramp: turn}}
  - slack: {{face: belt.amin, value: [free, -0.1, free], ramp: pull}}
  - tight: {{face: belt.amax, value: {tight}, ramp: pull}}
symmetry: [belt.lmin, belt.lmax]
contact:
  - wrap: {{mortar: pulley.outer, nonmortar: belt.inner, friction: 0.3}}
load: {{steps: 2}}
ramps:
  - pull: {{factors: [1, 1]}}
  - turn: {{factors: [0, 1]}}
"""


PULLED = f"""problem: pulled
bodies:
{pulley(180)}{belt(180, 48, 1, 2)}displacements:
  - fix: {{body: pulley, value: [0, 0, 0]}}
  - pull: {{face: belt.amax, value: [0, -0.5, free]}}
tractions:
  - weight: {{face: belt.amin, value: [0, -1, 0]}}
symmetry: [belt.lmin, belt.lmax]
contact:
  - wrap: {{mortar: pulley.outer, nonmortar: belt.inner, friction: 0.3}}
"""

HUNG = PULLED.replace(belt(180, 48, 1, 2), belt(180, 24, 1, 2)).replace("[0, -0.5, free]", "[free, -0.5, free]")


def steps_past(even, cell, length):
    """Cells that make up the length, those past so many equal ones each longer than the one before, and the longest
    over the shortest"""
    n = 1
    while cell * (even + sum(GROWTH**i for i in range(1, n + 1))) < length:
        n += 1
    return even + n, GROWTH**n


def cylinder(name, depth, center, across, deep, half="", material=""):
    (cells, longest), (ring, deepest), even = across[:2], deep[:2], across[2]
    return f"""  - {name}:
      shape: half_ellipse
      axis: y
      depth: {depth}{half}
      center: [0, 0, {center}]
      semi_axes: [{abs(center)}, {abs(center)}]
      extent: [0, {1 if half else WIDTH}]
      patches: [8, {cells}, {ring}]
      grading: [1, {longest:.6g}, {1 / deepest:.6g}]
      even: [1, {even}, 4]
      layers: 1
      {material or "young: 1000"}
      poisson: 0.3
      element: full
"""


def cattaneo(cells):
    even, cell = 5 * cells // 4, HALF_WIDTH / cells
    across, deep = (*steps_past(even, cell, math.pi / 4), even), steps_past(4, cell, 0.6)
    return f"""problem: cattaneo
bodies:
{cylinder("upper", "-z", 1, across, deep)}{cylinder("lower", "z", -1, across, deep)}faces:
  - top: {{of: upper.arc, lower: [{-2 * HALF_WIDTH}, -inf, -inf], upper: [{2 * HALF_WIDTH}, inf, 0.15]}}
  - bottom: {{of: lower.arc, lower: [{-2.5 * HALF_WIDTH}, -inf, -0.15], upper: [{2.5 * HALF_WIDTH}, inf, inf]}}
displacements:
  - fix: {{face: lower.flat, value: [0, 0, 0]}}
  - down: {{face: upper.flat, value: [free, free, -4.15e-5], ramp: down}}
  - across: {{face: upper.flat, value: [1.25e-5, free, free], ramp: across}}
symmetry: [upper.lmin, upper.lmax, lower.lmin, lower.lmax]
contact:
  - touch: {{mortar: lower.bottom, nonmortar: upper.top, friction: 0.3}}
load: {{steps: 2}}
ramps:
  - down: {{factors: [1, 1]}}
  - across: {{factors: [0, 0.8]}}
"""


def roller(cells, friction=0.1):
    even, cell = 13 * cells // 10, 6.215 / cells
    material = "young: {}\n      material: saint_venant"
    across, deep = (*steps_past(even, cell, 39.3), even), steps_past(4, cell, 30)
    (x, longest), (z, deepest) = steps_past(even, cell, 100), steps_past(4, cell, 200)
    return f"""problem: roller
bodies:
{cylinder("cylinder", "-z", 50, across, deep, half=chr(10) + "      half: x",
    material=material.format(210000))}  - block:
      lower: [0, 0, -200]
      upper: [100, 1, 0]
      cells: [{x}, 1, {z}]
      grading: [{longest:.6g}, 1, {1 / deepest:.6g}]
      even: [{even}, 1, 4]
      {material.format(70000)}
      poisson: 0.3
      element: full
faces:
  - crown: {{of: cylinder.arc, upper: [12, inf, 12]}}
displacements:
  - floor: {{face: block.zmin, value: [0, 0, 0]}}
symmetry: [cylinder.symmetry, cylinder.lmin, cylinder.lmax, block.xmin, block.ymin, block.ymax]
forces:
  - load: {{face: cylinder.flat, value: [0, 0, -17500]}}
contact:
  - touch: {{mortar: block.zmax, nonmortar: cylinder.crown, friction: {friction}}}
probes:
  - middle: {{point: [0, 0, 0], body: block}}
"""


def lift(law):
    return f"""problem: lift
bodies:
  - ground: {{lower: [-0.5, -0.5, -0.5], upper: [2.5, 1.5, 0], cells: [6, 4, 2], young: 1e5, poisson: 0.3,
             element: full}}
  - block: {{lower: [0, 0, 0], upper: [2, 1, 2], cells: [5, 3, 5], young: 1e5, poisson: 0.3, element: full}}
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
    "smooth_42": torque(28, 21).replace(f", friction: {FRICTION}", ""),
    "capstan_90_24": capstan(90, 24, 0.5),
    "capstan_90_48": capstan(90, 48, 0.5),
    "capstan_180_48": capstan(180, 48, 0.8),
    "capstan_180_96": capstan(180, 96, 0.8),
    "pulled": PULLED,
    "hung": HUNG,
    "cattaneo_14": cattaneo(14),
    "cattaneo_21": cattaneo(21),
    "roller_8": roller(8),
    "roller_16": roller(16),
    "lift_rough": lift("stick: true"),
    "lift_100": lift("friction: 100"),
}

LONG = sys.argv[1:] == ["long"]


def chosen(*coarse, fine=()):
    return fine if LONG else coarse


def verdict(what, value, limit):
    print(f"{what}: below {limit:g}" if value <= limit else f"{what}: {value:.3g} is above {limit:g}")


def load(name):
    with open(name + ".json") as file:
        return json.load(file)


def tube(bound):
    """Displacement at the fit of a tube held at radius `bound`, under a pressure of 1 on the fit, plane strain: u = A
    (r - bound^2 / r)"""
    shear = YOUNG / 2 / (1 + POISSON)
    lame = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    return -(FIT - bound**2 / FIT) / 2 / (lame + shear + shear * bound**2 / FIT**2)


def judge_greco():
    for name in chosen("greco_32", fine=("greco_64", )):
        probes = load(name)["steps"][-1]["probes"]
        found = [1e3 * probe["displacement"][0] for probe in probes]
        verdict(f"{name}, displacements of the base off the published ones",
                max(abs(u / p - 1) for u, p in zip(found, PUBLISHED.values())), 0.05)
        verdict(f"{name}, the first four of them",
                max(abs(u / p - 1) for u, p in list(zip(found, PUBLISHED.values()))[:4]), 0.01)
    if LONG:
        return
    one, five = (load(name)["steps"][-1] for name in ("greco_32", "greco_32_5"))
    verdict("greco_32 in 5 steps, displacements of the base off those in 1",
            max(abs(a["displacement"][0] / b["displacement"][0] - 1) for a, b in zip(five["probes"], one["probes"])),
            1e-6)
    verdict("greco_32 in 5 steps, dissipated work", abs(five["dissipated"] / one["dissipated"] - 1), 1e-3)


def judge_torque():
    pressure = INTERFERENCE / (tube(RIM) - tube(BORE))
    for name, limit in chosen(("torque_42", 4e-3), fine=(("torque_84", 1e-3), )):
        pairs = load(name)["steps"][-1]["pairs"]
        torque, normal = FIT * sum(pair["shear_force"] for pair in pairs), sum(pair["normal_force"] for pair in pairs)
        verdict(f"{name}, pressure off Lame's", abs(normal / (2 * math.pi * FIT * LENGTH) / pressure - 1), limit)
        verdict(f"{name}, torque off its closed form",
                abs(torque / (FRICTION * pressure * 2 * math.pi * FIT**2 * LENGTH) - 1), limit)


def judge_cost():
    with_friction, without = (load(name)["steps"] for name in ("torque_42_amg", "smooth_42_amg"))
    rubbing, smooth = (sum(step["amg_applications"] for step in steps) for steps in (with_friction, without))
    verdict("torque_42, applications of AMG without friction", smooth, 60)
    verdict("torque_42, with it", rubbing, 90)
    verdict("torque_42, with it against without", rubbing / smooth, 1.85)
    verdict("torque_42, KKT error", max(step["kkt_error"] for step in with_friction), 1e-8)


def judge_capstan():
    quarter, half = (90, 0.5, 1.602), (180, 0.8, 2.566)
    for name, (angle, thickness, published) in chosen(("capstan_90_24", quarter), ("capstan_180_48", half),
                                                      fine=(("capstan_90_48", quarter), ("capstan_180_96", half))):
        tension = {face["name"]: math.hypot(*face["reaction"][:2]) for face in load(name)["steps"][-1]["faces"]}
        ratio = tension["belt.amin"] / tension["belt.amax"]
        verdict(f"{name}, tensions off those of a thin belt", abs(ratio / published - 1), 0.01)
        verdict(f"{name}, off those of one of its thickness",
                abs(math.log(ratio) / (0.3 * math.radians(angle) * PULLEY / (PULLEY + thickness / 2)) - 1), 2e-3)


def judge_hung():
    run = load("pulled")
    print("pulled:", "converged" if run["converged"] else "not converged",
          "cuts %d" % sum(step["cuts"] for step in run["steps"]))
    run = load("hung")
    print("hung:", "converged" if run["converged"] else "not converged",
          "cuts %d" % sum(step["cuts"] for step in run["steps"]))
    force = run["steps"][-1]["pairs"][0]["force"]
    verdict("hung, force sideways", abs(force[0]) / abs(force[1]), 1e-8)
    verdict("hung, tensions off those of a belt of its thickness",
            abs((abs(force[1]) - 1) / math.exp(0.3 * math.pi * PULLEY / (PULLEY + 0.5)) - 1), 0.03)


def half_width(x, y):
    """Of the half-ellipse that has the second moment of a traction"""
    return 2 * math.sqrt((x**2 * y * np.gradient(x)).sum() / (y * np.gradient(x)).sum())


def judge_cattaneo():
    friction, radius, modulus = 0.3, 0.5, 1000 / (2 * (1 - 0.3**2))
    for name, edges in chosen(("cattaneo_14", 0.05), fine=(("cattaneo_21", 0.04), )):
        force = load(name)["steps"][1]["pairs"][0]["force"]
        normal, shear = force[2] / WIDTH, -force[0] / WIDTH
        a = math.sqrt(4 * normal * radius / math.pi / modulus)
        c, peak = a * math.sqrt(1 - shear / friction / normal), 2 * normal / math.pi / a
        with h5py.File(name + ".h5") as mesh, h5py.File(name + "_0002.h5") as step:
            x = mesh["vertices"][...]
            touching = ~np.isnan(step["contact_gap"][...]) & (x[:, 2] > 1e-12) & (x[:, 1] < 1e-9)
            order = np.argsort(x[touching, 0])
            x, p, q = x[touching,
                        0][order], step["contact_pressure"][...][touching][order], -step["contact_shear"][...][touching,
                                                                                                               0][order]
        verdict(f"{name}, half-width off Hertz's", abs(half_width(x, p) / a - 1), 0.01)
        verdict(f"{name}, peak off Hertz's", abs(p.max() / peak - 1), 0.01)
        verdict(f"{name}, half-width that sticks off Cattaneo's", abs(half_width(x, friction * p - q) / c - 1), 0.01)
        exact = friction * peak * (np.sqrt(np.maximum(0, 1 -
                                                      (x / a)**2)) - c / a * np.sqrt(np.maximum(0, 1 - (x / c)**2)))
        error, cell = abs(q - exact) * np.gradient(x), np.diff(x).min()
        apart = (abs(abs(x) - a) > 2 * cell) & (abs(abs(x) - c) > 2 * cell)
        verdict(f"{name}, traction off Cattaneo's but for two cells around its edges", error[apart].sum() / shear,
                0.005)
        verdict(f"{name}, with them", error.sum() / shear, edges)


def judge_roller():
    for name in chosen("roller_8", fine=("roller_16", )):
        probe = load(name)["steps"][0]["probes"][0]
        verdict(f"{name}, displacement off the published one", abs(probe["displacement"][2] / -1.30264 - 1), 0.01)
        verdict(f"{name}, pressure off the published one", abs(probe["contact_pressure"] / 3542.7 - 1), 0.005)


def judge_ranks():
    for name in chosen("torque_42", fine=("cattaneo_14", "roller_8")):
        one, three = (load(name + ranks)["steps"][-1]["pairs"] for ranks in ("", "_3"))
        verdict(f"{name}, 3 ranks against 1",
                max(abs(a["shear_force"] / b["shear_force"] - 1) for a, b in zip(one, three)), 1e-6)


def judge_lift():
    rough, large = load("lift_rough")["steps"], load("lift_100")["steps"]
    for name, steps in ("lift_rough", rough), ("lift_100", large):
        pair = steps[-1]["pairs"][0]
        print(f"{name}:", "converged" if all(step["converged"] for step in steps) else "not converged",
              "cuts %d" % sum(step["cuts"] for step in steps), "slip area %g" % pair["slip_area"])
        verdict(f"{name}, part of the base in contact", pair["area"] / 2, 0.5)
        verdict(f"{name}, force off the push", abs(abs(pair["force"][0]) / 250 - 1), 1e-6)
    verdict("lift, sticking against a coefficient of 100",
            abs(rough[-1]["pairs"][0]["shear_force"] / large[-1]["pairs"][0]["shear_force"] - 1), 1e-6)


if len(sys.argv) > 1 and sys.argv[1] == "scenes":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    judge_greco()
    judge_torque()
    judge_capstan()
    judge_cattaneo()
    judge_roller()
    judge_ranks()
    if not LONG:
        judge_cost()
        judge_hung()
        judge_lift()
