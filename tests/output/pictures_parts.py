"""Parts of the pictures of two boxes: one side of a pair, the mark, light, a section, and load steps with one view."""
import json

import draw
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

run = draw.Files("boxes")


def scene(words, frame=None):
    return draw.scene_of(draw.arguments(["boxes", "no.png", *words.split()]), run, frame)


def coloured(words):
    """Corners and values of the coloured faces, and their actors"""
    (_, bodies, _), _, _ = scene(words)
    actors = [actor for actor in bodies.GetActors() if actor.GetMapper().GetScalarVisibility()]
    parts = [actor.GetMapper().GetInput() for actor in actors]
    points = np.concatenate([vtk_to_numpy(part.GetPoints().GetData())[draw.faces_of(part)[1]] for part in parts])
    return points, parts, actors


step = run.step(None)
pressure, owner = run.field(step, "contact_pressure"), draw.body_of_vertices(run)
pressed = owner[np.argmax(pressure)]
_, parts, actors = coloured("--field contact_pressure --contact-only")
values = np.concatenate(
    [vtk_to_numpy(part.GetPointData().GetArray("colour"))[draw.faces_of(part)[1]] for part in parts])
points, _, _ = coloured("--field contact_pressure --contact-only")
places = (run.vertices + run.displacement(step))[(owner == pressed) & run.paired(step)]
off = max(np.linalg.norm(places - point, axis=1).min() for point in points)
print("one side of the pair:", bool(off < 1e-5 and values.max() == pressure.max()))
print("no light on colours:", not any(actor.GetProperty().GetLighting() for actor in actors))
_, _, (value, place, unit) = scene("--field nodal_von_mises")
stress = run.field(step, "nodal_von_mises")
with open("boxes.json", encoding="utf-8") as file:
    figures = [figure for figure in json.load(file)["figures"] if figure["quantity"] == "von Mises stress"]
named = max(figures, key=lambda figure: figure["value"])["place"]  # one of several with the same stress
best = np.argmin(np.linalg.norm(run.vertices - named, axis=1) + (stress < (1 - 1e-6) * stress.max()) * 1e9)
print("mark:", bool(value == stress.max() and np.allclose(run.vertices[best], named)
                    and np.allclose(place, (run.vertices + run.displacement(step))[best])), unit)
low, high = run.vertices.min(axis=0), run.vertices.max(axis=0)
middle = (low + high) / 2
for view, keep in (("20 -60", 1), ("20 60", -1)):
    points, _, _ = coloured(f"--field nodal_von_mises --scale 0 --view {view} --section y={middle[1]}")
    left = keep * (points[:, 1] - middle[1])
    _, _, (_, place, _) = scene(f"--field nodal_von_mises --scale 0 --view {view} --section y={middle[1]}")
    print(f"section, seen from {view}:",
          bool(left.min() > -1e-6 and left.max() > 0.4 * (high - low)[1] and keep * (place[1] - middle[1]) > -1e-6))
args = draw.arguments(["boxes", "no.png", "--field", "nodal_von_mises", "--scale", "auto"])
cells, tiny = draw.chosen_cells(args, run), 1e-14 * run.displacement(step)
print("rounding errors are not enlarged:", draw.displacement_scale(args, run, cells, tiny) == 1)
frame = draw.one_frame(args, run, sorted(run.files))
cameras = []
for args.step in sorted(run.files):
    (_, bodies, _), pixels, _ = draw.scene_of(args, run, frame)
    camera = bodies.GetActiveCamera()
    ranges = {
        actor.GetMapper().GetLookupTable().GetTableRange()
        for actor in bodies.GetActors()
        if actor.GetMapper().GetScalarVisibility()
    }
    cameras.append((pixels, camera.GetParallelScale(), camera.GetPosition(), *ranges))
print("load steps with one view and range:", len(cameras) > 1 and len(set(cameras)) == 1)
