"""Scenes of public reports about contact in other programs (share/doc/hard_cases.md), and what must hold here."""
import json
import math
import sys

# CalculiX issue 98: tubes 20 to 40.005 and 40 to 60, friction 0.1, 5.74 MPa, 1,371 N. Assumed: E 196,000 and length 19,
# which give these figures by Lame; a quarter
PRESS_IN = """bodies:
  - inner: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [10, 20.0025], angles: [0, 90], extent: [0, 19],
            cells: [4, 8, 5], young: 196000, poisson: 0.3}
  - outer: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [20, 30], angles: [0, 90], extent: [0, 19],
            cells: [4, 8, 5], young: 196000, poisson: 0.3}
symmetry: [inner.amin, inner.amax, outer.amin, outer.amax]
displacements:
  - stay: {face: outer.lmin, value: [free, free, 0]}
  - push: {face: inner.lmax, value: [free, free, -0.05], ramp: push}
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer, interference: true, friction: 0.1}
ramps:
  - push: {factors: [0, 1]}
load: {steps: 2}
"""

# CalculiX issue 162: the unit of length and of force must not matter. Assumed: a block on a block
UNITS = """bodies:
  - low: {{lower: [0, 0, 0], upper: [{a}, {a}, {b}], cells: [4, 4, 2], young: {E}, poisson: 0.3}}
  - top: {{lower: [{c}, {c}, {b}], upper: [{d}, {d}, {a}], cells: [3, 3, 2], young: {E}, poisson: 0.3}}
displacements:
  - ground: {{face: low.zmin, value: [0, 0, 0]}}
  - press: {{face: top.zmax, value: [{u}, 0, -{u}]}}
contact:
  - pair: {{mortar: low.zmax, nonmortar: top.zmin, friction: 0.3}}
load: {{steps: 1}}
"""

# MOOSE issue 10950, pull request 14241: plank 0.6 x 20, block 0.6 x 0.8, gap 0.01, E 1e9, friction 0.4: pressed and
# moved along. Assumed: plane strain by a slice, motions of 0.02 and 1, Poisson's ratio 0.3
PLANK = """bodies:
  - plank: {lower: [-0.3, -10, 0], upper: [0.3, 10, 0.3], cells: [2, 67, 1], young: 1e9, poisson: 0.3}
  - block: {lower: [0.31, 9.2, 0], upper: [0.91, 10, 0.3], cells: [3, 4, 1], young: 1e9, poisson: 0.3}
symmetry: [plank.zmin, plank.zmax, block.zmin, block.zmax]
displacements:
  - wall: {face: plank.xmin, value: [0, 0, free]}
  - press: {face: block.xmax, value: [-0.02, free, free], ramp: press}
  - slide: {face: block.xmax, value: [free, -1, free], ramp: slide}
contact:
  - side: {mortar: plank.xmax, nonmortar: block.xmin, friction: 0.4}
ramps:
  - press: {factors: [1, 1, 1, 1, 1]}
  - slide: {factors: [0, 0.25, 0.5, 0.75, 1]}
load: {steps: 5}
"""

# MOOSE issue 33493: two pairs that share the nodes of an edge, 2 x 1 cells on 2 x 1 cells, pressed
CORNER = """bodies:
  - lower: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [2, 1, 1], young: 1000, poisson: 0}
  - upper: {lower: [0, 0, 1], upper: [2, 1, 2], cells: [2, 1, 1], young: 1000, poisson: 0}
faces:
  - left: {of: upper.zmin, upper: [1, inf, inf]}
  - right: {of: upper.zmin, lower: [1, -inf, -inf]}
  - lleft: {of: lower.zmax, upper: [1, inf, inf]}
  - lright: {of: lower.zmax, lower: [1, -inf, -inf]}
displacements:
  - ground: {face: lower.zmin, value: [0, 0, 0]}
  - press: {face: upper.zmax, value: [0, 0, -0.02]}
contact:
  - left: {mortar: lower.lleft, nonmortar: upper.left}
  - right: {mortar: lower.lright, nonmortar: upper.right}
load: {steps: 1}
"""

# Kratos issue 8078: a block that is pressed on another one and dragged; its lower part must lag behind. Assumed: sizes
DRAG = """bodies:
  - base: {lower: [0, 0, 0], upper: [4, 1, 1], cells: [8, 2, 2], young: 1000, poisson: 0.3}
  - slider: {lower: [0.5, 0, 1], upper: [1.5, 1, 2], cells: [3, 2, 3], young: 1000, poisson: 0.3}
displacements:
  - ground: {face: base.zmin, value: [0, 0, 0]}
  - press: {face: slider.zmax, value: [free, 0, -0.02], ramp: press}
  - drag: {face: slider.zmax, value: [0.4, free, free], ramp: drag}
contact:
  - pair: {mortar: base.zmax, nonmortar: slider.zmin, friction: MU}
probes:
  - top: {point: [1, 0.5, 2], body: slider}
  - foot: {point: [1, 0.5, 1], body: slider}
ramps:
  - press: {factors: [1, 1, 1]}
  - drag: {factors: [0, 0.5, 1]}
load: {steps: 3}
"""

# CalculiX issue 97: forces at supports where contact is anywhere in the model: 2 x 5e7 pull a plate. Here a solid plate
ELSEWHERE = """bodies:
  - plate: {lower: [0, 0, 0], upper: [1, 1, 0.1], cells: [2, 2, 1], young: 2.1e11, poisson: 0}
  - low: {lower: [0, 2, 0], upper: [1, 3, 1], cells: [1, 1, 1], young: 2.1e11, poisson: 0}
  - top: {lower: [0, 2, 1], upper: [1, 3, 2], cells: [1, 1, 1], young: 2.1e11, poisson: 0}
displacements:
  - clamp: {face: plate.xmin, value: [0, 0, 0]}
  - ground: {face: low.zmin, value: [0, 0, 0]}
  - press: {face: top.zmax, value: [0, 0, -1e-4]}
forces:
  - pull: {face: plate.xmax, value: [1e8, 0, 0]}
contact:
  - pair: {mortar: low.zmax, nonmortar: top.zmin}
load: {steps: 1}
"""

# The CalculiX forum's 1486: a stack of loose plates. Assumed: five of them, friction 0.2, a load on top
STACK = "bodies:\n" + "".join((
    f"  - p{k}: "
    f"{{lower: [0, 0, {k}], upper: [4, 4, {k + 1}], cells: [{2 + k % 2}, {2 + k % 2}, 1], young: 2e5, poisson: 0.3}}\n")
                              for k in range(5)) + """displacements:
  - ground: {face: p0.zmin, value: [0, 0, 0]}
pressures:
  - load: {face: p4.zmax, value: 10}
contact:
  - auto: {friction: 0.2}
load: {steps: 1}
"""

# SimScale's 91408, MOOSE discussion 32856: a bolted joint, without contact parameters. Assumed: two plates, a hollow
# bolt with a head, its other end fixed, E 210,000, 2,000 N on a quarter, a clearance of 0.01 under the head
ARC = "shape: tube_arc, axis: z, center: [0, 0, 0], angles: [0, 90], young: 210e3, poisson: 0.3"
BOLTED = f"""bodies:
  - low: {{{ARC}, radii: [4.5, 12], extent: [0, 5], cells: [4, 6, 2]}}
  - top: {{{ARC}, radii: [4.5, 12], extent: [5, 10], cells: [4, 6, 2]}}
  - shank: {{{ARC}, radii: [2, 4], extent: [-2, 10.01], cells: [1, 6, 6]}}
  - head: {{{ARC}, radii: [2, 7], extent: [10.01, 14], cells: [3, 6, 2]}}
symmetry: [low.amin, low.amax, top.amin, top.amax, shank.amin, shank.amax, head.amin, head.amax]
displacements:
  - ground: {{face: low.lmin, value: [free, free, 0]}}
  - nut: {{face: shank.lmin, value: [0, 0, 0]}}
ties:
  - neck: {{mortar: head.lmin, nonmortar: shank.lmax}}
contact:
  - auto: {{friction: 0.1}}
bolts:
  - bolt: {{body: shank, point: [0, 0, 5], axis: [0, 0, 1], force: 2000}}
load: {{steps: 1}}
"""


def scenes():
    """Names and texts of all scenes"""
    made = {
        "press_in": PRESS_IN, "plank": PLANK, "corner": CORNER, "elsewhere": ELSEWHERE, "stack": STACK, "bolted": BOLTED
    }
    for name, length, force in (("mm_N", 1.0, 1.0), ("m_N", 1e-3, 1.0), ("um_kN", 1e3, 1e-3)):
        made[name] = UNITS.format(a=8 * length, b=4 * length, c=2 * length, d=6 * length, u=0.01 * length,
                                  E=2e5 * force / length**2)
    for mu in (0.1, 0.5, 0.9):
        made[f"drag_{mu}"] = DRAG.replace("MU", str(mu))
    return made


def load(name):
    with open(name + ".json") as file:
        return json.load(file)["steps"]


def say(what, off, allowed):
    print(f"{what}: {'sound' if abs(off) <= allowed else f'off by {off:g}'}")


def judge():
    steps = {name: load(name) for name in scenes()}
    fit = [step["pairs"][0] for step in steps["press_in"]]
    say("press_in: pressure, against Lame", fit[0]["normal_force"] / fit[0]["area"] / 5.74 - 1, 0.03)
    say("press_in: force of a quarter, against 1,371 / 4", fit[1]["shear_force"] / (1371 / 4) - 1, 0.03)
    energy = {name: steps[name][-1]["energy"] for name in ("mm_N", "m_N", "um_kN")}
    say("units: m instead of mm", energy["m_N"] / (energy["mm_N"] * 1e-3) - 1, 1e-9)
    say("units: um and kN instead of mm and N", energy["um_kN"] / energy["mm_N"] - 1, 1e-9)
    for step in steps["plank"][2:]:
        pair = step["pairs"][0]
        say(f"plank: friction is 0.4 of the pressure in load step {step['step']}",
            pair["shear_force"] / pair["normal_force"] / 0.4 - 1, 1e-4)
    corner = steps["corner"][-1]["pairs"]
    say("corner: the sum of both pairs", corner[0]["normal_force"] + corner[1]["normal_force"] - 20, 1e-6)
    # the nodes that they share are in both: which of them has their force is not determined
    say("corner: both have the same", corner[0]["normal_force"] - corner[1]["normal_force"], 0.02)
    for mu in (0.1, 0.5, 0.9):
        last = steps[f"drag_{mu}"][-1]
        probes = {probe["name"]: probe["displacement"][0] for probe in last["probes"]}
        print(f"drag_{mu}: the foot lags behind: {'sound' if probes['foot'] < probes['top'] else probes}")
        say(f"drag_{mu}: friction is its coefficient times the pressure",
            last["pairs"][0]["shear_force"] / last["pairs"][0]["normal_force"] / mu - 1, 1e-3)
    faces = {face["name"]: face["reaction"] for face in steps["elsewhere"][-1]["faces"]}
    say("elsewhere: the clamp holds the pull", faces["plate.xmin"][0] / -1e8 - 1, 1e-9)
    for pair in steps["stack"][-1]["pairs"]:
        say(f"stack: {pair['name']} carries the load", pair["normal_force"] / 160 - 1, 1e-6)
    bolted = steps["bolted"][-1]
    say("bolted: tension", bolted["bolts"][0]["force"] / 2000 - 1, 1e-8)
    loaded = [pair["normal_force"] for pair in bolted["pairs"] if pair["normal_force"] > 1000]
    say("bolted: seat and joint carry it", max(abs(force / 2000 - 1) for force in loaded) + abs(len(loaded) - 2), 0.02)


if sys.argv[1] == "write":
    for scene, text in scenes().items():
        with open(scene + ".yaml", "w") as out:
            out.write(text)
    print(*scenes())
else:
    judge()
