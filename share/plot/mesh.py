"""A picture of a mesh before it is used: its volumes in colours, with the edges of the cells and the sharp edges.

contact-mesh FILE -check -picture FILE.png calls it. A program can call draw_mesh().
"""
from types import SimpleNamespace

import numpy as np
from draw import (
    BODY_COLOURS,
    BODIES,
    WIDTH,
    actor_of,
    add,
    body_grid,
    colour_names,
    discrete_table,
    faces_actor,
    fit,
    place_camera,
    sharp_edges,
    surface,
    text_at,
    vtkRenderer,
    write,
)
from screen import open_screen

NAMED = 12  # volumes that have a line with their name


def draw_mesh(points, volumes, picture, caption, view=(25, -60)):
    """points: (n, 3); volumes: {name: list of the corners of its cells, 4 or 8}; writes a PNG file"""
    run = SimpleNamespace(vertices=np.asarray(points, float),
                          cells=[cell for cells in volumes.values() for cell in cells])
    grid = body_grid(run, range(len(run.cells)))
    add(grid.GetCellData(), "colour",
        np.repeat(np.arange(len(volumes)), [len(cells) for cells in volumes.values()]) % len(BODY_COLOURS))
    skin = surface(grid)
    names = list(volumes)[:min(NAMED, len(BODY_COLOURS))]
    colours = discrete_table(names + [""] * (len(BODY_COLOURS) - len(names)), BODY_COLOURS)
    args = SimpleNamespace(no_edges=False, section="", contact_only=False, view=view, up="z")
    bodies, page = vtkRenderer(), vtkRenderer()
    for renderer in (bodies, page):
        renderer.SetBackground(1, 1, 1)
    bodies.AddActor(faces_actor(args, skin, colours))
    bodies.AddActor(actor_of(sharp_edges(skin), (0.1, 0.1, 0.1), 1.4))
    used = run.vertices[np.unique(np.concatenate([np.ravel(cells) for cells in volumes.values()]).astype(int))]
    camera, right, up = place_camera(args, bodies, used.mean(axis=0), max(np.ptp(used, axis=0).max(), 1e-300))
    pixels, part = fit(camera, right, up, used, 0)
    bodies.SetViewport(*part)
    for actor in colour_names("volumes", discrete_table(names, BODY_COLOURS[:len(names)]), pixels):
        page.AddActor2D(actor)
    if len(volumes) > len(names):
        page.AddActor2D(text_at(f"and {len(volumes) - len(names)} more", BODIES * WIDTH + 20, 14, 14))
    page.AddActor2D(text_at(caption, 20, 14, 16))
    open_screen()
    write(((page, bodies), pixels, None), picture)
