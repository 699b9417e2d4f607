"""Scenes of the stress tests: the two blocks with anything changed, and a few geometries of their own."""


def box(name, lower, upper, cells, young, poisson, **more):
    return {
        name: {
            "shape": "box", "lower": list(lower), "upper": list(upper), "cells": list(cells), "young": young,
            "poisson": poisson, **more
        }
    }


def two_block(poisson=0.499, slab_young=1.0, block_young=1000.0, element="full", material="linear",
              slab_cells=(20, 6, 3), block_cells=(4, 4, 4), slab_lower=(-4.5, -2, -4.5), slab_upper=(4.5, 2, -1.5),
              block_x=(-3.5, -2.5), block_y=(-0.5, 0.5), height=1.0, lift=0.0, push=-5 / 7, steps=2, pair=None, **top):
    """share/scenes/two_block.yaml; `lift` is the gap between the two at the start, `push` what the top is moved by."""
    floor = slab_upper[2] + lift
    return {
        "bodies": [
            box("slab", slab_lower, slab_upper, slab_cells, slab_young, poisson, element=element, material=material),
            box("block", (block_x[0], block_y[0], floor), (block_x[1], block_y[1], floor + height), block_cells,
                block_young, 0, material=material),
        ],
        "displacements": [{"bottom": {"face": "slab.zmin", "value": [0, 0, 0]}},
                          {"top": {"face": "block.zmax", "value": [0, 0, push]}}],
        "contact": [{"blocks": {"mortar": "slab.zmax", "nonmortar": "block.zmin", **(pair or {})}}],
        "load": {"steps": steps},
        **top,
    }


def flat(aspect):
    """The two blocks with cells `aspect` times as wide as they are high."""
    width = 0.45
    slab = 3 * width / aspect
    return two_block(slab_lower=(-4.5, -2, -1.5 - slab), height=1 / aspect, push=-slab * 5 / 21)


def tall(aspect):
    """The same with cells `aspect` times as high as they are wide."""
    width = 0.45
    slab = 3 * width * aspect
    return two_block(slab_lower=(-4.5, -2, -1.5 - slab), height=aspect, push=-0.2)


def lost():
    """The block is driven so deep into the slab that no pair of facets is left."""
    return two_block(slab_lower=(-4.5, -2, -136.5), height=100, push=-32)


def rubbing(law, force=(0.0, ), moves=None, pressure=300.0, height=0.5, lift=0.0, wedge=False):
    """A block on a plate, under a pressure, pushed by forces or moved by its top, a load step an entry; `wedge`:
    squeezed by a second plate in place of the pressure."""
    factors = {"factors": [1] * len(moves or force)}
    scene = {
        "bodies": [
            box("ground", (-0.5, -0.5, -0.5), (2.5, 1.5, 0), (6, 4, 2), 1e5, 0.3),
            box("block", (0, 0, lift), (2, 1, lift + height), (5, 3, 2), 1e5, 0.3),
        ],
        "displacements": [{"fix": {"face": "ground.zmin", "value": [0, 0, 0]}}],
        "contact": [{"joint": {"mortar": "ground.zmax", "nonmortar": "block.zmin", **law}}],
        "load": factors,
        "ramps": [],
    }
    if moves:
        for c, axis in enumerate("xyz"):
            value = ["free"] * 3
            value[c] = 1
            scene["displacements"].append({f"move{axis}": {"face": "block.zmax", "value": value, "ramp": axis}})
            scene["ramps"].append({axis: {"factors": [move[c] for move in moves]}})
    else:
        scene["pressures"] = [{"press": {"face": "block.zmax", "value": pressure}}]
        scene["forces"] = [{
            "push": {"face": "block.zmin" if height < 1 else "block.zmax", "value": [1, 0, 0], "ramp": "across"}
        }]
        scene["ramps"].append({"across": {"factors": list(force)}})
    if wedge:
        scene["bodies"].append(
            box("lid", (-0.5, -0.5, lift + height), (2.5, 1.5, lift + height + 0.5), (7, 4, 2), 1e5, 0.3))
        scene["displacements"].append({"down": {"face": "lid.zmax", "value": [0, 0, -0.005]}})
        scene["contact"].append({"lid": {"mortar": "lid.zmin", "nonmortar": "block.zmax", **law}})
        del scene["pressures"]
        scene["forces"][0]["push"]["face"] = "block.xmin"
    return scene


def stack(cells, gap=0.0, held=True, young=(100.0, 1000.0, 100.0), weight=1.0, **top):
    """Blocks of unit height on each other, on a fixed one, under gravity alone. `held`: their sides cannot slide
    away."""
    bodies, contact, symmetry = [], [], []
    for k, n in enumerate(cells):
        name, floor, half = f"b{k}", k * (1 + gap), 1 - 0.15 * k
        bodies.append(box(name, (0, 0, floor), (half, half, floor + 1), n, young[k], 0.3))
        if k:
            contact.append({f"c{k}": {"mortar": f"b{k - 1}.zmax", "nonmortar": f"{name}.zmin"}})
            symmetry += [f"{name}.xmin", f"{name}.ymin"] if held else []
    scene = {
        "bodies": bodies,
        "displacements": [{"ground": {"face": "b0.zmin", "value": [0, 0, 0]}}],
        "body_forces": [{"gravity": {"value": [0, 0, -weight]}}],
        "contact": contact,
        **top,
    }
    if symmetry:
        scene["symmetry"] = symmetry
    return scene


def stack_weight(cells, weight=1.0):
    """What rests on the fixed block, and what the sum of all contact forces is."""
    volume = [(1 - 0.15 * k)**2 for k in range(len(cells))]
    return sum(weight * sum(volume[k:]) for k in range(1, len(cells)))


def slide(past, steps=8):
    """A block is pressed on a slab and moved along it until `past` of its length has left the slab's edge."""
    to = 0.02 + past
    return {
        "bodies": [
            box("slab", (0, 0, 0), (2, 1, 1), (8, 4, 4), 10, 0.3),
            box("block", (1.0 - 0.02, 0.1, 1), (2.0 - 0.02, 0.9, 1.5), (5, 4, 2), 1000, 0.3),
        ],
        "displacements": [
            {"bottom": {"face": "slab.zmin", "value": [0, 0, 0]}},
            {"press": {"face": "block.zmax", "value": ["free", 0, -0.05], "ramp": "down"}},
            {"along": {"face": "block.zmax", "value": [to, "free", "free"], "ramp": "along"}},
        ],
        "contact": [{"edge": {"mortar": "slab.zmax", "nonmortar": "block.zmin"}}],
        "load": {"steps": steps},
        "ramps": [{"down": {"factors": [1] * steps}}, {"along": {"factors": [k / (steps - 1) for k in range(steps)]}}],
        "contact_updates": 4,
    }


def plate(thickness):
    """A plate between two blocks, in contact on both sides and held by contact alone across its plane."""
    return {
        "bodies": [
            box("below", (0, 0, -1), (1, 1, 0), (4, 4, 2), 100, 0.3),
            box("plate", (0, 0, 0), (1, 1, thickness), (7, 7, 1), 1000, 0.3),
            box("above", (0.2, 0.2, thickness), (0.8, 0.8, 1 + thickness), (3, 3, 2), 100, 0.3),
        ],
        "displacements": [
            {"ground": {"face": "below.zmin", "value": [0, 0, 0]}},
            {"press": {"face": "above.zmax", "value": [0, 0, -0.05]}},
        ],
        "symmetry": ["plate.xmin", "plate.ymin"],
        "contact": [
            {"lower": {"mortar": "below.zmax", "nonmortar": "plate.zmin"}},
            {"upper": {"mortar": "plate.zmax", "nonmortar": "above.zmin"}},
        ],
        "load": {"steps": 2},
    }


def gmsh_box(file, name, cells, position, faces):
    """Writes a box of hexahedra as Gmsh 2.2, its vertices moved by position(x, y, z) of the unit cube; faces: names of
    zmin, zmax."""
    nx, ny, nz = cells

    def vertex(i, j, k):
        return 1 + i + (nx + 1) * (j + (ny + 1) * k)

    points = [position(i / nx, j / ny, k / nz) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    quads = []
    for j in range(ny):
        for i in range(nx):
            quads.append((1, [vertex(i, j, 0), vertex(i, j + 1, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j, 0)]))
            quads.append((2, [vertex(i, j, nz), vertex(i + 1, j, nz), vertex(i + 1, j + 1, nz), vertex(i, j + 1, nz)]))
    hexes = [[
        vertex(i, j, k),
        vertex(i + 1, j, k),
        vertex(i + 1, j + 1, k),
        vertex(i, j + 1, k),
        vertex(i, j, k + 1),
        vertex(i + 1, j, k + 1),
        vertex(i + 1, j + 1, k + 1),
        vertex(i, j + 1, k + 1)
    ] for k in range(nz) for j in range(ny) for i in range(nx)]
    lines = [
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", f'2 1 "{faces[0]}"', f'2 2 "{faces[1]}"',
        f'3 3 "{name}"', "$EndPhysicalNames"
    ]
    lines += [
        "$Nodes",
        str(len(points)), *(f"{n + 1} {x!r} {y!r} {z!r}" for n, (x, y, z) in enumerate(points)), "$EndNodes"
    ]
    lines += ["$Elements", str(len(quads) + len(hexes))]
    lines += [f"{n + 1} 3 2 {tag} {tag} " + " ".join(map(str, quad)) for n, (tag, quad) in enumerate(quads)]
    lines += [f"{n + 1 + len(quads)} 5 2 3 3 " + " ".join(map(str, cell)) for n, cell in enumerate(hexes)]
    lines += ["$EndElements", ""]
    with open(file, "w") as stream:
        stream.write("\n".join(lines))


def tip(width, depth, lower, shift=(0.0, 0.0), turned=False):
    """Position of a wedge or spike of unit height: its section shrinks to width x depth towards the tip at z = lower.

    Towards the top if `turned`."""

    def position(x, y, z):
        t = 1 - z if turned else z
        return (shift[0] + (x - 0.5) * (width + (1 - width) * t), shift[1] + (y - 0.5) * (depth + (1 - depth) * t),
                lower + z)

    return position


def pointed(folder, width, depth, target="slab", push=-0.1, nonmortar="tip", shift=(0.0, 0.0), young=100.0):
    """A wedge (depth 1) or spike (depth = width) pressed tip first on a slab, or on another one that points up, turned
    by 90 degrees."""
    gmsh_box(f"{folder}/down.msh", "down", (3, 3, 4), tip(width, depth, 0.0, shift), ("low", "high"))
    below = box("base", (-1, -1, -1), (1, 1, 0), (6, 6, 3), 10, 0.3)
    rest, on = "base.zmin", "base.zmax"
    if target == "pointed":
        gmsh_box(f"{folder}/up.msh", "up", (3, 3, 4), tip(depth, width, -1.0, turned=True), ("low", "high"))
        below = {"base": {"mesh": "up.msh", "volume": "up", "young": young, "poisson": 0.3}}
        rest, on = "base.low", "base.high"
    return {
        "bodies": [below, {"top": {"mesh": "down.msh", "volume": "down", "young": young, "poisson": 0.3}}],
        "displacements": [{"ground": {"face": rest, "value": [0, 0, 0]}},
                          {"press": {"face": "top.high", "value": [0, 0, push]}}],
        "contact": [{
            "point": {"mortar": on, "nonmortar": "top.low"}
            if nonmortar == "tip" else {"mortar": "top.low", "nonmortar": on}
        }],
        "load": {"steps": 2},
        "contact_updates": 3,
    }
