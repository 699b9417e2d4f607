"""What is said of loads that friction holds, and of those that it does not.

python3 friction_diagnosis.py scenes writes the scenes; python3 friction_diagnosis.py judges the runs that
friction_diagnosis.sh has made.
"""
import sys

from summaries import load, say

# Half-widths along x and y, middle along x, height, cells and Young's modulus of blocks that stand on each other
STACKS = {
    "stands_1": [(0.4577, 0.4577, 0, 0.952, [4, 2, 2], 5.617e4), (0.4577, 0.4577, 0, 0.411, [2, 2, 1], 7.1e5),
                 (0.412, 0.412, 0.075, 1.198, [1, 3, 4], 1.359e5)],
    "stands_2": [(0.592, 0.592, 0.073, 1.0, [4, 3, 1], 1.462e5), (0.414, 0.414, 0.06, 0.821, [1, 3, 1], 3.912e5),
                 (0.29, 0.29, 0, 0.409, [3, 4, 1], 1.176e5)],
    "stands_3": [(0.479, 0.479, -0.095, 1.146, [1, 1, 4], 7.93e5), (0.431, 0.431, 0, 0.788, [3, 2, 1], 5.417e5),
                 (0.431, 0.431, 0, 0.698, [1, 2, 1], 355.5)],
    "stands_4": [(0.479, 0.479, 0, 1.17, [2, 2, 2], 300), (0.431, 0.431, -0.009, 0.913, [2, 4, 1], 2e4),
                 (0.388, 0.388, -0.047, 0.587, [4, 4, 1], 1e6)],
}
SLIDES = [(0.6, 0.6, 0, 1, [3, 3, 3], 1e4), (0.53, 0.53, 0, 0.9, [4, 3, 2], 1e4), (0.46, 0.46, 0, 0.8, [3, 3, 3], 1e4)]
# Pulled by 48 out of jaws that press with 100 on two sides: friction holds 40
CLAMP = """problem: clamp
bodies:
  - low: {lower: [0, 0, -1], upper: [2, 1, 0], cells: [6, 3, 3], young: 1e4, poisson: 0.3}
  - bar: {lower: [-1, 0.1, 0], upper: [2, 0.9, 0.3], cells: [9, 3, 2], young: 1e5, poisson: 0.3}
  - top: {lower: [0, 0, 0.3], upper: [2, 1, 1.3], cells: [5, 3, 3], young: 1e4, poisson: 0.3}
displacements:
  - fix: {face: low.zmin, value: [0, 0, 0]}
  - hold: {face: top.zmax, value: [0, 0, free]}
pressures:
  - press: {face: top.zmax, value: 50, ramp: press}
tractions:
  - pull: {face: bar.xmin, value: [-200, 0, 0]}
contact:
  - under: {mortar: low.zmax, nonmortar: bar.zmin, friction: 0.2}
  - over: {mortar: top.zmin, nonmortar: bar.zmax, friction: 0.2}
load: {factors: [0, 0.5, 1]}
ramps:
  - press: {factors: [1, 1, 1]}
"""
# The jaws are driven: what they press with is for the bodies to decide, and no proof
DRIVEN = CLAMP.replace("pressures:\n  - press: {face: top.zmax, value: 50, ramp: press}\n",
                       "").replace("value: [0, 0, free]", "value: [0, 0, -0.005], ramp: press")


def stack(blocks, friction, more=""):
    bodies, pairs, top, below = "", "", 0.0, "floor.zmax"
    for k, (x, y, middle, height, cells, young) in enumerate(blocks):
        bodies += (f"  - b{k}: "
                   f"{{lower: [{middle - x}, {-y}, {top}], upper: [{middle + x}, {y}, {top + height}], cells: {cells}, "
                   f"young: {young}, poisson: 0.3}}\n")
        pairs += f"  - p{k}: {{mortar: {below}, nonmortar: b{k}.zmin, friction: {friction}}}\n"
        below, top = f"b{k}.zmax", top + height
    return f"""problem: stack
bodies:
  - floor: {{lower: [-1, -1, -0.5], upper: [1, 1, 0], cells: [3, 3, 1], young: 1e5, poisson: 0.3}}
{bodies}displacements:
  - fix: {{face: floor.zmin, value: [0, 0, 0]}}
body_forces:
  - weight: {{value: [0, 0, -1]}}
{more}contact:
{pairs}"""


PUSH = "tractions:\n  - push: {face: b2.xmin, value: [0.1, 0, 0]}\n"
# A plate that is pushed beside its middle slides, and turns a little about an axis far away
BESIDE = """bodies:
  - base: {lower: [-2, -2, -1], upper: [4, 3, 0], cells: [3, 2, 1], young: 1e5, poisson: 0.3}
  - plate: {lower: [0, 0, 0], upper: [1, 1, 0.2], cells: [2, 2, 1], young: 1e5, poisson: 0.3}
displacements:
  - fix: {face: base.zmin, value: [0, 0, 0]}
forces:
  - down: {face: plate.zmax, value: [0, 0, -10]}
  - push: {face: plate.xmin, value: [5, 1, 0]}
contact:
  - touch: {mortar: base.zmax, nonmortar: plate.zmin, friction: 0.3}
"""
SCENES = {
    **{name: stack(blocks, 0.3)
       for name, blocks in STACKS.items()}, "slides": stack(SLIDES, 0.05, PUSH), "held": stack(SLIDES, 0.3, PUSH),
    "tips": stack(SLIDES, 1,
                  PUSH.replace("0.1", "1.5").replace("xmin",
                                                     "xmax")), "clamp": CLAMP, "driven": DRIVEN, "beside": BESIDE
}


def moves(step, body, how, end):
    return f'body "{body}" {how}' in step["reason"] and step["reason"].endswith(end)


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for name in (*STACKS, "held"):
        run = load(name)
        say(f"{name}: nobody says that a stack falls that stands", run["converged"]
            or "nothing stops it" not in run["reason"], run["reason"])
    say("held: converged", load("held")["converged"], load("held")["reason"])
    for name, body, how in ("slides", "b2", "moves away along (1., 0., 0.)"), (
            "tips", "b",
            "turns about the axis along (0., 1., 0.)"), ("clamp", "bar", "moves away along (-1., 0., 0.)"), (
                "beside", "plate", "moves away along (0.9"), ("clamp_3", "bar", "moves away along (-1., 0., 0.)"):
        step = load(name)["steps"][-1]
        named = body if body != "b" else next((b for b in ("b0", "b1", "b2") if f'"{b}"' in step["reason"]), "none")
        say(
            f"{name}: which body moves, and how", step["reason"].startswith("friction does not hold the bodies")
            and moves(step, named, how, "nothing stops it"), step["reason"])
        say(f"{name}: said at once", step["cuts"] == 0, step["cuts"])
    step = load("driven")["steps"][-1]
    say(
        "driven: which body moves, and how", step["reason"].startswith("no equilibrium was found")
        and moves(step, "bar", "moves away along (-1., 0., 0.)", "it does not come to rest"), step["reason"])
