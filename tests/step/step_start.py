"""The starts of step_start.sh, and the forces to which they lead"""
from neo_hookean import uniaxial
from summaries import load, say, within


def start(name):
    """Objective and violation of the gaps at the first iterate of Newton's method"""
    lines = open(name + ".log").read().splitlines()
    newton = next(i for i, line in enumerate(lines) if line.startswith("iter") and "lg(mu)" in line)
    return [float(word) for word in next(line for line in lines[newton:] if line.startswith("   0 ")).split()[1:3]]


for way, ranks in (("free", (1, 2)), ("held", (1, ))):
    runs = [f"{way}_{n}" for n in ranks]
    starts = [start(run) for run in runs]
    say(f"block {way}: starts without penetration", all(gap < 1e-9 for _, gap in starts), starts)
    say("  at the same place", all(within(f, starts[0][0], 1e-5) for f, _ in starts), starts)
    steps = [load(run)["steps"] for run in runs]
    say("  without a cut, to the same energy",
        all(step[0]["cuts"] == 0 and within(step[0]["energy"], steps[0][0]["energy"], 1e-8) for step in steps), steps)
    forces = [abs(step[0]["reaction"][0]) for step in steps]
    exact = uniaxial(0.8, 10, 0.3)[1]
    if way == "free":
        say("  with the force of the closed form", all(within(force, exact, 1e-6) for force in forces), forces)

sides = [pair["normal_force"] for pair in load("wedge")["steps"][0]["pairs"]]
say("wedge: the same force on both sides, in any order of messages", within(sides[0], sides[1], 1e-5), sides)
