#!/usr/bin/env python3
"""Draws the deformed bodies of a run from the files that contact -output BASE wrote. No display is needed.

    share/plot/draw.py BASE PICTURE.png [--step N] [--field von_mises] [--scale FACTOR|auto] [--only BODY,...] ...

The field is one that the files hold (von_mises, nodal_von_mises, contact_pressure, contact_gap, contact_status,
displacement, ...), a component of one (displacement_z, stress_xx), or body. Grey lines are the outline of the
undeformed bodies. Contact fields colour only the faces of contact pairs.
"""
import argparse
import os
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "python")]
from interpreter import need

need("numpy", "h5py", "vtkmodules")
import numpy as np
from contact import tools
from contact.files import ContactError, Files
from screen import open_screen, stop

from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersGeneral import vtkReflectionFilter, vtkTableBasedClipDataSet, vtkWarpVector
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter, vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkAxesActor, vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkPolyDataMapper,
    vtkPolyDataMapper2D,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

KINDS = {4: 10, 8: 12, 10: 24}  # VTK's cells by number of nodes
LABELS = {
    "von_mises": "von Mises stress",
    "nodal_von_mises": "von Mises stress",
    "contact_pressure": "contact pressure",
    "contact_gap": "contact gap",
    "displacement": "displacement",
    "contact_area": "area of the vertex",
    "contact_slip_path": "slip path",
}
CUT = "--section takes an axis and a number, as 'y=0', or a normal and a number, as '1,1,0=3'"
STATUS = ["open", "closed", "slipping"]
STATUS_COLOURS = [(0.62, 0.75, 0.89), (0.80, 0.15, 0.15), (0.98, 0.75, 0.20)]
BODY_COLOURS = [
    (0.30, 0.47, 0.66),
    (0.95, 0.56, 0.17),
    (0.35, 0.63, 0.31),
    (0.88, 0.34, 0.35),
    (0.46, 0.72, 0.70),
    (0.69, 0.48, 0.63),
    (0.61, 0.46, 0.37),
]
GREY = (0.80, 0.80, 0.80)
VIRIDIS = [
    (0.267, 0.005, 0.329),
    (0.283, 0.141, 0.458),
    (0.254, 0.265, 0.530),
    (0.207, 0.372, 0.553),
    (0.164, 0.471, 0.558),
    (0.128, 0.567, 0.551),
    (0.135, 0.659, 0.518),
    (0.267, 0.749, 0.441),
    (0.478, 0.821, 0.318),
    (0.741, 0.873, 0.150),
    (0.993, 0.906, 0.144),
]
WIDTH, LOWEST, HIGHEST = 1100, 420, 800  # of the picture [pixels]
VIEW = (20, -60)  # elevation and azimuth [degrees]
BODIES = 0.82  # of the width, left of the colour bar
CAPTION = 44  # below the bodies [pixels]
# Values that differ by less are equal; among their places the one with the smallest product is taken. The program does
# the same: REPORT_TIE and LargestOrder()
TIE, ORDER = 1e-6, (1, 0.6180339887, 0.4142135624)
ROUNDING = 1e-12  # displacements, relative to the size of the model, that are not drawn larger than they are
TRIAD = 130  # below the colour bar


def arguments(words=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("base", help="BASE of contact -output BASE")
    parser.add_argument("picture", help="a PNG file")
    parser.add_argument("--step", type=int, help="load step; default: the last one")
    parser.add_argument("--field", default="von_mises",
                        help="field of the files, for example contact_pressure or displacement_z; default: von_mises")
    parser.add_argument(
        "--scale", default="1",
        help="factor of the displacements; auto: the largest one is at least a tenth of the model's size")
    view = ("ELEVATION", "AZIMUTH")
    parser.add_argument("--view", type=float, nargs=2, metavar=view,
                        help="direction of view [degrees]; default: 20 -60; with --contact-only towards the faces")
    parser.add_argument("--up", choices="xyz", default="z", help="axis that points upwards; default: z")
    parser.add_argument("--only", help="names of the bodies to draw, for example slab,die")
    parser.add_argument("--hide", default="", help="omit cells whose centre is on this side, for example 'y<0'")
    parser.add_argument(
        "--section", default="", metavar="PLANE",
        help="cut the undeformed bodies by a plane and omit the part in front of it, for example 'y=0', "
        "or '1,1,0=3': points whose product with (1, 1, 0) is 3")
    parser.add_argument("--mirror", default="",
                        help="draw also the mirror images in the planes x = 0, y = 0 or z = 0, for example xy")
    zoom = "show a region of FACTOR times the size of the contact area"
    parser.add_argument("--around-contact", type=float, metavar="FACTOR", help=zoom)
    parser.add_argument("--contact-only", action="store_true",
                        help="contact fields: colour one side of each pair, and draw the bodies transparent")
    parser.add_argument("--limit", type=float, help="largest value of the colour bar")
    parser.add_argument("--lowest", type=float, help="smallest value of the colour bar")
    parser.add_argument("--title", default="", help="title above the picture")
    parser.add_argument("--no-edges", action="store_true", help="do not draw the cells' edges")
    return parser.parse_args(words)


def chosen_cells(args, run):
    """Numbers of the cells to draw"""
    keep = np.ones(len(run.cells), bool)
    if args.only:
        keep &= np.isin(run.body, run.body_numbers(args.only))
    if args.hide:
        try:
            axis, side, value = "xyz".index(args.hide[0]), "<>".index(args.hide[1]), float(args.hide[2:])
        except (ValueError, IndexError):
            stop(f"--hide takes an axis, < or >, and a number, as 'y<0', not '{args.hide}'")
        centre = np.array([run.vertices[cell, axis].mean() for cell in run.cells])
        keep &= ~((centre > value) if side else (centre < value))
    if not keep.any():
        stop("no cell is left to draw")
    return np.flatnonzero(keep)


def ids(numbers):
    return numpy_to_vtkIdTypeArray(np.asarray(numbers).astype(np.int64), deep=True)


def body_grid(run, cells):
    """VTK's grid of some cells, undeformed"""
    grid, array, points = vtkUnstructuredGrid(), vtkCellArray(), vtkPoints()
    nodes = [run.cells[c] for c in cells]
    offsets = np.concatenate([[0], np.cumsum([len(cell) for cell in nodes])])
    array.SetData(ids(offsets), ids(np.concatenate(nodes)))
    points.SetData(numpy_to_vtk(run.vertices, deep=True))
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(np.array([KINDS[len(cell)] for cell in nodes], np.uint8), deep=True), array)
    return grid


def plane_of(args):
    """Normal, away from the camera, and distance of the plane of --section"""
    words, _, number = args.section.partition("=")
    try:
        normal = np.eye(3)["xyz".index(words)] if words in ("x", "y", "z") else np.array(words.split(","), float)
        distance = float(number)
    except ValueError:
        stop(f"{CUT}, not '{args.section}'")
    if normal.shape != (3, ) or not normal.any():
        stop(f"{CUT}, not '{args.section}'")
    if normal @ directions(args)[0] > 0:
        normal, distance = -normal, -distance
    return normal, distance


def not_cut_off(args, run):
    """Whether each vertex is on the plane of --section or behind it"""
    if not args.section:
        return np.ones(len(run.vertices), bool)
    normal, distance = plane_of(args)
    along = run.vertices @ normal
    return along >= distance - TIE * np.ptp(along)


def cut(args, grid):
    """The part of a grid behind the plane of --section, seen from the camera"""
    if not args.section:
        return grid
    normal, distance = plane_of(args)
    plane, clip = vtkPlane(), vtkTableBasedClipDataSet()
    plane.SetOrigin(*(normal * distance / (normal @ normal)))
    plane.SetNormal(*normal)
    clip.SetInputData(grid)
    clip.SetClipFunction(plane)
    clip.Update()
    if not clip.GetOutput().GetNumberOfCells():
        stop(f"no part of the bodies is behind the plane {args.section}")
    return clip.GetOutput()


def add(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values, float), deep=True)
    array.SetName(name)
    data.AddArray(array)


def surface(grid):
    """Its outer faces; those of ten nodes are cut into triangles"""
    skin = vtkDataSetSurfaceFilter()
    skin.SetInputData(grid)
    skin.SetNonlinearSubdivisionLevel(1)
    skin.Update()
    return skin.GetOutput()


def mirrored(args, data):
    """The same beside what mirror planes add"""
    for axis in args.mirror:
        mirror = vtkReflectionFilter()
        mirror.SetInputData(data)
        mirror.SetPlane({"x": 6, "y": 7, "z": 8}[axis])  # planes at a centre
        mirror.SetCenter(0.0)
        mirror.CopyInputOn()
        faces = vtkGeometryFilter()
        faces.SetInputConnection(mirror.GetOutputPort())
        faces.Update()
        data = faces.GetOutput()
    return data


def body_of_vertices(run):
    owner = np.zeros(len(run.vertices))
    for body, cell in zip(run.body, run.cells):
        owner[cell] = body
    return owner


def tool_surfaces(args, run, cells, displacement, scale):
    """The surfaces of rigid tools, displaced; infinite ones are drawn around the bodies"""
    nodes = nodes_of(run, cells)
    low, high = run.vertices[nodes].min(axis=0), run.vertices[nodes].max(axis=0)
    for body in run.surfaces if not args.only else set(run.surfaces) & set(run.body_numbers(args.only)):
        cube = run.tools[body]
        points, faces = tools.surface(run.surfaces[body], low, high)
        points = points + scale * tools.moved(points, run.vertices[cube], displacement[cube])
        data, array, places = vtkPolyData(), vtkCellArray(), vtkPoints()
        places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
        array.SetData(ids(np.arange(len(faces) + 1) * faces.shape[1]), ids(faces.ravel()))
        data.SetPoints(places)
        data.SetPolys(array)
        yield data


def tool_actor(data):
    """A surface through which the bodies are seen"""
    actor = actor_of(data, (0.55, 0.60, 0.66), 0.5)
    actor.GetProperty().SetOpacity(0.45)
    return actor


def warped(grid, scale):
    warp = vtkWarpVector()
    grid.GetPointData().SetActiveVectors("displacement")
    warp.SetInputData(grid)
    warp.SetScaleFactor(scale)
    warp.Update()
    return warp.GetOutput()


def faces_of(skin):
    """Where the vertices of each face begin and end, and the vertices"""
    polygons = skin.GetPolys()
    return vtk_to_numpy(polygons.GetOffsetsArray()), vtk_to_numpy(polygons.GetConnectivityArray())


def face_status(skin):
    """The status of a face: the middle one of its vertices'"""
    status, (ends, nodes) = vtk_to_numpy(skin.GetPointData().GetArray("colour")), faces_of(skin)
    add(skin.GetCellData(), "colour", [np.round(np.median(status[nodes[a:b]])) for a, b in zip(ends[:-1], ends[1:])])


def part_of(skin, keep):
    """Some faces of a surface, with the values of its vertices"""
    part, array, faces, (ends, nodes) = vtkPolyData(), vtkCellArray(), np.flatnonzero(keep), faces_of(skin)
    sizes = np.diff(ends)[faces]
    chosen = np.concatenate([nodes[ends[f]:ends[f + 1]] for f in faces]) if len(faces) else np.zeros(0, np.int64)
    array.SetData(ids(np.concatenate([[0], np.cumsum(sizes)])), ids(chosen))
    part.SetPoints(skin.GetPoints())
    part.SetPolys(array)
    part.GetPointData().ShallowCopy(skin.GetPointData())
    return part


def parted(skin):
    """The faces all of whose vertices have a value, and the others"""
    valued, (ends, nodes) = np.isfinite(vtk_to_numpy(skin.GetPointData().GetArray("colour"))), faces_of(skin)
    whole = np.logical_and.reduceat(valued[nodes], ends[:-1])
    return part_of(skin, whole), part_of(skin, ~whole)


def one_side(args, run, step):
    """Vertices of one side of each pair: of the body that has its largest pressure"""
    side, owner = np.zeros(len(run.vertices), bool), body_of_vertices(run)
    pressure = run.field(step, "contact_pressure")
    for paired in run.pairs(step, args.field):
        if paired.any():
            side |= paired & (owner == owner[np.argmax(np.where(paired, pressure, -np.inf))])
    return side


def towards_faces(args, coloured):
    """The direction of view from which coloured faces are seen, unless the user gave one"""
    if args.view is None and args.contact_only and coloured.GetNumberOfCells():
        ends, nodes = faces_of(coloured)
        corners = vtk_to_numpy(coloured.GetPoints().GetData())[np.stack([nodes[ends[:-1] + k] for k in range(3)])]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0]).sum(axis=0)
        if normal["xyz".index(args.up)] < 0:
            args.view = (-25, -60)
    args.view = args.view or VIEW


def continuous_table(low, high):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        place = i / 255 * (len(VIRIDIS) - 1)
        k = min(int(place), len(VIRIDIS) - 2)
        table.SetTableValue(i, *(a + (place - k) * (b - a) for a, b in zip(VIRIDIS[k], VIRIDIS[k + 1])), 1.0)
    table.SetTableRange(low, high if high > low else low + 1.0)
    table.SetNanColor(*GREY, 1.0)
    return table


def discrete_table(names, colours):
    """One colour for each name"""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(names))
    table.SetTableRange(0, len(names) - 1)
    table.IndexedLookupOn()
    for i, name in enumerate(names):
        table.SetAnnotation(i, name)
        table.SetTableValue(i, *colours[i % len(colours)], 1.0)
    return table


def field_values(args, run, step):
    """Values by vertex or by cell of the run; nothing in rigid bodies, and where a vertex is in no contact pair"""
    if args.field == "body":
        return run.body.astype(float)
    values = run.field(step, args.field).astype(float)
    if "stress" in args.field or args.field.endswith("von_mises"):
        owner = run.body if len(values) == len(run.cells) else body_of_vertices(run)
        for body in range(len(run.bodies)):  # rigid bodies have no stress
            if not values[owner == body].any():
                values[owner == body] = np.nan
    if args.field.startswith("contact_") and len(values) == len(run.vertices):
        values[~(one_side(args, run, step) if args.contact_only else run.paired(step))] = np.nan
    return values


def colour_table(args, run, values):
    if args.field == "body":
        return discrete_table(run.bodies, BODY_COLOURS)
    if args.field.startswith("contact_status"):
        return discrete_table(STATUS, STATUS_COLOURS)
    finite = values[np.isfinite(values)]
    if not len(finite) and args.field.startswith("contact_"):
        stop(f"no vertex of these bodies has the field {args.field}")
    if not len(finite):
        finite = np.zeros(1)
    low = min(0.0, finite.min()) if args.lowest is None else args.lowest
    return continuous_table(low, finite.max() if args.limit is None else args.limit)


def displacement_scale(args, run, cells, displacement):
    nodes = nodes_of(run, cells)
    if args.scale == "auto":
        largest, size = np.linalg.norm(displacement[nodes], axis=1).max(), np.ptp(run.vertices[nodes], axis=0).max()
        return max(1.0, 0.1 * size / largest) if largest > ROUNDING * size else 1.0
    try:
        return float(args.scale)
    except ValueError:
        stop(f"--scale takes a number or auto, not '{args.scale}'")


def actor_of(data, colour, width, table=None):
    """Faces coloured by a table, or lines of one colour"""
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if table:
        of_cells = data.GetCellData().GetArray("colour") is not None
        mapper.SetScalarModeToUseCellFieldData() if of_cells else mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("colour")
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
    else:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(*colour)
        actor.GetProperty().SetLineWidth(width)
    actor.SetMapper(mapper)
    return actor


def faces_actor(args, part, table):
    """Colours of a field are those of the table, whatever the light"""
    actor = actor_of(part, GREY, 0.5, table)
    if table and not table.GetIndexedLookup():
        actor.GetProperty().LightingOff()
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.6)
    if not args.no_edges and not args.section:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.35, 0.35, 0.35)
        actor.GetProperty().SetLineWidth(0.5)
    if args.contact_only and not table:
        actor.GetProperty().SetOpacity(0.12)
        actor.GetProperty().EdgeVisibilityOff()
    return actor


def sharp_edges(skin):
    """Edges at which faces make more than 30 degrees, and rims"""
    edges = vtkFeatureEdges()
    edges.SetInputData(skin)
    edges.SetFeatureAngle(30)
    edges.ColoringOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput()


def label_format(table):
    """Three digits of the largest number; no exponent between 0.001 and a million"""
    largest = max(abs(end) for end in table.GetTableRange())
    if not 1e-3 <= largest < 1e6:
        return "%.2e"
    return f"%.{max(0, 2 - int(np.floor(np.log10(largest))))}f"


def colour_bar(title, table, pixels):
    """The bar, and its title in lines that are not cut off"""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(6)
    bar.SetLabelFormat(label_format(table))
    bar.SetUnconstrainedFontSize(True)
    text = bar.GetLabelTextProperty()
    text.SetColor(0, 0, 0)
    text.SetFontSize(15)
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()
    lines = textwrap.wrap(title, 20)
    bar.SetPosition(0.84, TRIAD / pixels)
    bar.SetWidth(0.14)
    bar.SetHeight(0.93 - (TRIAD + 22 * len(lines)) / pixels)
    return [bar] + [
        text_at(line, BODIES * WIDTH + 12,
                int(0.97 * pixels) - 22 * (k + 1), 17) for k, line in enumerate(lines)
    ]


def colour_names(title, table, pixels):
    """A line for each colour, on that colour"""
    lines = [text_at(title, BODIES * WIDTH + 20, pixels // 2 + 50, 17)]
    names = [table.GetAnnotation(i) for i in range(table.GetNumberOfTableValues())]
    colours = [table.GetTableValue(i)[:3] for i in range(len(names))]
    for i, (name, colour) in enumerate(zip(names, colours)):
        line = text_at(f"  {name}  ", BODIES * WIDTH + 20, pixels // 2 + 14 - 32 * i, 17)
        line.GetTextProperty().SetBackgroundColor(*colour)
        line.GetTextProperty().SetBackgroundOpacity(1)
        lines.append(line)
    return lines


def legend(args, run, table, pixels):
    if table.GetIndexedLookup():
        actors = colour_names(args.field.replace("_", " "), table, pixels)
    else:
        name = LABELS.get(args.field, args.field.replace("_", " "))
        unit = run.unit(args.field)
        actors = colour_bar(f"{name} [{'–' if unit == '1' else unit}]", table, pixels)
    if args.field.startswith("contact_") and not args.contact_only:
        actors.append(text_at("grey: not in a pair", 0.7 * WIDTH, 14, 14))
    return actors


def text_at(text, x, y, size):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x, y)
    actor.GetTextProperty().SetColor(0, 0, 0)
    actor.GetTextProperty().SetFontSize(size)
    return actor


def caption(args, run, step, scale, cells, displacement):
    nodes = nodes_of(run, cells)
    largest = np.linalg.norm(displacement[nodes], axis=1).max()
    unit = run.unit("displacement")
    size = f"largest displacement {largest:.3g}" + (f" {unit}" if unit != "length" else "")
    drawn = "to scale" if scale == 1 else f"{scale:.3g} times as large (bodies may seem to overlap)"
    return f"load step {step}; {size}, drawn {drawn}; grey: undeformed"


def contact_box(args, run, step, cells, points):
    """Corners of a box about the vertices in contact, grown by a factor; with their mirror images"""
    nodes = nodes_of(run, cells)
    closed = points[nodes[run.in_contact(step)[nodes]]]
    if not len(closed):
        stop(f"no vertex of these bodies is in contact in load step {step}")
    closed = mirrored_points(args, closed)
    low, high = closed.min(axis=0), closed.max(axis=0)
    return (low + high) / 2, args.around_contact * np.linalg.norm(high - low) / 2


def directions(args):
    """Unit vectors towards the viewer and upwards, from an elevation and an azimuth, as of a map whose normal is up"""
    elevation, azimuth = np.radians(args.view or VIEW)
    order = {"z": [0, 1, 2], "x": [1, 2, 0], "y": [2, 0, 1]}[args.up]
    towards, up = np.zeros(3), np.zeros(3)
    towards[order] = np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)
    up[order] = -np.sin(elevation) * np.cos(azimuth), -np.sin(elevation) * np.sin(azimuth), np.cos(elevation)
    return towards, up


def place_camera(args, renderer, centre, radius):
    """Parallel projection"""
    towards, up = directions(args)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(np.asarray(centre) + 100 * radius * towards))
    camera.SetViewUp(*up)
    right = np.cross(up, towards)
    return camera, right, up


def fit(camera, right, up, corners, heading):
    """Lets the corners fill the projection; returns the height of the picture and the bodies' part of it"""
    across, along = corners @ right, corners @ up
    width, height = 1.06 * np.ptp(across), 1.06 * np.ptp(along)
    pixels = int(min(max(height / width * BODIES * WIDTH, LOWEST), HIGHEST))
    focal, place = np.array(camera.GetFocalPoint()), np.array(camera.GetPosition())
    move = ((across.max() + across.min()) / 2 - focal @ right) * right
    move += ((along.max() + along.min()) / 2 - focal @ up) * up
    camera.SetFocalPoint(*(focal + move))
    camera.SetPosition(*(place + move))
    camera.SetParallelScale(max(width / (BODIES * WIDTH) * pixels, height) / 2)
    total = CAPTION + pixels + heading
    return total, (0, CAPTION / total, BODIES, 1 - heading / total)


def write(scene, picture):
    """Writes the picture. Returns whether the place of the largest value is hidden."""
    renderers, pixels, best = scene
    window, image, writer = vtkRenderWindow(), vtkWindowToImageFilter(), vtkPNGWriter()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, pixels)
    for renderer in renderers:
        window.AddRenderer(renderer)
        renderer.ResetCameraClippingRange()
    hidden = False
    if best:
        value, place, unit = best
        clear = [actor for actor in renderers[1].GetActors() if actor.GetProperty().GetOpacity() < 1]
        for actor in clear:  # what is seen through hides nothing
            actor.VisibilityOff()
        window.Render()
        hidden = mark(renderers[1], place, value, unit)
        for actor in clear:
            actor.VisibilityOn()
    window.Render()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    writer.SetCompressionLevel(9)
    writer.SetFileName(picture)
    writer.SetInputData(image.GetOutput())
    writer.Write()
    window.Finalize()
    return hidden


def nodes_of(run, cells):
    return np.unique(np.concatenate([run.cells[c] for c in cells]))


def mirrored_points(args, points):
    for axis in args.mirror:
        points = np.concatenate([points, points * np.where(np.arange(3) == "xyz".index(axis), -1, 1)])
    return points


def measure(args, run, step):
    """The range of the colours, and the points that the picture of a load step shows"""
    cells, displacement = chosen_cells(args, run), run.displacement(step)
    nodes, scale = nodes_of(run, cells), displacement_scale(args, run, cells, displacement)
    points = run.vertices[nodes]
    pieces = [vtk_to_numpy(data.GetPoints().GetData()) for data in tool_surfaces(args, run, cells, displacement, scale)]
    points = np.concatenate(
        [mirrored_points(args, np.concatenate([points, points + scale * displacement[nodes]])), *pieces])
    values = field_values(args, run, step)
    shown = values[cells] if len(values) == len(run.cells) else values[nodes]
    low, high = colour_table(args, run, shown).GetTableRange()
    return low, high, scale, points


def one_frame(args, run, steps):
    """Sets one range of colours and one scale of displacements for all load steps; returns points for one view"""
    low, high, scales, points = zip(*(measure(args, run, step) for step in steps))
    args.lowest, args.limit, args.scale = min(low), max(high), str(min(scales))
    cells, displacement = chosen_cells(args, run), run.displacement(steps[-1])
    towards_faces(args, coloured_bodies(args, run, cells, field_values(args, run, steps[-1]), displacement, 1)[1])
    towards, up = directions(args)
    sides = (np.cross(up, towards), up)
    return np.concatenate(
        [part[[index(part @ side) for side in sides for index in (np.argmin, np.argmax)]] for part in points])


def coloured_bodies(args, run, cells, values, displacement, scale):
    """The surface with its colours and displaced, in two parts: with colours and without; and the undeformed outline"""
    grid, by_cell = body_grid(run, cells), len(values) == len(run.cells)
    add(grid.GetPointData(), "displacement", displacement)
    outline = mirrored(args, sharp_edges(surface(grid)))
    add(grid.GetCellData() if by_cell else grid.GetPointData(), "colour", values[cells] if by_cell else values)
    skin = surface(warped(cut(args, grid), scale))
    coloured, plain = (skin, None) if by_cell else parted(skin)
    if args.field.startswith("contact_status"):
        face_status(coloured)
    return skin, coloured, plain, outline


def largest_place(args, run, cells, values, points):
    """The largest value of what is drawn, and where it is; None for a field of names"""
    if args.field == "body" or args.field.startswith("contact_status"):
        return None
    by_cell, left = len(values) == len(run.cells), not_cut_off(args, run)
    numbers = cells if by_cell else nodes_of(run, cells)
    shown = np.array([left[run.cells[cell]].any() for cell in cells]) if by_cell else left[numbers]
    numbers = numbers[shown & np.isfinite(values[numbers])]
    if not len(numbers):
        return None
    largest = values[numbers].max()
    best = numbers[values[numbers] >= largest - TIE * abs(largest)]
    if not by_cell:
        return largest, points[best[np.argmin(run.vertices[best] @ ORDER)]]
    corners = np.concatenate([run.cells[cell] for cell in best])
    corners = points[corners[left[corners]]]
    return largest, corners[np.argmax(corners @ directions(args)[0])]  # the one next to the viewer


def number(value):
    """Four digits, and no exponent up to a million"""
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e6 else f"{value:.4g}"


def mark(renderer, place, value, unit):
    """A ring where the largest value is, with its number. Returns whether the place is hidden."""
    renderer.SetWorldPoint(*place, 1)
    renderer.WorldToDisplay()
    x, y, depth = renderer.GetDisplayPoint()
    hidden = renderer.GetZ(int(x), int(y)) < depth - 1e-3
    x, y = np.array([x, y]) - renderer.GetOrigin()
    ring, mapper, actor = vtkRegularPolygonSource(), vtkPolyDataMapper2D(), vtkActor2D()
    ring.SetNumberOfSides(24)
    ring.SetRadius(7)
    ring.GeneratePolygonOff()
    mapper.SetInputConnection(ring.GetOutputPort())
    actor.SetMapper(mapper)
    actor.SetPosition(x, y)
    actor.GetProperty().SetColor(0.85, 0, 0)
    actor.GetProperty().SetLineWidth(2.5)
    text = text_at(number(value) + (f" {unit}" if unit != "1" else "") + " (behind)" * hidden, x + 12, y + 8, 17)
    text.GetTextProperty().SetColor(0.75, 0, 0)
    text.GetTextProperty().SetBackgroundColor(1, 1, 1)
    text.GetTextProperty().SetBackgroundOpacity(0.75)
    if x > 0.65 * WIDTH:
        text.GetTextProperty().SetJustificationToRight()
        text.SetPosition(x - 12, y + 8)
    renderer.AddActor2D(actor)
    renderer.AddActor2D(text)
    return hidden


def triad(args, pixels):
    """The three axes, in the corner below the colours"""
    renderer, axes = vtkRenderer(), vtkAxesActor()
    for word, text in zip(
            "xyz", (axes.GetXAxisCaptionActor2D(), axes.GetYAxisCaptionActor2D(), axes.GetZAxisCaptionActor2D())):
        text.GetTextActor().SetTextScaleModeToNone()
        text.GetCaptionTextProperty().SetFontSize(15)
        text.GetCaptionTextProperty().SetColor(0, 0, 0)
        text.GetCaptionTextProperty().ShadowOff()
    axes.SetXAxisLabelText("x")
    axes.SetYAxisLabelText("y")
    axes.SetZAxisLabelText("z")
    renderer.AddActor(axes)
    renderer.SetBackground(1, 1, 1)
    camera, _, _ = place_camera(args, renderer, np.zeros(3), 1.0)
    camera.SetParallelScale(1.5)
    renderer.SetViewport(0.85, 10 / pixels, 0.85 + (TRIAD - 20) / WIDTH, (TRIAD - 10) / pixels)
    return renderer


def scene_of(args, run, frame=None):
    """What is drawn, as VTK's renderers, and the height of its picture. frame: points that the view shows"""
    step, cells = run.step(args.step), chosen_cells(args, run)
    values, displacement = field_values(args, run, step), run.displacement(step)
    scale = displacement_scale(args, run, cells, displacement)
    shown = values[cells] if len(values) == len(run.cells) else values[nodes_of(run, cells)]
    table = colour_table(args, run, shown)
    skin, coloured, plain, outline = coloured_bodies(args, run, cells, values, displacement, scale)
    towards_faces(args, coloured)
    bodies, page = vtkRenderer(), vtkRenderer()
    for part, colours in ((coloured, table), (plain, None)):
        if part and part.GetNumberOfCells():
            bodies.AddActor(faces_actor(args, mirrored(args, part), colours))
    skin = mirrored(args, skin)
    pieces = [mirrored(args, data) for data in tool_surfaces(args, run, cells, displacement, scale)]
    for data in pieces:
        bodies.AddActor(tool_actor(data))
        bodies.AddActor(actor_of(sharp_edges(data), (0.35, 0.40, 0.46), 1.2))
    for renderer in (bodies, page):
        renderer.SetBackground(1, 1, 1)
    bodies.AddActor(actor_of(outline, (0.55, 0.55, 0.55), 1.2))
    bodies.AddActor(actor_of(sharp_edges(skin), (0.1, 0.1, 0.1), 1.4))
    corners = frame
    if frame is None:
        corners = np.concatenate(
            [vtk_to_numpy(data.GetPoints().GetData()).astype(float) for data in (skin, outline, *pieces)])
    points = run.vertices + scale * displacement
    if args.around_contact:
        centre, radius = contact_box(args, run, step, cells, points)
        corners = centre + radius * (2.0 * np.array(list(np.ndindex(2, 2, 2))) - 1.0) / 3**0.5
    camera, right, up = place_camera(args, bodies, corners.mean(axis=0), np.ptp(corners, axis=0).max())
    pixels, part = fit(camera, right, up, corners, 50 if args.title else 0)
    bodies.SetViewport(*part)
    for actor in legend(args, run, table, pixels):
        page.AddActor2D(actor)
    page.AddActor2D(text_at(caption(args, run, step, scale, cells, displacement), 20, 14, 14))
    if args.title:
        page.AddActor2D(text_at(args.title, 20, pixels - 36, 22))
    best = largest_place(args, run, cells, values, points)
    return (page, bodies, triad(args, pixels)), pixels, best and (*best, run.unit(args.field) if run.units else "1")


def draw(words=None):
    args = arguments(words)
    try:
        scene = scene_of(args, Files(args.base))
    except ContactError as error:
        stop(str(error))
    open_screen()
    write(scene, args.picture)


def draw_steps(args, steps, pictures):
    """Pictures of load steps with one range of colours, one scale and one view. Returns which hide the largest one."""
    try:
        run = Files(args.base)
        frame = one_frame(args, run, steps)
        open_screen()
        hidden = []
        for args.step, picture in zip(steps, pictures):
            hidden.append(write(scene_of(args, run, frame), picture))
        return hidden
    except ContactError as error:
        stop(str(error))


if __name__ == "__main__":
    draw()
