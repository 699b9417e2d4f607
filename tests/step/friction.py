"""Scenes with friction, and what is known of them: statics of a block that is pushed, Cattaneo's and Mindlin's
cylinder, a shaft pushed out of its hub, a load cycle.

python3 friction.py scenes writes them; python3 friction.py judges the runs that friction.sh has made.
"""
import json
import math
import sys

SLIDE = """problem: slide
bodies:
  - ground: {{lower: [-0.5, -0.5, -0.5], upper: [2.5, 1.5, 0], cells: [6, 4, 2], young: 1e5, poisson: 0.3{material}}}
  - block: {{lower: [0, 0, 0], upper: [2, 1, 0.5], cells: [5, 3, 2], young: 1e5, poisson: 0.3{material}}}
displacements:
  - fix: {{face: ground.zmin, value: [0, 0, 0]}}
{driven}pressures:
  - press: {{face: block.zmax, value: 300}}
forces:
  - push: {{face: block.zmin, value: [{push}, 0, 0], ramp: across}}
contact:
  - joint: {{mortar: ground.zmax, nonmortar: block.zmin, {law}}}
load: {{factors: {down}}}
ramps:
  - across: {{factors: {across}}}
"""


def slide(push, law, across=(0, 0.5, 1), driven="", material=""):
    return SLIDE.format(push=push, law=law, across=list(across), down=[1] * len(across), driven=driven,
                        material=material)


def cylinder(name, depth, center, cells):
    return f"""  - {name}:
      shape: half_ellipse
      axis: y
      depth: {depth}
      center: [0, 0, {center}]
      semi_axes: [1, 1]
      extent: [0, 0.02]
      patches: [6, {cells}, 14]
      grading: [1, 40, 0.05]
      even: [1, {cells // 2}, 4]
      layers: 1
      young: 1000
      poisson: 0.3
"""


CYLINDERS = f"""problem: cattaneo
bodies:
{cylinder("upper", "-z", 1, 24)}{cylinder("lower", "z", -1, 20)}
faces:
  - top: {{of: upper.arc, upper: [inf, inf, 0.15]}}
  - bottom: {{of: lower.arc, lower: [-inf, -inf, -0.15]}}
displacements:
  - fix: {{face: lower.flat, value: [0, 0, 0]}}
  - down: {{face: upper.flat, value: [free, free, -0.012], ramp: down}}
  - across: {{face: upper.flat, value: [0.0036, free, free], ramp: across}}
symmetry: [upper.lmin, upper.lmax, lower.lmin, lower.lmax]
contact:
  - touch: {{mortar: lower.bottom, nonmortar: upper.top, friction: 0.3}}
load: {{steps: 3}}
ramps:
  - down: {{factors: [1, 1, 1]}}
  - across: {{factors: [0, 0.5, 1]}}
"""

SHAFT = """problem: shaft
bodies:
  - hub: {shape: tube_arc, axis: z, radii: [25, 40], angles: [0, 90], extent: [0, 20], cells: [4, 14, 4], young: 200000,
          poisson: 0.3}
  - shaft: {shape: tube_arc, axis: z, radii: [15, 25.02], angles: [0, 90], extent: [0, 20], cells: [4, 12, 4],
            young: 200000, poisson: 0.3}
displacements:
  - base: {face: hub.outer, value: [free, free, 0]}
  - push: {face: shaft.inner, value: [free, free, 0.05], ramp: push}
symmetry: [hub.amin, hub.amax, shaft.amin, shaft.amax]
contact:
  - fit: {mortar: hub.inner, nonmortar: shaft.outer, friction: 0.12, interference: true}
load: {steps: 3}
ramps:
  - push: {factors: [0, 0.2, 1]}
"""

FORESEEN = """problem: foreseen
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 5], young: 1, poisson: 0.3}
  - top: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [1, 1, 1], young: 1, poisson: 0.3}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - push: {face: top.zmax, value: [0, 0, -0.01]}
contact:
  - joint: {mortar: low.zmax, nonmortar: top.zmin, friction: 0.3}
load: {steps: 3}
"""

BRINK = """problem: brink
bodies:
  - plate: {lower: [-2, -2, -1], upper: [4, 3, 0], cells: [6, 5, 1], young: 1e5, poisson: 0.3}
  - block: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [4, 2, 2], young: 1e5, poisson: 0.3}
displacements:
  - fix: {face: plate.zmin, value: [0, 0, 0]}
contact:
  - joint: {mortar: plate.zmax, nonmortar: block.zmin, friction: 0.3}
body_forces:
  - g: {body: block, value: [29.99, 0, -100]}
"""

OPENS = """problem: opens
bodies:
  - ground: {lower: [-0.5, -0.5, -0.5], upper: [2.5, 1.5, 0], cells: [6, 4, 2], young: 1e5, poisson: 0.3}
  - block: {lower: [0, 0, 0], upper: [2, 1, 0.5], cells: [5, 3, 2], young: 1e5, poisson: 0.3}
displacements:
  - fix: {face: ground.zmin, value: [0, 0, 0]}
  - along: {face: block.zmax, value: [1, free, free], ramp: along}
  - across: {face: block.zmax, value: [free, 1, free], ramp: across}
  - down: {face: block.zmax, value: [free, free, 1], ramp: down}
contact:
  - joint: {mortar: ground.zmax, nonmortar: block.zmin, friction: 0.3}
load: {factors: [1, 1, 1, 1]}
ramps:
  - along: {factors: [0, 0.02, 0.02, 0.04]}
  - across: {factors: [0, 0, 0, 0]}
  - down: {factors: [-0.002, -0.002, 0.01, -0.002]}
"""

# Two plates, one held at its end, the other by friction alone, as a bolt's head presses them together: rows close while
# they slide
PLATES = """problem: plates
bodies:
  - lower: {lower: [-15, -15, -6], upper: [15, 15, 0], cells: [10, 10, 3], young: 70000, poisson: 0.33}
  - upper: {lower: [-15, -15, 0], upper: [15, 15, 6], cells: [12, 12, 3], young: 70000, poisson: 0.33}
  - bolt: {lower: [-5, -5, 6], upper: [5, 5, 11], cells: [6, 6, 3], young: 210000, poisson: 0.3}
displacements:
  - fix: {face: lower.xmin, value: [0, 0, 0]}
contact:
  - seam: {mortar: lower.zmax, nonmortar: upper.zmin, friction: 0.2}
  - head: {mortar: upper.zmax, nonmortar: bolt.zmin, friction: 0.2}
tractions:
  - clamp: {face: bolt.zmax, value: [0, 0, -60]}
  - pull: {face: upper.xmax, value: [3, 0, 0]}
"""

# A plate of one cell between two blocks: all of its vertices are in a pair, nothing but the pairs holds it
THIN = """problem: thin
bodies:
  - low: {lower: [0, 0, 0], upper: [2, 1, 0.5], cells: [5, 3, 2], young: 1e5, poisson: 0.3}
  - plate: {lower: [0.1, 0.1, 0.5], upper: [1.75, 0.85, 0.7], cells: [5, 2, 1], young: 1e5, poisson: 0.3}
  - top: {lower: [0, 0, 0.7], upper: [2, 1, 1.2], cells: [4, 3, 2], young: 1e5, poisson: 0.3}
displacements:
  - fix: {face: low.zmin, value: [0, 0, 0]}
  - press: {face: top.zmax, value: [free, free, -0.002]}
  - shift: {face: top.zmax, value: [0.001, 0, free], ramp: across}
contact:
  - under: {mortar: low.zmax, nonmortar: plate.zmin, friction: 1}
  - over: {mortar: plate.zmax, nonmortar: top.zmin, friction: 1}
body_forces:
  - weight: {body: plate, value: [20, 0, -40]}
load: {factors: [1, 1, 1]}
ramps:
  - across: {factors: [0, 0.5, 1]}
"""

FEW = """problem: few
bodies:
  - low: {lower: [0, 0, 0], upper: [3, 2, 0.6], cells: [6, 2, 3], young: 1e4, poisson: 0.3, material: neohookean}
  - top: {lower: [0.639, 0.56, 0.6], upper: [2.414, 1.842, 1.6], cells: [2, 4, 2], young: 1e5, poisson: 0.49,
          material: neohookean, element: full}
displacements:
  - fix: {face: low.zmin, value: [0, 0, 0]}
  - press: {face: top.zmax, value: [free, free, -0.032]}
  - shift: {face: top.zmax, value: [0.0005621, 0.0063753, free], ramp: across}
contact:
  - joint: {mortar: top.zmin, nonmortar: low.zmax, friction: 0.1, gap: node}
load: {factors: [1, 1, 1, 1]}
ramps:
  - across: {factors: [0, 0.2, 0.4, 1]}
"""


def proportional(steps):
    """Pressure and push grow together: any number of steps goes the same way"""
    return slide(120, "friction: 0.3",
                 [(k + 1) / steps for k in range(steps)]).replace(f"{{factors: {[1] * steps}}}", f"{{steps: {steps}}}")


DRIVEN = "  - carry: {face: block.zmax, value: [0.02, 0, free], ramp: across}\n"
CYCLE = slide(0, "friction: 0.3", (0, 0.5, 1, 0.5, 0, -0.5, -1, 0, 1), DRIVEN)


def swap(text):
    """The larger face nonmortar: most of its vertices at the block's rim are covered in part"""
    return text.replace("mortar: ground.zmax, nonmortar: block.zmin", "mortar: block.zmin, nonmortar: ground.zmax")


SCENES = {
    "sticks": slide(178.2, "friction: 0.3"),
    "slides": slide(181.8, "friction: 0.3"),
    "limited": slide(0, "shear_limit: 50", driven=DRIVEN),
    "capped": slide(0, "friction: 0.3, shear_limit: 50", driven=DRIVEN),
    "rough": slide(0, "stick: true", driven=DRIVEN.replace("0.02", "0.01")),
    "oiled": slide(0, "friction: 1e-6", driven=DRIVEN),
    "grips": slide(0, "friction: 10", driven=DRIVEN),
    "swapped": swap(slide(0, "friction: 0.3", driven=DRIVEN)),
    "swapped_limited": swap(slide(0, "shear_limit: 50", driven=DRIVEN)),
    "finite": slide(0, "friction: 0.3", driven=DRIVEN, material=", material: neohookean"),
    "cycle": CYCLE,
    "node": CYCLE.replace("friction: 0.3", "friction: 0.3, gap: node"),
    **{f"proportional_{n}": proportional(n)
       for n in (1, 2, 5, 20)},
    "cattaneo": CYLINDERS,
    "shaft": SHAFT,
    "inclined": SHAFT.replace("[0, 90]", "[13, 103]"),
    "foreseen": FORESEEN,
    "brink": BRINK,
    "opens": OPENS,
    "few": FEW,
    "plates": PLATES,
    "thin": THIN,
    "guided": THIN.replace(", friction: 1", "").replace("body_forces:",
                                                        "symmetry: [plate.xmin, plate.ymin]\nbody_forces:").replace(
                                                            "[20, 0, -40]", "[0, 0, -40]"),
    "over": BRINK.replace("29.99", "30.01"),
}


def verdict(what, value, limit):
    print(f"{what}: below {limit:g}" if value <= limit else f"{what}: {value:.3g} is above {limit:g}")


def load(name):
    try:
        with open(name + ".json") as file:
            return json.load(file)
    except OSError:
        return None


def last(name):
    run = load(name)
    return run["steps"][-1]["pairs"][0]


def imbalance(step, first):
    """Work against what is stored and dissipated, relative to the work, since a step whose energy is no work of
    loads"""
    return abs(step["energy"] - first["energy"] + step["dissipated"] - first["dissipated"] -
               (step["work"] - first["work"])) / step["work"]


def taken_up(name):
    """Work of the loads against what is stored and what the contacts take up, of it: of linear bodies as exact as
    equilibrium is"""
    run = load(name)
    return max(abs(step["work"] - step["energy"] - step["contact_work"])
               for step in run["steps"]) / max(abs(step["work"]) for step in run["steps"])


def weightless(step, across):
    """What a plate's two pairs leave of the forces on it, relative to them; across: its body force along x, None: other
    things hold it that way"""
    volume = 1.65 * 0.75 * 0.2
    under, over = (pair["force"] for pair in step["pairs"])
    left = [under[2] - over[2] - 40 * volume
            ] + ([] if across is None else [under[0] - over[0] + across * volume, under[1] - over[1]])
    return max(map(abs, left)) / over[2]


def slip_law(name, coefficient, limit, tolerance=2e-3):
    pair = last(name)
    verdict(f"{name}, friction over its law",
            abs(pair["shear_force"] / min(coefficient * pair["normal_force"], limit * pair["area"]) - 1), tolerance)


def beyond(name, coefficient):
    """Of the largest pressure"""
    import h5py
    import numpy as np

    with h5py.File(name + "_0003.h5") as fields:
        pressure, shear = fields["contact_pressure"][...], np.linalg.norm(fields["contact_shear"][...], axis=1)
    return max(0, np.nanmax(shear - coefficient * pressure) / np.nanmax(pressure))


def judge():
    sticks, slides = load("sticks"), load("slides")
    verdict("block that sticks, force", abs(last("sticks")["force"][0] / -178.2 - 1), 1e-6)
    verdict("block that sticks, energy balance", imbalance(sticks["steps"][-1], sticks["steps"][0]), 1e-3)
    print("block that slides away:",
          "converged" if slides["converged"] else "not converged, exit code %d" % slides["exit_code"])
    print("block a little below and above what friction holds:",
          *("converged" if load(name)["converged"] else "not converged" for name in ("brink", "over")))
    verdict("block a little below it, force", abs(last("brink")["force"][0] / -59.98 - 1), 1e-6)
    opened = load("opens")
    verdict("block that is lifted off and put down again by MUMPS, cuts",
            sum(step["cuts"] for step in opened["steps"]) if opened["converged"] else math.inf, 0)
    verdict("block that is lifted off, force", max(map(abs, opened["steps"][2]["pairs"][0]["force"])), 0)
    print("block on three vertices at finite strain:", "converged" if load("few")["converged"] else "not converged",
          "cuts %d" % sum(step["cuts"] for step in load("few")["steps"]))
    for name in "thin", "guided":
        runs = [load(name)] + ([load("thin_3")] if name == "thin" else [])
        print(f"plate of one cell between two blocks, {name}:",
              *("converged" if run["converged"] else "not converged" for run in runs))
        verdict(f"{name}, cuts", max(step["cuts"] for run in runs for step in run["steps"]), 0)
        verdict(f"{name}, its pairs' forces against its weight",
                max(weightless(step, 20 if name == "thin" else None) for run in runs for step in run["steps"]), 1e-6)
        verdict(f"{name}, 3 ranks against 1", abs(runs[-1]["steps"][-1]["energy"] / runs[0]["steps"][-1]["energy"] - 1),
                1e-6)
        verdict(f"{name}, solves a load step", max(step["amg_applications"] for run in runs for step in run["steps"]),
                40)
    forces = [step["pairs"][0]["normal_force"] for step in load("foreseen")["steps"]]
    verdict("each step the continuation of the last, cuts", sum(step["cuts"] for step in load("foreseen")["steps"]), 0)
    verdict("each step the continuation of the last, force off a straight line",
            max(abs(f / forces[0] - 1 - i) for i, f in enumerate(forces)), 1e-9)
    slip_law("finite", 0.3, math.inf)
    slip_law("limited", math.inf, 50)
    slip_law("capped", 0.3, 50, 0.02)  # less where the pressure is low
    slip_law("swapped", 0.3, math.inf)
    slip_law("swapped_limited", math.inf, 50)
    for name in "swapped", "swapped_limited":
        verdict(f"{name}, sizes of its forces against their resultant",
                abs(last(name)["shear_force"] / abs(last(name)["force"][0]) - 1), 5e-3)
    verdict("swapped, traction beyond friction x pressure", beyond("swapped", 0.3), 1e-6)
    print("slip area where all sticks: %g" % last("rough")["slip_area"],
          "converged" if load("rough")["converged"] else "not converged")
    print("coefficients of 1e-6 and 10:",
          "converged" if load("oiled")["converged"] and load("grips")["converged"] else "not converged")
    for name in "cycle", "node":
        run = load(name)
        dissipated = [step["dissipated"] for step in run["steps"]]
        slip_law(name, 0.3, math.inf)
        verdict(f"{name}, energy balance", max(imbalance(step, run["steps"][0]) for step in run["steps"][1:]), 2e-3)
        verdict(f"{name}, work of the loads that is neither stored nor taken up by the contacts", taken_up(name), 1e-9)
        verdict(f"{name}, dissipation that is taken back",
                max(a - b for a, b in zip(dissipated, dissipated[1:])) / dissipated[-1], 0.02)
    for name in "cycle_restarted", "swapped", "shaft", "cattaneo":
        verdict(f"{name}, work of the loads that is neither stored nor taken up by the contacts", taken_up(name), 1e-9)
    judge_proportional()
    whole, parts = load("cycle"), load("cycle_restarted")
    a, b = whole["steps"][-1], parts["steps"][-1]
    verdict("restarted on 2 ranks, force", abs(a["pairs"][0]["force"][0] / b["pairs"][0]["force"][0] - 1), 1e-6)
    verdict("restarted on 2 ranks, dissipated", abs(a["dissipated"] / b["dissipated"] - 1), 1e-6)
    shaft = last("shaft")
    verdict("shaft, force over friction x pressure x area",
            abs(-shaft["force"][2] / (0.12 * shaft["normal_force"]) - 1), 5e-3)
    pressed = [load(name)["steps"][0]["pairs"][0]["shear_force"] for name in ("shaft", "inclined")]
    verdict("shaft between inclined planes, friction of the press fit", abs(pressed[1] / pressed[0] - 1), 0.01)
    cattaneo()


def judge_proportional():
    """All of a step's work is of loads here; tilting normals leave a hundredth of a per cent"""
    ends = {n: load(f"proportional_{n}")["steps"][-1] for n in (1, 2, 5, 20)}
    for n, step in ends.items():
        pair, fine = step["pairs"][0], ends[20]["pairs"][0]
        verdict(f"proportional path in {n} steps, friction and stick area",
                max(abs(pair[key] / fine[key] - 1) for key in ("shear_force", "stick_area", "slip_area")), 1e-5)
        verdict(f"proportional path in {n} steps, dissipation", abs(pair["dissipated"] / fine["dissipated"] - 1), 5e-3)
        verdict(f"proportional path in {n} steps, energy balance",
                abs(step["energy"] + step["dissipated"] - step["work"]) / step["work"], 1e-4)


def cattaneo():
    """Traction of a cylinder that sticks within c = a sqrt(1 - Q / (mu P)): mu p0 (sqrt(1 - x^2/a^2) - c/a sqrt(1 -
    x^2/c^2))"""
    import h5py
    import numpy as np

    mu, length = 0.3, 0.02
    modulus, radius = 1000 / (2 * (1 - 0.09)), 0.5
    run = load("cattaneo")
    with h5py.File("cattaneo.h5") as mesh:
        x = mesh["vertices"][...]
    for step in run["steps"][1:]:
        force = step["pairs"][0]["force"]
        P, Q = force[2] / length, -force[0] / length
        a = math.sqrt(4 * P * radius / (math.pi * modulus))
        c, p0 = a * math.sqrt(1 - Q / (mu * P)), 2 * P / (math.pi * a)
        with h5py.File("cattaneo_%04d.h5" % step["step"]) as fields:
            on = ~np.isnan(fields["contact_gap"][...]) & (x[:, 2] > 1e-12) & (x[:, 1] < 1e-9)
            shear, status = np.abs(fields["contact_shear"][...][on, 0]), fields["contact_status"][...][on]
        order = np.argsort(x[on, 0])
        s = x[on, 0][order]
        half = lambda r: np.sqrt(np.maximum(0, 1 - s**2 / r**2))
        exact = mu * p0 * (half(a) - c / a * half(c))
        verdict("Cattaneo, traction in the mean at Q = %.1f mu P" % (Q / (mu * P)),
                (np.diff(s) * 0.5 * (np.abs(shear[order] - exact)[1:] + np.abs(shear[order] - exact)[:-1])).sum() / Q,
                0.2)
        cell = np.diff(s).min()
        held, gives = np.abs(s[status[order] == 1]).max(), np.abs(s[status[order] == 2]).min()
        verdict("Cattaneo, border of the sticking area, in cells", max(held - c, c - gives) / cell, 1.5)


if len(sys.argv) > 1 and sys.argv[1] == "scenes":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    judge()
