"""Every two effects of a scene together: they run to forces in balance, or are refused by one sentence. python
combinations.py [part | table | triples N | with EFFECT]"""
import itertools
import json
import os
import random
import subprocess
import sys

from tetrahedra import BOX_FACES, Block

CONTACT = os.path.join(os.environ["AMGF_DIR"], "bin", "contact")
BODY = "  - %s: {%s, %s}\n"
BOX = "lower: %s, upper: %s, cells: [2, 2, 1]"
CORNERS = dict(low=([0, 0, 0], [3, 2, 1]), top=([0.5, 0.5, 1], [2.5, 1.5, 2]))
LAW = "young: 10, poisson: 0.3"


class Scene:
    """Two blocks, the upper one pressed on the lower: sections of text, options, ranks"""

    def __init__(self):
        self.law = dict(low="", top="")
        self.shape = {name: BOX % corners for name, corners in CORNERS.items()}
        self.constants = LAW
        self.bodies, self.top, self.options, self.ranks, self.restarts = "", [], [], 1, False
        self.lists = {
            "displacements": ["floor: {face: low.zmin, value: [0, 0, 0]}", "hold: {face: top.zmin, value: [0, 0, 0]}"],
            "pressures": ["press: {face: top.zmax, value: 0.05}"],
        }

    def add(self, section, entry):
        self.lists.setdefault(section, []).append(entry)

    def text(self):
        bodies = "".join(BODY % (name, self.shape[name], self.law[name] + self.constants)
                         for name in ("low", "top")) + self.bodies
        lists = "".join("%s:\n%s" % (name, "".join("  - %s\n" % entry
                                                   for entry in entries))
                        for name, entries in self.lists.items()
                        if entries)
        return "bodies:\n" + bodies + lists + "".join(line + "\n" for line in self.top)


def law(text):

    def change(scene):
        scene.law = {name: text + old for name, old in scene.law.items()}

    return change


def entry(section, text):
    return lambda scene: scene.add(section, text)


def option(*words):
    return lambda scene: scene.options.extend(words)


def line(text):
    return lambda scene: scene.top.append(text)


def contact(scene):
    scene.lists["displacements"][1] = "guide: {face: top.zmax, value: [0, 0, -0.01]}"
    scene.add("contact", "touch: {mortar: low.zmax, nonmortar: top.zmin}")


def node(scene):
    contact(scene)
    scene.lists["contact"][-1] = "touch: {mortar: low.zmax, nonmortar: top.zmin, gap: node}"


def friction(scene):
    contact(scene)
    scene.lists["contact"][-1] = "touch: {mortar: low.zmax, nonmortar: top.zmin, friction: 0.3}"


def tie(scene):
    scene.bodies += BODY % ("cap", BOX % ([0.5, 0.5, 2], [2.5, 1.5, 2.5]), LAW)
    scene.add("pressures", "cap: {face: cap.zmax, value: 0.02}")
    scene.add("ties", "glue: {mortar: top.zmax, nonmortar: cap.zmin}")


def rigid(scene):
    scene.bodies += BODY % ("wall", BOX % ([-0.5, -0.5, -0.5], [0, 2.5, 1.5]), "material: rigid")
    scene.add("displacements", "shove: {body: wall, value: [0.005, 0, 0]}")
    scene.add("contact", "side: {mortar: wall.xmax, nonmortar: low.xmin}")


def driven(scene):
    """By a force, along x"""
    rigid(scene)
    scene.lists["displacements"][-1] = "shove: {body: wall, value: [free, 0, 0]}"
    scene.add("forces", "push: {body: wall, value: [0.02, 0, 0]}")


def pad(scene):
    scene.bodies += BODY % ("lid", BOX % ([0.5, 0.5, 2.1], [2.5, 1.5, 2.5]), LAW)
    scene.add("pressures", "lid: {face: lid.zmax, value: 0.02}")
    scene.add("springs", "pad: {face: lid.zmin, to: top.zmax, value: [1, 1, 4], distance: 0.2}")


def follows(scene):
    scene.law = {name: "material: neohookean, " + old for name, old in scene.law.items()}
    scene.add("pressures", "blow: {face: low.ymax, value: 0.05, follows: true}")


def rotation(scene):
    scene.lists["displacements"][
        0] = "floor: {face: low.zmin, value: [0, 0, 0], rotation: [0, 0, 0.2], center: [1.5, 1, 0]}"


def tetrahedra(order, *names):

    def change(scene):
        for name in names:
            lower, upper = CORNERS[name]
            cells = Block(order, [2, 2, 1], lambda p, a=lower, b=upper: [x + t * (y - x) for x, y, t in zip(a, b, p)],
                          BOX_FACES)
            cells.write("%s_%d.msh" % (name, order), "2.2")
            scene.shape[name] = "mesh: %s_%d.msh, volume: block" % (name, order)
            scene.law[name] += "order: 1, " if order == 1 else ""

    return change


def order_low(scene):
    scene.law["low"] += "order: 2, "


def rubber(scene):
    scene.law = {name: "material: mooney_rivlin, " + old for name, old in scene.law.items()}
    scene.constants = "c10: 1.5, c01: 0.4, bulk: 8"


def wood(scene):
    scene.law = {name: "material: orthotropic, first_axis: [1, 1, 0], " + old for name, old in scene.law.items()}
    scene.constants = "young: [12, 10, 8], poisson: [0.3, 0.3, 0.25], shear: [4, 3, 3.5], expansion: [1e-3, 2e-3, 3e-3]"


def heat(scene):
    scene.constants += "" if "expansion" in scene.constants else ", expansion: 1e-3"
    scene.add("temperatures", "warm: {value: 5 - z}")


def library(scene):
    scene.top.append("library: %s/share/materials/mm_N.yaml" % os.environ["AMGF_DIR"])
    scene.constants = "material: steel"


def ranks(scene):
    scene.ranks = 3


def restart(scene):
    scene.restarts = True
    scene.top.append("load: {steps: 2}")


EFFECTS = {
    "contact": contact,
    "gap node": node,
    "friction": friction,
    "finite strain": law("material: neohookean, "),
    "Saint Venant": law("material: saint_venant, "),
    "Mooney-Rivlin": rubber,
    "orthotropic": wood,
    "temperature": heat,
    "bbar": law("element: bbar, "),
    "incompatible": law("element: incompatible, "),
    "order 2": law("order: 2, "),
    "order 2 below": order_low,
    "tetrahedra": tetrahedra(2, "low", "top"),
    "tetrahedra of 4 nodes": tetrahedra(1, "low"),
    "tie": tie,
    "rigid body": rigid,
    "driven by force": driven,
    "pad": pad,
    "follower": follows,
    "rotation": rotation,
    "inclined plane": entry("symmetry", "cut: {face: low.xmin, normal: [1, 1, 0]}"),
    "point": entry("displacements", "pin: {body: low, point: [3, 2, 1], value: [free, 0, free]}"),
    "edge": entry("displacements", "rail: {body: low, from: [3, 0, 1], to: [3, 2, 1], value: [0, free, free]}"),
    "springs": entry("springs", "soil: {face: low.xmax, value: [1, 2, 3]}"),
    "weak springs": line("weak_springs: true"),
    "traction": entry("tractions", "wind: {face: low.ymax, value: [0.01, 0, 0.02]}"),
    "force": entry("forces", "bolt: {face: low.xmax, value: [0, 0, 0.03], moment: [0, 0.01, 0]}"),
    "body force": entry("body_forces", "weight: {value: [0, 0, -0.01]}"),
    "probe": entry("probes", "tip: {point: [2.5, 1.5, 1.7]}"),
    "expression": line("load: {steps: 2, expression: sin(pi*s/2)}"),
    "bounds": line("load: {factors: [0.4, 0.7, 1]}\ndisplacement_bounds: 2"),
    "quadratic": line("model: quadratic"),
    "one gap": line("contact_updates: 1"),
    "library": library,
    "local refinement": entry("refinements", "spot: {lower: [0, 0, 0.5], upper: [1.6, 2, 1.4]}"),
    "refined": option("-refine", "1"),
    "interior point": option("-tao_ipfilter_subspace", "false"),
    "direct": option("-options_file", os.path.join(os.environ["AMGF_DIR"], "share", "options", "direct.opts")),
    "output": option("-output", "combination", "-output_gauss"),
    "ranks": ranks,
    "restart": restart,
}


def run(scene, *more):
    command = [
        CONTACT, "combination.yaml", "-quiet", "-tao_ipfilter_tol", "1e-11", "-summary", "combination.json",
        *scene.options, *more
    ]
    if scene.ranks > 1:
        command = ["mpiexec", "--oversubscribe", "-n", str(scene.ranks), *command]
    return subprocess.run(command, capture_output=True, text=True, timeout=1200)


def off(step):
    """Forces out of balance on any body by the largest forces on one"""
    size = lambda vector: sum(x * x for x in vector)**0.5
    largest = max(
        sum(size(body[kind]) for kind in ("contact", "reaction", "springs", "ties", "load")) for body in step["bodies"])
    return max(size(body["residual"]) for body in step["bodies"]) / largest


def judge(names):
    """What comes of it: runs, refused, or what is wrong"""
    scene = Scene()
    for name in names:
        EFFECTS[name](scene)
    with open("combination.yaml", "w") as file:
        file.write("problem: combination\n" + scene.text())
    if os.path.exists("combination.json"):
        os.remove("combination.json")
    end = run(
        scene,
        *(["-checkpoint_every", "1", "-checkpoint", "combination_state.h5", "-load_steps", "2"]
          if scene.restarts else []))
    said = [
        text for text in (end.stderr + end.stdout).splitlines()
        if "contact: error" in text or "contact: load step" in text
    ]
    if end.returncode == 1 and len(said) == 1:
        return "refused", said[0].split("contact: error: ")[-1]
    if end.returncode:
        return "exit code %d" % end.returncode, " ".join(said) or end.stderr[-300:]
    step = json.load(open("combination.json"))["steps"][-1]
    held_back = {"quadratic", "bounds", "one gap"} & set(names)  # ends that are not in balance, by choice
    if not step["energy"] > 0 or (off(step) > 1e-6 and not held_back):
        return "out of balance", "%g, energy %g" % (off(step), step["energy"])
    return "runs", ""


# By themselves only: they change nothing of what is solved, or little
ALONE = {
    "tetrahedra of 4 nodes", "pad", "follower", "Mooney-Rivlin", "orthotropic", "gap node", "edge", "probe", "library",
    "output", "one gap", "refined", "local refinement", "body force", "expression"
}
TABLE = {}


def chosen(words):
    """Each alone and each two, or an eighth of the twos, always the same ones; of all effects for the table; or so many
    of three; or one with each other"""
    if words[:1] == ["triples"]:
        return random.Random(1).sample(list(itertools.combinations(EFFECTS, 3)), int(words[1]))
    if words[:1] == ["with"]:
        return [(words[1], name) for name in EFFECTS if name != words[1]]
    pairs = list(itertools.combinations([name for name in EFFECTS if name not in ALONE or words[:1] == ["table"]], 2))
    if words[:1] == ["part"]:
        pairs = random.Random(1).sample(pairs, len(pairs) // 8)
    return [(name, ) for name in EFFECTS] + pairs


for pair in chosen(sys.argv[1:]):
    first = [
        line.split(":")[0] for name in pair for scene in [Scene()] for _ in [EFFECTS[name](scene)] for text in scene.top
        for line in text.split("\n")
    ]
    if len(set(first)) < len(first):
        continue  # the two say one key
    TABLE[pair] = judge(pair)
alone = [pair[0] for pair, (end, _) in TABLE.items() if len(pair) == 1 and end != "runs"]
print("effects that do not run by themselves:", alone or "none")
for pair, (end, why) in TABLE.items():
    if end not in ("runs", "refused"):
        print(" and ".join(pair), "-", end, why)
print("each two together run or are refused by one sentence: %s" %
      ("yes" if all(end in ("runs", "refused") for end, _ in TABLE.values()) else "no"))
if sys.argv[1:] not in ([], ["part"]):
    print(len(EFFECTS), "effects,", sum(end == "runs" for end, _ in TABLE.values()), "run,",
          sum(end == "refused" for end, _ in TABLE.values()), "refused")
    for pair, (end, why) in TABLE.items():
        if end == "refused":
            print("|", " and ".join(pair), "|", why, "|")
