"""Reproduces the tables and figures of arXiv:2505.18576 and writes them beside the published values: python3 published.py [--quick] [--only NAME]

A run that has ended is kept in build/published, or in runs beside this file, and is not repeated. README.md there is the page, with its figures beside it."""
import argparse
import csv
import datetime
import json
import os
import re
import subprocess
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(TOP, "share", "bench"))
import machine
import runner

FOLDER = os.path.join(TOP, "build", "published")
KEPT = os.path.join(HERE, "runs")
STEP_KEYS = ("converged", "ip_iterations", "ksp_iterations", "filter_dofs", "constraints", "amg_applications", "solve_time", "energy")
PUBLISHED_FILE = os.path.join(HERE, "published.csv")
# problem: scene, refinement of mesh 1, further options of the published configuration
PROBLEMS = {
    "two_block": ("two_block", 1, ()),
    "ironing": ("ironing", 1, ()),
    "beam_sphere_linear": ("beam_sphere_linear", 0, ()),
    "beam_sphere_nonlinear": ("beam_sphere_neo_hookean", 0, ("-displacement_bounds", "4")),
}
TITLES = {"two_block": "Two blocks", "ironing": "Ironing", "beam_sphere_linear": "Beam and sphere, linear", "beam_sphere_nonlinear": "Beam and sphere, neo-Hookean"}
AMG_LIMIT = "5000"  # PCG iterations of AMG alone, as published
IP = "-tao_ipfilter_"
BOOMERAMG = {"coarsen_type": "HMIS", "interp_type": "ext+i", "P_max": "4", "strong_threshold": "0.5", "agg_nl": "0", "relax_type_down": "l1scaled-SOR/Jacobi", "relax_type_up": "l1scaled-SOR/Jacobi"}
AMG_ALONE = (IP + "pc_type", "hypre", IP + "ksp_max_it", AMG_LIMIT, *(word for key, value in BOOMERAMG.items() for word in (f"{IP}pc_hypre_boomeramg_{key}", value)))
OPTIONS = ("-options_file", "share/options/published.opts")
# configuration: options; the limit of a run [s] on mesh 1, quick and full
WAYS = {"AMGF": (OPTIONS + ("-contact_free", "-info", ":tao"), 300), "AMG": (OPTIONS + AMG_ALONE, 100), "defaults": ((), 120)}
LIMITS = {1: 1, 2: 10, 3: 40, 4: 60}  # times that of mesh 1
DEVIATION = 0.10  # above which a value is marked
EXPLANATIONS = os.path.join(HERE, "explanations.json")


def published():
    with open(PUBLISHED_FILE) as file:
        return {(row["problem"], int(row["mesh"])): row for row in csv.DictReader(file)}


def command(problem, mesh, way):
    scene, first, more = PROBLEMS[problem]
    options = WAYS[way][0] + (more if way != "defaults" else ())
    return ["bin/contact", f"share/scenes/{scene}.yaml", "-refine", str(first + mesh - 1), *options]


def kept(problem, mesh, way):
    """The file of a run that has ended, here or in an earlier session; None if there is none"""
    name = f"{problem}_{mesh}_{way}.run.json"
    return next((path for folder in (FOLDER, KEPT) if os.path.exists(path := os.path.join(folder, name))), None)


def reduced(record):
    """What the page is made from"""
    short = {key: record[key] for key in ("commit", "dofs", "time", "code", "cut", "limit", "words") if key in record}
    short["contact_free"] = {"bound": record.get("contact_free", {}).get("bound")}
    short["ratios"] = [float(f"{ratio:.3g}") for ratio in record["ratios"]]
    short["steps"] = [{key: step[key] for key in STEP_KEYS if key in step} for step in record["steps"]]
    return short


def run(problem, mesh, way, quick):
    """The summary of a run, with the weights' ratios, how it was cut short and its command; kept on disk"""
    base = os.path.join(FOLDER, f"{problem}_{mesh}_{way}")
    if not kept(problem, mesh, way):
        limit = WAYS[way][1] * LIMITS[mesh] * (1 if quick else 5)
        print(f"{problem} mesh {mesh} {way}: at most {limit} s", flush=True)
        os.chdir(TOP)
        code, said, cut = runner.execute([*command(problem, mesh, way), "-summary", base + ".json"], limit)
        record = runner.read_summary(base) or {"steps": []}
        record.update(commit=commit(), code=code, cut=cut, limit=limit, ratios=[float(ratio) for ratio in re.findall(r"D_max/D_min (\S+)", said)], words=runner.last_words(said))
        with open(base + ".run.json", "w") as file:
            json.dump(reduced(record), file)
    with open(kept(problem, mesh, way)) as file:
        return json.load(file)


def steps(record):
    return [step for step in record["steps"] if step["converged"]]


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else None


def pcg_of_newton(step):
    return step["ksp_iterations"]


def row(problem, mesh, record):
    """n, largest n_c and m, mean interior point iterations a load step, mean PCG iterations a system, the bound"""
    done = steps(record)
    systems = [its for step in done for its in pcg_of_newton(step)]
    bound = record.get("contact_free", {}).get("bound")
    return {
        "n": record.get("dofs"),
        "n_c_max": max((step["filter_dofs"] for step in done), default=None),
        "m_max": max((step["constraints"] for step in done), default=None),
        "ip_iterations_avg": mean(step["ip_iterations"] for step in done),
        "amgf_pcg_iterations_avg": mean(systems),
        "amgf_bound": bound or None,
    }


def show(value):
    if value is None:
        return "-"
    return f"{value:,.0f}" if abs(value - round(value)) < 0.05 else f"{value:,.1f}"


def cell(ours, theirs):
    theirs = float(theirs) if theirs else None
    if ours is None or theirs is None:
        return f"{show(ours)} / {show(theirs)}"
    mark = " *" if abs(ours - theirs) > DEVIATION * theirs else ""
    return f"{show(ours)} / {show(theirs)}{mark}"


def iteration_tables(cases, records, reference, explanations):
    columns = ("n", "n_c_max", "m_max", "ip_iterations_avg", "amgf_pcg_iterations_avg", "amgf_bound")
    heads = ("unknowns n", "filtered n_c", "constraints m", "interior point iterations a load step", "PCG iterations a system", "bound")
    for problem, title in TITLES.items():
        meshes = [mesh for other, mesh in cases if other == problem]
        if not meshes:
            continue
        yield f"### {title}\n"
        yield "| mesh | load steps done | " + " | ".join(heads) + " | commit |"
        yield "| --- |" + " --- |" * (len(heads) + 2)
        for mesh in meshes:
            record = records[problem, mesh, "AMGF"]
            ours = row(problem, mesh, record)
            cells = [cell(ours[column], reference[problem, mesh][column]) for column in columns]
            yield f"| {mesh} | {len(steps(record))} | " + " | ".join(cells) + f" | {record['commit']} |"
        yield ""
        for mesh in meshes:
            yield f"    {' '.join(command(problem, mesh, 'AMGF'))}"
        if problem in explanations:
            yield "\n" + explanations[problem]
        yield ""


def cost(record, count):
    """Applications of AMG, seconds, and seconds an interior point iteration of the first load steps"""
    done = steps(record)[:count]
    return sum(step["amg_applications"] for step in done), sum(step["solve_time"] for step in done), sum(step["ip_iterations"] for step in done)


def speed_table(cases, records):
    yield "| problem | mesh | load steps compared | AMGF-PCG [s] | AMG-PCG [s] | speed-up | PCG iterations of the last ten systems, AMGF | the same, AMG | ratio |"
    yield "| --- |" + " --- |" * 8
    for problem, mesh in cases:
        amgf, amg = (records.get((problem, mesh, way)) for way in ("AMGF", "AMG"))
        if not amg:
            continue
        count = min(len(steps(amgf)), len(steps(amg)))
        if not count:
            its = [its for step in amg["steps"] for its in pcg_of_newton(step)]
            yield f"| {TITLES[problem]} | {mesh} | 0 | - | above {amg['limit']} | - | - | {sum(its[-10:]) or '-'} | - |"
            continue
        (_, ours, _), (_, theirs, _) = cost(amgf, count), cost(amg, count)
        last = [sum(sum(pcg_of_newton(step)[-10:]) for step in steps(record)[:count]) for record in (amgf, amg)]
        yield f"| {TITLES[problem]} | {mesh} | {count} | {ours:.1f} | {theirs:.1f} | {theirs / ours:.1f} | {last[0]:,} | {last[1]:,} | {last[1] / last[0]:.1f} |"


def share_table(cases, records):
    phases = ("amg_setup", "amg_apply", "filter_setup", "filter_apply")
    yield "| problem | mesh | AMG set-up | AMG application | filter set-up | filter application | the rest |"
    yield "| --- |" + " --- |" * 6
    for problem, mesh in cases:
        time = records[problem, mesh, "AMGF"].get("time")
        if not time:
            continue
        parts = [time[phase] / time["total"] for phase in phases]
        yield f"| {TITLES[problem]} | {mesh} | " + " | ".join(f"{100 * part:.1f} %" for part in (*parts, 1 - sum(parts))) + " |"


def growth_table(cases, records, reference):
    yield "| problem | mesh | PCG iterations over mesh 1, ours | published | square root of the bounds' growth, published |"
    yield "| --- |" + " --- |" * 4
    for problem, mesh in cases:
        if mesh == 1:
            continue
        ours = [row(problem, which, records[problem, which, "AMGF"])["amgf_pcg_iterations_avg"] for which in (1, mesh)]
        theirs = [float(reference[problem, which]["amgf_pcg_iterations_avg"]) for which in (1, mesh)]
        bounds = [reference[problem, which]["amgf_bound"] for which in (1, mesh)]
        bound = f"{float(bounds[1]) / float(bounds[0]):.2f}" if all(bounds) else "-"
        yield f"| {TITLES[problem]} | {mesh} | {ours[1] / ours[0]:.2f} | {theirs[1] / theirs[0]:.2f} | {bound} |" if all(ours) else f"| {TITLES[problem]} | {mesh} | - | {theirs[1] / theirs[0]:.2f} | {bound} |"


def defaults_table(cases, records):
    yield "| problem | mesh | load steps | AMG applications, or solves with factors, published configuration | defaults | time, published configuration [s] | defaults [s] | ratio | energy of the last step, relative difference |"
    yield "| --- |" + " --- |" * 8
    for problem, mesh in cases:
        theirs, ours = records[problem, mesh, "AMGF"], records.get((problem, mesh, "defaults"))
        count = min(len(steps(theirs)), len(steps(ours))) if ours else 0
        if not count:
            yield f"| {TITLES[problem]} | {mesh} | 0 | - | - | - | - | - | - |"
            continue
        (a, t, _), (b, u, _) = cost(theirs, count), cost(ours, count)
        energies = [steps(record)[count - 1]["energy"] for record in (theirs, ours)]
        yield f"| {TITLES[problem]} | {mesh} | {count} | {a:,} | {b:,} | {t:.1f} | {u:.1f} | {t / u:.0f} | {abs(energies[1] / energies[0] - 1):.1e} |"


def curves(cases, records):
    """PCG iterations and the weights' ratio against the interior point iteration, of the first mesh of every problem"""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    first = [case for case in cases if case[1] == 1]
    figure, axes = plt.subplots(2, len(first), figsize=(4.2 * len(first), 6.4), squeeze=False)
    for (problem, mesh), (above, below) in zip(first, axes.T):
        for way, style in (("AMG", "C1.-"), ("AMGF", "C0.-")):
            record = records.get((problem, mesh, way))
            its = [its for step in (record["steps"] if record else []) for its in pcg_of_newton(step)]
            above.semilogy(range(1, len(its) + 1), its, style, label=way + "-PCG", markersize=3, linewidth=0.8)
        ratios = records[problem, mesh, "AMGF"]["ratios"]
        below.semilogy(range(1, len(ratios) + 1), ratios, "C2.-", markersize=3, linewidth=0.8)
        above.set(title=f"{TITLES[problem]}, mesh {mesh}", ylabel="PCG iterations", ylim=(5, 8000))
        above.legend(fontsize=8)
        below.set(xlabel="Newton system, all load steps", ylabel="D_max / D_min")
    figure.tight_layout()
    figure.savefig(os.path.join(FOLDER, "curves.png"), dpi=90)


def commit():
    found = subprocess.run(["git", "-C", TOP, "log", "-1", "--format=%h"], capture_output=True, text=True).stdout.strip()
    return found or "no repository"


def cut_runs(records):
    for (problem, mesh, way), record in records.items():
        what = f"- {TITLES[problem]}, mesh {mesh}, {way}: "
        if record["cut"]:
            yield what + f"{len(steps(record))} load steps done when the limit of {record['limit']} s ended it"
        elif record["code"] == 5:
            yield what + f"{len(steps(record))} load steps done when it was ended by hand"
        elif not steps(record):
            yield what + record["words"]


def page(cases, records, omitted, clock):
    reference = published()
    with open(EXPLANATIONS) as file:
        explanations = json.load(file)
    where = machine.describe()
    yield "# The published results, reproduced\n"
    yield "S. Petrides et al., AMG with filtering, arXiv:2505.18576, 2025. Every cell shows ours / theirs. A star marks a deviation above 10 %."
    yield "`make published` makes this page, `make published-quick` that of mesh 1 alone.\n"
    yield f"Machine: {where['processor']}, {where['cores']} cores, one used. " + ", ".join(f"{name} {version}" for name, version in where["versions"].items()) + f". {datetime.date.today()}. Times: {clock}.\n"
    yield "## Iterations and sizes\n"
    yield "Configuration `published.opts`. Interior point iterations are the mean over load steps, PCG iterations the mean over Newton systems."
    yield "The bound is that of the condition number, from the contact-free problem: PCG iterations of AMG on K times sqrt(2 (beta + 3) / beta).\n"
    yield from iteration_tables(cases, records, reference, explanations)
    yield "## PCG iterations and the barrier\n"
    yield f"AMG alone is stopped at {AMG_LIMIT} iterations a system, as published. Its curve ends where the time limit ended the run.\n"
    yield "![PCG iterations and ratio of the weights against the Newton system](curves.png)\n"
    yield "## Speed-up of AMGF over AMG\n"
    yield "Published: 4 to more than 10.\n"
    yield from speed_table(cases, records)
    yield "\n## Where the time goes\n"
    yield "Published: AMG about 90 %, filter 3 to 7 %.\n"
    yield from share_table(cases, records)
    if any(mesh > 1 for _, mesh in cases):
        yield "\n## Growth with the mesh\n"
        yield from growth_table(cases, records, reference)
    yield "\n## What the defaults take\n"
    yield "The defaults linearize the gap again until it is exact, unless the scene asks for one linearization. They minimize the true energy of neo-Hookean bodies."
    yield "Energies therefore differ where the published configuration leaves an error: see explanations.\n"
    yield from defaults_table(cases, records)
    if "defaults" in explanations:
        yield "\n" + explanations["defaults"]
    yield "\n## Not run, or not to the end\n"
    yield from cut_runs(records)
    yield from omitted


def wrapped(text):
    """Paragraphs of at most 100 columns; tables and commands as they are"""
    free = text.lstrip("\n")[:1] not in ("|", " ", "#", "!", "")
    return "\n".join(textwrap.fill(line, 100, break_long_words=False, break_on_hyphens=False) for line in text.split("\n")) if free else text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="mesh 1 alone, ten minutes")
    parser.add_argument("--meshes", type=int, default=3, help="meshes of every problem")
    parser.add_argument("--only", default="", help="problems whose name has this")
    parser.add_argument("--clock", default="elapsed seconds", help="what the page says of the times")
    parser.add_argument("--kept", action="store_true", help="makes the page of the runs that are there, and starts none")
    parsed = parser.parse_args()
    os.makedirs(FOLDER, exist_ok=True)
    meshes = range(1, 2 if parsed.quick else parsed.meshes + 1)
    cases = [(problem, mesh) for problem in PROBLEMS if parsed.only in problem for mesh in meshes]
    if parsed.kept:
        cases = [(problem, mesh) for problem, mesh in cases if kept(problem, mesh, "AMGF")]
    records = {}
    for problem, mesh in cases:
        for way in WAYS:
            if (way != "AMG" or mesh == 1) and (not parsed.kept or kept(problem, mesh, way)):
                records[problem, mesh, way] = run(problem, mesh, way, parsed.quick)
    curves(cases, records)
    omitted = ["- Other meshes: beyond the time of this run.", "- AMG alone on meshes above 1: 5,000 iterations a system take hours."]
    with open(os.path.join(FOLDER, "README.md"), "w") as file:
        file.write("\n".join(map(wrapped, page(cases, records, omitted, parsed.clock))) + "\n")
    print(os.path.join(FOLDER, "README.md"))


main()
