"""Scenes for ties.sh, and their answers: python ties.py write|judge."""
import sys

import numpy as np

from summaries import load, say

LOW = "{lower: [0, 0, 0], upper: [3, 2, 1], cells: [3, 2, 2], %syoung: 10, poisson: 0.3}"
TOP = "{lower: [0, 0, 1], upper: [3, 2, 2.5], cells: [4, 5, 3], %syoung: 10, poisson: 0.3}"
TWO = "bodies:\n  - low: " + LOW + "\n  - top: " + TOP + "\n"
GLUE = "ties:\n  - glue: {mortar: low.zmax, nonmortar: top.zmin}\n"
PROBES = ("probes:\n  - corner: {point: [3, 2, 2.5]}\n  - inside: {point: [1.3, 0.7, 1.4]}\n"
          "  - below: {point: [1.3, 0.7, 0.4]}\n")
SYMMETRY = "symmetry: [low.xmin, low.ymin, low.zmin, top.xmin, top.ymin]\n"
STRESS = np.array([[0.3, 0.05, -0.1], [0.05, -0.2, 0.15], [-0.1, 0.15, 0.1]])
FINITE = "material: neohookean, "


def tractions():
    """A uniform stress from outside, on all faces but those that are tied"""
    faces = [(b, f) for b in ("low", "top") for f in ("xmin", "xmax", "ymin", "ymax")] + [("low", "zmin"),
                                                                                          ("top", "zmax")]
    return "tractions:\n" + "".join("  - %s_%s: {face: %s.%s, value: %s}\n" %
                                    (b, f, b, f, list((-1 if f.endswith("min") else 1) * STRESS["xyz".index(f[0])]))
                                    for b, f in faces)


SCENES = {
    "pull": TWO % ("", "") + SYMMETRY + "tractions:\n  - up: {face: top.zmax, value: [0, 0, 0.1]}\n" + GLUE + PROBES,
    "uniform": TWO % ("", "") + tractions() + "weak_springs: 1e-9\n" + GLUE + PROBES,
    "finite": TWO % (FINITE, FINITE) + SYMMETRY +
    "displacements:\n  - top: {face: top.zmax, value: [free, free, 0.5]}\nload: {steps: 2}\n" + GLUE + PROBES,
    "whole": "bodies:\n  - low: " + LOW.replace("2, 1]", "2, 2.5]") % FINITE +
    ("\nsymmetry: [low.xmin, low.ymin, low.zmin]\ndisplacements:\n"
     "  - top: {face: low.zmax, value: [free, free, 0.5]}\nload: {steps: 2}\n") + PROBES,
    "touch": TWO % ("", "") +
    ("  - lid: {lower: [-1, -1, 2.5], upper: [4, 3, 3], cells: [5, 5, 1], young: 10, poisson: 0}\n"
     "symmetry: [low.xmin, low.ymin, low.zmin, top.xmin, top.ymin]\n") +
    ("displacements:\n  - under: {face: lid.zmin, value: [0, 0, -0.025]}\n"
     "  - over: {face: lid.zmax, value: [0, 0, -0.025]}\ncontact:\n"
     "  - push: {mortar: lid.zmin, nonmortar: top.zmax}\n") + GLUE + PROBES.replace("2.5]}", "2.5], body: top}"),
    "tied_touch": TWO.replace("top: {lower: [0, 0, 1]", "top: {lower: [0.6, 0.4, 1]").replace(
        "upper: [3, 2, 2.5]", "upper: [2.4, 1.6, 2.5]") % ("", "") +
    "  - base: {lower: [-1, -1, -1], upper: [4, 3, 0], material: rigid, cells: [2, 2, 1]}\nsymmetry: []\n" +
    ("displacements:\n  - base: {body: base, value: [0, 0, 0]}\nforces:\n"
     "  - down: {face: top.zmax, value: [0, 0, -0.3]}\nweak_springs: true\ncontact:\n"
     "  - stand: {mortar: base.zmax, nonmortar: low.zmin}\n") + GLUE,
}


def near(a, b, size, within=1e-6):
    return bool(np.linalg.norm(np.subtract(a, b)) <= within * size)


def stress(probe):
    return [probe["stress_" + c] for c in ("xx", "yy", "zz", "xy", "yz", "zx")]


def judge():
    steps = {name: load(name)["steps"][-1] for name in SCENES}
    probes = {name: step["probes"] for name, step in steps.items()}
    say(
        "pulled: stress and displacement to 1e-11",
        all(
            near(stress(p), [0, 0, 0.1, 0, 0, 0], 0.1, 1e-11)
            and near(p["displacement"], np.multiply([-0.003, -0.003, 0.01], place), 0.03, 1e-11)
            for p, place in zip(probes["pull"], ([3, 2, 2.5], [1.3, 0.7, 1.4], [1.3, 0.7, 0.4]))), probes["pull"])
    body = steps["pull"]["bodies"][1]
    say("pulled: what the tie carries, in balance",
        near(body["ties"], [0, 0, -0.6], 0.6) and steps["pull"]["balance"] < 1e-11, body)
    s = STRESS
    say("any uniform stress passes",
        all(near(stress(p), [s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]], 0.3) for p in probes["uniform"]),
        probes["uniform"])
    say(
        "finite strain: as one body",
        near(steps["finite"]["energy"], steps["whole"]["energy"], steps["whole"]["energy"]) and all(
            near(a["displacement"], b["displacement"], 0.5) and near(stress(a), stress(b), 2)
            for a, b in zip(probes["finite"], probes["whole"])), (probes["finite"], probes["whole"]))
    say(
        "pressed by contact: stress and displacement",
        all(near(stress(p), [0, 0, -0.1, 0, 0, 0], 0.1) for p in probes["touch"])
        and near(probes["touch"][0]["displacement"], [0.009, 0.006, -0.025], 0.025), probes["touch"])
    step = steps["tied_touch"]
    say(
        "a tied stack stands on a rigid base: forces",
        near(step["pairs"][0]["force"], [0, 0, 0.3], 0.3) and near(step["bodies"][0]["ties"], [0, 0, -0.3], 0.3)
        and step["balance"] < 1e-6, (step["pairs"], step["bodies"]))


def judge_units():
    for unit in ("e-15", "e-11", "e14"):
        steps = {name: load("%s_%s" % (name, unit))["steps"][-1] for name in ("pull", "tied_touch")}
        force, probe = float("1" + unit), steps["pull"]["probes"][0]
        say(
            "unit of force 1%s, pulled: stress and displacement to 1e-11" % unit,
            near(stress(probe), [0, 0, 0.1 * force, 0, 0, 0], 0.1 * force, 1e-11)
            and near(probe["displacement"], [-0.009, -0.006, 0.025], 0.03, 1e-11), probe)
        energy = load("tied_touch")["steps"][-1]["energy"] * force
        say("unit of force 1%s, a tied stack: energy to 1e-9" % unit,
            near(steps["tied_touch"]["energy"], energy, energy, 1e-9), (steps["tied_touch"]["energy"], energy))


def main():
    if sys.argv[1] == "write":
        for name, text in SCENES.items():
            with open(name + ".yaml", "w") as file:
                file.write("problem: %s\n%s" % (name, text.replace("symmetry: []\n", "")))
    else:
        judge()
        judge_units()


if __name__ == "__main__":
    main()
