"""TAOIPFILTER, IPOPT and other solvers of TAO on nonlinear programs whose solutions are known: tests/stress/nlp.md.

The problems are those of tests/tao_ipfilter/ipfilter_nlp.h and of nlp_problems.py, and, counted by themselves, those of
nlp_kinds.py, nlp_textbook.py and nlp_degenerate.py; `make stress STRESS=nlp` builds the programs and runs this.
"""
import argparse
import itertools
import os
import select
import subprocess
import time

from nlp_degenerate import DEGENERATES
from nlp_kinds import KINDS
from nlp_problems import DEGENERATE, INFEASIBLE, PROBLEMS, REACHED, SOLVED, UNBOUNDED, Problem
from nlp_textbook import TEXTBOOK

HERE = os.path.dirname(os.path.abspath(__file__))
FAR = 1e-5  # relative error of the objective: more is wrong
FAR_VIOLATION = 1e-4  # relative to the rows of the Jacobian; IPOPT's own limit, constr_viol_tol
# of the objective where no multipliers exist: it moves by the square root of what constraints are relaxed by
FAR_DEGENERATE = 1e-2
LOOSE = 1e-6  # more is remarked


class Solver:
    """applies(problem): whether it can be asked"""

    def __init__(self, name, command, applies=lambda problem: True):
        self.name, self.command, self.applies = name, command, applies


class Result:

    def __init__(self, status, objective=float("nan"), violation=float("nan"), iterations=0, points=0, seconds=0.0,
                 sentence=""):
        self.status, self.sentence = status, sentence
        self.objective, self.violation, self.iterations, self.points, self.seconds = float(objective), float(
            violation), int(iterations), int(points), float(seconds)
        self.verdict = self.error = None


def solvers(folder):
    tao, ipopt = os.path.join(folder, "tao"), os.path.join(folder, "ipopt")

    def solver_of_tao(name, options, applies=lambda problem: True):
        return Solver(name, lambda path, first: [tao, "-problems", path, "-first", str(first), *options], applies)

    def bounds_only(problem):
        return not problem.inequalities and not problem.equalities

    return [
        solver_of_tao("ipfilter", []),
        solver_of_tao("ipfilter, scaling none", ["-tao_ipfilter_scaling", "none"]),
        Solver("IPOPT", lambda path, first: [ipopt, path, str(first)]),
        solver_of_tao("tron", ["-tao_type", "tron"], bounds_only),
        solver_of_tao("bnls", ["-tao_type", "bnls"], bounds_only),
        solver_of_tao("almm", ["-tao_type", "almm"], lambda problem: not bounds_only(problem))
    ]


def shipped(folder):
    """The problems of tests/tao_ipfilter/ipfilter_nlp.h"""
    lines = subprocess.run([os.path.join(folder, "tao")], capture_output=True, text=True, check=True).stdout.split("\n")
    for name, optimum, end, others, objective, inequalities, equalities, bounds, start in zip(*[iter(lines)] * 9):
        yield Problem(name, objective, float(optimum), start, ge=[inequalities], eq=[equalities], bounds=bounds,
                      others=map(float, others.split()), end=DEGENERATE if int(end) == REACHED else int(end))


def write(path, problems):
    with open(path, "w") as file:
        for p in problems:
            file.write("\n".join([p.name, p.objective, p.inequalities, p.equalities, p.bounds, p.start]) + "\n")


def lines_until(process, limit):
    """The lines that a process prints, until it takes longer than the limit for one"""
    pending, stop = b"", time.monotonic() + limit
    while select.select([process.stdout], [], [], max(0.0, stop - time.monotonic()))[0]:
        text = os.read(process.stdout.fileno(), 65536)
        if not text:
            return
        *lines, pending = (pending + text).split(b"\n")
        for line in lines:
            stop = time.monotonic() + limit
            yield line.decode()
    process.kill()


def last_error(said):
    """What PETSc said of the error that ended the program, less its frame"""
    errors = [line.split("PETSC ERROR: ")[1].strip() for line in said if "PETSC ERROR: " in line]
    return " ".join([line for line in errors if not line.startswith("---")][:2])


def run(solver, problems, folder, limit):
    """One result a problem; where the program ends or hangs, a new one begins with the next problem"""
    path, results = os.path.join(folder, "problems.txt"), []
    write(path, problems)
    while len(results) < len(problems):
        with open(os.path.join(folder, "said"),
                  "w+") as said, subprocess.Popen(solver.command(path, len(results)), stdout=subprocess.PIPE,
                                                  stderr=said) as process:
            for line in lines_until(process, limit):
                name, *fields = line.split("|", 7)  # the sentence may hold some, too
                if len(fields) == 7 and name == problems[len(results)].name:
                    results.append(Result(*fields))
            process.wait()
            if len(results) < len(problems):
                said.seek(0)
                hung = process.returncode == -9
                results.append(
                    Result("hung" if hung else "crashed",
                           sentence=f"no end after {limit:g} s" if hung else last_error(said)))
    return dict(zip((p.name for p in problems), results))


def relative_error(objective, optimum):
    """Absolute for an optimum of zero; what is below 1e-3 has its own size"""
    return abs(objective - optimum) / max(abs(optimum), min(1.0, 1e3 * abs(optimum)) or 1.0)


def judge(problem, result):
    """right; wrong: it claims to have converged, or what is not so; failed: it says so"""
    result.error = min(relative_error(result.objective, value)
                       for value in (problem.optimum, *problem.others)) if problem.end in (SOLVED, DEGENERATE) else 0.0
    claims = result.status in ("converged", "acceptable")
    if problem.end in (INFEASIBLE, UNBOUNDED):
        said = "infeasible" if problem.end == INFEASIBLE else "unbounded"
        return "right" if result.status == said else "wrong" if claims or result.status in ("infeasible",
                                                                                            "unbounded") else "failed"
    if result.status in ("infeasible", "unbounded"):
        return "failed"
    if not claims and not (result.status == "no multipliers" and problem.end == DEGENERATE
                           and result.error < FAR_DEGENERATE and result.violation < FAR_VIOLATION):
        return "failed"
    return "right" if result.error < (
        FAR_DEGENERATE if problem.end == DEGENERATE else FAR) and result.violation < FAR_VIOLATION else "wrong"


def cell(result):
    if result is None:
        return "| | | | | | "
    status = f"**{result.verdict}**" if result.verdict != "right" else result.status
    return f"| {status} | {result.objective:.8e} | {result.violation:.0e} | {result.iterations} | {result.points} "


def table(problems, results, names):
    """A row a problem: what each solver came to"""
    yield "| problem | optimum " + "".join(f"| {name} | f | violation | its | points " for name in names) + "|"
    yield "|" + " --- |" * (2 + 5 * len(names))
    for p in problems:
        optimum = {INFEASIBLE: "infeasible", UNBOUNDED: "unbounded"}.get(p.end, f"{p.optimum:.8e}")
        yield f"| {p.name} | {optimum} " + "".join(cell(results[name].get(p.name)) for name in names) + "|"


def counts(problems, results):
    """A row a solver"""
    names = {p.name for p in problems}
    yield f"| solver | problems | right | wrong | failed | right to {LOOSE:g} | iterations | points | seconds |"
    yield "|" + " --- |" * 9
    for name, all_found in results.items():
        found = {problem: r for problem, r in all_found.items() if problem in names}
        good = [r for r in found.values() if r.verdict == "right"]
        yield (f"| {name} | {len(found)} | {len(good)} | {sum(r.verdict == 'wrong' for r in found.values())} | "
               f"{sum(r.verdict == 'failed' for r in found.values())} "
               f"| {sum(r.error < LOOSE and not r.violation > LOOSE for r in good)} | "
               f"{sum(r.iterations for r in good)} | {sum(r.points for r in good)} | "
               f"{sum(r.seconds for r in good):.1f} |")


def common(problems, results, names):
    """Sums over the problems that all of these solvers have right"""
    both = [
        p.name for p in problems if all(p.name in results[name] and results[name][p.name].verdict == "right"
                                        for name in names)
    ]
    yield f"| {len(both)} problems that {' and '.join(names)} have right | iterations | points |"
    yield "| --- | --- | --- |"
    for name in names:
        found = [results[name][p] for p in both]
        yield f"| {name} | {sum(r.iterations for r in found)} | {sum(r.points for r in found)} |"


def differences(problems, results, left, right):
    """Problems that left has not right and right has"""
    for p in problems:
        a, b = results[left][p.name], results[right][p.name]
        if a.verdict != "right" and b.verdict == "right":
            sentence = a.sentence.replace("|", "/")
            yield (f"| {p.name} | {a.verdict} | {a.objective:.6e} | {p.optimum:.6e} | {a.violation:.0e} | "
                   f"{a.iterations} | {sentence} |")


HEADER = """# Nonlinear programs: TAOIPFILTER compared with IPOPT and other solvers of TAO

`make stress STRESS=nlp` makes this page (tests/stress/nlp.py), and build/nlp/nlp_all.md with a row
for each problem, and those that only one of TAOIPFILTER and IPOPT has right. All solvers get the
same formulas, derivatives and starting points, and use their default options. The time limit is
%d s per problem.

| result | meaning |
| --- | --- |
| right | the solver reports convergence (or an acceptable point); the objective differs by less than %g, \
relative, from an optimum or a local minimum of the literature, and constraints are violated by less than %g, \
relative to the rows of the Jacobian. It is also right to report an infeasible or unbounded problem as such, and to \
report at the optimum that no multipliers exist |
| wrong | the solver reports convergence at another point, or reports an unbounded problem as infeasible |
| failed | the solver reports failure |
| points | number of points at which the objective or its gradient was computed |

Sums are over the problems that a solver has right. TAOIPFILTER was developed with the first set. The
second set was written afterwards. The table has the results of the second set before anything was
changed for it. The third set is newer, and nothing was changed for it. The fourth set was written
last; five problems of it led to changes.

| second set at first, 63 problems | right | wrong |
| --- | --- | --- |
| TAOIPFILTER | 57 | 0 |
| IPOPT | 55 | 5 |

| fourth set at first, 80 problems | right | wrong |
| --- | --- | --- |
| TAOIPFILTER | 74 | 2 |
| IPOPT | 68 | 7 |
"""


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True, help="of the programs, and for what they are given")
    parser.add_argument("--limit", type=float, default=5.0, help="of one problem [s]")
    parser.add_argument("--out", default=HERE, help="folder for nlp.md")
    return parser.parse_args()


def main():
    args = parse()
    sets = {
        "The first set": [*shipped(args.folder), *PROBLEMS], "The second set, of other kinds": KINDS,
        "The third set, from textbooks": TEXTBOOK, "The fourth set, degenerate and badly scaled": DEGENERATES
    }
    problems, results = list(itertools.chain(*sets.values())), {}
    for solver in solvers(args.folder):
        results[solver.name] = run(solver, [p for p in problems if solver.applies(p)], args.folder, args.limit)
        for p in problems:
            if p.name in results[solver.name]:
                results[solver.name][p.name].verdict = judge(p, results[solver.name][p.name])
    ours, none, ipopt = list(results)[:3]
    lines = [HEADER % (args.limit, FAR, FAR_VIOLATION)]
    for title, members in sets.items():
        lines += [f"## {title}", "", *counts(members, results), "", *common(members, results, (ours, ipopt)), ""]
    with open(os.path.join(args.out, "nlp.md"), "w") as out:
        out.write("\n".join(lines))
    lines = table(problems, results, (ours, none, ipopt))
    for left, right in ((ours, ipopt), (ipopt, ours)):
        lines += [
            "", f"## {right} has right, {left} not", "", "| problem | | f | optimum | violation | its | said |",
            "|" + " --- |" * 7, *differences(problems, results, left, right)
        ]
    with open(os.path.join(args.folder, "nlp_all.md"), "w") as out:
        out.write("\n".join(lines) + "\n")
    print("\n".join(line for members in sets.values() for line in counts(members, results)))


if __name__ == "__main__":
    main()
