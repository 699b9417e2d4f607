"""The rows of the sweeps: a scene each, what it must come to, and what its answer is held against."""
import os

import scenes
from runner import DIRECT, Case, solve

ENDS = {
    "converges": ("converged", ), "says so": ("failed", "refused"), "is refused": ("refused", ),
    "converges or says so": ("converged", "failed", "refused")
}


class Row:
    """A scene, the end it must come to, and checks: (what, value of the run, exact value, tolerance relative to it).

    Its energy is held against MUMPS on the same scene, or on the scene `like`."""

    def __init__(self, group, name, scene, options=(), end="converges", checks=(), drift=1e-6, reference=True,
                 quick=False, like=None):
        self.group, self.name, self.scene, self.options = group, name, scene, options
        self.end, self.checks, self.drift, self.reference = end, checks, drift, reference
        self.quick, self.like = quick, like


def nonmortar_force(run):
    return run.last["contact_force"][2]


def untouched(run):
    return max(abs(f) for f in run.last["contact_force"])


def rows_of(run):
    return run.last["constraints"]


def penetration(run):
    return max(0.0, -(run.last["gap_true"] or 0.0))


def materials():
    for nu in (0, 0.3, 0.49, 0.499, 0.4999, 0.49999):
        for element in ("full", "bbar"):
            yield Row("Poisson's ratio", f"nu {nu}, {element}", scenes.two_block(poisson=nu, element=element),
                      quick=nu == 0.49999)
    for ratio in (1e-6, 1e-3, 1e-1, 1, 1e1, 1e3, 1e6):
        yield Row("stiffness of block over slab", f"{ratio:g}", scenes.two_block(poisson=0.3, block_young=ratio),
                  quick=ratio in (1e-6, 1e6))


def meshes():
    yield Row("mesh size, nonmortar over mortar", "1:8", scenes.two_block(slab_cells=(9, 4, 2), block_cells=(8, 8, 2)))
    yield Row(
        "mesh size, nonmortar over mortar", "8:1",
        scenes.two_block(slab_lower=(-4.5, -1.5, -4.5), slab_upper=(-1.5, 1.5, -1.5), slab_cells=(24, 24, 3),
                         block_cells=(1, 1, 1)))
    for aspect in (10, 100):
        yield Row("aspect ratio of the cells", f"{aspect} flat", scenes.flat(aspect), quick=aspect == 100)
        yield Row("aspect ratio of the cells", f"{aspect} tall", scenes.tall(aspect), quick=aspect == 100)
    cells = {"slab_cells": (20, 6, 3), "block_cells": (2, 2, 2), "block_x": (-3.6, -2.7), "block_y": (-2 / 3, 2 / 3)}
    for shift in (0, 1e-12, -1e-12, 1e-9):
        moved = {**cells, "block_x": (-3.6 + shift, -2.7 + shift), "block_y": (-2 / 3 + shift, 2 / 3 + shift)}
        yield Row("edges of the two faces", f"aligned, shifted by {shift:g}" if shift else "aligned",
                  scenes.two_block(**moved), quick=shift == 1e-12)


def gaps():
    # the search depth is the mean thickness of the block, unless the distance of the pair is larger
    for overlap in (1e-3, 0.125, 0.25, 0.5):
        pair = {"distance": 0.6} if overlap == 0.5 else {}
        yield Row("overlap at the start", f"{overlap:g}",
                  scenes.two_block(lift=-overlap, push=0, steps=1, contact_updates=20, pair=pair),
                  quick=overlap == 0.25, checks=[("true penetration", penetration, 0, 1e-5), ("rows", rows_of, 25, 0)])
    yield Row("overlap at the start", "0.5, deeper than the search depth", scenes.two_block(lift=-0.5, push=0, steps=1),
              quick=True, end="is refused")
    for lift in (0, 1e-14, -1e-14, 1e-8):
        yield Row("gap at the start", f"{lift:g}", scenes.two_block(lift=lift), quick=lift == 1e-14)
    yield Row("gap at the start", "10, never closed", scenes.two_block(lift=10), checks=[("force", untouched, 0, 1e-7)],
              quick=True)
    closed = scenes.two_block(push=-5 / 7, steps=1, contact_updates=20)
    for steps in (1, 8):
        yield Row(
            "gap at the start",
            f"10, closed in {steps} steps",
            scenes.two_block(lift=10, push=-10 - 5 / 7, steps=steps, contact_updates=20),
            like=closed,
            drift=1e-5,  # the gap is updated to 1e-6 of the largest displacement, which is 10
            checks=[("true penetration", penetration, 0, 1e-4)])


def loads():
    for factor in (0, 1e-8, 1e-4, 1e-2, 10, 100):
        yield Row("load, linear", f"{factor:g}", scenes.two_block(push=-5 / 7 * factor), quick=factor in (1e-8, 100),
                  end="converges" if factor <= 10 else "converges or says so")
    yield Row("load, linear", "no pair left", scenes.lost(), end="converges or says so", reference=False)
    for factor in (1e-8, 1e-4, 1, 2, 3, 4, 10, 100):
        scene = scenes.two_block(push=-5 / 7 * factor, poisson=0.3, block_young=10, material="neohookean",
                                 slab_cells=(10, 5, 3), block_cells=(3, 3, 2), contact_updates=10)
        yield Row("load, neo-Hookean", f"{factor:g}", scene, quick=factor in (1e-8, 10),
                  end="converges" if factor < 2 else "says so" if factor >= 4.2 else "converges or says so")


def shear(run):
    return run.last["pairs"][0]["shear_force"] / run.last["pairs"][0]["normal_force"]


def friction():
    """What friction can do to a solver; laws that are none are refused"""
    path = [(0, 0, -0.002), (0.02, 0, -0.002)]
    for mu in (1e-6, 1e-3, 0.3, 1, 10):
        law = [("friction over normal force", shear, mu, 2e-3)] if mu <= 0.3 else []
        yield Row("friction", f"coefficient {mu:g}, block moved by its top",
                  scenes.rubbing({"friction": mu}, moves=path), checks=law, quick=mu in (1e-6, 10))
    yield Row("friction", "pushed with 0.99 of the force at which it slides",
              scenes.rubbing({"friction": 0.3}, force=(0, 178.2)),
              checks=[("friction over normal force", shear, 0.297, 2e-2)], quick=True)
    yield Row("friction", "pushed with 1.01 of the force at which it slides",
              scenes.rubbing({"friction": 0.3}, force=(0, 181.8)), end="says so", reference=False, quick=True)
    yield Row("friction", "pulled off", scenes.rubbing({"friction": 0.3}, pressure=-300), end="says so",
              reference=False, quick=True)
    yield Row("friction", "turned back twice",
              scenes.rubbing({"friction": 0.3}, moves=[*path, (-0.02, 0, -0.002), (0.02, 0, -0.002)]),
              checks=[("friction over normal force", shear, 0.3, 2e-3)])
    yield Row("friction", "opens and closes again",
              scenes.rubbing({"friction": 0.3}, moves=[*path, (0.02, 0, 0.01), (0.04, 0, -0.002)]), quick=True)
    yield Row("friction", "closes while it slides",
              scenes.rubbing({"friction": 0.3}, moves=[(0.02, 0, -0.007)], lift=0.005),
              checks=[("friction over normal force", shear, 0.3, 2e-3)])
    yield Row("friction", "opens while it slides", scenes.rubbing({"friction": 0.3}, moves=[*path, (0.04, 0, 0.01)]),
              checks=[("force", untouched, 0, 1e-7)])
    yield Row("friction", "no pair in contact", scenes.rubbing({"friction": 0.3}, moves=[(0.02, 0, -0.002)], lift=0.1),
              checks=[("force", untouched, 0, 1e-7)], quick=True)
    for mu in (1, 3, 100):
        yield Row("friction", f"coefficient {mu}, half of the base lifts off",
                  scenes.rubbing({"friction": mu}, force=(0, 125, 250), height=2), quick=mu == 100)
    for mu in (0.3, 3):
        yield Row("friction", f"coefficient {mu:g}, squeezed between plates and pushed",
                  scenes.rubbing({"friction": mu}, force=(0, 300), wedge=True), quick=mu == 3)
    for key, value in (("friction", -0.3), ("friction", "nan"), ("fricton", 0.3), ("shear_limit", -1)):
        yield Row("friction", f"{key}: {value}", scenes.rubbing({key: value}), end="is refused", reference=False)


def structures():
    two, three = [(3, 3, 3), (4, 4, 3)], [(3, 3, 3), (4, 4, 3), (5, 5, 2)]
    weight = ("weight", nonmortar_force)
    yield Row("contact and gravity alone", "block on block", scenes.stack(two),
              checks=[(*weight, scenes.stack_weight(two), 1e-6)], quick=True)
    yield Row("contact and gravity alone", "block above block, gap 0.1", scenes.stack(two, gap=0.1),
              checks=[(*weight, scenes.stack_weight(two), 1e-6)])
    yield Row("contact and gravity alone", "free to slide", scenes.stack(two, held=False),
              checks=[(*weight, scenes.stack_weight(two), 1e-6)], end="converges or says so", quick=True)
    yield Row("contact and gravity alone", "gravity upwards", scenes.stack(two, weight=-1), end="says so",
              reference=False, quick=True)
    yield Row("contact and gravity alone", "tower of three", scenes.stack(three),
              checks=[(*weight, scenes.stack_weight(three), 1e-6)], quick=True)
    yield Row("contact and gravity alone", "tower, soft below stiff", scenes.stack(three, young=(1e3, 10, 1e6)),
              checks=[(*weight, scenes.stack_weight(three), 1e-6)])
    yield Row("contact and gravity alone", "tower of three, neo-Hookean", neo_hookean(scenes.stack(three)),
              checks=[(*weight, scenes.stack_weight(three), 1e-6)])
    for past in (0.5, 0.9, 1.2):
        checks = [("force", untouched, 0, 1e-6)] if past > 1 else []
        yield Row("sliding off an edge", f"{past:g} of the block beyond the edge", scenes.slide(past), checks=checks)
    for thickness in (0.1, 0.01, 0.001):
        yield Row("pairs on both sides of a plate", f"thickness {thickness:g}", scenes.plate(thickness),
                  quick=thickness == 0.01)


def neo_hookean(scene):
    for body in scene["bodies"]:
        next(iter(body.values()))["material"] = "neohookean"
    return scene


def points(folder):
    for name, width, depth in (("wedge", 0.1, 1), ("wedge", 1e-3, 1), ("spike", 0.1, 0.1), ("spike", 1e-3, 1e-3)):
        for target, nonmortar in (("slab", "tip"), ("slab", "slab"), ("pointed", "tip")):
            on = f"on slab, {nonmortar} nonmortar" if target == "slab" else f"on a {name}"
            where = os.path.join(folder, f"{name}_{width:g}_{target}_{nonmortar}")
            os.makedirs(where, exist_ok=True)
            row = Row("sharp bodies", f"{name} {width:g} wide, {on}",
                      scenes.pointed(where, width, depth, target, nonmortar=nonmortar), end="converges or says so",
                      quick=width == 1e-3 and target == "slab" and nonmortar == "tip")
            row.folder = where
            yield row


NO_ENERGY = 1e-18  # the smallest load still gives 20 times as much


def once(row):
    """One linearization of the gap, where the scene does not say: what is swept is the solver"""
    if "contact_updates" not in row.scene:
        row.options = ["-contact_updates", 1, *row.options]
    return row


def rows(folder, refine):
    """refine: of the two linear blocks where the gap is linearized once a load step; the other scenes are solved as
    they are."""
    for row in (*materials(), *meshes(), *gaps(), *loads()):
        if refine and "Hookean" not in row.group:
            if "contact_updates" in row.scene:
                row.name += ", mesh 0"
            else:
                row.options = ["-refine", refine, *row.options]
        yield once(row)
    yield from map(once, structures())
    yield from friction()
    yield from map(once, points(folder))


def drift(run, reference):
    """Relative to the energy, or where there is none but rounding, absolute."""
    if not reference or not reference.converged or not run.converged:
        return None
    return (run.energy - reference.energy) / (reference.energy if abs(reference.energy) > NO_ENERGY else 1.0)


def judge(row, run, reference):
    """What is wrong with a run, as sentences; none: it passes."""
    wrong = []
    if run.status not in ENDS[row.end]:
        wrong.append(f"{run.status}; required: {row.end}")
    if run.status in ("crashed", "refused", "failed", "time limit"):
        return wrong
    off = drift(run, reference)
    if off is not None and not abs(off) <= row.drift:
        wrong.append(f"energy drifts by {off:.1e}")
    for what, value, exact, tolerance in row.checks:
        seen = value(run)
        if not abs(seen - exact) <= tolerance * (abs(exact) or 1.0):
            wrong.append(f"{what} {seen:.6g}, exact {exact:.6g}")
    return wrong


def solve_row(args, row):
    where = getattr(row, "folder", args.folder)
    name = "".join(c if c.isalnum() else "_" for c in f"{row.group}_{row.name}")
    run = solve(where, name, row.scene, row.options, args.limit)
    reference = None
    if row.reference and run.converged:
        reference = solve(where, name + "_direct", row.like or row.scene,
                          ["-options_file", DIRECT, "-tao_ipfilter_tol", 1e-10, *row.options], args.limit)
    return {"name": row.name, "run": run, "drift": drift(run, reference), "wrong": judge(row, run, reference)}


def cases(args):
    for row in rows(args.folder, args.refine):
        yield Case(row.group, row.name, lambda row=row: [solve_row(args, row)])
