"""Writes a mesh of two rings, one inside the other, for round_bodies.sh: python round_bodies.py FILE.

The triangles of the round faces are irregular, so that their normals miss the axis."""
import math
import sys

AROUND, LAYERS = 20, 1


def ring(nodes, cells, ends, tag, radii, shift):
    first = len(nodes)
    for k in range(LAYERS + 1):
        for j in range(AROUND):
            angle = 2 * math.pi / AROUND * (j + shift * ((7 * j + 3 * k) % 5 - 2) * 0.1 + 0.25 * k)
            for r in radii:
                nodes.append((r * math.cos(angle), r * math.sin(angle), 4.0 * k / LAYERS))
    at = lambda i, j, k: first + 1 + i + 2 * (j % AROUND + AROUND * k)
    for k in range(LAYERS):
        for j in range(AROUND):
            v = [at(i, j + a, k + b) for b in (0, 1) for a in (0, 1) for i in (0, 1)]
            for a, b in ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)):
                cells.append((tag, v[0], v[a], v[b], v[7]))
            ends += [] if k else [(tag, v[0], v[1], v[3]), (tag, v[0], v[3], v[2])]


nodes, cells, ends = [], [], []
ring(nodes, cells, ends, 1, (5.0, 8.0), 1)
ring(nodes, cells, ends, 2, (2.5, 4.99), -1)
with open(sys.argv[1], 'w') as f:
    f.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n')
    f.write('$PhysicalNames\n4\n3 1 "hub"\n3 2 "bush"\n2 1 "hub_end"\n2 2 "bush_end"\n$EndPhysicalNames\n')
    f.write(f'$Nodes\n{len(nodes)}\n')
    for n, x in enumerate(nodes):
        f.write(f'{n + 1} {x[0]!r} {x[1]!r} {x[2]!r}\n')
    f.write(f'$EndNodes\n$Elements\n{len(cells) + len(ends)}\n')
    for n, c in enumerate(ends):
        f.write(f'{len(cells) + n + 1} 2 2 {c[0]} {c[0]} {c[1]} {c[2]} {c[3]}\n')
    for n, c in enumerate(cells):
        f.write(f'{n + 1} 4 2 {c[0]} {c[0]} {c[1]} {c[2]} {c[3]} {c[4]}\n')
    f.write('$EndElements\n')
