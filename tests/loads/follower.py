"""Scenes for follower.sh, and their answers: python follower.py write|judge."""
import functools
import sys

from summaries import load, say

MU, KAPPA = 1 / 2.6, 1 / 1.2  # of Young's modulus 1 and Poisson's ratio 0.3
CUBE = """bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1.5, 2], cells: [2, 3, 3], material: neohookean, young: 1, poisson: 0.3}
symmetry: [cube.xmin, cube.ymin, cube.zmin]
pressures:
  - px: {face: cube.xmax, value: 0.3, follows: true}
  - py: {face: cube.ymax, value: 0.3, follows: true}
  - pz: {face: cube.zmax, value: 0.3, follows: true}
probes:
  - corner: {point: [1, 1.5, 2]}
load: {steps: 2}
"""
OTHER_SIDES = "".join("  - q%s: {face: cube.%smin, value: 0.3, follows: true}\n" % (axis, axis) for axis in "xyz")
SPHERE = """bodies:
  - ball: {shape: sphere_shell, inner: {radius: 1}, outer: {radius: 2}, patches: [3, 3, 3], layers: 3,
      material: neohookean, young: 1, poisson: 0.3, order: 2}
symmetry: [ball.x0, ball.y0, ball.z0]
pressures:
  - blow: {face: ball.inner, value: 0.2, follows: true}
probes:
  - inside: {point: [1, 0, 0]}
"""
BAR = CUBE.replace(
    "  - px: {face: cube.xmax, value: 0.3, follows: true}\n  - py: {face: cube.ymax, value: 0.3, follows: true}\n", "")
PRESS = """bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 1, poisson: 0.3}
  - top: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [3, 3, 2], material: neohookean, young: 1, poisson: 0.3}
symmetry: [low.xmin, low.ymin, low.zmin, top.xmin, top.ymin]
pressures:
  - press: {face: top.zmax, value: 0.1, follows: true}
contact:
  - touch: {mortar: top.zmin, nonmortar: low.zmax}
probes:
  - tip: {point: [1, 1, 2]}
"""
RIDE = """problem: ride
bodies:
  - low: {lower: [0, 0, 0], upper: [4, 2, 1], cells: [5, 2, 1], material: neohookean, young: 10, poisson: 0.3}
  - top: {lower: [0.5, 0.5, 1], upper: [1.5, 1.5, 2], cells: [2, 2, 2], material: neohookean, young: 5, poisson: 0.3}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - drag: {face: top.xmin, value: [0.3, 0, free]}
pressures:
  - press: {face: top.zmax, value: 0.3, follows: true}
contact:
  - touch: {mortar: low.zmax, nonmortar: top.zmin}
"""
SCENES = {
    "cube": CUBE,
    "free": CUBE.replace("symmetry: [cube.xmin, cube.ymin, cube.zmin]",
                         "weak_springs: true").replace("probes:", OTHER_SIDES + "probes:"),
    "bar": BAR,
    "sphere": SPHERE,
    "press": PRESS,
    "glued": PRESS.replace("contact:", "ties:"),
    "fine": BAR.replace("probes:", "refinements:\n  - spot: {lower: [0, 0, 1.5], upper: [0.4, 0.4, 2]}\nprobes:"),
}


def root(function, a, b):
    """By bisection"""
    for _ in range(60):
        middle = (a + b) / 2
        a, b = (middle, b) if function(a) * function(middle) > 0 else (a, middle)
    return (a + b) / 2


def stresses(radial, hoop):
    """Nominal stress of the law by principal stretches, two of which are the same"""
    J, square = radial * hoop**2, radial**2 + 2 * hoop**2
    stress = lambda stretch: MU * J**(-2 / 3) * (stretch - square / (3 * stretch)) + KAPPA * (J - 1) * J / stretch
    return stress(radial), stress(hoop)


@functools.cache
def blown(pressure, n=60):
    """Displacement inside of the sphere: the radial problem by shooting, fourth order Runge-Kutta"""

    def rates(R, r, P):
        radial = root(lambda stretch: stresses(stretch, r / R)[0] - P, 0.2, 3)
        return radial, -2 / R * (P - stresses(radial, r / R)[1])

    def outer(inner):
        r, P, h = inner, -pressure * inner**2, 1 / n
        for k in range(n):
            R = 1 + k * h
            a = rates(R, r, P)
            b = rates(R + h / 2, r + h / 2 * a[0], P + h / 2 * a[1])
            c = rates(R + h / 2, r + h / 2 * b[0], P + h / 2 * b[1])
            d = rates(R + h, r + h * c[0], P + h * c[1])
            r, P = r + h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0]), P + h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
        return P

    before, now = 1.2, 1.3  # secants
    for _ in range(8):
        f = outer(before), outer(now)
        if f[0] == f[1]:
            break
        before, now = now, now - f[1] * (now - before) / (f[1] - f[0])
    return now - 1


@functools.cache
def column(pressure):
    """Stretches along and across of a block under a pressure at its ends alone"""
    across = lambda along: root(lambda hoop: stresses(along, hoop)[1], 0.5, 2)
    along = root(lambda stretch: stresses(stretch, across(stretch))[0] + pressure * across(stretch)**2, 0.3, 1)
    return along, across(along)


def judge(inside):
    steps = {name: load(name)["steps"] for name in SCENES}
    for name in ("cube", "free"):
        energies = [3 * KAPPA / 2 * (p / KAPPA)**2 for p in (0.15, 0.3)]  # of the volume 3
        good = all(
            abs(step["energy"] - e) < 1e-6 * e and abs(step["probes"][0]["stress_zz"] + p) < 1e-6 * p
            for step, e, p in zip(steps[name], energies, (0.15, 0.3)))
        say(name + ": the pressure inside is that outside, the energy that of the law", good,
            [step["energy"] for step in steps[name]])
    along, across = column(0.3)
    exact = [across - 1, 1.5 * (across - 1), 2 * (along - 1)]
    for name in ("bar", "fine"):
        moved = steps[name][1]["probes"][0]["displacement"]
        say(name + ": stretches along and across",
            max(abs(a - b) for a, b in zip(moved, exact)) < 1e-7, (moved, exact))
    along, across = column(0.1)
    for name in ("press", "glued"):
        moved, force = steps[name][0]["probes"][0]["displacement"][2], steps[name][0]["faces"][2]["reaction"][2]
        say(name + ": two blocks, the force of the stretched face",
            abs(moved - 2 * (along - 1)) < 1e-6 and abs(force - 0.1 * across**2) < 1e-7, (moved, force))
    its = [step["ip_iterations"] for step in steps["free"]]
    say(
        ("free: at most 40 Newton steps in a load step, although a body on weak springs turns about almost "
                 "without force"),
        max(its) <= 40, its)
    moved = steps["sphere"][0]["probes"][0]["displacement"][0]
    say("sphere: as the radial problem has it, to 0.2 %", abs(moved - inside) < 2e-3 * inside, (moved, inside))
    say(
        "in equilibrium and in balance",
        all(step["equilibrium"] < 1e-7 and (step["balance"] < 1e-7 or name == "free")
            for name in steps
            for step in steps[name]), {name: [(s["equilibrium"], s["balance"]) for s in steps[name]]
                                       for name in steps})


if sys.argv[1] == "write":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s" % (name, text))
    with open("ride.yaml", "w") as file:
        file.write(RIDE)
else:
    judge(blown(0.2, 30))
