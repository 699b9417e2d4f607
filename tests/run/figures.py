"""Scenes whose largest values are known, and the checks of them; `figures.py write`, then `figures.py check`."""
import csv
import math
import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "tests", "lib"))
from summaries import load, say, within  # noqa: E402

CANTILEVER = """
problem: cantilever
units: mm, N, MPa
bodies:
  - beam: {lower: [0, 0, 0], upper: [100, 10, 10], cells: [20, 2, 4], order: 2, young: 210000, poisson: 0, yield: 240}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
tractions:
  - tip: {face: beam.xmax, value: [0, 0, -2]}
load: {factors: [0.5, 1, 0.25]}
"""
TUBE = """
problem: tube
units: m, N
bodies:
  - tube: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [1, 2], angles: [0, 90], extent: [0, 0.5],
           cells: [12, 12, 1], order: 2, young: 2e5, poisson: 0.3, yield: 240}
displacements:
  - ends: {face: tube.lmin, value: [free, free, 0]}
  - others: {face: tube.lmax, value: [free, free, 0]}
symmetry:
  - x: {face: tube.amin, normal: y}
  - y: {face: tube.amax, normal: x}
pressures:
  - bore: {face: tube.inner, value: 60}
load: {steps: 1}
"""
TOOL = """
problem: tool
units: mm, N, N/mm^2
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [4, 4, 4], young: 1000, poisson: 0}
  - tool: {shape: rigid_plane, point: [0.5, 0.5, 1], normal: [0, 0, -1]}
displacements:
  - base: {face: block.zmin, value: [free, free, 0]}
  - side: {face: block.xmin, value: [0, free, free]}
  - back: {face: block.ymin, value: [free, 0, free]}
  - press: {body: tool, value: [0, 0, -0.01]}
contact:
  - pair: {mortar: tool.surface, nonmortar: block.zmax}
load: {factors: [1, 0.5]}
"""

BOLT = """
problem: bolt
units: mm, N, MPa
bodies:
  - screw: {lower: [0, 0, 0], upper: [10, 1, 1], cells: [10, 1, 1], young: 1000, poisson: 0}
displacements:
  - left: {face: screw.xmin, value: [0, 0, 0]}
  - right: {face: screw.xmax, value: [0, 0, 0]}
bolts:
  - m1: {body: screw, point: [5, 0, 0], axis: [1, 0, 0], force: 3}
"""

LAYER = TUBE.replace("problem: tube", "problem: layer").replace("[12, 12, 1], order: 2", "[12, 24, 1]")
HINGE = """
problem: hinge
bodies:
  - strip: {lower: [0, 0, 0], upper: [20, 2, 2], cells: [20, 2, 4], material: j2_finite, young: 1e5, poisson: 0.3,
            yield: 100, hardening: 300}
displacements:
  - left: {face: strip.xmin, value: [0, free, 0]}
  - middle: {face: strip.ymin, value: [free, 0, free]}
forces:
  - right: {face: strip.xmax, moment: [0, -260, 0]}
load: {steps: 4}
"""
ROLL = """
problem: roll
bodies:
  - block: {lower: [0, 0, 0], upper: [4, 1, 1], cells: [4, 1, 2], young: 1000, poisson: 0.3}
  - roll: {shape: rigid_cylinder, center: [2, 0, 4], direction: [0, 1, 0], radius: 3}
displacements:
  - base: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: roll, value: [0, 0, -0.01]}
contact:
  - line: {mortar: roll.surface, nonmortar: block.zmax}
"""
# The middle of the end moves by 0.1 mm and turns by 1 degree
CRANK = """
problem: crank
units: mm, N, MPa
bodies:
  - beam: {lower: [0, 0, 0], upper: [100, 10, 10], cells: [20, 2, 4], order: 2, material: neohookean,
           young: 210000, poisson: 0}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
  - turn: {face: beam.xmax, value: [0, 0, 0.1], rotation: [0, 1, 0], center: [100, 5, 5]}
load: {factors: [1, 0.5]}
"""
BRAKE = (ROLL.replace("problem: roll", "problem: brake")
         .replace("nonmortar: block.zmax", "nonmortar: block.zmax, friction: 0.2")
         .replace("value: [0, 0, -0.01]}", "value: [0, 0, -0.01], rotation: [0, 2, 0], center: [2, 0, 4]}"))


# Twenty blocks, each pressed by its plane; the last but one is pressed most
MANY = "problem: many\nbodies:\n" + "".join(
    f"  - b{k}: {{lower: [{2 * k}, 0, 0], upper: [{2 * k + 1}, 1, 1], cells: [1, 1, 1], young: 1000, poisson: 0, "
    f"yield: 30}}\n"
    f"  - t{k}: {{shape: rigid_plane, point: [{2 * k}, 0, 1], normal: [0, 0, -1]}}\n" for k in range(20))
MANY += "displacements:\n" + "".join(
    f"  - foot{k}: {{face: b{k}.zmin, value: [0, 0, 0]}}\n"
    f"  - press{k}: {{body: t{k}, value: [0, 0, -0.0{2 if k == 18 else 1}]}}\n" for k in range(20))
MANY += "contact:\n" + "".join(f"  - c{k}: {{mortar: t{k}.surface, nonmortar: b{k}.zmax}}\n" for k in range(20))


def figure(run, quantity, name=""):
    found = [one for one in run["figures"] if (one["quantity"], one["name"]) == (quantity, name)]
    assert len(found) == 1, (quantity, name, found)
    return found[0]


def near(place, target, limit):
    return max(abs(a - b) for a, b in zip(place, target)) <= limit


def cantilever(run):
    length, size, force, young = 100, 10, 200, 210000
    inertia = size**4 / 12
    exact = force * length**3 / (3 * young * inertia) + force * length / (5 / 6 * young / 2 * size**2)
    exact = math.hypot(exact, force * length**2 / (2 * young * inertia) * size / 2)
    tip, stress = figure(run, "displacement", "beam"), figure(run, "von Mises stress", "beam")
    say("cantilever: largest displacement", within(tip["value"], exact, 2e-3) and tip["unit"] == "mm", (tip, exact))
    say("cantilever: at the tip, in the second load step", tip["place"][0] == length and tip["step"] == 2, tip)
    exact = force * length * size / 2 / inertia
    say("cantilever: largest stress", within(stress["value"], exact, 0.02) and stress["unit"] == "MPa", (stress, exact))
    say("cantilever: at the surface of the wall", stress["place"][0] == 0 and stress["place"][2] in (0, size), stress)
    safety = figure(run, "safety against yield", "beam")
    say("cantilever: safety factor",
        within(safety["value"], 240 / stress["value"], 1e-12) and safety["step"] == 2, safety)
    wall = figure(run, "reaction", "beam.xmin")
    say("cantilever: reaction",
        within(wall["value"], force, 1e-9) and within(wall["components"][2], force, 1e-9) and wall["unit"] == "N", wall)


def tube(run):
    inner, outer, pressure, young, poisson = 1, 2, 60, 2e5, 0.3
    bore = pressure * inner / (outer**2 - inner**2) * (1 + poisson) / young * ((1 - 2 * poisson) * inner**2 + outer**2)
    hoop = pressure * (outer**2 + inner**2) / (outer**2 - inner**2)
    axial = poisson * (hoop - pressure)
    mises = math.sqrt(((hoop + pressure)**2 + (hoop - axial)**2 + (axial + pressure)**2) / 2)
    moved, stress = figure(run, "displacement", "tube"), figure(run, "von Mises stress", "tube")
    say("tube: displacement of the bore",
        within(moved["value"], bore, 1e-3) and within(math.hypot(*moved["place"][:2]), inner, 1e-9), (moved, bore))
    say(
        "tube: stress at the bore",
        within(stress["value"], mises, 0.02) and stress["unit"] == "N/m^2"
        and within(math.hypot(*stress["place"][:2]), inner, 1e-9), (stress, mises))
    plane = figure(run, "symmetry reaction", "tube.amin")
    say("tube: reaction of a symmetry plane", within(plane["value"], pressure * inner * 0.5, 1e-6), plane)
    say("tube: safety factor", within(figure(run, "safety against yield", "tube")["value"], 240 / mises, 0.02), mises)


def hertz(run):
    """Stress below the middle of the strip of contact, in plane strain (McEwen 1949)"""
    width, peak, poisson = 0.005, 2.747, 0.3
    best = (0, 0)
    for k in range(1, 2000):
        z = width * k / 1000
        root = math.hypot(width, z)
        x, y = -peak / width * ((width**2 + 2 * z**2) / root - 2 * z), -peak * width / root
        out = poisson * (x + y)
        best = max(best, (math.sqrt(((x - y)**2 + (y - out)**2 + (out - x)**2) / 2), z))
    stress, pressure = figure(run, "von Mises stress", "cylinder"), figure(run, "contact pressure", "touch")
    say("Hertz: largest stress", within(stress["value"], best[0], 0.02), (stress, best))
    say("Hertz: below the surface",
        near(stress["place"][:1], [0], 1e-9) and within(stress["place"][2], best[1], 0.1), (stress, best))
    say("Hertz: largest pressure in the middle",
        within(pressure["value"], peak, 0.01) and near([pressure["place"][0], pressure["place"][2]], [0, 0], 1e-9),
        pressure)


def tool(run):
    force, pressed = figure(run, "contact force", "pair"), figure(run, "contact pressure", "pair")
    say(
        "tool: moves as the scene says",
        within(figure(run, "displacement", "tool")["value"], 0.01, 1e-12)
        and not [one for one in run["figures"] if one["name"] == "tool" and one["quantity"] != "displacement"],
        run["figures"])
    say(
        "tool: force, area and pressure",
        within(force["value"], 10, 1e-6) and force["step"] == 1 and within(force["components"][2], -10, 1e-6)
        and within(pressed["value"], 10, 1e-6) and within(figure(run, "contact area", "pair")["value"], 1, 1e-6)
        and figure(run, "contact area", "pair")["unit"] == "mm^2", (force, pressed))
    say(
        "tool: uniform stress, at the corner that is first in order",
        within(figure(run, "von Mises stress", "block")["value"], 10, 1e-6)
        and near(figure(run, "von Mises stress", "block")["place"], [0, 0, 0], 1e-12), run["figures"])


def layer(run):
    """The tube with one layer of cells of order 1"""
    hoop, radial, axial = 100, -60, 12
    mises = math.sqrt(((hoop - radial)**2 + (hoop - axial)**2 + (axial - radial)**2) / 2)
    stress = figure(run, "von Mises stress", "tube")
    say("layer: stress at the bore", within(stress["value"], mises, 0.03), (stress, mises))


def hinge(run):
    """A strip of metal that is bent to an arc: the largest stress at a node is the yield stress of the cells there"""
    stress, strain = figure(run, "von Mises stress", "strip"), figure(run, "eq. plastic strain", "strip")
    say("hinge: stress is the yield stress",
        strain["value"] > 0.05 and within(stress["value"], 100 + 300 * strain["value"], 0.03), (stress, strain))


def roll(run):
    """A line that a cylinder presses: its width is that of the facets"""
    pairs = {pair["name"]: pair["narrow"] for pair in run["steps"][0]["pairs"]}
    say("roll: one facet wide", pairs["line"], pairs)


def crank(run):
    """The torque is the moment of the wall about the middle of the end, and that of a beam whose end moves and turns"""
    torque, wall = figure(run, "torque", "beam.xmax"), run["steps"][0]["faces"][0]
    x, y, z = 100, 5, 5.1
    about = wall["moment"][1] - (z * wall["reaction"][0] - x * wall["reaction"][2])
    say("crank: equilibrium", within(torque["value"], -about, 1e-9) and torque["unit"] == "N mm", (torque, wall))
    length, size, young = 100, 10, 210000
    shear = 2.4 * (size / length)**2
    stiffness = young * size**4 / 12 / length / (1 + shear)
    exact = stiffness * ((4 + shear) * math.radians(1) + 6 * 0.1 / length)
    say("crank: torque of a beam", within(torque["value"], exact, 0.01) and torque["step"] == 1, (torque, exact))


def brake(run):
    """A roll that slides where it stands: torque = friction x force x radius"""
    torque, force = figure(run, "torque", "roll.*"), figure(run, "normal force", "line")
    say("brake: torque", within(torque["value"], 0.2 * force["value"] * 3, 0.01), (torque, force))
    sign = run["steps"][0]["faces"][-1]["torque"]
    say("brake: the torque turns the roll", within(sign, torque["value"], 1e-12), sign)


def bolt(run):
    force = figure(run, "bolt force", "m1")
    say("bolt: force", within(force["value"], 3, 1e-6) and force["unit"] == "N", force)
    say("bolt: reaction", within(figure(run, "reaction", "screw.xmin")["value"], 3, 1e-6), run["figures"])


# Table and column of the terminal for each quantity
COLUMNS = {
    "displacement": ("body", "displacement"),
    "von Mises stress": ("body", "von Mises stress"),
    "safety against yield": ("body", "safety"),
    "eq. plastic strain": ("body", "plastic strain"),
    "contact force": ("force", "force"),
    "normal force": ("force", "normal force"),
    "contact pressure": ("force", "pressure"),
    "contact area": ("force", "area"),
    "reaction": ("force", "force"),
    "torque": ("force", "torque"),
    "bolt force": ("force", "force")
}


def words(vector, tiny):
    return ", ".join(f"{0 if abs(part) <= tiny else part:.5g}" for part in vector)


def table(lines, owner):
    """{name: {heading: text}} of the terminal's table; a value's place and load step stand under its heading, too. A
    row "pair, tool" is that of both."""
    rows, heads = {}, None
    for line in lines:
        cells = re.split("  +", line.strip())
        if heads and len(cells) == len(heads) and line.startswith("  "):
            row = {}
            rows.update((name, row) for name in cells[0].split(", "))
            for head, cell in zip(heads, cells):
                key = head if head not in ("at", "components", "step") else key
                row[key] = (*row.get(key, ()), cell)
        else:
            kind = "force" if {*cells[0].split(", ")} <= {"pair", "face", "bolt"} else cells[0]
            heads = cells if kind == owner else None
    return rows


def said(figure, lines, steps, narrow):
    """Whether the terminal has the figure, with its place or components and its load step"""
    value, vector = f"{figure['value']:.5g}", figure["components"]
    if figure["quantity"] == "symmetry reaction":
        body, face = figure["name"].split(".")
        rows = [line for line in lines if line.startswith(f"  symmetry reactions {body}: ")]
        return len(rows) == 1 and f" {face} {value}" in rows[0] and rows[0].endswith(figure["unit"] + "\n")
    if figure["quantity"].startswith("stress error"):
        step = f" in load step {figure['step']}" if steps else ""
        return lines[-1].startswith(f"  {figure['quantity']}: {figure['value']:.3g} %{step}; ")
    owner, column = COLUMNS[figure["quantity"]]
    column += f" [{figure['unit']}]" if figure["unit"] else ""
    if figure["place"][0] is not None:
        vector = figure["place"]
    expected = [value + " (one facet wide)" * (figure["quantity"] == "contact area" and figure["name"] in narrow)]
    if vector[0] is not None:
        expected.append(f"({words(vector, 1e-9 * max(map(abs, vector)))})")
        expected += [str(figure["step"])] * steps
    elif column.startswith("force"):
        expected += ["-"] * (1 + steps)
    return table(lines, owner).get(figure["name"].removesuffix(".*"), {}).get(column) == tuple(expected)


def terminal(name, run):
    with open(name + ".txt", encoding="utf-8") as file:
        lines = file.readlines()
    steps = sum(step["converged"] for step in run["steps"]) > 1
    narrow = [pair["name"] for pair in run["steps"][0]["pairs"] if pair["narrow"]]
    missing = [figure for figure in run["figures"] if not said(figure, lines, steps, narrow)]
    say(name + ": the terminal has the figures of the summary", not missing, missing)
    known = [figure["name"] for figure in run["figures"] if figure["quantity"] == "safety against yield"]
    said_none = [
        table(lines, "body")[figure["name"]]["safety"] == ("-", ) for figure in run["figures"]
        if figure["quantity"] == "von Mises stress" and figure["name"] not in known
    ]
    say(name + ": no safety factor without a yield stress", all(said_none), lines)
    end = len(lines) - next(k for k, line in enumerate(lines) if line.startswith("Problem "))
    say(name + ": at most nine lines", end <= 9, lines[-end:])


def history(name, run):
    with open(name + ".csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for quantity, column in (("displacement", "displacement"), ("von Mises stress", "von_mises"), ("contact pressure",
                                                                                                   "pressure")):
        for one in run["figures"]:
            if one["quantity"] != quantity:
                continue
            values = [float(row[f"{one['name']}.{column}"]) for row in rows]
            row = rows[one["step"] - 1]
            place = [float(row[f"{one['name']}.{column}_place_{axis}"]) for axis in "xyz"]
            say(f"{name}: history of {quantity}, {one['name']}",
                within(max(values), one["value"], 1e-12) and near(place, one["place"], 1e-12), (values, one))


def ranks(name, run):
    others = load(name + "_3")["figures"]
    same = len(others) == len(run["figures"]) and all(
        one["name"] == other["name"] and abs(one["value"] - other["value"]) < 1e-5 * one["value"] +
        1e-9 and one["step"] == other["step"] and (one["place"][0] is None or near(one["place"], other["place"], 1e-9))
        for one, other in zip(run["figures"], others))
    say(name + ": the same on three ranks", same, (run["figures"], others))


def many():
    """Of many bodies and pairs the terminal has those with the largest values"""
    with open("many.txt", encoding="utf-8") as file:
        lines = file.readlines()
    lines = lines[next(k for k, line in enumerate(lines) if line.startswith("Problem ")):]
    bodies, forces = table(lines, "body"), table(lines, "force")
    say("many: rows", (len(bodies), len(forces), len(lines)) == (8, 16, 22), lines)
    say("many: largest values", bodies["b18"]["safety"] == ("1.5", ) and forces["t18"]["force"][0] == "20", lines)
    others = [line.split()[1] for line in lines if line.startswith("  and ")]
    say("many: the number of the others", others == ["32", "32"], lines)


def check():
    many()
    for name, test in (("cantilever", cantilever), ("tube", tube), ("tool", tool), ("bolt", bolt), ("layer", layer),
                       ("hinge", hinge), ("roll", roll), ("crank", crank), ("brake", brake)):
        run = load(name)
        test(run)
        terminal(name, run)
        history(name, run)
        if name in ("tool", "bolt", "brake"):
            ranks(name, run)
    hertz(load("hertz"))
    plain = [one for one in load("tube")["figures"] if not one["quantity"].startswith("stress error")]
    say("without the error estimate", load("plain")["figures"] == plain, load("plain")["figures"])
    run = load("yields")
    safety, strain = figure(run, "safety against yield", "tube"), figure(run, "eq. plastic strain", "tube")
    say("a tube that yields", safety["value"] <= 1
        and within(strain["value"], max(step["plastic_strain"] for step in run["steps"]), 1e-12), (safety, strain))
    burst = load("burst")
    say("a load step that fails gives no figures", [step["converged"] for step in burst["steps"]] == [True, False]
        and {one["step"]
             for one in burst["figures"]} == {1}, burst["figures"])


if sys.argv[1] == "write":
    for name, text in (("cantilever", CANTILEVER), ("tube", TUBE), ("tool", TOOL), ("bolt", BOLT), ("layer", LAYER),
                       ("hinge", HINGE), ("roll", ROLL), ("crank", CRANK), ("brake", BRAKE), ("many", MANY)):
        with open(name + ".yaml", "w", encoding="utf-8") as file:
            file.write(text.lstrip())
else:
    check()
