"""What the runs of thermal.sh say, against statics."""
from summaries import load, say

YOUNG, EXPANSION = 200, 1e-3
runs = {name: load(name) for name in ("bodies", "bodies_3", "again", "gap", "gap_3")}
one, two = runs["bodies"]["steps"]
pressed = YOUNG * EXPANSION * 20
say("a held bar is pressed by E alpha T", abs(two["faces"][0]["reaction"][0] - pressed) < 1e-8 * pressed, two["faces"])
say("free bodies of every element take no energy",
    abs(two["energy"] - pressed**2 / (2 * YOUNG) * 4) < 1e-6 * two["energy"], two["energy"])
say("half of it at half the load", abs(one["faces"][0]["reaction"][0] - pressed / 2) < 1e-8 * pressed, one["faces"])
for name, reference in (("bodies_3", "bodies"), ("again", "gap"), ("gap_3", "gap")):
    a, b = runs[name]["steps"][-1], runs[reference]["steps"][-1]
    say(name + ": the energy of " + reference, abs(a["energy"] / b["energy"] - 1) < 1e-9, (a["energy"], b["energy"]))
for number, step in enumerate(runs["gap"]["steps"], 1):
    free = EXPANSION * number / 4 * 15 * 10  # of the bar's length
    force = max(0, YOUNG * (free - 0.1) / 10)
    say("load step %d: the bar pushes by E (alpha T - gap/length)" % number,
        abs(step["pairs"][0]["force"][0] + force) < 1e-6 * YOUNG * EXPANSION * 10, (step["pairs"][0]["force"], force))
