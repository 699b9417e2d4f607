"""Scenes for coarse_mortar.sh, and what they must show: python coarse_mortar.py write|judge."""
import sys

import numpy as np

from forces import Fields, near
from summaries import load, say

# A flat die of area 3 on a slab of larger cells, its edges within their facets
DIE = """problem: {name}
bodies:
  - slab: {{lower: [0, 0, 0], upper: [6, 4, 2], cells: {slab}, young: 1000, poisson: 0.3}}
  - die: {{lower: [1.5, 1, 2], upper: [4.5, 2, 3], cells: {die}, young: {young}, poisson: 0.3}}
displacements:
  - ground: {{face: slab.zmin, value: [0, 0, 0]}}
  - press: {{face: die.zmax, value: {press}}}
contact:
  - pair: {{mortar: slab.zmax, nonmortar: die.zmin, {pair}}}
"""
DIES = {
    "stiff": dict(slab=[6, 4, 2], die=[15, 5, 4], young=200e3, pair="gap: mortar"),
    "finer": dict(slab=[12, 8, 4], die=[15, 5, 4], young=200e3, pair="gap: mortar"),
    "halves": dict(slab=[6, 4, 2], die=[6, 2, 2], young=200e3, pair="gap: mortar"),
    "alike": dict(slab=[6, 4, 2], die=[15, 5, 4], young=10e3, pair="gap: mortar"),
    "node": dict(slab=[6, 4, 2], die=[15, 5, 4], young=200e3, pair="gap: node"),
    "rubs": dict(slab=[6, 4, 2], die=[15, 5, 4], young=200e3, pair="friction: 0.3", press=[0.004, 0, -0.02]),
}
# A rubber pad on a rigid floor of one cell, which carries the constraints or does not
PAD = """problem: {name}
bodies:
  - floor: {{lower: [-1, -1, -1], upper: [3, 3, 0], cells: [1, 1, 1], material: rigid}}
  - pad: {{lower: [0, 0, 0], upper: [2, 2, 1], cells: [2, 2, 2], young: 10, poisson: 0.49, element: bbar}}
displacements:
  - ground: {{body: floor, value: [0, 0, 0]}}
pressures:
  - press: {{face: pad.zmax, value: 1}}
contact:
  - pair: {{{sides}, stick: true}}
"""
PADS = {
    "mean": "mortar: pad.zmin, nonmortar: floor.zmax", "vertices": "mortar: floor.zmax, nonmortar: pad.zmin",
    "points": "mortar: floor.zmax, nonmortar: pad.zmin, gap: node"
}
# largest pressure over the mean: that of a punch on such cells
MEAN = {"stiff": 2.5, "finer": 2.5, "halves": 2, "alike": 2, "node": 3, "rubs": 3}


def write():
    for name, values in DIES.items():
        with open(name + ".yaml", "w") as file:
            file.write(DIE.format(name=name, **{"press": [0, 0, -0.02], **values}))
    for name, sides in PADS.items():
        with open(name + ".yaml", "w") as file:
            file.write(PAD.format(name=name, sides=sides))


def judge_die(name, run):
    pair, fields = load(run)["steps"][-1]["pairs"][0], Fields(run)
    pressure, area, status = (np.nan_to_num(fields.values["contact_" + what])
                              for what in ("pressure", "area", "status"))
    force = np.nan_to_num(fields.values["contact_force"])
    say("%s: the area is the die's to 1 %%" % run, abs(pair["area"] / 3 - 1) <= 0.01, pair["area"])
    say("%s: all vertices with pressure are closed, on both sides" % run, bool((status[pressure > 0] > 0).all()),
        status[(pressure > 0) & (status == 0)].size)
    say("%s: the largest pressure is at most %g times the mean" % (run, MEAN[name]),
        pair["pressure"] <= MEAN[name] * pair["normal_force"] / 3, pair["pressure"] / pair["normal_force"] * 3)
    die = fields.body == 1
    say("%s: the area is that of the die's closed vertices" % run,
        near(area[die & (status > 0)].sum(), pair["area"], 1e-12), area[die & (status > 0)].sum())
    say("%s: pressure times area is the force on each side" % run,
        all(near((pressure * area)[fields.body == b].sum(), pair["normal_force"], 1e-10) for b in (0, 1)), pair)
    say("%s: the vertices' forces sum to the pair's" % run, near(force[die].sum(axis=0), pair["force"], 1e-10), pair)
    if name == "rubs":
        shear = np.linalg.norm(np.nan_to_num(fields.values["contact_shear"]), axis=1)
        say("%s: what sticks and what slips is what is closed" % run,
            near(pair["stick_area"] + pair["slip_area"], pair["area"], 1e-12), pair)
        say("%s: no shear is beyond friction times pressure" % run,
            bool((shear <= 0.3 * pressure + 1e-9 * pressure.max()).all()), (shear - 0.3 * pressure).max())


def judge_pad(name, run):
    summary, fields = load(run), Fields(run)
    step, pad = summary["steps"][-1], fields.body == 1
    lowest = -min(0, (fields.x + fields.values["displacement"])[pad, 2].min())
    pair = step["pairs"][0]
    say("%s: the penetration is that of the lowest vertex" % run,
        abs(pair["penetration"] - lowest) <= 1e-12, (pair["penetration"], lowest))
    say("%s: the mean gap is closed" % run, abs(step["gap_true"]) <= 1e-6, step["gap_true"])
    warned = [warning for warning in summary["warnings"] if "penetrates the other body" in warning]
    say(
        "%s: a vertex %s" %
        (run, "goes through the floor, and is warned of" if name == "mean" else "stays above the floor"),
        (lowest > 0.04 and len(warned) == 1) if name == "mean" else lowest <= 1e-12 and not warned, (lowest, warned))


def judge():
    for name in PADS:
        judge_pad(name, name)
    for name in DIES:
        judge_die(name, name)
    judge_die("rubs", "rubs_3")


if __name__ == "__main__":
    {"write": write, "judge": judge}[sys.argv[1]]()
