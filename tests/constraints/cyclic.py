"""Cyclic symmetry: sectors against whole bodies. python3 cyclic.py scenes|judge|scenes_long|judge_long"""
import math
import re
import sys

from summaries import load, say, within

LINEAR = "young: 1000, poisson: 0.3"
FINITE = LINEAR + ", material: neohookean"
TWIST = """problem: twist
bodies:
  - tube: {{shape: tube_arc, axis: z, center: [3, -1, 0], radii: [1, 2], angles: [{angles}], extent: [0, 3],
      cells: [2, {cells}, 3], {material}}}
displacements:
  - foot: {{face: tube.lmin, value: [0, 0, 0]}}
  - top: {{face: tube.lmax, value: [0, 0, 0.05], rotation: [0, 0, 20], center: [3, -1, 0]}}
{cut}
"""
CUT = "cyclic:\n  - cut: {from: tube.amin, to: tube.amax, axis: [0, 0, 2], center: [3, -1, 7]}"
# A solid shaft: a half and a quarter, both with nodes on the axis
SHAFT = """problem: shaft
bodies:
  - shaft: {{shape: half_ellipse, axis: x, depth: y, {half}semi_axes: [1, 1], extent: [0, 2], patches: [2, 2, 2],
      layers: 3, {material}}}
faces:
  - left: {{of: shaft.flat, upper: [inf, inf, 0]}}
  - right: {{of: shaft.flat, lower: [-inf, -inf, 0]}}
displacements:
  - foot: {{face: shaft.lmin, value: [0, 0, 0]}}
  - end: {{face: shaft.lmax, value: [0.05, 0, 0], rotation: [40, 0, 0], center: [0, 0, 0]}}
cyclic:
  - cut: {{from: shaft.{cut}, axis: [1, 0, 0]}}
"""
PULL = """problem: pull
bodies:
  - bar: {shape: wedge, axis: z, corners: [0, 0, 2, 0, 1, 1.7320508075688772], extent: [0, 3], side_cells: 2,
      length_cells: 2, young: 1000, poisson: 0.3}
displacements:
  - foot: {face: bar.lmin, value: [free, free, 0]}
  - end: {face: bar.lmax, value: [free, free, 0.03]}
  - turn: {point: [2, 0, 0], body: bar, value: [free, 0, free]}
cyclic:
  - cut: {from: bar.side1, to: bar.side3, axis: [0, 0, 1]}
"""
FIT = """problem: fit
bodies:
  - shaft: {{shape: tube_arc, axis: z, radii: [0.5, 1.005], angles: [{angles}], extent: [0, 1], cells: [2, {shaft}, 2],
      {material}}}
  - ring: {{shape: tube_arc, axis: z, radii: [1, 2], angles: [{angles}], extent: [0, 1], cells: [3, {ring}, 2],
      {material}}}
load_steps: 2
ramps:
  - turn: {{factors: [0, 1]}}
displacements:
  - in: {{face: shaft.inner, value: [0, 0, 0]}}
  - out: {{face: ring.outer, value: [0, 0, 0], rotation: [0, 0, 0.3], center: [0, 0, 0], ramp: turn}}
{cut}
contact:
  - fit: {{mortar: shaft.outer, nonmortar: ring.inner, interference: true, friction: 0.3}}
"""
FIT_CUTS = ("cyclic:\n  - one: {from: shaft.amin, to: shaft.amax, axis: [0, 0, 1]}\n"
            "  - two: {from: ring.amin, to: ring.amax, axis: [0, 0, 1]}")


def bladed(blades, whole):
    """A disc with blades, which pull outward and sideways."""
    lines = ["problem: disc", "bodies:"]
    lines += [(f"  - disc: "
               f"{{shape: tube_arc, axis: z, radii: [0.5, 2], angles: [0, {360 if whole else 60}], extent: [0, 0.5], "
               f"cells: [3, {24 if whole else 4}, 1], {LINEAR}, order: 1}}")]
    for k in range(blades):
        lines += [
            (f"  - blade{k}: "
             f"{{shape: tube_arc, axis: z, radii: [2, 3], angles: [{60 * k + 15}, {60 * k + 45}], extent: [0, 0.5], "
             f"cells: [2, 2, 1], {LINEAR}, order: 1}}")
        ]
    lines += ["ties:"] + [f"  - root{k}: {{mortar: disc.outer, nonmortar: blade{k}.inner}}" for k in range(blades)]
    lines += ["displacements:", "  - hub: {face: disc.inner, value: [0, 0, 0]}", "body_forces:"]
    for k in range(blades):
        a = math.radians(60 * k + 30)
        lines += [
            (f"  - pull{k}: "
             f"{{body: blade{k}, "
             f"value: [{10 * math.cos(a) - 4 * math.sin(a):.15g}, {10 * math.sin(a) + 4 * math.cos(a):.15g}, 1]}}")
        ]
    if not whole:
        lines += ["cyclic:", "  - cut: {from: disc.amin, to: disc.amax, axis: [0, 0, 1]}"]
    return "\n".join(lines) + "\n"


def twist(angles, cells, material, cut=CUT):
    return TWIST.format(angles=angles, cells=cells, material=material, cut=cut)


def unlike():
    """The faces of the cyclic symmetry have different meshes"""
    wedge = "wedge, axis: z, corners: [0, 0, 2, 0, 0.5, 0.866], extent: [0, 1], side_cells: 2, length_cells: 1"
    scene = re.sub(r"tube_arc.*\n.*cells: \[2, 2, 3\]", wedge, twist("0, 60", 2, LINEAR))
    scene = scene.replace("tube.amin, to: tube.amax, axis: [0, 0, 2], center: [3, -1, 7]",
                          "tube.side1, to: tube.side3, axis: [0, 0, 1]")
    return scene.replace("center: [3, -1, 0]", "center: [0, 0, 0]")


def fit(whole, material):
    return FIT.format(angles="0, 360" if whole else "0, 60", shaft=18 if whole else 3, ring=24 if whole else 4,
                      material=material, cut="" if whole else FIT_CUTS)


SCENES = {
    "whole": twist("0, 360", 12, LINEAR, ""),
    "sector": twist("0, 60", 2, LINEAR),
    "backwards": twist("70, 190", 4, LINEAR,
                       CUT.replace("from: tube.amin, to: tube.amax", "from: tube.amax, to: tube.amin")),
    "finite_whole": twist("0, 360", 12, FINITE, ""),
    "finite": twist("0, 60", 2, FINITE),
    "pull": PULL,
    "half": SHAFT.format(half="", cut="right, to: shaft.left", material=FINITE),
    "quarter": SHAFT.format(half="half: z, ", cut="flat, to: shaft.symmetry", material=FINITE).replace(
        ("faces:\n  - left: {of: shaft.flat, upper: [inf, inf, 0]}\n"
         "  - right: {of: shaft.flat, lower: [-inf, -inf, 0]}\n"), ""),
    "fit_whole": fit(True, LINEAR),
    "fit": fit(False, LINEAR),
    "disc_whole": bladed(6, True),
    "disc": bladed(1, False),
    "fifty": twist("0, 50", 2, LINEAR),
    "unlike": unlike(),
    "one": twist("0, 60", 2, LINEAR).replace("value: [0, 0, 0]}", "value: [0, free, 0]}"),
    "same": twist("0, 60", 2, LINEAR).replace("to: tube.amax", "to: tube.amin"),
    "digits": twist("0, 60", 2, LINEAR).replace(
        "shape: tube_arc, axis: z, center: [3, -1, 0], radii: [1, 2], angles: [0, 60], extent: [0, 3],\n"
        "      cells: [2, 2, 3]", "mesh: digits.inp, volume: tube, curved: false"),
}


def write_digits():
    """The mesh of the scene sector with coordinates of five digits"""
    places = [(r, a, z) for z in range(4) for a in (0, 30, 60) for r in (1, 1.5, 2)]
    with open("digits.inp", "w") as deck:
        deck.write("*NODE\n")
        for number, (r, a, z) in enumerate(places, 1):
            x, y = 3 + r * math.cos(math.radians(a)), -1 + r * math.sin(math.radians(a))
            deck.write(f"{number}, {x:.5g}, {y:.5g}, {z}\n")
        deck.write("*ELEMENT, TYPE=C3D8, ELSET=tube\n")
        cells = [9 * k + 3 * j + i for k in range(3) for j in range(2) for i in (1, 2)]
        for number, first in enumerate(cells, 1):
            base = [first, first + 1, first + 4, first + 3]
            deck.write(", ".join(map(str, [number, *base, *(node + 9 for node in base)])) + "\n")
        for name, inside in (("amin", lambda p: p[1] == 0), ("amax", lambda p: p[1] == 60),
                             ("lmin", lambda p: p[2] == 0), ("lmax", lambda p: p[2] == 3)):
            deck.write(f"*NSET, NSET={name}\n" + "".join(f"{n}\n" for n, p in enumerate(places, 1) if inside(p)))


def energy(name):
    return load(name)["steps"][-1]["energy"]


def axial(name):
    return load(name)["steps"][-1]["pairs"][0]["moment"][2]


def judge():
    for name, whole, n in ("sector", "whole", 6), ("backwards", "whole", 3), ("finite", "finite_whole",
                                                                              6), ("half", "quarter", 0.5):
        say(f"{name}: {n} of its energy are that of {whole}", within(n * energy(name), energy(whole), 1e-9),
            (n * energy(name), energy(whole)))
    say("coordinates with five digits: the energy of sector", within(energy("digits"), energy("sector"), 1e-4),
        energy("digits"))
    say("the same on three ranks", within(energy("finite_3"), energy("finite"), 1e-9), energy("finite_3"))
    say("pulled bar with nodes on the axis: a uniform stress",
        within(energy("pull"), 0.5 * 1000 * 0.01**2 * math.sqrt(3) * 3, 1e-9), energy("pull"))
    say("disc with blades: a sixth of the whole one", within(6 * energy("disc"), energy("disc_whole"), 1e-9),
        (6 * energy("disc"), energy("disc_whole")))
    fits("", 2e-2, 2e-3)
    say("the same on three ranks", within(energy("fit_3"), energy("fit"), 1e-7), energy("fit_3"))


def fits(suffix, tolerance, close):
    one, two = "fit" + suffix, "fit_whole" + suffix
    say("press fit that is turned: energy as of the whole one", within(6 * energy(one), energy(two), tolerance),
        (6 * energy(one), energy(two)))
    say("press fit that is turned: torque as of the whole one", within(6 * axial(one), axial(two), close),
        (6 * axial(one), axial(two)))


if sys.argv[1] == "scenes":
    for key, text in SCENES.items():
        with open(key + ".yaml", "w") as file:
            file.write(text)
    write_digits()
elif sys.argv[1] == "judge":
    judge()
else:
    fits("_1", 1e-3, 1e-4)
