"""A block with its weight, and half of it or so sideways: it tips where the resultant leaves its face, whatever its
cells are. A roof of pressure by dual functions.

python3 edge_resultant.py scenes writes the scenes; python3 edge_resultant.py judges the runs that edge_resultant.sh has
made.
"""
import sys

from summaries import load, say, within

BLOCK = """problem: tip
bodies:
  - floor: {{lower: [-1, -1, -0.5], upper: [2, 2, 0], cells: [6, 6, 2], young: 1e5, poisson: 0.3}}
  - block: {{lower: [0, 0, 0], upper: [1, 1, 2], cells: [{cells}, 2, 4], young: 1e5, poisson: 0.3}}
displacements:
  - fix: {{face: floor.zmin, value: [0, 0, 0]}}
body_forces:
  - weight: {{body: block, value: [{push}, 0, -1]}}
contact:
  - foot: {{mortar: floor.zmax, nonmortar: block.zmin, friction: 1, gap: {gap}}}
"""
SCENES = {
    f"{gap}_{cells}_{push}": BLOCK.format(gap=gap, cells=cells, push=push / 1000)
    for gap in ("dual", "node", "mortar", "auto") for cells in (1, 6) for push in (450, 495, 505)
}
SCENES["auto_three"] = SCENES["auto_6_495"] + "load: {factors: [1, 0.99, 0.98]}\n"

if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for gap in "dual", "node":
        for cells in 1, 6:
            runs = [load(f"{gap}_{cells}_{push}") for push in (450, 495, 505)]
            say(f"{gap}, {cells} cells: stands at 0.45 and 0.495, tips at 0.505",
                [run["converged"] for run in runs] == [True, True, False], [run["reason"] for run in runs])
            say(
                f"{gap}, {cells} cells: the sentence",
                'body "block" turns about the axis along (0., 1., 0.) through (1., 0.5, 0.): nothing stops it'
                in runs[2]["reason"], runs[2]["reason"])
            pair = runs[1]["steps"][-1]["pairs"][0]
            middle = pair["moment"][1] / -pair["force"][2]
            say(f"{gap}, {cells} cells: where the resultant stands", abs(middle - 0.995) < 2e-3, middle)
    runs = [load(f"auto_6_{push}") for push in (450, 495, 505)]
    say("auto, 6 cells: stands at 0.45 and 0.495, tips at 0.505",
        [run["converged"] for run in runs] == [True, True, False], [run["reason"] for run in runs])
    say("auto, 6 cells: its warning", ["gap: dual from now on" in " ".join(map(str, run["warnings"]))
                                       for run in runs] == [True, True, False], [run["warnings"] for run in runs])
    say("auto, 6 cells: the sentence", "nothing stops it" in runs[2]["reason"], runs[2]["reason"])
    rest, whole = load("auto_rest"), load("auto_three")
    say(
        "auto, continued from a checkpoint: dual functions from the start", rest["steps"][-1]["converged"]
        and not rest["warnings"] and within(rest["steps"][-1]["energy"], whole["steps"][-1]["energy"], 1e-7),
        (rest["warnings"], rest["steps"][-1]["energy"], whole["steps"][-1]["energy"]))
    for push in 450, 495:
        run = load(f"mortar_6_{push}")
        say(f"mortar, 6 cells, {push / 1000}: nobody says that a block tips that stands", run["converged"]
            or "nothing stops it" not in run["reason"], run["reason"])
    say(
        "mortar, 6 cells, 0.495: the advice",
        load("mortar_6_495")["reason"].endswith(
            "it does not come to rest; if it should stand near the edge of a face, use gap: dual"),
        load("mortar_6_495")["reason"])
    say("mortar, 6 cells, 0.505: the sentence", "nothing stops it" in load("mortar_6_505")["reason"],
        load("mortar_6_505")["reason"])
    truth, dual = (load(name)["steps"][-1] for name in ("cylinder", "cylinder_dual"))
    say(
        "Hertz's cylinder by dual functions: force and largest pressure as by mortar",
        within(dual["pairs"][0]["normal_force"], truth["pairs"][0]["normal_force"], 1e-3)
        and within(dual["pairs"][0]["pressure"], truth["pairs"][0]["pressure"], 2e-3), (dual["pairs"], truth["pairs"]))
    patch = load("patch_dual")["steps"][-1]
    say(
        "patch test by dual functions",
        within(patch["pairs"][0]["pressure"], 0.01, 1e-9) and within(patch["energy"],
                                                                     load("patch")["steps"][-1]["energy"], 1e-9), patch)
