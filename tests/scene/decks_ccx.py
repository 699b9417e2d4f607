"""Decks of decks_ccx.sh, and what their results must be: python decks_ccx.py write|judge."""
import sys

from decks import DECKS, rigid, step
from summaries import load, say

# A cube: its corners, and the numbers of the corners of its edges, in the order of CalculiX's cell of 20 nodes
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))


PLACES = [*CORNERS, *(tuple((a + b) / 2 for a, b in zip(CORNERS[i], CORNERS[j])) for i, j in EDGES)]


def cube(material, *steps):
    """A cube of one cell of 20 nodes, numbered from 101, with reduced integration"""
    lines = ["*NODE, NSET=Nall", *(f"{n}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(PLACES, 101))]
    lines += [
        "*ELEMENT, TYPE=C3D20R, ELSET=Eall", "7, " + ", ".join(map(str, range(101, 116))) + ",",
        ", ".join(map(str, range(116, 121)))
    ]
    for name, z in (("foot", 0), ("top", 1)):
        lines += [f"*NSET, NSET={name}", *(str(n) for n, place in enumerate(PLACES, 101) if place[2] == z)]
    lines += ["*MATERIAL, NAME=EL", *material, "*SOLID SECTION, ELSET=Eall, MATERIAL=EL", *steps]
    return "\n".join(lines) + "\n"


# compressed by 0.02 = s / 1000 + (s - 5) / 100
ORDER2 = cube(("*ELASTIC", "1000., 0.3", "*PLASTIC", "5., 0.", "15., 0.1"), "*BOUNDARY", "foot, 3", "101, 1, 2",
              "102, 2", step("*BOUNDARY\ntop, 3, 3, -0.02", "*NODE PRINT, NSET=foot, TOTALS=ONLY\nRF"),
              "*STEP\n*FREQUENCY\n5\n*END STEP")
# the displacement 0.01 x^2 y along x; 8 points integrate x^4, of the shear strain, to 7/36 instead of 1/5
REDUCED = cube(("*ELASTIC", "1000., 0."), step("*BOUNDARY", "Nall, 2, 3",
                                               *(f"{n}, 1, 1, {0.01 * x * x * y}"
                                                 for n, (x, y, _) in enumerate(PLACES, 101)), "*EL FILE", "E",
                                               "*EL PRINT, ELSET=Eall", "S"))

# bent by M L / (E I); node 17 is above the end by half of the length
RIGID = rigid("*CLOAD\n18, 2, 1.E-4\n*NSET, NSET=ends\n17, 18\n*NODE PRINT, NSET=ends\nU, RF")


def blocks(name):
    """{(field, number of the load step): {node: values}} of a .frd file"""
    found, step, values = {}, None, None
    with open(name + ".frd") as file:
        for line in file:
            if line.startswith("  100C"):
                step = int(line[58:63])
            elif line.startswith(" -4"):
                values = found.setdefault((line[5:13].strip(), step), {})
            elif line.startswith(" -3"):
                values = None
            elif line.startswith(" -1") and values is not None:
                words = line[13:].rstrip("\n")
                values[int(line[3:13])] = [float(words[i:i + 12]) for i in range(0, len(words), 12)]
    return found


def table(name):
    """The rows of a .dat file"""
    with open(name + ".dat") as file:
        return [[float(word) for word in line.split()] for line in file if line.strip()[:1] in list("-0123456789")]


def close(what, found, wanted):
    say(what, all(abs(one - other) <= 2e-5 * max(map(abs, wanted)) for one, other in zip(found, wanted)),
        (found, wanted))


def judge():
    found = blocks("pressure")
    close("pressure: displacement", found["DISP", 1][13], [0, 0, -0.02])
    close("pressure: reactions", [sum(values[axis] for values in found["FORC", 1].values()) for axis in range(3)],
          [0, 0, 10])
    close("pressure: reaction of a corner", found["FORC", 1][1], [0, 0, 2.5])
    close("pressure: stress", found["STRESS", 1][3], [0, 0, -10, 0, 0, 0])
    close("pressure: contact pressure", [found["CONTACT", 1][node][3] for node in (5, 9)], [10, 10])
    found, stress = blocks("order2"), 0.07 / 0.011
    close("order2: displacement in the middle of an edge", [found["DISP", 2][117][2]], [-0.01])
    foot = [found["FORC", 2][n][2] for n, place in enumerate(PLACES, 101) if place[2] == 0]
    close("order2: reaction, also of the node inside the face", [sum(foot)], [stress])
    close("order2: stress", found["STRESS", 2][110], [0, 0, -stress, 0, 0, 0])
    close("order2: plastic strain", found["PE", 2][110], [(stress - 5) / 100])
    # the line through x^2 at the points, of the shear strain, is 5/6 at the corner
    close("reduced: strain", blocks("reduced")["TOSTRAIN", 1][107], [0.02, 0, 0, 0.005 * 5 / 6, 0, 0])
    close("reduced: energy", [load("reduced_deck")["steps"][-1]["energy"]], [0.1 * (2 / 9 + 7 / 144)])
    rows = table("order2")
    close("order2: displacement in the file .dat", [rows[-20][3], rows[-1][3]], [0, -0.01])
    close("order2: total force in the file .dat", rows[-21], [0, 0, stress])
    turn, rows = 1e-4 * 2 * 12 / 1000, table("rigid")
    close("rigid: displacement and rotation of its nodes", rows[0] + rows[1], [17, 2 * turn, 0, 0, 18, 0, turn, 0])
    close("rigid: rotation", rows[1][1:], [0, turn, 0])
    x = [0.5 - 0.75**0.5 / 3, 0.5 + 0.75**0.5 / 3]
    close("reduced: stress in the file .dat", sum(table("reduced")[:8], []),
          sum(([7, k + 1, 20 * x[k % 2] * x[k // 2 % 2], 0, 0, 5 * x[k % 2]**2, 0, 0] for k in range(8)), []))


if __name__ == "__main__":
    if sys.argv[1] == "write":
        for key, text in (("pressure", DECKS["pressure"][0]), ("order2", ORDER2), ("reduced", REDUCED),
                          ("rigid", RIGID)):
            with open(key + ".inp", "w") as out:
                out.write(text)
    else:
        judge()
