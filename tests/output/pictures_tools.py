"""A scene with a tool of each shape, and the check that the surfaces that are drawn are the exact ones."""
import os
import sys

import numpy as np

sys.path[:0] = [os.path.join(os.environ["AMGF_DIR"], "share", folder) for folder in ("plot", "python")]
AXIS = np.array([1.0, 2.0, 2.0]) / 3
MOVE, ANGLE, CENTRE = np.array([0.1, -0.2, 0.3]), 40.0, np.array([1.0, 0.0, 0.0])
SHAPES = {
    "plane": "rigid_plane, point: [0, 0, -1], normal: [1, 2, 2]",
    "sphere": "rigid_sphere, center: [3, 0, 0], radius: 0.8",
    "cylinder": "rigid_cylinder, center: [0, 3, 0], direction: [1, 2, 2], radius: 0.7",
    "cone": "rigid_cone, tip: [0, 0, 2], direction: [1, 2, 2], half_angle: 30",
    "torus": "rigid_torus, center: [0, -3, 0], direction: [1, 2, 2], radius: 1, section_radius: 0.3",
    "groove": "rigid_extruded, center: [0, 0, -2], direction: [1, 2, 2], across: [2, 1, -2], "
    "points: [3, 1, 0.5, 0, -0.5, 0, -3, 1], outside: 0.1",
    "ring": "rigid_revolved, center: [4, 4, 0], direction: [1, 2, 2], outside: 0.1, "
            "points: [0.5, 2, 0.5, 1, 0.9, 0, 0.5, -1, 0.5, -2]",
    "facets": "rigid_stl, mesh: facets.stl, scale: 2",
}
STL = """solid one
facet normal 0 0 1
outer loop
vertex 0 0 1
vertex 1 0 1
vertex 0 1 1
endloop
endfacet
facet normal 1 1 -1
outer loop
vertex 0 0 1
vertex 0 1 1
vertex 0 0 0
endloop
endfacet
facet normal 1 1 -1
outer loop
vertex 0 1 1
vertex 1 0 1
vertex 0 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 1 0 1
vertex 0 0 1
vertex 0 0 0
endloop
endfacet
endsolid one
"""


def write():
    lines = [
        "problem: tools", "bodies:", "  - block: {lower: [-1, -1, -1], upper: [1, 1, 1], cells: [2, 2, 2], young: 1, "
        "poisson: 0.3}"
    ]
    lines += [f"  - {name}: {{shape: {text}}}" for name, text in SHAPES.items()]
    lines += ["displacements:", "  - foot: {face: block.zmin, value: [0, 0, 0]}"]
    lines += [
        f"  - move_{name}: {{body: {name}, value: {MOVE.tolist()}, rotation: {(ANGLE * AXIS[::-1]).tolist()}, "
        f"center: {CENTRE.tolist()}}}" for name in SHAPES
    ]
    with open("tools.yaml", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    with open("facets.stl", "w", encoding="utf-8") as file:
        file.write(STL)


def back(points):
    """Where points were before the tools moved: Rodrigues' formula about the centre"""
    axis, angle = AXIS[::-1], -np.radians(ANGLE)
    r = points - MOVE - CENTRE
    return CENTRE + r * np.cos(angle) + np.cross(axis, r) * np.sin(angle) + np.outer(r @ axis,
                                                                                     axis) * (1 - np.cos(angle))


def polar(points, centre):
    """Distance from an axis, and place along it"""
    r = points - np.array(centre, float)
    along = r @ AXIS
    return np.linalg.norm(r - np.outer(along, AXIS), axis=1), along


def segments(points, line):
    """Distance of points from a line through corners, whose ends are infinite"""
    best = np.full(len(points), np.inf)
    for k, (a, b) in enumerate(zip(line[:-1], line[1:])):
        part = (points - a) @ (b - a) / ((b - a) @ (b - a))
        part = np.clip(part, -np.inf if k == 0 else 0, np.inf if k == len(line) - 2 else 1)
        best = np.minimum(best, np.linalg.norm(points - a - np.outer(part, b - a), axis=1))
    return best


def distance(name, points):
    """From the exact surface"""
    if name == "plane":
        return (points - [0, 0, -1]) @ AXIS
    if name == "sphere":
        return np.linalg.norm(points - [3, 0, 0], axis=1) - 0.8
    if name == "cylinder":
        return polar(points, [0, 3, 0])[0] - 0.7
    if name == "cone":
        across, along = polar(points, [0, 0, 2])
        return across * np.cos(np.pi / 6) - along * np.sin(np.pi / 6)
    if name == "torus":
        across, along = polar(points, [0, -3, 0])
        return np.hypot(across - 1, along) - 0.3
    if name == "groove":
        first = np.array([2, 1, -2]) / 3
        r = points - [0, 0, -2]
        flat = np.stack([r @ first, r @ np.cross(AXIS, first)], axis=1)
        return segments(flat, np.array([[3, 1], [0.5, 0], [-0.5, 0], [-3, 1]], float)) - 0.1
    if name == "ring":
        flat = np.stack(polar(points, [4, 4, 0]), axis=1)
        return segments(flat, np.array([[0.5, 2], [0.5, 1], [0.9, 0], [0.5, -1], [0.5, -2]])) - 0.1
    corners = 2.0 * np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [0, 0, 0]])
    return np.linalg.norm(points[:, None] - corners[None], axis=2).min(axis=1)


def paraview(run):
    """The files of -output tools.pvd: surfaces instead of cubes, displaced as the tools are"""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(f"tools_{run.step(None):04d}.vtu")
    reader.Update()
    grid = reader.GetOutput()
    body, kinds = (vtk_to_numpy(grid.GetCellData().GetArray("body")), vtk_to_numpy(grid.GetCellTypesArray()))
    places = vtk_to_numpy(grid.GetPoints().GetData()) + vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
    ends, nodes = (vtk_to_numpy(values) for values in (grid.GetCells().GetOffsetsArray(),
                                                       grid.GetCells().GetConnectivityArray()))
    off = 0
    for number in run.surfaces:
        own = np.concatenate([nodes[ends[c]:ends[c + 1]] for c in np.flatnonzero(body == number)])
        off = max(off, np.abs(distance(run.bodies[number], back(places[np.unique(own)]))).max())
    print("files for ParaView: cells of tools are faces:", set(kinds[np.isin(body, list(run.surfaces))]) <= {5, 9},
          "; on the exact surface, displaced:", off < 1e-9)


def check():
    import draw
    from contact import tools
    from contact.files import Files

    run = Files("tools")
    moves = run.displacement(run.step(None))
    low, high = np.array([-1.0] * 3), np.array([1.0] * 3)
    print("tools:", *(run.bodies[body] for body in run.surfaces))
    for body, note in run.surfaces.items():
        name = run.bodies[body]
        points, faces = tools.surface(note, low, high)
        cube = run.tools[body]
        after = points + tools.moved(points, run.vertices[cube], moves[cube])
        off = max(np.abs(distance(name, points)).max(), np.abs(distance(name, back(after))).max())
        middles = np.abs(distance(name, points[faces].mean(axis=1))).max() if name != "facets" else 0
        print(f"{name}: on the surface: {'yes' if off < 1e-9 else off},",
              f"middles of the faces near it: {'yes' if middles < 0.02 else middles}")
    paraview(run)
    run = Files("roller")
    colours = draw.field_values(draw.arguments(["roller", "roller.png", "--field", "nodal_von_mises"]), run, 1)
    rigid = draw.body_of_vertices(run) == run.bodies.index("roller")
    grey = np.isnan(colours)
    print("rigid body with a mesh: without colour:", bool(grey[rigid].all() and not grey[~rigid].any()))
    run = Files("tools")
    cells = draw.chosen_cells(draw.arguments(["tools", "tools.png"]), run)
    print("cells that are drawn:", len(cells), "of", {run.bodies[body] for body in run.body[cells]})


if sys.argv[1] == "write":
    write()
else:
    check()
