"""friction_clutch.py: the torque of the clutch of friction_clutch.sh"""
from summaries import load, say

FRICTION, RADIUS = 0.3, 50


def torque(step):
    """Torque over that of a round disc under uniform pressure, 2/3 of friction times force times radius"""
    pair = step["pairs"][0]
    return pair["moment"][2] / (2 / 3 * FRICTION * pair["normal_force"] * RADIUS)


ratios = [torque(step) for step in load("clutch")["steps"]]
say("no torque when pressed", abs(ratios[0]) < 1e-6, ratios)
say("torque when turned and when turned back", abs(ratios[1] + 1) < 0.01 and abs(ratios[2] - 1) < 0.01, ratios)
