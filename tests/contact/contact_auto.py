"""Scenes for contact_auto.sh: python contact_auto.py write|judge."""
import sys

from summaries import load, say

BOX = "  - {}: {{lower: [{}, {}, {}], upper: [{}, {}, {}], cells: [{}, {}, {}], young: {}, poisson: 0.3}}\n"


def box(name, lower, upper, cells, young=1000):
    return BOX.format(name, *lower, *upper, *cells, young)


def deck(file, boxes):
    """Cubes of 2 x 2 x 2 cells in a deck of CalculiX without surfaces: name, lower corner, size"""
    nodes, cells = [], []
    for name, lower, size in boxes:
        first = len(nodes) + 1
        nodes += [[lower[c] + size[c] * at[c] / 2 for c in range(3)] for at in ((i, j, k) for k in range(3)
                                                                                for j in range(3) for i in range(3))]
        cells.append((name, [[
            first + i + di + 3 * (j + dj) + 9 * (k + dk)
            for di, dj, dk in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
        ]
                             for k in range(2) for j in range(2) for i in range(2)]))
    with open(file, "w") as out:
        out.write("*NODE\n" + "".join("%d, %.9g, %.9g, %.9g\n" % (k + 1, *x) for k, x in enumerate(nodes)))
        number = 0
        for name, own in cells:
            out.write(f"*ELEMENT, TYPE=C3D8, ELSET={name}\n")
            for cell in own:
                number += 1
                out.write(", ".join(map(str, [number] + cell)) + "\n")


def write():
    # Two blocks: found or listed
    base = ("bodies:\n" + box("slab", (-2, -2, -1), (2, 2, 0), (6, 6, 2), 10) + box("block", (-1, -1, 0), (1, 1, 1),
                                                                                    (10, 10, 2)) +
            ("displacements:\n  - foot: {face: slab.zmin, value: [0, 0, 0]}\n"
             "  - head: {face: block.zmax, value: [0.01, 0, -0.05]}\n"))
    scenes = {
        "found": base + "contact: auto\n",
        "listed": base + "contact:\n  - own: {mortar: slab.zmax, nonmortar: block.zmin}\n",
        "friction": base + "contact:\n  - auto: {friction: 0.2}\n",
        "friction_listed": base + "contact:\n  - own: {mortar: slab.zmax, nonmortar: block.zmin, friction: 0.2}\n",
        "bodies": base + "contact:\n  - both: {mortar: block, nonmortar: slab, friction: 0.1}\n",
        "settled": base + "contact:\n  - auto: {friction: 0.2}\n  - own: {mortar: slab.zmax, nonmortar: block.zmin}\n",
        "tied": base + "contact:\n  - auto: {tie: 0.001}\n",
        "tied_listed": base + "ties:\n  - own: {mortar: slab.zmax, nonmortar: block.zmin}\n",
    }
    # Five thin plates: each meets its neighbours only, although the next but one is within the default distance
    plates = "".join(box(f"plate{k}", (0, 0, k), (40, 40, k + 1), (4, 4, 1)) for k in range(5))
    foot = "displacements:\n  - foot: {face: plate0.zmin, value: [0, 0, 0]}\n"
    scenes["plates"] = "bodies:\n" + plates + foot + "contact: auto\nweak_springs: true\n"
    scenes["excepted"] = scenes["plates"].replace("auto", "[auto: {except: [plate1/plate2, plate4]}]")
    # A block slides from one slab onto the next, and past a column that it never reaches
    scenes["slides"] = ("bodies:\n" + box("first", (0, 0, -1), (2, 1, 0),
                                          (4, 2, 1)) + box("second", (2, 0, -1), (4, 1, 0), (4, 2, 1)) +
                        box("rider", (0.2, 0.2, 0.0001), (0.8, 0.8, 0.6),
                            (4, 4, 2)) + box("column", (1, 3, -1), (2, 4, 1), (1, 1, 1)) + "displacements:\n" +
                        "".join(f"  - foot_{name}: {{face: {name}.zmin, value: [0, 0, 0]}}\n"
                                for name in ("first", "second", "column")) +
                        "  - ride: {face: rider.zmax, value: [2.5, 0, -0.001]}\ncontact: auto\nload: {steps: 5}\n")
    # A deck of CalculiX without names of surfaces: a tower of three cubes, found and listed, and two rigid ones
    deck("tower.inp", [("low", (0, 0, 0), (4, 4, 1)), ("middle", (1, 1, 1), (2, 2, 1)),
                       ("high", (0.5, 0.5, 2), (3, 3, 1))])
    tower = "bodies:\n" + "".join(f"  - {name}: {{mesh: tower.inp, volume: {name}, young: 1000, poisson: 0.3}}\n"
                                  for name in ("low", "middle", "high"))
    tower += ("weak_springs: true\ndisplacements:\n  - foot: {face: low.surface_%d, value: [0, 0, 0]}\npressures:\n"
              "  - top: {face: high.surface_%d, value: 1}\ncontact: auto\n")
    scenes["tower"] = tower % (3, 6)
    # Rigid surfaces without facets: a plane below two blocks, which the lower one hides from the upper one, and a
    # sphere that comes down
    scenes["tools"] = (
        "bodies:\n" + box("low", (0, 0, 0), (2, 2, 0.2), (4, 4, 1)) + box("high", (0, 0, 0.2), (2, 2, 1), (4, 4, 2)) +
        ("  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}\n"
         "  - ball: {shape: rigid_sphere, center: [1, 1, 4], radius: 1}\n") +
        "displacements:\n  - rest: {body: floor, value: [0, 0, 0]}\n  - press: {body: ball, value: [0, 0, -2.02]}\n" +
        "symmetry: [low.xmin, low.ymin, high.xmin, high.ymin]\ncontact: auto\nload: {steps: 2}\n")
    scenes["tools_listed"] = scenes["tools"].replace(
        "auto",
        ("\n  - a: {mortar: floor.surface, nonmortar: low.zmin}\n"
         "  - b: {mortar: ball.surface, nonmortar: high.zmax}\n  - c: {mortar: low.zmax, nonmortar: high.zmin}"))
    scenes["wrong_tool"] = scenes["tools_listed"].replace("floor.surface", "floor")
    scenes["wrong_body"] = base + "contact:\n  - auto: {except: [slap]}\n"
    scenes["wrong_face"] = base + "contact:\n  - auto: {except: [slab.top]}\n"
    scenes["wrong_side"] = base + "contact:\n  - auto: {mortar: slab.zmax}\n"
    scenes["wrong_key"] = base + "contact:\n  - own: {mortar: slab.zmax, nonmortar: block.zmin, tie: 1}\n"
    scenes["no_side"] = base + "contact:\n  - own: {mortar: slab.zmax}\n"
    scenes["far"] = base.replace(
        "head: {face: block.zmax, value: [0.01, 0, -0.05]}", "head: {face: block.zmax, value: [0, 0, 0]}").replace(
            "lower: [-1, -1, 0]", "lower: [-1, -1, 0.9]") + "contact:\n  - auto: {distance: 0.5}\n"
    scenes["all_excepted"] = base + "contact:\n  - auto: {except: [slab]}\n"
    # facets of a bush and of its bore that are turned against each other, and a bush with a clearance
    bush = """bodies:
  - plate: {{shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 360], extent: [0, 1], cells: [2, 18, 2], young: 1,
            poisson: 0.3}}
  - bush: {{shape: tube_arc, axis: z, radii: [0.7, {radius}], angles: [10, 370], extent: [0, 1], cells: [1, 18, 2],
           young: 1, poisson: 0.3}}
  - other: {{lower: [5, 5, 5], upper: [6, 6, 6], cells: [1, 1, 1], young: 1, poisson: 0.3}}
displacements:
  - hold: {{face: plate.outer, value: [0, 0, 0]}}
  - keep: {{face: other.zmin, value: [0, 0, 0]}}
  - pin: {{face: bush.lmin, value: [0, 0, 0]}}
contact:
"""
    scenes["bush"] = bush.format(radius=1) + "  - seat: {mortar: plate, nonmortar: bush, tie: 0.001}\n"
    scenes["loose_bush"] = bush.format(radius=0.99) + "  - auto: {tie: 0.001}\n"
    scenes["untied"] = bush.format(
        radius=1) + "  - seat: {mortar: plate, nonmortar: other, tie: 0.001}\n  - auto: {friction: 0}\n"
    scenes["partly_tied"] = base.replace("lower: [-1, -1, 0]",
                                         "lower: [-1, -3, 0]") + "contact:\n  - auto: {tie: 0.001}\n"
    for name, text in scenes.items():
        with open(name + ".yaml", "w") as out:
            out.write(text)


def judge():
    energy = {
        name: load(name)["steps"][-1]["energy"]
        for name in ("found", "listed", "friction", "friction_listed", "tied", "tied_listed", "tools", "tools_listed")
    }
    for name in ("found", "friction", "tied", "tools"):
        other = "listed" if name == "found" else name + "_listed"
        difference = abs(energy[name] / energy[other] - 1)
        say(f"{name}: the energy of the scene that lists it", difference < 1e-9, difference)
    force = sum(pair["force"][2] for pair in load("tower")["steps"][-1]["pairs"] if "low" in pair["name"])
    say("tower: the lowest contact carries the pressure on the top", abs(abs(force) - 9) < 1e-5, force)
    steps = load("slides")["steps"]
    forces = [[abs(pair["force"][2]) for pair in step["pairs"] if "rider" in pair["name"]] for step in steps]
    say("slides: from the first slab onto the second", forces[0][0] > 0 and forces[0][1] == 0 and forces[-1][0] == 0
        and forces[-1][1] > 0, forces)


{"write": write, "judge": judge}[sys.argv[1]]()
