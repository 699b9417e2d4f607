"""Soft and floating bodies that friction holds: rubber pads between rigid plates, stacks of blocks of unlike stiffness
under their own weight, and leaves that bend.

python3 friction_soft.py scenes writes the scenes; python3 friction_soft.py judges the runs that friction_soft.sh has
made.
"""
import json
import sys

from leaves import leaves

PLATES = """problem: pad
bodies:
  - low: {{lower: [-0.5, -0.5, -0.2], upper: [1.5, 1.5, 0], cells: [1, 1, 1], material: rigid}}
  - pad: {{lower: [0, 0, 0], upper: [1, 1, 1], cells: [{cells}], young: 1, poisson: 0.49, element: bbar{law}}}
  - top: {{lower: [-0.5, -0.5, 1], upper: [1.5, 1.5, 1.2], cells: [1, 1, 1], material: rigid}}
{symmetry}displacements:
  - fix: {{body: low, value: [0, 0, 0]}}
  - press: {{body: top, value: [0, 0, -0.25]}}
{kind}:
  - under: {{mortar: low.zmax, nonmortar: pad.zmin{key}}}
  - over: {{mortar: top.zmin, nonmortar: pad.zmax{key}}}
"""
QUARTER = "symmetry: [pad.xmin, pad.ymin]\n"
BLOCK = ("  - b{i}: {{lower: [{low}, {low}, {bottom}], upper: [{high}, {high}, {top}], cells: {cells}, young: "
         "{young}, poisson: 0.3}}\n")
GROUND = "  - ground: {lower: [-4, -4, -1], upper: [4, 4, 0], cells: [8, 8, 2], young: 1e5, poisson: 0.3}\n"
CUBES = [(1, 1, [3, 3, 3], young) for young in (300, 2e4, 1e6)]  # width, height, cells, Young's modulus
UNLIKE = [
    (1.1, 0.9, [2, 4, 3], 1e6),
    (1.4, 0.6, [2, 4, 3], 1e5),
    (1.4, 0.4, [3, 2, 2], 2e4),
    (1.0, 0.7, [4, 4, 2], 700),
    (1.9, 0.9, [3, 3, 4], 5e5),
    (1.2, 0.8, [4, 2, 3], 300),
    (1.7, 0.5, [2, 3, 2], 3e5),
    (1.3, 0.6, [3, 4, 2], 1500),
    (1.6, 0.7, [4, 3, 3], 9e4),
    (1.1, 0.5, [2, 2, 2], 6000),
]
# A block that rests on rigid ground, inclined by atan 1/3, and is held by friction alone
RESTS = """problem: rests
bodies:
  - ground: {lower: [-2, 0, -1], upper: [2, 1, 0], cells: [4, 2, 1], material: rigid}
  - block: {lower: [-0.5, 0.1, 0], upper: [0.5, 0.9, 0.5], cells: [4, 2, 2], young: 1e6, poisson: 0.3}
displacements:
  - fix: {body: ground, value: [0, 0, 0]}
body_forces:
  - weight: {body: block, value: [3000, 0, -9000]}
contact:
  - foot: {mortar: ground.zmax, nonmortar: block.zmin, friction: 0.4}
"""
STACKS = {"cubes": CUBES, "unlike": UNLIKE}


def pad(key, cells="8, 8, 8", law="", symmetry=""):
    return PLATES.format(cells=cells, law=law, symmetry=symmetry, kind="contact" if key else "ties", key=key)


def stack(blocks, law="friction: 0.3"):
    text, pairs, top = "problem: stack\nbodies:\n" + GROUND, "", 0
    for i, (width, height, cells, young) in enumerate(blocks):
        bottom, top = top, round(top + height, 6)
        text += BLOCK.format(i=i, low=-width / 2, high=width / 2, bottom=bottom, top=top, cells=cells, young=young)
        pairs += f"  - j{i}: {{mortar: {f'b{i - 1}' if i else 'ground'}.zmax, nonmortar: b{i}.zmin, {law}}}\n"
    return text + ("displacements:\n  - fix: {face: ground.zmin, value: [0, 0, 0]}\nbody_forces:\n"
                   "  - g: {value: [0, 0, -1]}\ncontact:\n") + pairs


def tower(law):
    """A block pressed on a floor and pushed along its top so that half of its base lifts off: vertices beside the part
    in contact would neither stick nor open"""
    return f"""problem: tower
bodies:
  - floor: {{lower: [-2, -1, -1], upper: [2, 1, 0], cells: [12, 6, 2], young: 1e4, poisson: 0.3}}
  - block: {{lower: [-0.5, -0.5, 0], upper: [0.5, 0.5, 2], cells: [6, 6, 7], young: 1e5, poisson: 0.45}}
displacements:
  - fix: {{face: floor.zmin, value: [0, 0, 0]}}
pressures:
  - press: {{face: block.zmax, value: {PRESS}}}
tractions:
  - push: {{face: block.zmax, value: [{PUSH}, 0, 0]}}
{"contact" if law else "ties"}:
  - base: {{mortar: floor.zmax, nonmortar: block.zmin{law}}}
load: {{steps: 2}}
"""


PRESS, PUSH = 100, 20
SCENES = {
    "tied": pad(""),
    "sticks": pad(", stick: true"),
    "grips": pad(", friction: 1"),
    "tied_quarter": pad("", symmetry=QUARTER),
    "sticks_quarter": pad(", stick: true", symmetry=QUARTER),
    "finite": pad(", friction: 0.3", "4, 4, 4", ", material: neohookean"),
    "finite_tied": pad("", "4, 4, 4", ", material: neohookean"),
    "finite_quarter": pad(", friction: 0.3", "4, 4, 4", ", material: neohookean", QUARTER),
    "leaves": leaves(5, ", friction: 0.1"),
    "rests": RESTS,
    "finite_sticks": pad(", stick: true", "4, 4, 4", ", material: neohookean"),
    "finite_sticks_6": pad(", stick: true", "6, 6, 6", ", material: neohookean"),
} | {name: stack(blocks)
     for name, blocks in STACKS.items()} | {
         "unlike_sticks": stack(UNLIKE, "stick: true"), "tower": tower(", friction: 0.6"),
         "tower_sticks": tower(", stick: true"), "tower_tied": tower("")
     }


def load(name):
    with open(name + ".json") as file:
        return json.load(file)["steps"][-1]


def say(what, ok, found):
    print(f"{what}: {'yes' if ok else f'no, {found}'}")


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for name in (*SCENES, "sticks_3"):
        if name == "finite_tied":
            continue  # cut to half the load step
        step = load(name)
        say(f"{name}: solved without a cut", step["converged"] and step["cuts"] == 0, (step["reason"], step["cuts"]))
    for name, twin in (("sticks", "tied"), ("sticks_quarter", "tied_quarter"), ("sticks_3", "sticks"), ("finite_sticks",
                                                                                                        "finite_tied")):
        found = load(name)["energy"] / load(twin)["energy"] - 1
        say(f"{name}: the energy of {twin} to 1e-8", abs(found) < 1e-8, found)
    step = load("grips")
    say("grips: no more energy than what is tied", step["energy"] <= (1 + 1e-12) * load("tied")["energy"],
        step["energy"])
    say("grips: work is stored or taken up by the contacts",
        abs(step["work"] - step["energy"] - step["contact_work"]) < 1e-6 * step["work"], step["work"])
    step = load("finite_sticks_6")
    forces = [pair["force"][2] for pair in step["pairs"]]
    say(
        "finite_sticks_6: both faces carry the same and stick",
        abs(sum(forces)) < 1e-8 * abs(forces[0])
        and all(pair["slip_area"] == 0 and pair["dissipated"] < 1e-12 for pair in step["pairs"]), step["pairs"])
    off = [abs(a - b) for a, b in zip(load("rests")["pairs"][0]["force"], (-1200, 0, 3600))]
    say("rests: carries the weight to 1e-6", max(off) < 3.6e-3, off)
    step = load("leaves")
    say("leaves: work is stored or taken up by the contacts to 1 %",
        abs(step["work"] - step["energy"] - step["contact_work"]) < 0.01 * step["work"], step["work"])
    for name, coefficient in (("grips", 1), ("finite", 0.3), ("finite_quarter", 0.3), ("leaves", 0.1)):
        step = load(name)
        for pair in step["pairs"]:
            most = coefficient * pair["normal_force"]
            say(f"{name}, {pair['name']}: pressed, and friction within its law",
                0 < pair["shear_force"] <= most * (1 + 1e-6), pair)
    energies = [load(name)["energy"] for name in ("tower_tied", "tower_sticks", "tower")]
    say("tower_sticks: softer than what is tied, stiffer than what slides", energies == sorted(energies), energies)
    for name in "tower", "tower_sticks":
        pair = load(name)["pairs"][0]
        off = max(abs(abs(found) - applied) for found, applied in zip(pair["force"], (PUSH, 0, PRESS)))
        say(f"{name}: carries what is applied, and part of the base is open", off < 1e-6 * PRESS
            and 0.1 < pair["area"] < 0.9, pair)
    for name, blocks in (STACKS | {"unlike_sticks": UNLIKE}).items():
        for i, pair in enumerate(load(name)["pairs"]):
            weight = sum(width**2 * height for width, height, _, _ in blocks[i:])
            say(f"{name}, {pair['name']}: carries what is above",
                abs(pair["force"][2] / weight - 1) < 1e-6, pair["force"][2] / weight - 1)
