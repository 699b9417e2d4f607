"""contact-mesh IN OUT converts a mesh, or results BASE.xmf to VTK files OUT.pvd. contact-mesh IN -check lists the
volumes and faces of a mesh, and -picture FILE.png draws it. contact-mesh DECK.inp -scene SCENE.yaml translates a deck
of Abaqus or CalculiX."""
import argparse
import os
import sys

import numpy as np

from contact import ContactError, load
from contact.places import script

from ..decks.translate import translate
from . import formats
from .model import FACETS, KINDS, MeshError
from .quality import cell_volumes, facet_areas, scaled_jacobian


def report(path, mesh, left):
    size = mesh.points.max(axis=0) - mesh.points.min(axis=0)
    yield (f"{path}: {len(mesh.points):,} nodes, {sum(len(cells) for _, cells in mesh.blocks):,} cells, "
           f"{' x '.join(f'{length:.6g}' for length in size)}")
    yield f"{'volume':<32} {'cells':>9} {'kind':<14} {'volume':>13}  worst scaled Jacobian"
    for name, rows in mesh.volumes.items():
        tables = [(mesh.blocks[block][0], mesh.blocks[block][1][these]) for block, these in rows.items()]
        volume = sum(cell_volumes(kind, cells, mesh.points).sum() for kind, cells in tables)
        worst = min(scaled_jacobian(kind, cells, mesh.points).min() for kind, cells in tables)
        kinds = ", ".join(sorted({kind for kind, _ in tables}))
        yield f"{name:<32} {sum(len(cells) for _, cells in tables):>9,} {kinds:<14} {volume:>13.6g}  {worst:.3f}" + (
            "  inverted or flat cells" if worst <= 0 else "")
    yield f"{'face':<32} {'facets':>9} {'kind':<14} {'area':>13}"
    for name, tables in mesh.faces.items():
        area = sum(facet_areas(facets, FACETS[kind], mesh.points).sum() for kind, facets in tables)
        yield (f"{name:<32} {sum(len(facets) for _, facets in tables):>9,} "
               f"{', '.join(kind for kind, _ in tables):<14} {area:>13.6g}")
    if left:
        yield "sets of nodes that hold no whole facet, left out: " + ", ".join(left)


def check(mesh):
    """What keeps a scene from using the mesh"""
    for name in mesh.volumes:
        kinds = mesh.kinds_of(name)
        if len({KINDS[kind].ncorners for kind in kinds}) > 1:
            raise MeshError(
                f"the volume \"{name}\" has cells of the kinds {' and '.join(kinds)}; make two volumes of it "
                f"and tie them")
    if not np.isfinite(mesh.points).all():
        raise MeshError("a coordinate is not a number")


def inverted(mesh):
    """The volumes with inverted or flat cells, how many they are, and the middle of the first"""
    for name, rows in mesh.volumes.items():
        for block, these in rows.items():
            kind, cells = mesh.blocks[block][0], mesh.blocks[block][1][these]
            bad = np.flatnonzero(scaled_jacobian(kind, cells, mesh.points) <= 0)
            if len(bad):
                middle = ", ".join(f"{x:.6g}" for x in mesh.points[cells[bad[0]]].mean(axis=0))
                yield f"the volume \"{name}\" has {len(bad):,} inverted or flat cells, the first at ({middle})"


def draw(mesh, path, picture):
    """A picture of the volumes, by the drawing of share/plot"""
    sys.path.insert(0, os.path.dirname(script("plot/mesh.py")))
    from mesh import draw_mesh

    corners = {
        name: [
            cell for block, these in rows.items()
            for cell in mesh.blocks[block][1][these, :KINDS[mesh.blocks[block][0]].ncorners]
        ]
        for name, rows in mesh.volumes.items()
    }
    draw_mesh(mesh.points, corners, picture,
              f"{os.path.basename(path)}: {sum(len(cells) for cells in corners.values()):,} cells")


def write_results(source, target):
    """Results of a run as files of VTK"""
    try:
        load(source).write_vtk(target)
    except (ContactError, OSError) as error:
        sys.exit(f"contact-mesh: error: {error}")


def write_scene(given):
    """Translates a deck"""
    if not given.input.lower().endswith(".inp"):
        sys.exit(f"contact-mesh: error: {given.input}: -scene translates decks, whose names end in .inp")
    try:
        translator, bodies = translate(given.input, given.scene, given.deck_ignore)
    except (MeshError, OSError) as error:
        text = str(error)
        sys.exit("contact-mesh: error: " + (text if text.startswith(given.input) else f"{given.input}: {text}"))
    if not given.quiet:
        print(f"{given.scene}: {len(bodies.names)} bodies, {sum(step.n for step in translator.steps)} load steps")
        print("\n".join(translator.notes.lines()))


def main():
    parser = argparse.ArgumentParser(prog="contact-mesh", description=__doc__,
                                     epilog=f"Reads {formats.READ}. Writes .msh, .inp and .vtu.")
    parser.add_argument("input")
    parser.add_argument("output", nargs="?")
    parser.add_argument("-scale", "--scale", type=float, default=1.0,
                        help="factor of all coordinates; 1e-3 converts mm to m")
    parser.add_argument("-check", "--check", action="store_true",
                        help="prints volumes, faces, sizes and the quality of the cells")
    parser.add_argument("-picture", "--picture", metavar="FILE.png",
                        help="draws the volumes with the edges of their cells; needs VTK")
    parser.add_argument("-scene", "--scene", metavar="FILE.yaml",
                        help="translates the whole deck (.inp) into a scene FILE.yaml and its mesh FILE.msh")
    parser.add_argument("-deck_ignore", "--deck_ignore", action="append", default=[], metavar="KEYWORD",
                        help="with -scene: keywords of the deck, separated by commas, that are left out")
    parser.add_argument("-quiet", "--quiet", action="store_true", help="prints errors only")
    given = parser.parse_args()
    if given.output is None and not given.check and not given.picture and not given.scene:
        parser.error("give an output file, -scene, -check or -picture")
    if not np.isfinite(given.scale) or given.scale <= 0:
        sys.exit(f"contact-mesh: error: -scale {given.scale}: a factor above 0 is expected")
    if given.input.endswith(".xmf") and given.output:
        write_results(given.input, given.output)
        return
    if given.scene:
        write_scene(given)
        return
    if given.output and os.path.splitext(given.output)[1].lower() not in formats.WRITTEN:
        sys.exit(f"contact-mesh: error: {given.output}: its ending is none of {', '.join(formats.WRITTEN)}")
    try:
        mesh, left = formats.read(given.input)
        mesh.points = given.scale * mesh.points
        check(mesh)
        if given.output:
            partial = given.output + ".part" + os.path.splitext(given.output)[1]
            formats.write(partial, mesh)
            os.replace(partial, given.output)
    except (MeshError, OSError) as error:
        text = str(error)
        sys.exit("contact-mesh: error: " + (text if text.startswith(given.input) else f"{given.input}: {text}"))
    if given.picture:
        draw(mesh, given.input, given.picture)
    if not given.quiet:
        print("\n".join(report(given.input, mesh, left)), flush=True)
    wrong = "; ".join(inverted(mesh)) if given.check else ""
    if wrong:
        sys.exit(f"contact-mesh: error: {given.input}: {wrong}")


if __name__ == "__main__":
    main()
