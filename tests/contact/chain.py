"""Writes a chain of three links that touch at one point each, for assemblies.sh.

python chain.py FILE STRAIGHT AROUND OFFSET"""
import math
import sys

RADIUS, THICKNESS = 3.0, 0.9  # of the bends and of the bar
STRAIGHT = float(sys.argv[2])  # half the length of the straight parts
AROUND, OFFSET = int(sys.argv[3]), float(sys.argv[4])  # cells along the bar, and where they begin


def middle(along):
    """Middle of the bar, and the direction away from the hole; along: from 0 to 1 around the link"""
    length = 4 * STRAIGHT + 2 * math.pi * RADIUS
    side, way = divmod(along * length + STRAIGHT, length / 2)
    sign = 1 if side % 2 == 0 else -1
    if way < 2 * STRAIGHT:
        return sign * (STRAIGHT - way), sign * RADIUS, 0.0, float(sign)
    turn = (way - 2 * STRAIGHT) / RADIUS
    x, y = -STRAIGHT - RADIUS * math.sin(turn), RADIUS * math.cos(turn)
    return sign * x, sign * y, -sign * math.sin(turn), sign * math.cos(turn)


def place(link, along, s, t):
    """A point of the bar; s, t: from -1 to 1 across it"""
    scale = THICKNESS * max(abs(s), abs(t)) / max(math.hypot(s, t), 1e-30)
    x, y, out_x, out_y = middle(along)
    x, y, z = x + scale * s * out_x, y + scale * s * out_y, scale * t
    if link % 2:
        y, z = -z, y
    return x + 2 * (RADIUS + STRAIGHT - THICKNESS) * link, y, z


def write(file, links):
    nodes, cells = [], []
    for link in range(links):
        first, grid = len(nodes), [-1, -0.5, 0, 0.5, 1]
        nodes += [place(link, (k + OFFSET) / AROUND, s, t) for k in range(AROUND) for t in grid for s in grid]
        ring = lambda k, i, j: first + 25 * (k % AROUND) + 5 * j + i + 1
        for k in range(AROUND):
            for j in range(4):
                for i in range(4):
                    face = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    ends = [[ring(k + e, *at) for at in face] for e in (1, 0)]
                    cells.append((f"link{link}", ends[0] + ends[1]))
    with open(file, "w") as out:
        out.write("*NODE\n" + "".join("%d, %.12g, %.12g, %.12g\n" % (n + 1, *x) for n, x in enumerate(nodes)))
        for link in range(links):
            out.write(f"*ELEMENT, TYPE=C3D8, ELSET=link{link}\n")
            own = [(n + 1, *cell) for n, (name, cell) in enumerate(cells) if name == f"link{link}"]
            out.write("".join(", ".join(map(str, row)) + "\n" for row in own))


write(sys.argv[1], 3)
