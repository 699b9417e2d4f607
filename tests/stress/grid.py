"""TAOIPFILTER, TAOTRON and IPOPT on obstacle problems on a grid: tests/stress/grid.md.

The problems are those of tests/tao_ipfilter/ipfilter_grid.h; `make stress STRESS=grid` builds the programs and runs
this. What has been run is kept in the folder: an interrupted run goes on where it stopped.
"""
import argparse
import json
import math
import os
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
PROBLEMS = ("obstacle", "torsion", "bearing", "signorini", "surface")
QUADRATIC = PROBLEMS[:-1]
LARGE = 1000  # from there on, the first and the third problem alone: an hour else
RANKS = (2, 4)  # of the runs beside those of one rank, on the largest grid below that
FAR = 1e-6  # relative error of the objective: more is marked
TIGHT = ["-tao_gatol", "1e-13", "-tao_ipfilter_pc_type", "hypre"]  # for the reference
HYPRE = ["-tao_ipfilter_pc_type", "hypre"]


class Run:

    def __init__(self, solver, problem, n, ranks=1):
        self.solver, self.problem, self.n, self.ranks = solver, problem, n, ranks

    def key(self):
        return f"{self.solver} {self.problem} {self.n} {self.ranks}"

    def command(self, folder):
        if self.solver == "IPOPT":
            return [os.path.join(folder, "ipopt"), self.problem, str(self.n)]
        options = {
            "ipfilter": HYPRE, "ipfilter, amgf": [], "ipfilter, rows": ["-rows"], "tron": ["-solver", "tron"],
            "reference": TIGHT
        }
        mpi = ["mpiexec", "--oversubscribe", "--bind-to", "none", "-n", str(self.ranks)] if self.ranks > 1 else []
        return [
            *mpi,
            os.path.join(folder, "tao"), "-report", "-problem", self.problem, "-n",
            str(self.n), *options[self.solver]
        ]


class Result:

    def __init__(self, line):
        _, status, objective, violation, steps, krylov, wall, processor = line.split("|")
        self.status, self.objective, self.violation = status, float(objective), float(violation)
        self.steps, self.krylov, self.wall, self.processor = int(steps), int(krylov), float(wall), float(processor)


def plan(sizes, largest_for_ipopt):
    for n in sizes:
        for problem in PROBLEMS if n < LARGE else ("obstacle", "bearing"):
            yield Run("reference", problem, n)
            yield Run("ipfilter", problem, n)
            if n < LARGE:
                yield Run("ipfilter, amgf", problem, n)
            if n < LARGE and problem in QUADRATIC:
                yield Run("ipfilter, rows", problem, n)
            yield Run("tron", problem, n)
            if n <= largest_for_ipopt:
                yield Run("IPOPT", problem, n)
    for ranks in RANKS:
        for problem in PROBLEMS:
            yield Run("ipfilter", problem, max(n for n in sizes if n < LARGE), ranks)
            yield Run("tron", problem, max(n for n in sizes if n < LARGE), ranks)


def perform(runs, folder, limit):
    path, lines = os.path.join(folder, "results.json"), {}
    if os.path.exists(path):
        with open(path) as file:
            lines = json.load(file)
    for run in runs:
        if run.key() in lines:
            continue
        try:
            said = subprocess.run(run.command(folder), capture_output=True, text=True, timeout=limit,
                                  check=False).stdout.strip().split("\n")[-1]
        except subprocess.TimeoutExpired:
            said = ""
        lines[run.key()] = said if said.count(
            "|") == 7 else f"{run.problem}|no end in {limit:g} s or an error|nan|nan|0|0|nan|nan"
        print(run.key(), lines[run.key()], flush=True)
        with open(path, "w") as file:
            json.dump(lines, file, indent=1)
    return {key: Result(line) for key, line in lines.items()}


def best(runs, results):
    """The lowest objective of what is feasible, by problem and size: the reference"""
    found = {}
    for run in runs:
        result, place = results[run.key()], (run.problem, run.n)
        if math.isfinite(result.objective) and result.violation <= 1e-12 and "DIVERGED" not in result.status:
            found[place] = min(found.get(place, math.inf), result.objective)
    return found


def row(run, result, lowest):
    error = (result.objective - lowest) / abs(lowest)
    mark = " (!)" if not error <= FAR else ""
    return (f"| {run.problem} | {run.n}² | {run.ranks} | {run.solver} | {result.status} | {result.steps} | "
            f"{result.krylov or ''} | {error:.1e}{mark} | {result.processor:.2f} |")


def page(runs, results):
    found = best(runs, results)
    shown = [run for run in runs if run.solver != "reference" and (run.problem, run.n) in found]
    lines = [
        "# Obstacle problems on a grid", "", "`make stress STRESS=grid` makes this page. The problems are those of",
        "`tests/tao_ipfilter/ipfilter_grid.h`. All start from u = 0, and each solver has its default tolerances.", "",
        "| solver | settings |", "| --- | --- |", "| ipfilter, tron | hypre as preconditioner |",
        "| ipfilter, amgf | its default preconditioner |",
        "| ipfilter, rows | bounds given as inequality constraints, with two sides where there are two bounds |", "",
        "The error is that of the objective, relative to the lowest objective that any solver found, or",
        f"`ipfilter` with gatol 1e-13. Errors above {FAR:g} are marked (!). The time is the sum over all ranks.", "",
        ("| problem | unknowns | ranks | solver | end | steps | Krylov iterations | error of the objective | "
         "processor time [s] |"), "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    ]
    lines += [row(run, results[run.key()], found[run.problem, run.n]) for run in shown]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True)
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 300, 1000])
    parser.add_argument("--ipopt", type=int, default=300, help="largest size for IPOPT, which factors")
    parser.add_argument("--limit", type=float, default=900.0, help="seconds a run")
    parser.add_argument("--page", default=os.path.join(HERE, "grid.md"))
    arguments = parser.parse_args()
    runs = list(plan(arguments.sizes, arguments.ipopt))
    results = perform(runs, arguments.folder, arguments.limit)
    with open(arguments.page, "w") as file:
        file.write(page(runs, results))


main()
