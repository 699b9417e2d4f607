"""sliding.py write: a die that slides over a flat, and a pin that goes round in a hole, 20 steps each; judge: the
forces that sliding.sh found."""
import math
import sys

import numpy as np

from summaries import each, load, say

STEPS = 20
DIE, PRESS, SLIDE = 4.0, 0.1, 0.75  # radius, how deep it is pressed, how far it slides: three cells of the flat
HOLE, PIN, FURTHER = 10.0, 9.8, 0.01  # radii, how much farther than its play the pin goes

FLAT = """bodies:
  - flat: {{lower: [-6, 0, -3], upper: [6, 1, 0], cells: [48, 1, 12], young: 1000, poisson: 0.3, element: full}}
  - die: {{shape: tube_arc, axis: y, center: [0, 0, {radius}], radii: [{inner}, {radius}], angles: [135, 225],
          extent: [0, 1], cells: [3, {around}, 1], young: 1000, poisson: 0.3, element: full}}
displacements:
  - bottom: {{face: flat.zmin, value: [0, 0, 0]}}
  - press: {{face: die.inner, value: [free, 0, {press}]}}
  - slide: {{face: die.inner, value: [{slide}, free, free], ramp: along}}
symmetry: [flat.ymin, flat.ymax, die.lmin, die.lmax]
contact:
  - pair: {{mortar: {sides[0]}, nonmortar: {sides[1]}{gap}}}
load: {{factors: [{whole}]}}
ramps:
  - along: {{factors: [{along}]}}
"""
ROUND = """bodies:
  - hole: {{shape: tube_arc, axis: y, radii: [{hole}, 16], angles: [80, 280], extent: [0, 1], cells: [4, 60, 1],
           young: 1000, poisson: 0.3, element: full}}
  - pin: {{shape: tube_arc, axis: y, radii: [4.8, {pin}], angles: [90, 270], extent: [0, 1], cells: [4, 54, 1],
          young: 1000, poisson: 0.3, element: full}}
displacements:
  - rim: {{face: hole.outer, value: [0, 0, 0]}}
  - along: {{face: pin.inner, value: [{way}, free, free], ramp: sine}}
  - down: {{face: pin.inner, value: [free, 0, -{way}], ramp: cosine}}
symmetry: [hole.lmin, hole.lmax, pin.lmin, pin.lmax]
contact:
  - pair: {{mortar: hole.inner, nonmortar: pin.outer}}
load: {{steps: {steps}}}
ramps:
  - sine: {{factors: [{sine}]}}
  - cosine: {{factors: [{cosine}]}}
"""


def numbers(values):
    return ", ".join("%.15g" % v for v in values)


def write():
    times = [i / STEPS for i in range(STEPS + 1)]
    angles = [math.radians(50 * t - 25) for t in times]
    sides = ("flat.zmax", "die.outer")
    for name, around, pair, gap in (("die", 16, sides, ""), ("flat", 24, sides[::-1], ""), ("dual", 24, sides[::-1],
                                                                                            ", gap: dual")):
        with open(name + ".yaml", "w") as file:
            file.write(
                FLAT.format(radius=DIE, inner=DIE - 1.5, around=around, press=-PRESS, slide=SLIDE, sides=pair, gap=gap,
                            whole=numbers([1] * len(times)), along=numbers(times)))
    with open("pin.yaml", "w") as file:
        file.write(
            ROUND.format(hole=HOLE, pin=PIN, way=HOLE - PIN + FURTHER, steps=len(times),
                         sine=numbers(map(math.sin, angles)), cosine=numbers(map(math.cos, angles))))


def judge():
    for name, limit in (("die", 0.1), ("pin", 0.5), ("flat", 1.1), ("dual", 1.1)):
        run = load(name)
        force = np.array([np.linalg.norm(step["pairs"][0]["force"]) for step in run["steps"]])
        x = np.linspace(-1, 1, len(force))
        off = 100 * (force / np.polyval(np.polyfit(x, force, 3), x) - 1)
        say("%s: %d steps, all converged" % (name, len(force)), run["converged"] and len(force) == STEPS + 1,
            run["reason"])
        say("%s: the force is within %g %% of a smooth trend, and jumps by no more" % (name, limit),
            max(abs(off).max(),
                abs(np.diff(off)).max()) <= limit, off.tolist())
        say(name + ": gaps true to 1e-6",
            max(each(run, "gap_change")) <= 1e-6 and min(each(run, "gap_true")) >= -1e-6,
            (each(run, "gap_change"), each(run, "gap_true")))
        say(name + ": each body in balance to 1e-8", max(each(run, "balance")) <= 1e-8, each(run, "balance"))
        say(name + ": no step is cut, no update damped", not sum(each(run, "cuts")) and not sum(each(run, "gap_damped"))
            and not run["warnings"], run["warnings"])
        updates = each(run, "contact_updates")
        say(name + ": 5 linearizations a step at most, 3.5 in the mean",
            max(updates) <= 5 and np.mean(updates) <= 3.5, updates)


if __name__ == "__main__":
    {"write": write, "judge": judge}[sys.argv[1]]()
