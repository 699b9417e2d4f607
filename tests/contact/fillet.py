"""Writes a block whose lower face is a plane and a fillet, on another block, and the scene: fillet.py cells height
pair."""
import itertools
import math
import sys

n, height = int(sys.argv[1]), float(sys.argv[2])
pair = ", " + " ".join(sys.argv[3:]) if sys.argv[3:] else ""
HIGH = 2  # cells from the lower to the upper face
ANGLES = [math.radians(80) * i / n for i in range(1, n + 1)]
LOWER = [(i / n, 0.0) for i in range(n + 1)] + [(1 + math.sin(a), 1 - math.cos(a)) for a in ANGLES]
number = {}
with open("fillet.inp", "w", encoding="utf-8") as file:
    file.write("*NODE\n")
    for i, j, k in itertools.product(range(len(LOWER)), range(2), range(HIGH + 1)):
        part = k / HIGH
        place = [2 * part * i / (2 * n) + (1 - part) * LOWER[i][0], 0.5 * j, 2 * part + (1 - part) * LOWER[i][1]]
        number[i, j, k] = len(number) + 1
        file.write(f"{number[i, j, k]}, {place[0]}, {place[1]}, {place[2]}\n")
    file.write("*ELEMENT, TYPE=C3D8, ELSET=block\n")
    for e, (i, k) in enumerate(itertools.product(range(2 * n), range(HIGH))):
        corners = [(i + a, b, k + c) for c in range(2) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        file.write(f"{e + 1}, " + ", ".join(str(number[corner]) for corner in corners) + "\n")
    file.write("*SURFACE, NAME=lower\n" + "".join(f"{HIGH * i + 1}, S1\n" for i in range(2 * n)))
    file.write("*SURFACE, NAME=upper\n" + "".join(f"{HIGH * i + HIGH}, S2\n" for i in range(2 * n)))
with open("fillet.yaml", "w", encoding="utf-8") as file:
    file.write(f"""problem: fillet
bodies:
  - block: {{shape: gmsh, mesh: fillet.inp, volume: block, young: 1000, poisson: 0.3}}
  - base: {{lower: [-1, -1, -1], upper: [3, 1, {height}], cells: [6, 3, 2], young: 1000, poisson: 0.3}}
displacements:
  - bottom: {{face: base.zmin, value: [0, 0, 0]}}
  - press: {{face: block.upper, value: [0, 0, -0.001]}}
contact:
  - touch: {{mortar: base.zmax, nonmortar: block.lower{pair}}}
""")
