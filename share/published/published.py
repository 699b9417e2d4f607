"""Reproduces the tables and figures of arXiv:2505.18576 and writes them beside the published values: python3
published.py [--quick] [--only NAME]

The record of a run is written when it ends, and the run is not repeated: build/published has those of now, runs beside
this file those of earlier sessions.
A run that its limit or SIGUSR1 ends counts with the load steps and systems that it has done. README.md in
build/published is the page, with its figures."""
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
STEP_KEYS = ("converged", "ip_iterations", "ksp_iterations", "filter_dofs", "constraints", "amg_applications",
             "solve_time", "energy")
PUBLISHED_FILE = os.path.join(HERE, "published.csv")
# problem: scene, refinement of mesh 1, further options of the published configuration
PROBLEMS = {
    "two_block": ("two_block", 1, ()),
    "ironing": ("ironing", 1, ()),
    "beam_sphere_linear": ("beam_sphere_linear", 0, ()),
    "beam_sphere_nonlinear": ("beam_sphere_neo_hookean", 0, ("-displacement_bounds", "4")),
}
LOAD_STEPS = {"two_block": 2, "ironing": 10, "beam_sphere_linear": 6, "beam_sphere_nonlinear": 6}
TITLES = {
    "two_block": "Two blocks", "ironing": "Ironing", "beam_sphere_linear": "Beam and sphere, linear",
    "beam_sphere_nonlinear": "Beam and sphere, neo-Hookean"
}
AMG_LIMIT = "5000"  # PCG iterations of AMG alone, as published
IP = "-tao_ipfilter_"
BOOMERAMG = {
    "coarsen_type": "HMIS", "interp_type": "ext+i", "P_max": "4", "strong_threshold": "0.5", "agg_nl": "0",
    "relax_type_down": "l1scaled-SOR/Jacobi", "relax_type_up": "l1scaled-SOR/Jacobi"
}
AMG_ALONE = (IP + "ksp_max_it", AMG_LIMIT, *(word for key, value in BOOMERAMG.items()
                                             for word in (f"{IP}pc_hypre_boomeramg_{key}", value)))
OPTIONS = ("-options_file", "share/options/published.opts")
AMGF = OPTIONS + ("-contact_free", "-info", ":tao")
# configuration: options; the limit of a run [s] on mesh 1, quick and full
WAYS = {
    "AMGF": (AMGF, 300), "own": (AMGF + (IP + "amgf_amg_pc_type", "blockamg"), 60), "defaults": ((), 120),
    "AMG-own": (OPTIONS + AMG_ALONE + (IP + "pc_type", "blockamg"), 60),
    "AMG": (OPTIONS + AMG_ALONE + (IP + "pc_type", "hypre"), 100)
}
CYCLES = {"AMGF": "BoomerAMG's", "own": "own"}
ALONE = {"AMGF": "AMG", "own": "AMG-own"}  # AMG without filter, by the same V-cycle
LIMITS = {1: 1, 2: 10, 3: 40, 4: 60}  # times that of mesh 1
GROWTH = 1.23  # time of AMG grows like n to this power: share/doc/results.md
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
    kept_keys = ("commit", "processor", "date", "dofs", "time", "code", "cut", "limit", "words", "peak_memory_bytes")
    short = {key: record[key] for key in kept_keys if key in record}
    short["contact_free"] = {"bound": record.get("contact_free", {}).get("bound")}
    short["ratios"] = [float(f"{ratio:.3g}") for ratio in record["ratios"]]
    short["steps"] = [{key: step[key] for key in STEP_KEYS if key in step} for step in record["steps"]]
    return short


def run(problem, mesh, way, quick=False, limit=None):
    """The summary of a run, with the weights' ratios, how it was cut short and its command; kept on disk. Its clock is
    processor time"""
    base = os.path.join(FOLDER, f"{problem}_{mesh}_{way}")
    if not kept(problem, mesh, way):
        limit = limit or WAYS[way][1] * LIMITS[mesh] * (1 if quick else 5)
        print(f"{problem} mesh {mesh} {way}: at most {limit} s", flush=True)
        os.chdir(TOP)
        os.environ["LD_PRELOAD"] = os.path.join(FOLDER, "cpuclock.so")
        code, said, cut = runner.execute([*command(problem, mesh, way), "-summary", base + ".json"], limit)
        record = runner.read_summary(base) or {"steps": []}
        record.update(commit=commit(), processor=machine.describe()["processor"], date=str(datetime.date.today()),
                      code=code, cut=cut, limit=limit,
                      ratios=[float(ratio)
                              for ratio in re.findall(r"D_max/D_min (\S+)", said)], words=runner.last_words(said))
        del os.environ["LD_PRELOAD"]
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


def unfinished(record):
    """PCG iterations of the systems of the load step in which the run was ended"""
    return [its for step in record["steps"] if not step["converged"] for its in pcg_of_newton(step)]


def row(problem, mesh, record):
    """n, largest n_c and m, mean interior point iterations a load step, mean PCG iterations a system, the bound"""
    done = steps(record)
    systems = [its for step in done for its in pcg_of_newton(step)] or unfinished(record)
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


def ordered(records):
    return sorted(records, key=lambda name: (list(PROBLEMS).index(name[0]), *name[1:]))


def done_of(record):
    """How far a run came: load steps, and systems of the next"""
    begun = len(unfinished(record))
    return f"{len(steps(record))}" + (f", {begun} systems" if begun else "")


def iteration_tables(records, reference, explanations):
    columns = ("n", "n_c_max", "m_max", "ip_iterations_avg", "amgf_pcg_iterations_avg", "amgf_bound")
    heads = ("unknowns n", "filtered n_c, most", "constraints m, most", "interior point iterations a load step",
             "PCG iterations a system", "bound")
    for problem, title in TITLES.items():
        runs = sorted(key[1:] for key in records if key[0] == problem and key[2] in CYCLES)
        if not runs:
            continue
        yield f"### {title}\n"
        yield f"{LOAD_STEPS[problem]} load steps.\n"
        yield "| mesh | V-cycle | load steps done | " + " | ".join(heads) + " |"
        yield "| --- |" + " --- |" * (len(heads) + 2)
        for mesh, way in runs:
            ours = row(problem, mesh, records[problem, mesh, way])
            cells = [cell(ours[column], reference[problem, mesh][column]) for column in columns]
            yield f"| {mesh} | {CYCLES[way]} | {done_of(records[problem, mesh, way])} | " + " | ".join(cells) + " |"
        yield ""
        yield f"    {' '.join(command(problem, runs[0][0], 'AMGF'))}"
        if problem in explanations:
            yield "\n" + explanations[problem]
        yield ""


def cost(record, count):
    """Applications of AMG, seconds, and seconds an interior point iteration of the first load steps"""
    done = steps(record)[:count]
    return sum(step["amg_applications"]
               for step in done), sum(step["solve_time"] for step in done), sum(step["ip_iterations"] for step in done)


def time_ratio(first, second, seconds, digits=1):
    """Ratio of the seconds of two runs; "-" if they are not of the same commit and the same kind of processor"""
    if any(first[key] != second[key] for key in ("commit", "processor")):
        return "-"
    return f"{seconds[0] / seconds[1]:.{digits}f}"


def speed_table(records):
    yield ("| problem | mesh | V-cycle | load steps compared | AMGF-PCG [s] | AMG-PCG [s] | speed-up | PCG "
           "iterations, AMGF | PCG iterations, AMG | ratio of iterations |")
    yield "| --- |" + " --- |" * 9
    for problem, mesh, way in ordered(records):
        amgf, amg = records[problem, mesh, way], records.get((problem, mesh, ALONE.get(way)))
        if not amg:
            continue
        count = min(len(steps(amgf)), len(steps(amg)))
        if not count:
            its = unfinished(amg)
            yield (f"| {TITLES[problem]} | {mesh} | {CYCLES[way]} | 0 | - | above {amg['limit']} | - | - | "
                   f"{sum(its[-10:]) or '-'} | - |")
            continue
        (_, ours, _), (_, theirs, _) = cost(amgf, count), cost(amg, count)
        last = [sum(sum(pcg_of_newton(step)[-10:]) for step in steps(record)[:count]) for record in (amgf, amg)]
        yield (f"| {TITLES[problem]} | {mesh} | {CYCLES[way]} | {count} | {ours:.1f} | {theirs:.1f} | "
               f"{time_ratio(amg, amgf, (theirs, ours))} | {last[0]:,} | {last[1]:,} | {last[1] / last[0]:.1f} |")


def share_table(cases, records):
    phases = ("amg_setup", "amg_apply", "filter_setup", "filter_apply")
    yield "| problem | mesh | AMG set-up | AMG application | filter set-up | filter application | the rest |"
    yield "| --- |" + " --- |" * 6
    for problem, mesh in cases:
        time = records.get((problem, mesh, "AMGF"), {}).get("time")
        if not time:
            continue
        parts = [time[phase] / time["total"] for phase in phases]
        yield f"| {TITLES[problem]} | {mesh} | " + " | ".join(f"{100 * part:.1f} %"
                                                              for part in (*parts, 1 - sum(parts))) + " |"


def same_systems(coarse, fine):
    """What both runs have done: its name, and the PCG iterations of each"""
    count = min(len(steps(coarse)), len(steps(fine)))
    if count:
        return f"load steps 1 to {count}" if count > 1 else "load step 1", *([
            its for step in steps(record)[:count] for its in pcg_of_newton(step)
        ] for record in (coarse, fine))
    first = [pcg_of_newton(record["steps"][0]) if record["steps"] else [] for record in (coarse, fine)]
    count = min(map(len, first))
    return f"first {count} systems", first[0][:count], first[1][:count]


def growth_table(records, reference):
    yield ("| problem | mesh | V-cycle | compared | PCG iterations over mesh 1, ours | published, all load steps | "
           "bound over mesh 1, ours | published |")
    yield "| --- |" + " --- |" * 7
    for problem, mesh, way in ordered(records):
        if mesh == 1 or way not in CYCLES or (problem, 1, way) not in records:
            continue
        pair = records[problem, 1, way], records[problem, mesh, way]
        what, coarse, fine = same_systems(*pair)
        if not fine:
            continue
        theirs = [float(reference[problem, which]["amgf_pcg_iterations_avg"]) for which in (1, mesh)]
        bounds = [reference[problem, which]["amgf_bound"] for which in (1, mesh)]
        ours = [record.get("contact_free", {}).get("bound") for record in pair]
        bound = [f"{float(b) / float(a):.2f}" if a and b else "-" for a, b in (ours, bounds)]
        yield (f"| {TITLES[problem]} | {mesh} | {CYCLES[way]} | {what} | {mean(fine) / mean(coarse):.2f} | "
               f"{theirs[1] / theirs[0]:.2f} | {bound[0]} | {bound[1]} |")


def own_table(records):
    yield ("| problem | mesh | load steps compared | PCG iterations a system, BoomerAMG's V-cycle | own | time, "
           "BoomerAMG's over own | energy of the last step, relative difference |")
    yield "| --- |" + " --- |" * 6
    for problem, mesh, way in ordered(records):
        theirs = records.get((problem, mesh, "AMGF"))
        if way != "own" or not theirs:
            continue
        ours = records[problem, mesh, way]
        count = min(len(steps(theirs)), len(steps(ours)))
        if not count:
            continue
        its = [mean(its for step in steps(record)[:count] for its in pcg_of_newton(step)) for record in (theirs, ours)]
        times = [cost(record, count)[1] for record in (theirs, ours)]
        energies = [steps(record)[count - 1]["energy"] for record in (theirs, ours)]
        yield (f"| {TITLES[problem]} | {mesh} | {count} | {its[0]:.1f} | {its[1]:.1f} | "
               f"{time_ratio(theirs, ours, times)} | {abs(energies[1] / energies[0] - 1):.1e} |")


def farthest(problem, mesh, records):
    """The published configuration with the V-cycle that solved more load steps, BoomerAMG's if both solved as many"""
    runs = [way for way in CYCLES if (problem, mesh, way) in records]
    return max(runs, key=lambda way: len(steps(records[problem, mesh, way])), default=None)


def memory(record):
    found = record.get("peak_memory_bytes")
    return f"{found / 1e9:.2f}" if found else "-"


def defaults_table(cases, records):
    yield ("| problem | mesh | V-cycle of the published configuration | load steps | AMG applications, or solves with "
           "factors, published configuration | defaults | time, published configuration [s] | defaults [s] | ratio | "
           "memory, published configuration [GB] | defaults [GB] | energy of the last step, relative difference |")
    yield "| --- |" + " --- |" * 11
    for problem, mesh in cases:
        way, ours = farthest(problem, mesh, records), records.get((problem, mesh, "defaults"))
        if not ours or not steps(ours):
            continue
        theirs = records.get((problem, mesh, way))
        count = min(len(steps(theirs)), len(steps(ours))) if theirs else 0
        if not count:
            (b, u, _) = cost(ours, len(steps(ours)))
            yield (f"| {TITLES[problem]} | {mesh} | - | {len(steps(ours))} | - | {b:,} | - | {u:.1f} | - | - | "
                   f"{memory(ours)} | - |")
            continue
        (a, t, _), (b, u, _) = cost(theirs, count), cost(ours, count)
        energies = [steps(record)[count - 1]["energy"] for record in (theirs, ours)]
        yield (f"| {TITLES[problem]} | {mesh} | {CYCLES[way]} | {count} | {a:,} | {b:,} | {t:.1f} | {u:.1f} | "
               f"{time_ratio(theirs, ours, (t, u), 0)} | {memory(theirs)} | {memory(ours)} | "
               f"{abs(energies[1] / energies[0] - 1):.1e} |")


def curves(cases, records):
    """PCG iterations and the weights' ratio against the interior point iteration, of the first mesh of every problem"""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    first = [case for case in cases if case[1] == 1]
    figure, axes = plt.subplots(2, len(first), figsize=(4.2 * len(first), 6.4), squeeze=False)
    for (problem, mesh), (above, below) in zip(first, axes.T):
        alone = "AMG" if (problem, mesh, "AMG") in records else "AMG-own"
        for way, style in ((alone, "C1.-"), ("AMGF", "C0.-")):
            record = records.get((problem, mesh, way))
            its = [its for step in (record["steps"] if record else []) for its in pcg_of_newton(step)]
            above.semilogy(range(1, len(its) + 1), its, style, label=way + "-PCG", markersize=3, linewidth=0.8)
        ratios = records[problem, mesh, "AMGF"]["ratios"] if (problem, mesh, "AMGF") in records else []
        below.semilogy(range(1, len(ratios) + 1), ratios, "C2.-", markersize=3, linewidth=0.8)
        above.set(title=f"{TITLES[problem]}, mesh {mesh}", ylabel="PCG iterations", ylim=(5, 8000))
        above.legend(fontsize=8)
        below.set(xlabel="Newton system, all load steps", ylabel="D_max / D_min")
    figure.tight_layout()
    figure.savefig(os.path.join(FOLDER, "curves.png"), dpi=90)


def commit():
    found = subprocess.run(["git", "-C", TOP, "log", "-1", "--format=%h"], capture_output=True,
                           text=True).stdout.strip()
    return found or "no repository"


def cut_runs(records):
    for problem, mesh, way in ordered(records):
        record = records[problem, mesh, way]
        begun = len(unfinished(record))
        what = f"- {TITLES[problem]}, mesh {mesh}, {way}: {len(steps(record))} of {LOAD_STEPS[problem]} load steps" + (
            f" and {begun} systems of the next one" if begun else "") + " were solved. "
        if record["cut"]:
            yield what + f"The limit of {record['limit']:.0f} s of elapsed time ended the run."
        elif record["code"] == 5:
            yield what + "The run was ended by hand."
        elif not steps(record):
            yield f"- {TITLES[problem]}, mesh {mesh}, {way}: {record['words']}"


def estimate(problem, mesh, way, records, reference):
    """Hours of processor time of all load steps, from the time of the load steps that were solved, else from the time
    of a PCG iteration on the finest mesh that was run; None where none was run"""
    done = steps(records.get((problem, mesh, way), {"steps": []}))
    if done:
        return sum(step["solve_time"] for step in done) / len(done) * LOAD_STEPS[problem] / 3600
    known = max((which for other, which, another in records if (other, another) == (problem, way)), default=None)
    its = known and sum(sum(pcg_of_newton(step)) for step in records[problem, known, way]["steps"])
    if not its:
        return None
    each = records[problem, known, way]["time"]["total"] / its
    n, coarse = (float(reference[problem, which]["n"]) for which in (mesh, known))
    systems = LOAD_STEPS[problem] * float(reference[problem, mesh]["ip_iterations_avg"])
    return each * (n / coarse)**GROWTH * systems * float(reference[problem, mesh]["amgf_pcg_iterations_avg"]) / 3600


def not_run(records, reference):
    """Meshes 1 to 3 of the published tables that were not run to the end"""
    for problem in TITLES:
        for mesh in (1, 2, 3):
            missing = [
                way for way in CYCLES
                if len(steps(records.get((problem, mesh, way), {"steps": []}))) < LOAD_STEPS[problem]
            ]
            hours = {CYCLES[way]: estimate(problem, mesh, way, records, reference) for way in missing}
            said = ", ".join(f"{cycle} V-cycle " + (f"{time:.2g} h" if time else "not estimated")
                             for cycle, time in hours.items())
            if missing:
                yield (f"- {TITLES[problem]}, mesh {mesh}: not all load steps were run; estimated processor time of "
                       f"all of them: {said}.")


def origins(records):
    """The commit, the dates and the processor of most runs, and the runs of others"""
    by_origin = {}
    for name in ordered(records):
        by_origin.setdefault((records[name]["commit"], records[name]["processor"]), []).append(name)
    most, *others = sorted(by_origin.items(), key=lambda item: -len(item[1]))

    def where(origin, names):
        dates = sorted({records[name]["date"] for name in names})
        return f"commit {origin[0]}, {' to '.join(dict.fromkeys((dates[0], dates[-1])))}, on {origin[1]}"

    def named(names):
        return "; ".join(f"{TITLES[problem]}, mesh {mesh}, {CYCLES[way] + ' V-cycle' if way in CYCLES else way}"
                         for problem, mesh, way in names)

    exceptions = "\n".join(f"- {where(origin, names)}: {named(names)}." for origin, names in others)
    return f"All runs: {where(*most)}" + (f", with these exceptions.\n\n{exceptions}" if others else ".")


def page(cases, records):
    reference = published()
    with open(EXPLANATIONS) as file:
        explanations = json.load(file)
    where = machine.describe()
    yield "# The published results, reproduced\n"
    yield ("S. Petrides et al., AMG with filtering, arXiv:2505.18576, 2025. Every cell shows our value / the "
           "published value. A star marks a deviation of more than 10 %.")
    yield "`make published` creates this page, `make published-quick` a page for mesh 1 alone.\n"
    yield "One core. " + ", ".join(f"{name} {version}"
                                   for name, version in where["versions"].items()) + f". {origins(records)}\n"
    yield ("Times: processor seconds of one core (`cpuclock.c`). Other programs were running on the machine, which "
           "slows memory down. The same run varies by up to 20 %.\n")
    yield "## Iterations and sizes\n"
    yield ("Configuration `published.opts`. Interior point iterations are the mean over load steps, PCG iterations "
           "the mean over Newton systems.")
    yield ("\"Bound\" is the bound of the PCG iterations that follows from the condition number beta of the problem "
           "without contact: sqrt(2 (beta + 3) / beta) times the PCG iterations with AMG for K.")
    yield ("The V-cycle \"BoomerAMG's\" is that of the publication. The V-cycle \"own\" is that of this program, "
           "`-tao_ipfilter_amgf_amg_pc_type blockamg`, see [below](#the-programs-own-v-cycle).")
    yield ("If no load step was finished, the figures are those of the systems that were solved. Each mesh has "
           "`-refine` increased by one compared with the previous mesh.\n")
    yield from iteration_tables(records, reference, explanations)
    if any(way == "own" for _, _, way in records):
        yield "## The program's own V-cycle\n"
        yield explanations["own"] + "\n"
        yield from own_table(records)
        yield ""
    yield "## PCG iterations and the barrier\n"
    yield (f"AMG alone is stopped at {AMG_LIMIT} iterations a system, as published, and uses the program's own "
           f"V-cycle if the table below has no other. Its curve ends where the time limit ended the run.\n")
    yield "![PCG iterations and ratio of the weights against the Newton system](curves.png)\n"
    yield "## Speed-up of AMGF over AMG\n"
    yield ("The paper reports speed-ups of 4 to more than 10. The PCG iterations are summed over the last ten "
           "systems of each load step.\n")
    yield from speed_table(records)
    if "speed" in explanations:
        yield "\n" + explanations["speed"]
    yield "\n## Where the time goes\n"
    yield "The paper reports about 90 % for AMG and 3 to 7 % for the filter.\n"
    yield from share_table(cases, records)
    if any(mesh > 1 for _, mesh in cases):
        yield "\n## Growth with the mesh\n"
        yield from growth_table(records, reference)
        if "growth" in explanations:
            yield "\n" + explanations["growth"]
    yield "\n## What the defaults take\n"
    yield ("With the default settings the linearization of the gap is updated until the gap is consistent, unless "
           "the scene requests one linearization. The energy of neo-Hookean bodies is minimized without a quadratic "
           "model.")
    yield ("The energies therefore differ where the published configuration has an error, as explained below the "
           "table.\n")
    yield from defaults_table(cases, records)
    if "defaults" in explanations:
        yield "\n" + explanations["defaults"]
    yield "\n## Not run, or not to the end\n"
    yield from cut_runs(records)
    yield from not_run(records, reference)
    if "earlier" in explanations:
        yield explanations["earlier"]
    yield f"- AMG alone was not run on meshes 2 and 3: {AMG_LIMIT} iterations a system take hours."


def wrapped(text):
    """Paragraphs of at most 100 columns; tables and commands as they are"""
    free = text.lstrip("\n")[:1] not in ("|", " ", "#", "!", "")
    if not free:
        return text
    lines = text.split("\n")
    return "\n".join(
        line if line.startswith("|") else textwrap.fill(line, 100, break_long_words=False, break_on_hyphens=False)
        for line in lines)


def default_runs(quick, meshes, only):
    """In the order of their costs: own cycle before BoomerAMG's; AMG alone on mesh 1"""
    for mesh in range(1, 2 if quick else meshes + 1):
        for way in WAYS if mesh == 1 else ("own", "defaults", "AMGF"):
            for problem in PROBLEMS:
                if only in problem:
                    yield problem, mesh, way, None


def named_runs(words):
    """PROBLEM/MESH/WAY:SECONDS"""
    for word in words:
        name, _, limit = word.partition(":")
        problem, mesh, way = name.split("/")
        yield problem, int(mesh), way, float(limit) if limit else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="mesh 1 alone, ten minutes")
    parser.add_argument("--meshes", type=int, default=3, help="meshes of every problem")
    parser.add_argument("--only", default="", help="problems whose name has this")
    parser.add_argument(
        "--runs", nargs="*",
        help="these alone, in this order: PROBLEM/MESH/WAY:SECONDS, with a limit in elapsed seconds; the ways are " +
        ", ".join(WAYS))
    parser.add_argument("--kept", action="store_true",
                        help="makes the page of the runs that are there, and starts none")
    parsed = parser.parse_args()
    os.makedirs(FOLDER, exist_ok=True)
    if not parsed.kept:
        for problem, mesh, way, limit in named_runs(parsed.runs) if parsed.runs else default_runs(
                parsed.quick, parsed.meshes, parsed.only):
            run(problem, mesh, way, parsed.quick, limit)
    names = [(problem, mesh, way) for problem in PROBLEMS
             for mesh in sorted(LIMITS) for way in WAYS if parsed.only in problem and kept(problem, mesh, way)]
    records = {name: run(*name) for name in names}
    cases = list(dict.fromkeys((problem, mesh) for problem, mesh, _ in names))
    curves(cases, records)
    with open(os.path.join(FOLDER, "README.md"), "w") as file:
        file.write("\n".join(map(wrapped, page(cases, records))) + "\n")
    print(os.path.join(FOLDER, "README.md"))


main()
