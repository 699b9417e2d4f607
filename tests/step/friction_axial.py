"""A shaft shrunk into a hub and pushed out of it: Lame's pressure, and friction x pressure x 2 pi r L.

python3 friction_axial.py scenes writes the scenes, two meshes of a quarter; python3 friction_axial.py judges the runs
that friction_axial.sh has made.

Poisson's ratio is 0, or the length of the shaft would change with its pressure, against the face that pushes it; the
interference is small, or the forces along the fit would tilt it.
"""
import math
import sys

from summaries import load, say, within

YOUNG, INTERFERENCE, FRICTION, LENGTH, PUSH = 200000, 0.002, 0.12, 20, 0.005
BORE, FIT, RIM = 15.0, 25.0, 40.0
MESHES = {"axial_16": (16, 12, 4), "axial_32": (32, 24, 6)}
LIMITS = {"axial_16": 5e-3, "axial_32": 1e-3}


def tube(name, inner, outer, around, along):
    return (f"  - {name}: "
            f"{{shape: tube_arc, axis: z, radii: [{inner}, {outer}], angles: [0, 90], extent: [0, {LENGTH}], "
            f"cells: [{around // 3}, {around}, {along}], young: {YOUNG}, poisson: 0}}\n")


def scene(outside, inside, along):
    return f"""problem: axial
bodies:
{tube("hub", FIT, RIM, outside, along)}{tube("shaft", BORE, FIT + INTERFERENCE, inside, along)}displacements:
  - hold: {{face: hub.outer, value: [0, 0, 0]}}
  - push: {{face: shaft.inner, value: [0, 0, {PUSH}], ramp: push}}
symmetry: [hub.amin, hub.amax, shaft.amin, shaft.amax]
contact:
  - fit: {{mortar: hub.inner, nonmortar: shaft.outer, friction: {FRICTION}, interference: true}}
load: {{steps: 3}}
ramps:
  - push: {{factors: [0, 0.1, 1]}}
"""


# The shaft is pushed at its end, in the plane that the hub's end is held on
HELD = ("held_1", "held_5", "held_swapped")


def held(name):
    along, law = 1 if name in (
        "held_1", "held_sticks") else 5, "stick: true" if name == "held_sticks" else f"friction: {FRICTION}"
    sides = ("hub.inner", "shaft.outer") if name == "held_swapped" else ("shaft.outer", "hub.inner")
    return f"""problem: held
bodies:
{tube("hub", FIT, RIM, 12, along)}{tube("shaft", BORE, FIT + INTERFERENCE, 10, along)}displacements:
  - push: {{face: shaft.lmin, value: [free, free, 0.02], ramp: push}}
symmetry: [hub.amin, hub.amax, shaft.amin, shaft.amax, hub.lmin]
contact:
  - fit: {{mortar: {sides[0]}, nonmortar: {sides[1]}, {law}, interference: true}}
load: {{steps: 3}}
ramps:
  - push: {{factors: [0, 0.1, 1]}}
"""


def stiffness(bound):
    """Of a tube held at radius `bound`, against a pressure on the fit: u = A (r - bound^2 / r) there, stress E A (1 +
    bound^2 / r^2)"""
    return YOUNG * (1 + bound**2 / FIT**2) / abs(FIT - bound**2 / FIT)


if sys.argv[1:] == ["scenes"]:
    for name, cells in MESHES.items():
        with open(name + ".yaml", "w") as file:
            file.write(scene(*cells))
    for name in (*HELD, "held_sticks"):
        with open(name + ".yaml", "w") as file:
            file.write(held(name))
else:
    normal = INTERFERENCE / (1 / stiffness(RIM) + 1 / stiffness(BORE)) * 2 * math.pi * FIT * LENGTH
    for name, limit in LIMITS.items():
        steps = [step["pairs"][0] for step in load(name)["steps"]]
        found, force = 4 * steps[2]["normal_force"], -4 * steps[2]["force"][2]
        say(f"{name}: no friction before the push",
            abs(steps[0]["shear_force"]) < 1e-3 * steps[2]["shear_force"], steps[0]["shear_force"])
        say(f"{name}: all of it slips in the end", steps[2]["stick_area"] == 0, steps[2]["stick_area"])
        say(f"{name}: pressure within {limit:g} of Lame's", within(found, normal, limit), found / normal)
        say(f"{name}: force within {limit:g} of friction x pressure x 2 pi r L",
            within(force, FRICTION * normal, limit), force / FRICTION / normal)
    one, three = (load(name)["steps"][2]["pairs"][0]["force"][2] for name in ("axial_16", "axial_16_3"))
    say("3 ranks as 1", within(three, one, 1e-6), (three, one))
    for name in HELD:
        run = load(name)
        pair = run["steps"][2]["pairs"][0]
        say(f"{name}: friction acts on nodes that are held",
            within(abs(pair["force"][2]), FRICTION * pair["normal_force"], 2e-3),
            pair["force"][2] / FRICTION / pair["normal_force"])
        say(f"{name}: no warning of nodes without friction",
            not any("no friction" in warning for warning in run["warnings"]), run["warnings"])
    warnings = load("held_sticks")["warnings"]
    say("what sticks and is driven apart: 13 of 26 nodes",
        any("cannot stick at 13 of the 26 nodes of hub.inner" in warning for warning in warnings), warnings)
