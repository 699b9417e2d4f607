"""Judges the run of gearbox_long.sh: bolts, equilibrium of each part, friction, energy, and the report page"""
import os

from summaries import load, say

PRELOAD, PUSH, MOMENT, FRICTION = 12000, 400, 4000, 0.15  # as in share/scenes/gearbox.py

run = load("gearbox")
tighten, drive = run["steps"]
say("both load steps converge", run["converged"], run["reason"])
say("33 parts", len(drive["bodies"]) == 33, len(drive["bodies"]))
forces = [bolt["force"] for bolt in tighten["bolts"]]
say("the six bolts have their pretension",
    len(forces) == 6 and all(abs(force / PRELOAD - 1) < 1e-6 for force in forces), forces)
same = [abs(a["shortening"] - b["shortening"]) for a, b in zip(tighten["bolts"], drive["bolts"])]
say("locked bolts keep their shortening", max(same) == 0, same)
forces = [bolt["force"] for bolt in drive["bolts"]]
say("and nearly their forces, since friction carries the load of the gear",
    all(abs(force / PRELOAD - 1) < 1e-3 for force in forces), forces)
for step in run["steps"]:
    worst = max(step["bodies"], key=lambda body: max(map(abs, body["residual"])))
    say(f"load step {step['step']}: each part is in equilibrium",
        max(map(abs, worst["residual"])) < 1e-6 * PRELOAD, worst)
    beyond = max(pair["shear_force"] - FRICTION * pair["normal_force"] for pair in step["pairs"])
    say(f"load step {step['step']}: friction is within its bound", beyond < 1e-6 * PRELOAD, beyond)
    left = abs(step["imbalance"])
    say(f"load step {step['step']}: the work of bolts and loads is stored or dissipated", left < 1e-3, left)
foot = drive["faces"][0]
say("the foot carries the load of the gear",
    abs(foot["reaction"][0]) + abs(foot["reaction"][1] + PUSH) + abs(foot["reaction"][2]) < 1e-6 * PUSH,
    foot["reaction"])
say("and its moment", abs(foot["moment"][2] / MOMENT + 1) < 1e-3, foot["moment"])
with open("gearbox.html") as file:
    page = file.read()
say("the report page has pictures and all bolts", "<img" in page and all(f"m8_{k}" in page for k in range(1, 7)),
    os.path.getsize("gearbox.html"))
