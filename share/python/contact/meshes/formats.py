"""Reads and writes mesh files. Abaqus decks have a reader of their own, sides of Exodus too; the rest is meshio's."""
import contextlib
import os

import numpy as np

from . import abaqus, gmsh
from .model import FACETS, KINDS, Mesh, MeshError, VTK_TO_ABAQUS_27

READ = ".inp, .msh, .med, .e, .exo, .ex2, .vtu, .vtk"
# Exodus' sides as Abaqus' sides, from 0
EXODUS_SIDES = {4: (1, 2, 3, 0), 8: (2, 3, 4, 5, 0, 1)}
WEDGES = {"wedge": 3}


def meshio_module():
    try:
        import meshio
    except ImportError:
        raise MeshError("this format needs the Python module meshio (Debian: python3-meshio)") from None
    return meshio


def read(path):
    """The mesh of a file, and the names of its sets that are neither volume nor face"""
    suffix = os.path.splitext(path)[1].lower()
    if not os.path.isfile(path):
        raise MeshError("there is no such file")
    if suffix == ".inp":
        return abaqus.read(path)
    if suffix not in READ.replace(",", "").split():
        raise MeshError(f"its ending \"{suffix}\" is none of {READ}")
    try:
        with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere), contextlib.redirect_stderr(nowhere):
            source = meshio_module().read(path)
    except (MeshError, MemoryError, KeyboardInterrupt):
        raise
    except ModuleNotFoundError as error:
        raise MeshError(
            f"this format needs the Python module {error.name} (Debian: python3-{error.name.lower()})") from None
    except (Exception, SystemExit) as error:  # readers of meshio end by whatever a damaged file leads to
        reason = "" if isinstance(error, SystemExit) else f" ({str(error).strip() or type(error).__name__})"
        raise MeshError(f"meshio cannot read it as a file of that format{reason}") from None
    points = np.zeros((len(source.points), 3))
    points[:, :source.points.shape[1]] = source.points
    mesh, numbers, facets = Mesh(points), {}, {}
    for at, block in enumerate(source.cells):
        cells = np.asarray(block.data)
        if block.type == "hexahedron27":
            cells = cells[:, VTK_TO_ABAQUS_27]
        if block.type in FACETS:
            facets[at] = (block.type, cells)
        elif block.type not in ("line", "line3", "vertex"):
            numbers[at] = (mesh.add_block(block.type, cells), WEDGES.get(block.type, 1))
    for name, rows in named_cells(source, suffix):
        for at, these in rows.items():
            if at in numbers:
                block, copies = numbers[at]
                mesh.add_volume(name, {block: (copies * these[:, None] + np.arange(copies)).ravel()})
            elif at in facets and len(these):
                mesh.add_face(name, facets[at][0], facets[at][1][these])
    if suffix in (".e", ".exo", ".ex2"):
        add_exodus_names(mesh, path, numbers)
    left = mesh.add_node_sets(dict(named_points(source)))
    abaqus.merge_facets(mesh)
    mesh.finish()
    return mesh, left


def named_cells(source, suffix):
    """(name, {block: rows}) of sets of cells, of MED's families, of physical names, and of the integers of a VTU
    file"""
    for name, rows in source.cell_sets.items():
        if not name.startswith("gmsh:"):
            yield name, {
                at: np.asarray(these, int)
                for at, these in enumerate(rows)
                if these is not None and len(these)
            }
    families = getattr(source, "cell_tags", None) or {}
    if families and "cell_tags" in source.cell_data:
        names = sorted({name for group in families.values() for name in group})
        for name in names:
            members = [tag for tag, group in families.items() if name in group]
            yield name, {
                at: np.flatnonzero(np.isin(tags, members))
                for at, tags in enumerate(source.cell_data["cell_tags"])
            }
    tags = source.cell_data.get("gmsh:physical")
    if tags is not None and not any(not name.startswith("gmsh:") for name in source.cell_sets):
        dims = {at: block.dim for at, block in enumerate(source.cells)}
        for name, (tag, dim) in source.field_data.items():
            yield name, {
                at: np.flatnonzero(np.asarray(these) == tag)
                for at, these in enumerate(tags)
                if dims[at] == dim
            }
    if suffix in (".vtu", ".vtk"):
        for name, values in source.cell_data.items():
            if all(np.issubdtype(np.asarray(these).dtype, np.integer) for these in values):
                for value in sorted({int(one) for these in values for one in np.unique(these)}):
                    yield f"{name}_{value}", {
                        at: np.flatnonzero(np.asarray(these).ravel() == value)
                        for at, these in enumerate(values)
                    }
                break


def named_points(source):
    for name, nodes in source.point_sets.items():
        yield name, np.asarray(nodes, int)
    families = getattr(source, "point_tags", None) or {}
    tags = source.point_data.get("point_tags")
    for name in sorted({name for group in families.values() for name in group}) if tags is not None else ():
        yield name, np.flatnonzero(np.isin(tags, [tag for tag, group in families.items() if name in group]))


def add_exodus_names(mesh, path, numbers):
    """Names of element blocks and side sets, which meshio leaves out"""
    import netCDF4

    with netCDF4.Dataset(path) as file:

        def names(variable, count, word):
            table = file.variables[variable][:] if variable in file.variables else []
            given = ["".join(letter.decode() for letter in np.ma.filled(row, b"")).strip("\0 ") for row in table]
            return [given[i] if i < len(given) and given[i] else f"{word}_{i + 1}" for i in range(count)]

        nblocks = len(file.dimensions["num_el_blk"]) if "num_el_blk" in file.dimensions else 0
        block_names = names("eb_names", nblocks, "block")
        sizes = [len(file.dimensions[f"num_el_in_blk{i + 1}"]) for i in range(nblocks)]
        for at, name in enumerate(block_names):
            if at in numbers:
                block, copies = numbers[at]
                mesh.add_volume(name, {block: np.arange(copies * sizes[at])})
        first = np.concatenate([[0], np.cumsum(sizes)]).astype(int)
        nsets = len(file.dimensions["num_side_sets"]) if "num_side_sets" in file.dimensions else 0
        for i, name in enumerate(names("ss_names", nsets, "side_set")):
            elements, sides = (np.asarray(file.variables[f"{word}_ss{i + 1}"][:], int) - 1 for word in ("elem", "side"))
            which = np.searchsorted(first, elements, side="right") - 1
            for at, side in sorted({(int(a), int(b)) for a, b in zip(which, sides)}):
                if at not in numbers or numbers[at][1] > 1:
                    raise MeshError(f"the side set \"{name}\" is on cells that are neither tetrahedra nor hexahedra")
                block = numbers[at][0]
                rows = elements[(which == at) & (sides == side)] - first[at]
                mesh.add_sides(name, block, rows, EXODUS_SIDES[KINDS[mesh.blocks[block][0]].ncorners][side])


WRITTEN = (".msh", ".inp", ".vtu")


def write(path, mesh):
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".inp":
        abaqus.write(path, mesh)
    elif suffix == ".msh":
        gmsh.write(path, mesh)
    else:
        write_vtu(path, mesh)


def to_vtk(kind, cells):
    return cells[:, np.argsort(VTK_TO_ABAQUS_27)] if kind == "hexahedron27" else cells


def write_vtu(path, mesh):
    """For a look at it: cells with the number of their first volume"""
    meshio = meshio_module()
    number = [np.zeros(len(cells), int) for _, cells in mesh.blocks]
    for tag, rows in reversed(list(enumerate(mesh.volumes.values(), 1))):
        for block, these in rows.items():
            number[block][these] = tag
    meshio.write(
        path,
        meshio.Mesh(mesh.points, [(kind, to_vtk(kind, cells)) for kind, cells in mesh.blocks],
                    cell_data={"volume": number}), binary=True)
