"""Scenes for whole_shapes.sh: python whole_shapes.py write|judge."""
import math
import sys

from summaries import load, say, within

MATERIAL = "young: 1000, poisson: 0.3"


def write():
    tube = ("bodies:\n"
            "  - tube: {shape: tube_arc, axis: y, center: [1, 0, 2], radii: [1, 2], angles: [%s], extent: [0, 1], "
            "cells: [2, %d, 1], %s}\n"
            "pressures:\n"
            "  - inside: {face: tube.inner, value: 1}\n"
            "weak_springs: true\n"
            "symmetry: [tube.lmin, tube.lmax%s]\n")
    rod = ("bodies:\n"
           "  - rod: {shape: cylinder, axis: x, center: [0, 1, -1], radius: 2, extent: [0, 3], cells: [2, 2, 3], "
           "young: 1000, poisson: 0%s}\n"
           "weak_springs: true\n"
           "symmetry: [rod.lmin]\n"
           "displacements:\n"
           "  - pull: {face: rod.lmax, value: [0.003, free, free]}\n")
    block = ("bodies:\n  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], %s}\ndisplacements:\n"
             "  - foot: {face: block.zmin, value: [0, 0, 0]}\n%sload: {steps: 2}\n%s")
    two = ("  - down: {face: block.zmax, value: [0.01, 0, -0.03]}\n"
           "  - along: {face: block.zmax, value: [0.02, 0.01, 0.01], ramp: later}\n")
    one = "  - both: {face: block.zmax, value: [0.03, 0.01, -0.02]}\n"
    pin = ("bodies:\n"
           "  - ring: {shape: tube_arc, axis: z, radii: [1.05, 2], angles: [-180, 180], extent: [0, 0.5], "
           "cells: [2, 24, 1], %s}\n"
           "  - pin: {shape: cylinder, axis: z, radius: 1, extent: [0, 0.5], cells: [6, 2, 1], %s}\n"
           "contact: auto\nsymmetry: [ring.lmin, ring.lmax, pin.lmin, pin.lmax]\ndisplacements:\n"
           "  - rim: {face: ring.outer, value: [0, 0, 0]}\n"
           "  - axle: {body: pin, from: [0, 0, 0], to: [0, 0, 0.5], value: [0, 0.06, free]}\n"
           "  - turn: {body: pin, point: [1, 0, 0], value: [free, 0.06, free]}\n")
    # A pin that is too large for its ring: nothing but the shape of the true contact surface resists that it turns
    fit = (
        "bodies:\n  - pin: {shape: cylinder, axis: z, radius: 1.001, extent: [0, 2], cells: [3, 3, 5], %s}\n"
        "  - ring: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 360], extent: [0, 2], cells: [3, 24, 5], %s}\n"
        "symmetry: [ring.lmin, pin.lmin]\ncontact:\n"
        "  - fit: {mortar: ring.inner, nonmortar: pin.surface, interference: true}\nweak_springs: %s\n")
    kirsch = (
        "bodies:\n"
        "  - plate: {shape: holed_box, axis: z, lower: [0, 0, 0], upper: [20, 20, 0.5], radius: 1, cells: "
        "[8, 3, 1], grading: [30, 1, 1], %s, order: 2}\n"
        "symmetry: [plate.xmin, plate.ymin, plate.zmin]\ntractions:\n  - pull: {face: plate.xmax, value: [1, 0, 0]}\n"
        "probes:\n  - top: {point: [0, 1, 0]}\n  - side: {point: [1, 0, 0]}\n")
    for name, text in {
            "kirsch": kirsch % MATERIAL,
            "fit": fit % (MATERIAL, MATERIAL, "true"),
            "fit_finite": fit % (MATERIAL + ", material: neohookean", MATERIAL + ", material: neohookean", "true"),
            "fit_springs": fit % (MATERIAL, MATERIAL, "1e-3"),
            "whole": tube % ("30, 390", 16, MATERIAL, ""),
            "quarter": tube % ("0, 90", 4, MATERIAL, ", tube.amin, tube.amax"),
            "rod": rod % "",
            "rod_order2": rod % ", order: 2",
            "oblique": block % (MATERIAL, two, "ramps:\n  - later: {factors: [0, 1]}\n"),
            "straight": block % (MATERIAL, one, ""),
            "refused": block %
        (MATERIAL, two.replace("0.01, 0, -0.03", "0.01, free, -0.03"), "ramps:\n  - later: {factors: [0, 1]}\n"),
            "pin": pin % (MATERIAL, MATERIAL),
            "graded": tube % ("0, 360", 8, MATERIAL + ", grading: [1, 2, 1]", ""),
    }.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)


def judge():
    energy = {
        name: load(name)["steps"][-1]["energy"]
        for name in ("whole_0", "whole_1", "whole_2", "quarter_0", "quarter_1", "quarter_2", "rod_0", "rod_1", "rod_2",
                     "rod_order2_1", "oblique_0", "straight_0")
    }
    for refine in range(3):
        say(f"whole tube, refine {refine}: four quarters",
            within(energy[f"whole_{refine}"], 4 * energy[f"quarter_{refine}"], 1e-6), energy)
    for refine in range(3):
        n = 8 * 2**refine
        polygon = n / 2 * math.sin(2 * math.pi / n) * 4 * 3
        say(f"cylinder, refine {refine}: the volume of a prism of {n} sides",
            within(energy[f"rod_{refine}"], 0.5 * 1000 * 0.001**2 * polygon, 1e-7), energy)
    say("cylinder of order 2: the volume to 1e-4",
        within(energy["rod_order2_1"], 0.5 * 1000 * 0.001**2 * math.pi * 12, 1e-4), energy)
    say("two oblique motions of a face add up", within(energy["oblique_0"], energy["straight_0"], 1e-9), energy)
    top, side = (load("kirsch_0")["steps"][-1]["probes"][k]["displacement"] for k in (0, 1))
    say("plate with a hole: it widens as Kirsch says",
        within(side[0], 3e-3, 5e-3) and within(top[1], -1e-3, 1e-2), (top, side))
    springs = load("fit_springs_0")["steps"][-1]
    for name in "fit", "fit_finite":
        step = load(name + "_0")["steps"][-1]
        say(
            f"{name}: a pin that may turn is pressed as one on stiffer springs",
            within(step["pairs"][0]["normal_force"], springs["pairs"][0]["normal_force"], 1e-2)
            and within(step["energy"], springs["energy"], 1e-2),
            (step["pairs"][0]["normal_force"], springs["pairs"][0]["normal_force"], step["energy"], springs["energy"]))
    pair = load("pin_1")["steps"][-1]["pairs"][0]
    say("pin in a ring: it presses where it is pushed",
        abs(pair["force"][1]) > 0.1 and abs(pair["force"][0]) < 1e-3 * abs(pair["force"][1]), pair["force"])


{"write": write, "judge": judge}[sys.argv[1]]()
