"""The forces on the wedge of friction_wedge.sh.

They are equal on both sides, also at the tip, where equilibrium alone does not say how much of them each plane takes;
within the cone of friction; and none at the end."""
from summaries import load, say

steps = load("wedge")["steps"]
pressed = [[pair["normal_force"] for pair in step["pairs"]] for step in steps]
alike = all(abs(a - b) < 1e-5 * pressed[1][0] for a, b in pressed)
say("pressed alike by both faces", alike and 0 < pressed[0][0] < pressed[1][0], pressed)
say("without force at the end", max(pressed[-1]) < 1e-9 * pressed[1][0], pressed)
cuts = [step["cuts"] for step in steps]
say("no load step is cut, although rounding errors are all that is left at the end", not any(cuts), cuts)
most = max(step["ip_iterations"] for step in steps)
say("no load step takes more than 15 iterations: where nothing is left to solve, rounding errors count as none",
    most <= 15, [step["ip_iterations"] for step in steps])
