"""What the bench varies: studies that turn one setting at a time, grouped into pages, the comparison with other
methods, and the growth with size."""
from dataclasses import dataclass

from problems import PROBLEMS
from store import Case

SIZES = ("tiny", "quick", "full")


@dataclass
class Series:
    """The runs of one line, in the order of the knob"""

    label: str
    points: list  # (value of the knob, Case)


@dataclass
class Panel:
    """One problem of a study; careful: the run on the same mesh that shows what is left of the error without the
    mesh"""

    problem: str
    level: str
    series: list
    careful: Case = None

    @property
    def title(self):
        return PROBLEMS[self.problem].title + (f", mesh {self.level}" if self.level else "")


@dataclass
class Study:
    name: str
    title: str
    knob: str
    panels: list
    costs: tuple = ("time", "applications")
    kind: str = "knob"
    text: str = ""  # what the page says before the figure

    def cases(self):
        for panel in self.panels:
            for series in panel.series:
                yield from (case for _, case in series.points)
            if panel.careful:
                yield panel.careful


# problem: its meshes in the studies that turn a knob on one mesh
MESHES = {
    "tiny": {"hertz_sphere": "coarse", "two_block": "1"},
    "quick": {"hertz_sphere": "medium", "two_block": "2", "beam_sphere_linear": "0", "beam_sphere_neo_hookean": "0"},
    "full": {"hertz_sphere": "0", "two_block": "4", "beam_sphere_linear": "1", "beam_sphere_neo_hookean": "0"},
}
# problem: its meshes where the mesh is the knob
LEVELS = {
    "tiny": {},
    "quick": {
        "hertz_cylinder": ("coarse", "medium", "0"), "hertz_sphere": ("coarse", "medium"), "two_block": ("1", "2", "4"),
        "cantilever": ("0", "1")
    },
    "full": {
        "hertz_cylinder": ("coarse", "medium", "0", "1"), "hertz_sphere": ("coarse", "medium", "0"),
        "two_block": ("1", "2", "4", "8"), "cantilever": ("0", "1", "2")
    },
}
# problem: the mesh that -accuracy begins with, its targets
TARGETS = {
    "tiny": {},
    "quick": {
        "hertz_cylinder": ("coarse", ("1e-2", "3e-3", "1e-3")), "hertz_sphere": ("coarse", ("1e-1", "3e-2", "1e-2")),
        "cantilever": ("0", ("1e-2", "3e-3"))
    },
    "full": {
        "hertz_cylinder": ("coarse", ("1e-2", "3e-3", "1e-3", "3e-4")),
        "hertz_sphere": ("coarse", ("1e-1", "3e-2", "1e-2", "3e-3")), "cantilever": ("0", ("1e-2", "3e-3", "1e-3"))
    },
}
LIMIT = {"tiny": 60, "quick": 45, "full": 600}  # seconds of a run
IP = "-tao_ipfilter_"
AMG = IP + "amgf_amg_"
AIJ = ("-elasticity_mat_type", "aij")


def boomeramg(prefix, threshold, down, up):
    """BoomerAMG as both the published and the tuned configuration have it, but for strength threshold and smoother"""
    settings = {
        "coarsen_type": "HMIS", "interp_type": "ext+i", "P_max": "4", "strong_threshold": threshold, "agg_nl": "0",
        "relax_type_down": down, "relax_type_up": up
    }
    return tuple(word for key, value in settings.items() for word in (f"{prefix}pc_hypre_boomeramg_{key}", value))


THRESHOLD = AMG + "pc_hypre_boomeramg_strong_threshold"
# option: what contact has built in, so that one run serves all studies; tests/doc/bench.sh holds this against the
# program
BUILT_IN = {
    IP + "tol": "1e-8", IP + "pc_amgf_cycle": "fbf", THRESHOLD: "0.7", "-contact_gap": "mortar",
    "-contact_quadrature": "5", "-elasticity_quadrature": "2", "-model": "energy"
}
LONG = (IP + "ksp_max_it", "20000")
INTERIOR = (IP + "subspace", "false")
BY_AMG = (IP + "pc_amgf_factor", "false")
# name: keys of every body
ELEMENTS = {
    "full": (("element", "full"), ), "bbar": (("element", "bbar"), ), "incompatible": (("element", "incompatible"), ),
    "order 2": (("element", "full"), ("order", "2")), "order 2, bbar": (("element", "bbar"), ("order", "2"))
}
REFINED_BY = {"uniform": (), "adaptive": ("-accuracy_adaptive", ), "order 2": ("-accuracy_order", "2")}


def values(option, *numbers):
    """The variants of a knob"""
    return [(number, (option, number) if number != BUILT_IN.get(option) else ()) for number in numbers]


def turn(size, problems, variants, careful=None, always=()):
    """Panels of one line each: the variants (value, options[, body keys]) on the mesh of every problem; always: options
    of them all"""
    panels = []
    for problem in problems:
        level = MESHES[size].get(problem)
        if level is None:
            continue
        points = [(variant[0],
                   Case(problem, level, (*always, *variant[1]),
                        tuple(variant[2]) if len(variant) > 2 else (), limit=LIMIT[size])) for variant in variants]
        panels.append(
            Panel(problem, level, [Series("", points)],
                  Case(problem, level, careful, limit=LIMIT[size]) if careful is not None else None))
    return panels


def mesh_page(size):
    """All elements on the same meshes; a requested accuracy, by a mesh that is refined everywhere, where the error is,
    or raised to order 2"""
    panels = []
    for problem, levels in LEVELS[size].items():
        reach = lambda name: levels[:len(levels) - 1] if "order 2" in name and len(levels
                                                                                   ) > 1 else levels  # noqa: B023, E731
        panels.append(
            Panel(problem, "", [
                Series(name, [(level, Case(problem, level, body=body, limit=LIMIT[size]))
                              for level in reach(name)])
                for name, body in ELEMENTS.items()
            ]))
    yield Study("elements", "Elements on the same meshes", "mesh", panels, costs=("time", "memory"))
    panels = []
    for problem, (level, targets) in TARGETS[size].items():
        panels.append(
            Panel(problem, level, [
                Series(name, [(target, Case(problem, level, ("-accuracy", target, *options), limit=2 * LIMIT[size]))
                              for target in targets])
                for name, options in REFINED_BY.items()
            ]))
    yield Study("accuracy", "A requested accuracy: -accuracy", "requested error", panels, costs=("time", "memory"))


def contact_page(size):
    true = ("-contact_updates", "20", IP + "tol", "1e-9")
    three = ("hertz_sphere", "beam_sphere_linear", "beam_sphere_neo_hookean")
    yield Study(
        "updates", "Contact updates per load step", "contact updates",
        turn(size, three, [(n, ("-contact_updates", n)) for n in ("1", "2", "3", "5", "20")], careful=true),
        text=("With 1 the gap is not checked. With more a run fails if the gap is not consistent after so many\n"
              "updates. The default is 20."))
    steps = [(n, ("-load_steps", n, "-contact_updates", "20")) for n in ("1", "2", "4", "8")]
    yield Study("load_steps", "Load steps", "load steps",
                turn(size, three[1:], steps, careful=("-load_steps", "16", *true)))
    two = ("hertz_sphere", "two_block")
    yield Study("gap", "Contact gap: mortar and node to segment", "gap",
                turn(size, two, values("-contact_gap", "mortar", "node")), costs=("time", ))
    yield Study("contact_quadrature", "Degree of exactness of the mortar integrals", "degree",
                turn(size, two, values("-contact_quadrature", "1", "2", "5"), careful=("-contact_quadrature", "8")),
                costs=("time", ))
    rubbing = [("none", ()), ("0.3", (), (("friction", "0.3"), ))]
    yield Study("friction", "Friction: coefficients 0 and 0.3", "friction",
                turn(size, (*two, "beam_sphere_linear"), rubbing),
                text="Friction changes the answer. The table shows what it costs.")


def material_page(size):
    two = ("hertz_sphere", "two_block")
    materials = [("linear", (), (("element", "bbar"), )),
                 ("neo-Hookean", (), (("material", "neohookean"), ("element", "bbar")))]
    yield Study("material", "Material: linear and neo-Hookean", "material", turn(size, two, materials))
    true = ("-load_steps", "12", "-contact_updates", "20")
    yield Study("model", "Load step at finite strain: true energy and quadratic model", "model",
                turn(size, ("beam_sphere_neo_hookean", ), values("-model", "energy", "quadratic"), careful=true))
    yield Study("quadrature", "Gauss points per axis of a hexahedron", "points",
                turn(size, two, values("-elasticity_quadrature", "2", "3")), costs=("time", ))


def solver_page(size):
    three = ("two_block", "hertz_sphere", "beam_sphere_linear")
    ways = [("chosen", ()), ("AMG", BY_AMG), ("MUMPS", (IP + "pc_amgf_factor", "true")), ("interior point", INTERIOR)]
    costs = ("time", "applications", "memory")
    yield Study("method", "Subspace method with AMG or MUMPS, and interior point method", "method",
                turn(size, three, ways), costs=costs)
    end = ("-contact_update_tol", "1e-10")  # so that nothing but the solver is left
    yield Study(
        "tolerance", "Tolerance of the optimizer", "tolerance",
        turn(size, three, values(IP + "tol", "1e-2", "1e-4", "1e-6", "1e-8", "1e-10"),
             careful=(IP + "tol", "1e-12", *end), always=end))
    directions = values(IP + "subspace_max", "20", "80", "320")
    yield Study("directions", "Largest number of directions of the subspace method", "directions",
                turn(size, three, directions, always=BY_AMG), costs=costs)
    amg = [("built in", ()), ("BoomerAMG's V-cycle", (AMG + "pc_type", "hypre")),
           ("GAMG", (AMG + "pc_type", "gamg", *AIJ)), ("ML", (AMG + "pc_type", "ml", *AIJ))]
    yield Study("amg", "AMG of the preconditioner", "AMG", turn(size, three, amg, always=BY_AMG), costs=costs)
    yield Study("threshold", "Strength threshold of the AMG", "threshold",
                turn(size, three, values(THRESHOLD, "0.25", "0.5", "0.7", "0.9"), always=BY_AMG), costs=costs)
    cycles = turn(size, three[:1], values(IP + "pc_amgf_cycle", "fbf", "bfb", "additive"), always=INTERIOR)
    yield Study(
        "cycle", "Order of AMG and filter in the interior point method", "cycle", cycles,
        text=("`fbf` applies the filter before and after the AMG, `bfb` the AMG before and after the filter.\n"
              "In `additive` both are applied to the same residual, and the results are added."))
    panels = []
    for problem in three:
        if level := MESHES[size].get(problem):
            panels.append(
                Panel(problem, level, [
                    Series("", [(str(ranks), Case(problem, level, ranks=ranks, limit=LIMIT[size])) for ranks in (1, 2)])
                ]))
    yield Study("ranks", "Ranks", "ranks", panels, costs=("wall", "time"),
                text="User seconds are summed over the ranks. The figure and the table also show elapsed seconds.")


# name: options of the way
BASELINES = {
    "defaults": (),
    "interior point": INTERIOR,
    "published configuration": ("-options_file", "published.opts"),
    "MUMPS Cholesky": ("-options_file", "direct.opts"),
    "AMG-PCG": (IP + "pc_type", "hypre", *boomeramg(IP, "0.7", "l1-Gauss-Seidel", "backward-l1-Gauss-Seidel"), *LONG),
    "GAMG-PCG": (IP + "pc_type", "gamg", *AIJ, *LONG),
    "TAO almm": ("-tao_type", "almm", "-tao_almm_type", "classic"),
    "TAO pdipm": ("-options_file", "pdipm.opts"),
}


def ways(problem, level, limits):
    """The baselines of a mesh, a series each; limits: name: seconds"""
    return [
        Series(name, [(level, Case(problem, level, BASELINES[name], limit=limit))]) for name, limit in limits.items()
    ]


def baseline_page(size):
    """Where a limit ends a run, the load steps it has done are compared; then two-block from 2,000 to 700,000
    unknowns"""
    every = tuple(BASELINES)
    meshes = {
        "tiny": [], "quick": [("two_block", "2", dict.fromkeys(every, 30) | {every[2]: 60}),
                              ("beam_sphere_linear", "0", dict.fromkeys(every, 30) | {every[2]: 60}),
                              ("ironing", "1", dict.fromkeys(every[:4], 60))]
    }
    meshes["full"] = [
        ("two_block", "2", dict.fromkeys(every, 300)),
        ("two_block", "4", dict.fromkeys(every[:4], 1200)),
        ("ironing", "1", dict.fromkeys(every, 300)),
        ("beam_sphere_linear", "1", dict.fromkeys(every, 300)),
        ("beam_sphere_linear", "2", dict.fromkeys(every[:2], 900)),
    ]
    panels = []
    for problem, level, limits in meshes[size]:
        careful = Case(problem, level, (IP + "tol", "1e-11"), limit=LIMIT[size])
        panels.append(Panel(problem, level, ways(problem, level, limits), careful))
    yield Study("methods", "Comparison with other methods", "mesh", panels, kind="baselines")
    reach = {
        "tiny": {}, "quick": {
            "defaults": ("124", 60), "interior point": ("124", 120), "published configuration": ("12", 60),
            "MUMPS Cholesky": ("12", 60)
        }
    }
    reach["full"] = {
        "defaults": ("1248", 1200), "interior point": ("1248", 1200), "published configuration": ("124", 1800),
        "MUMPS Cholesky": ("124", 1200), "AMG-PCG": ("12", 120), "GAMG-PCG": ("12", 120)
    }
    series = [
        Series(name, [(level, Case("two_block", level, BASELINES[name], limit=limit))
                      for level in levels])
        for name, (levels, limit) in reach[size].items()
    ]
    yield Study("growth", "Growth with size", "mesh", [Panel("two_block", "", series)] if series else [], kind="growth")


# file: title of the page, its studies
PAGES = {
    "mesh": ("Mesh, element and requested accuracy", mesh_page),
    "contact": ("Contact: updates, load steps, integrals, friction", contact_page),
    "material": ("Material and model", material_page),
    "solver": ("Solver", solver_page),
    "methods": ("Other methods, and growth with size", baseline_page),
}


def studies(size, page):
    """All of a page; those that have no problem of that size are left out"""
    return [study for study in PAGES[page][1](size) if study.panels]
