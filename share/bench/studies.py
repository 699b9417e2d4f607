"""What the bench runs: studies that turn one knob at a time, the baselines, the growth with size, and the runs behind the roofline."""
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
    """One problem of a study; careful: the run on the same mesh that shows what is left of the error without the mesh"""

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
    needs: str = ""  # an option without which the study makes no sense
    kind: str = "knob"
    default: str = ""  # the value of the knob that contact has built in; only where every value leads to the same answer

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
    "full": {"hertz_sphere": "0", "hertz_cylinder": "0", "two_block": "3", "beam_sphere_linear": "0", "beam_sphere_neo_hookean": "0"},
}
# meshes made by refinement, besides; the AMG coarsens by the numbering
REFINED = {"tiny": {}, "quick": {"cantilever": "1"}, "full": {"two_block": "4", "cantilever": "2"}}
# problem: its meshes where the mesh is the knob
LEVELS = {
    "tiny": {"hertz_sphere": ("coarse",), "two_block": ("1", "2")},
    "quick": {"hertz_sphere": ("coarse", "medium", "0"), "hertz_cylinder": ("coarse", "medium", "0"), "two_block": ("1", "2", "3"), "beam_sphere_linear": ("0",), "cantilever": ("0", "1")},
    "full": {"hertz_sphere": ("coarse", "medium", "0", "1"), "hertz_cylinder": ("coarse", "medium", "0", "1", "2"), "two_block": ("1", "2", "4", "8"), "beam_sphere_linear": ("0", "1", "2"), "cantilever": ("0", "1", "2", "3")},
}
IP = "-tao_ipfilter_"
AMG = IP + "amgf_amg_"
AIJ = ("-elasticity_mat_type", "aij")


def boomeramg(prefix, threshold, down, up):
    """BoomerAMG as both the published and the tuned configuration have it, but for strength threshold and smoother"""
    settings = {"coarsen_type": "HMIS", "interp_type": "ext+i", "P_max": "4", "strong_threshold": threshold, "agg_nl": "0", "relax_type_down": down, "relax_type_up": up}
    return tuple(word for key, value in settings.items() for word in (f"{prefix}pc_hypre_boomeramg_{key}", value))


THRESHOLD = AMG + "pc_hypre_boomeramg_strong_threshold"
ELASTIC_THRESHOLD = THRESHOLD.replace(IP, "-elasticity_")  # where there is no contact
# option: what contact has built in, so that one run serves all studies; tests/doc/bench.sh holds this against the program
BUILT_IN = {IP + "tol": "1e-8", IP + "pc_amgf_cycle": "fbf", IP + "pc_amgf_amg_lag": "auto", THRESHOLD: "0.7", "-contact_gap": "mortar", "-contact_quadrature": "5", "-elasticity_quadrature": "2"}
TUNED = (BUILT_IN[THRESHOLD], "l1-Gauss-Seidel", "backward-l1-Gauss-Seidel")
PUBLISHED = ("0.5", "l1scaled-SOR/Jacobi", "l1scaled-SOR/Jacobi")
LONG = (IP + "ksp_max_it", "20000")
# the knobs of a Newton system turn something in the interior point method alone, those of the AMG where no factorization takes its place
INTERIOR = (IP + "subspace", "false")
BY_AMG = (IP + "pc_amgf_factor", "false")
TOLERANCES = ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10")


def values(option, *numbers, also=()):
    """The variants of a knob; also: options that take the same value"""
    return [(number, tuple(word for name in (option, *also) for word in (name, number)) if number != BUILT_IN.get(option) else ()) for number in numbers]


def few(size, problems):
    """Small benches turn most knobs on two problems"""
    return problems if size == "full" else problems[:2]


def turn(size, problems, variants, careful=None, work=1.0, meshes=MESHES, always=()):
    """Panels of one line each: the variants (value, options[, body keys]) on the mesh of every problem; always: options of them all"""
    panels = []
    for problem in problems:
        level = meshes[size].get(problem)
        if level is None:
            continue
        points = [(variant[0], Case(problem, level, (*always, *variant[1]), tuple(variant[2]) if len(variant) > 2 else (), work=work)) for variant in variants]
        panels.append(Panel(problem, level, [Series("", points)], Case(problem, level, careful) if careful is not None else None))
    return panels


def mesh_studies(size):
    meshes = [Panel(p, "", [Series("", [(level, Case(p, level, limit=1200)) for level in levels])]) for p, levels in LEVELS[size].items()]
    yield Study("mesh", "Mesh", "mesh", meshes, costs=("time", "applications", "memory"))
    panels = []
    for problem, levels in LEVELS[size].items():
        if problem == "beam_sphere_linear":
            continue
        lines = [Series(element, [(level, Case(problem, level, body=body, limit=1200)) for level in levels[: 3 if size == "full" else 2]]) for element, body in (("full", ()), ("bbar", (("element", "bbar"),)))]
        panels.append(Panel(problem, "", lines))
    yield Study("element", "Element: full integration and mean dilatation (bbar)", "mesh", panels, costs=("time", "applications", "memory"))


# name: keys of every body, and options; a target in place of a mesh refines by itself
ELEMENTS = {"full": (), "bbar": (("element", "bbar"),), "incompatible": (("element", "incompatible"),), "order 2": (("order", "2"),), "order 2, bbar": (("order", "2"), ("element", "bbar"))}
REFINED_BY = {"uniform": (), "adaptive": ("-accuracy_adaptive",), "order 2": ("-accuracy_order", "2")}
ELEMENT_MESHES = {
    "tiny": {},
    "quick": {"hertz_cylinder": ("coarse",), "cantilever": ("0",)},
    "full": {"hertz_cylinder": ("coarse", "medium", "0"), "cantilever": ("0", "1")},
}


def element_studies(size):
    """All elements on the same meshes; one mesh refined everywhere, where the error is, or raised to order 2"""
    panels = [Panel(p, "", [Series(name, [(level, Case(p, level, body=body)) for level in levels]) for name, body in ELEMENTS.items()]) for p, levels in ELEMENT_MESHES[size].items()]
    yield Study("elements", "All elements", "mesh", panels, costs=("time", "memory"))
    targets = ("1e-2", "3e-3", "1e-3") if size == "full" else ("1e-2",)
    panels = []
    for problem, levels in ELEMENT_MESHES[size].items():
        lines = [Series(name, [(target, Case(problem, levels[0], ("-accuracy", target, *options), work=8)) for target in targets]) for name, options in REFINED_BY.items()]
        panels.append(Panel(problem, levels[0], lines))
    yield Study("refined", "Refinement: uniform, adaptive, elements of order 2", "target", panels, costs=("time", "memory"), needs="-accuracy_order")


def algebraic_studies(size):
    end = ("-contact_update_tol", "1e-10")  # so that nothing but the solver is left
    tight = (IP + "tol", "1e-11", *end)
    three = ("hertz_sphere", "two_block", "beam_sphere_linear")
    yield Study("tolerance", "Tolerance of the interior point method", "tolerance", turn(size, ("hertz_cylinder", *three), values(IP + "tol", *TOLERANCES[:: 1 if size == "full" else 2]), careful=tight, always=end))
    forcing = [("adaptive", ())] + [(rtol, (IP + "forcing", "fixed", IP + "ksp_rtol", rtol)) for rtol in ("1e-6", "1e-10")]
    yield Study("forcing", "Tolerance of PCG in a Newton step", "forcing", turn(size, few(size, three), forcing, careful=tight, work=1.5, always=(*INTERIOR, *end)), default="adaptive")


def path_studies(size):
    true = ("-contact_updates", "20" if size == "full" else "10", "-contact_gap_tol", "1", IP + "tol", "1e-9")
    yield Study("load_steps", "Load steps", "load steps", turn(size, ("two_block", "beam_sphere_linear"), values("-load_steps", "1", "2", "4", *(("8",) if size == "full" else ())), careful=true, work=1.5))
    three = ("hertz_sphere", "two_block", "beam_sphere_linear")
    yield Study("gap_updates", "Contact updates per load step", "contact updates", turn(size, few(size, three), [(n, ("-contact_updates", n, "-contact_gap_tol", "1")) for n in ("1", "2", "3", *(("5", "10") if size == "full" else ()))], careful=true, work=1.5))


def formulation_studies(size):
    two = ("hertz_sphere", "two_block")
    yield Study("gap", "Contact gap: mortar and node to segment", "gap", turn(size, two, values("-contact_gap", "mortar", "node")), costs=("time",))
    degrees = values("-contact_quadrature", "1", "2", "4", "5", "8")
    yield Study("mortar_quadrature", "Degree of exactness of the mortar integrals", "degree", turn(size, two, degrees, careful=(IP + "tol", "1e-11")), costs=("time",))
    yield Study("quadrature", "Gauss points per axis of a hexahedron", "points", turn(size, two, values("-elasticity_quadrature", "2", "3")), costs=("time",))
    materials = [("linear", ()), ("neo-Hookean", (), (("material", "neohookean"),))]
    yield Study("material", "Material: linear and neo-Hookean", "material", turn(size, two, materials, work=4))
    rubbing = [("none", ()), ("0.3", (), (("friction", "0.3"),))]
    yield Study("friction", "Coefficient of friction: 0 and 0.3", "friction", turn(size, few(size, ("two_block", "beam_sphere_linear", "hertz_sphere")), rubbing, work=2), costs=("time", "applications"))
    models = values("-model", "quadratic", "energy")
    steps, updates = ("12", "3") if size == "full" else ("6", "2")
    true = ("-model", "energy", "-load_steps", steps, "-contact_updates", updates, "-contact_gap_tol", "1")
    panels = turn(size, ("beam_sphere_neo_hookean",), models, careful=true, work=4)
    yield Study("model", "Load step at finite strain: quadratic model and true energy", "model", panels)


def preconditioner_studies(size):
    two = ("two_block", "beam_sphere_linear" if size == "full" else "hertz_sphere")
    all_costs = ("time", "applications", "memory")
    amg = [
        ("tuned l1-GS", ()),
        ("published l1-SGS", boomeramg(AMG, *PUBLISHED)),
        ("GAMG", (AMG + "pc_type", "gamg", *AIJ)),
        ("ML", (AMG + "pc_type", "ml", *AIJ)),
    ]
    yield Study("amg", "AMG of the preconditioner", "AMG", turn(size, two if size == "full" else two[:1], amg, work=2, always=BY_AMG), costs=all_costs, default="tuned l1-GS")
    thresholds = values(THRESHOLD, *(("0.25",) if size == "full" else ()), "0.5", "0.7", "0.9", also=(ELASTIC_THRESHOLD,))
    panels = turn(size, few(size, ("hertz_sphere", "two_block", "beam_sphere_linear")), thresholds, work=1.5, always=BY_AMG) + turn(size, ("two_block", "cantilever"), thresholds, work=1.5, meshes=REFINED, always=(*BY_AMG, "-elasticity_pc_amgf_factor", "false"))
    yield Study("threshold", "Strength threshold of BoomerAMG", "threshold", panels, costs=all_costs, default=BUILT_IN[THRESHOLD])
    yield Study("cycle", "Order of AMG and filter", "cycle", turn(size, two, values(IP + "pc_amgf_cycle", "fbf", "bfb", *(("additive",) if size == "full" else ())), work=1.5, always=INTERIOR), default=BUILT_IN[IP + "pc_amgf_cycle"])
    yield Study("lag", "Number of Newton systems between set-ups of the AMG", "lag", turn(size, two, values(IP + "pc_amgf_amg_lag", "auto", "1", *(("2", "4") if size == "full" else ()), "-1"), work=1.5, always=INTERIOR), default=BUILT_IN[IP + "pc_amgf_amg_lag"])


def subspace_studies(size):
    problems = few(size, ("two_block", "hertz_sphere", "beam_sphere_linear"))
    ways = [("chosen", ()), ("AMG", BY_AMG), ("MUMPS", (IP + "pc_amgf_factor", "true")), ("interior point", INTERIOR)]
    yield Study("subspace", "Filtered subspace method with AMG or MUMPS, and interior point method", "method", turn(size, problems, ways, work=2), costs=("time", "applications", "memory"), default="chosen")
    directions = values(IP + "subspace_max", "20", "40", "80", *(("160", "320") if size == "full" else ()))
    yield Study("directions", "Number of directions of the filtered subspace method", "directions", turn(size, problems, directions, work=1.5, always=BY_AMG), costs=("time", "applications", "memory"))


def rank_study(size):
    panels = []
    for problem in ("hertz_sphere", "two_block", "beam_sphere_linear"):
        level = MESHES[size].get(problem)
        if level:
            panels.append(Panel(problem, level, [Series("", [(str(ranks), Case(problem, level, ranks=ranks)) for ranks in (1, 2)])]))
    yield Study("ranks", "Ranks", "ranks", panels, costs=("time", "applications", "memory"))


# size: problem, the mesh that -accuracy begins with, its targets
TARGETS = {
    "tiny": (),
    "quick": (("hertz_sphere", "coarse", ("1e-1", "3e-2", "1e-2")), ("hertz_cylinder", "coarse", ("1e-2", "3e-3"))),
    "full": (("hertz_sphere", "coarse", ("1e-1", "3e-2", "1e-2", "3e-3", "1e-3")), ("hertz_cylinder", "coarse", ("1e-2", "3e-3", "1e-3")), ("hertz_cylinder", "0", ("3e-3", "1e-3"))),
}


def accuracy_study(size):
    """The option refines by itself, up to a limit on the unknowns"""
    most = {"tiny": "10000", "quick": "60000", "full": "3000000"}[size]
    panels = []
    for problem, level, targets in TARGETS[size]:
        work = {target: 10 * (1e-2 / float(target)) ** 2 for target in targets}  # a mesh twice as fine has a quarter of the error and costs 16 times as much
        points = [(target, Case(problem, level, ("-accuracy", target, "-accuracy_max_dofs", most), limit=1200, work=work[target])) for target in targets]
        panels.append(Panel(problem, level, [Series("", points)]))
    yield Study("accuracy", "Accuracy as input: -accuracy", "target", panels, needs="-accuracy")


# name: options and how many times the default's time they may take
BASELINES = {
    "defaults": ((), 1),
    "interior point": (INTERIOR, 3),
    "published configuration": (("-options_file", "published.opts"), 20),
    "MUMPS Cholesky": (("-options_file", "direct.opts"), 4),
    "AMG-PCG": ((IP + "pc_type", "hypre", *boomeramg(IP, *TUNED), *LONG), 10),
    "GAMG-PCG": ((IP + "pc_type", "gamg", *AIJ, *LONG), 10),
    "penalty, stiffness 10": (("-contact_penalty", "10"), 5),
    "penalty, stiffness 1000": (("-contact_penalty", "1000"), 10),
    "TAO almm": (("-tao_type", "almm", "-tao_almm_type", "classic"), 100),
    "TAO pdipm": (("-options_file", "pdipm.opts"), 10),
}


def ways(problem, level, limits, work=1.0):
    """The baselines of a mesh, a series each; limits: name: seconds"""
    return [Series(name, [(level, Case(problem, level, BASELINES[name][0], limit=limit, work=work * BASELINES[name][1]))]) for name, limit in limits.items()]


def baseline_study(size):
    """Where a limit ends the published configuration, the load steps it has done are compared"""
    every, filtered = tuple(BASELINES), ("defaults", "published configuration")
    meshes = {"tiny": [("two_block", "1", dict.fromkeys(every, 10))], "quick": [("two_block", "1", dict.fromkeys(every, 15))]}
    meshes["full"] = [
        ("two_block", "2", dict.fromkeys(every, 120)),
        ("two_block", "4", dict.fromkeys(every[:4], 1200)),
        ("ironing", "2", dict.fromkeys(filtered, 500)),
        ("beam_sphere_linear", "1", dict.fromkeys((name for name in every if name != "published configuration"), 60) | {"MUMPS Cholesky": 300}),
        ("beam_sphere_linear", "2", dict.fromkeys(filtered, 900)),
    ]
    panels = []
    for problem, level, limits in meshes[size]:
        careful = Case(problem, level, (IP + "tol", "1e-11")) if "MUMPS Cholesky" in limits else None
        panels.append(Panel(problem, level, ways(problem, level, limits), careful))
    yield Study("baselines", "Comparison with other methods", "mesh", panels, kind="baselines")


def growth_study(size):
    """Two-block from 2,000 to 700,000 unknowns, at full size by refinement alone; name: the meshes, a letter each, and their limit"""
    reach = {"tiny": {"defaults": ("1", 10)}, "quick": {"defaults": ("123", 90), "published configuration": ("1", 90), "MUMPS Cholesky": ("12", 90), "AMG-PCG": ("1", 15)}}
    reach["full"] = {"defaults": ("1248", 1200), "published configuration": ("124", 1200), "MUMPS Cholesky": ("124", 1200), "AMG-PCG": ("12", 120), "GAMG-PCG": ("12", 120)}
    series = []
    for name, (levels, limit) in reach[size].items():
        options, work = BASELINES[name]
        series.append(Series(name, [(level, Case("two_block", level, options, limit=limit, work=work)) for level in levels]))
    yield Study("growth", "Growth with size", "mesh", [Panel("two_block", "", series)], kind="growth")


def roofline_study(size):
    levels = {"tiny": ("1",), "quick": ("2", "3"), "full": ("2", "4", "6")}[size]
    cycles = ("fbf", "bfb", "additive")[: 3 if size == "full" else 2]
    lines = [Series(cycle, [(level, Case("two_block", level, (*INTERIOR, *values(IP + "pc_amgf_cycle", cycle)[0][1]), log=True)) for level in (levels if cycle == "fbf" else levels[:1])]) for cycle in cycles]
    yield Study("roofline", "Share of the memory bandwidth", "mesh", [Panel("two_block", "", lines)], kind="roofline")


MAKERS = (mesh_studies, element_studies, algebraic_studies, path_studies, formulation_studies, preconditioner_studies, subspace_studies, rank_study, accuracy_study, baseline_study, growth_study, roofline_study)


def studies(size):
    """All of a size; those that have no problem of that size are left out"""
    return [study for maker in MAKERS for study in maker(size) if study.panels]
