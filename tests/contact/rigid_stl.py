"""Rigid surfaces of STL files, against the same surfaces by formula; text and binary files; an open surface; wrong
files.

python3 rigid_stl.py scenes writes the files; python3 rigid_stl.py judges the runs.
"""
import math
import struct
import sys

from summaries import load, say, within

BLOCK = """problem: {name}
bodies:
  - block: {{lower: [-1, -1, 0], upper: [1, 1, 1], cells: [8, 8, 4], young: 1000, poisson: {poisson}}}
  - tool: {{{tool}}}
displacements:
  - bottom: {{face: block.zmin, value: [free, free, 0]}}
  - pin: {{point: [-1, -1, 0], body: block, value: [0, 0, 0]}}
  - line: {{point: [1, -1, 0], body: block, value: [free, 0, 0]}}
  - press: {{body: tool, value: [0, 0, {press}]}}
contact:
  - touch: {{mortar: tool.surface, nonmortar: block.zmax}}
"""
CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # seen from outside


def box(low, high, sides=SIDES):
    at = [tuple(h if up else l for l, h, up in zip(low, high, corner)) for corner in CORNERS]
    return [(at[s[0]], at[s[i]], at[s[i + 1]]) for s in sides for i in (1, 2)]


def ball(center, radius, n):
    """A ball: the surface of a box of n x n squares on each side, on the sphere."""
    facets = []
    for side in SIDES:
        a, b, c, d = ([2 * x - 1 for x in CORNERS[k]] for k in side)

        def at(i, j):
            s, t = (math.tan(math.pi / 4 * (2 * k / n - 1)) / 2 + 0.5 for k in (i, j))
            p = [a[k] + s * (b[k] - a[k]) + t * (d[k] - a[k]) for k in range(3)]
            length = math.sqrt(sum(x * x for x in p))
            return tuple(o + radius * x / length for o, x in zip(center, p))

        for i in range(n):
            for j in range(n):
                facets += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return facets


def text(name, facets):
    with open(name, "w") as file:
        file.write("solid a tool\n")
        for facet in facets:
            file.write(" facet normal 0 0 0\n  outer loop\n" + "".join("   vertex %.9g %.9g %.9g\n" % p
                                                                       for p in facet) + "  endloop\n endfacet\n")
        file.write("endsolid a tool\n")


def binary(name, facets):
    with open(name, "wb") as file:
        file.write(b"solid, though binary".ljust(80) + struct.pack("<I", len(facets)))
        for facet in facets:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for p in facet for x in p), 0))


def scenes():
    text("box.stl", box((-1.5, -1.5, 1), (1.5, 2, 3)))
    binary("box_mm.stl", box((-1500, -1500, 1000), (1500, 2000, 3000)))
    text("sheet.stl", box((0, -1.5, 1), (1.5, 2, 3), SIDES[:1]))
    binary("ball.stl", ball((0.1, 0, 1.5), 0.5, 24))
    text("turned.stl", [f if k else f[::-1] for k, f in enumerate(box((-1, -1, 1), (1, 1, 2)))])
    with open("box.stl") as file:
        lines = file.read().split("\n")
    for name, number, line in ("word", 4, "   vertex 1 2 here"), ("early", 17, None), ("loop", 3, "  outer lop"):
        with open(name + ".stl", "w") as file:
            file.write("\n".join(lines[:number - 1] + ([line] + lines[number:] if line else [])) + "\n")
    with open("ball.stl", "rb") as file, open("short.stl", "wb") as short:
        short.write(file.read()[:-1])
    text("empty.stl", [])
    tools = {
        "box": ("shape: rigid_stl, mesh: box.stl", 0,
                -0.01), "box_mm": ("shape: rigid_stl, mesh: box_mm.stl, scale: 1e-3", 0, -0.01),
        "sheet": ("shape: rigid_stl, mesh: sheet.stl", 0, -0.01),
        "plane": ("lower: [0, -1.5, 1], upper: [1.5, 2, 3], cells: [1, 1, 1], material: rigid", 0, -0.01),
        "ball": ("shape: rigid_stl, mesh: ball.stl", 0.3, -0.05),
        "sphere": ("shape: rigid_sphere, center: [0.1, 0, 1.5], radius: 0.5", 0.3, -0.05)
    }
    for name in "word", "early", "loop", "short", "empty", "turned", "none":
        tools[name] = (f"shape: rigid_stl, mesh: {name}.stl", 0, -0.01)
    for name, (tool, poisson, press) in tools.items():
        with open(name + ".yaml", "w") as file:
            file.write(
                BLOCK.format(name=name, tool=tool, poisson=poisson,
                             press=press).replace("tool.surface", "tool.zmin" if name == "plane" else "tool.surface"))


def pair(name):
    return load(name)["steps"][-1]["pairs"][0]


if sys.argv[1:] == ["scenes"]:
    scenes()
else:
    for name in "box", "box_mm":
        seen = pair(name)
        say(f"{name}: uniform pressure of 10",
            within(seen["pressure"], 10, 1e-6) and within(-seen["force"][2], 40, 1e-6), seen)
    one, other = pair("ball"), pair("sphere")
    say("ball of 6,912 facets: force within 1 % of the sphere's", within(one["force"][2], other["force"][2], 1e-2),
        (one, other))
    three = load("ball_3")["steps"][-1]["energy"]
    say("ball: the same on three ranks", within(three, load("ball")["steps"][-1]["energy"], 1e-8), three)
    one, other = -pair("sheet")["force"][2], -pair("plane")["force"][2]
    say(("an open surface over half of the block: within 12 % of a box with facets, which is the part of the "
         "nodes at its edge"),
        abs(one / other - 1) < 0.12, (one, other))
    place = load("ball")["steps"][-1]["rigid_bodies"][0]["position"]
    say("ball: its position is that of its centre of mass",
        all(abs(a - b) < 1e-6 for a, b in zip(place, (0.1, 0, 1.45))), place)
