"""Holds the summaries that step_models.sh wrote against exact values and against each other."""
from summaries import load, say, within

# strain of the bar at height z: -(p + w (3 - z)) / E; its energy int E e^2 / 2 over area 2, of the piecewise linear
# interpolant whose nodes are exact
E, AREA, LENGTH, CELLS, P, W = 10, 2, 3, 4, 0.5, 0.3


def displacement(z, w):
    return -(P * z + w * (LENGTH * z - z * z / 2)) / E


def energy(w):
    h = LENGTH / CELLS
    nodes = [displacement(i * h, w) for i in range(CELLS + 1)]
    return sum(E * AREA * (b - a)**2 / (2 * h) for a, b in zip(nodes, nodes[1:]))


bar = load("bar")["steps"]
for step, w in zip(bar, (0, W)):
    say("bar, step %d: energy exact to 1e-8" % step["step"], within(step["energy"], energy(w), 1e-8), step["energy"])
    say("bar, step %d: the foot bears pressure and weight" % step["step"],
        within(step["reaction"][2], AREA * (P + w * LENGTH), 1e-8), step["reaction"])
    say("bar, step %d: stored energy is half the work of dead loads" % step["step"],
        within(step["potential"], -step["energy"], 1e-8), step["potential"])

names = ("energy", "quadratic", "updated_2", "updated_5", "untrue", "press", "squash", "gentle")
runs = {name: load(name) for name in names}
last = {name: run["steps"][-1] for name, run in runs.items()}
say("energy: equilibrium to 1e-8", last["energy"]["equilibrium"] <= 1e-8, last["energy"]["equilibrium"])
say("quadratic: no equilibrium, by more than 1e-4", last["quadratic"]["equilibrium"] > 1e-4,
    last["quadratic"]["equilibrium"])
say("the linear block was assembled once, the other body again and again", runs["energy"]["assemblies"]["block"] == 1
    and runs["energy"]["assemblies"]["base"] > 4, runs["energy"]["assemblies"])
say("one linearization of the gap leaves penetration", last["energy"]["gap_true"] < -1e-4, last["energy"]["gap_true"])
for name in ("updated_2", "updated_5"):
    say("%s: the true gap within 1e-6 of the displacement" % name, -0.6e-6 <= last[name]["gap_true"]
        and last[name]["contact_updates"] < 20, (last[name]["gap_true"], last[name]["contact_updates"]))
say("updated to the end, 2 and 5 load steps give the same energy to 1e-5",
    within(last["updated_2"]["energy"], last["updated_5"]["energy"], 1e-5),
    (last["updated_2"]["energy"], last["updated_5"]["energy"]))
untrue = runs["untrue"]
say(
    "a limit on linearizations that comes too early is said, and no convergence", not untrue["converged"]
    and last["untrue"]["gap_unconverged"] and untrue["exit_code"] == 3
    and "the gap still changes by" in untrue["reason"], untrue["reason"])
say(
    "one linearization that is asked for converges, and says how far its gap is off", runs["energy"]["converged"]
    and last["energy"]["gap_unconverged"] and "contact gap error up to" in runs["energy"]["reason"],
    runs["energy"]["reason"])
say("a large step that inverts no element was not cut", not last["press"]["cuts"], last["press"]["cuts"])
say("the step that was too large was cut", last["squash"]["cuts"] > 0 and last["squash"]["substeps"] > 1,
    (last["squash"]["cuts"], last["squash"]["substeps"]))
say("cut or not, the same energy to 1e-8", within(last["squash"]["energy"], last["gentle"]["energy"], 1e-8),
    (last["squash"]["energy"], last["gentle"]["energy"]))
say("nothing of contact in a scene without it",
    not any(step[key] for step in runs["squash"]["steps"] for key in ("pairs", "contact_updates", "filtered_systems")),
    last["squash"])
