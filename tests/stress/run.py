"""make stress: bin/contact on the cases that break solvers, as tables that are printed and kept."""
import argparse
import fnmatch
import json
import os
import resource

import barrier
import clip
import steps
import sweeps
import together
import units
from runner import AMGF_DIR

HEADER = """# Stress report

`make stress` makes this page (`tests/stress/run.py`). The two blocks are on mesh 1.

| column | meaning |
| --- | --- |
| status | converged; failed: the run stopped with a message; refused: the input was rejected before the run |
| PCG mean, PCG max | iterations of PCG per Newton system |
| true gap | smallest gap of the deformed bodies. It is negative where bodies overlap, because these scenes have one \
contact update per load step |
| difference in energy | relative difference from a run with MUMPS on the whole matrix and a tolerance of 1e-10 |
| verdict | whether the result is as it must be |"""


def number(value, form):
    return "" if value is None else format(value, form)


def counts(run):
    """Newton iterations, PCG iterations a system on average, and at most."""
    pcg = run.pcg
    return [str(run.newton), f"{sum(pcg) / len(pcg):.1f}" if pcg else "", str(max(pcg, default=""))]


def cpu_seconds():
    """Of all runs so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def gap(run):
    return "" if not run.steps else "no contact" if run.gap_true is None else format(run.gap_true, ".1e")


def last_words(run):
    if run.converged:
        return ""
    said = run.said.splitlines()
    return said[-1].replace("|", "/").replace(AMGF_DIR + os.sep, "") if said else f"exit code {run.code}"


class Report:
    """Markdown, printed line by line and kept in a file; what is wrong is repeated at the end. Cases done are kept
    apart, to resume."""

    def __init__(self, args):
        self.stream = open(args.report, "w") if args.report else None
        self.done_file = os.path.join(args.folder, "done.json")
        self.done = {}
        self.title = None
        self.bad = []
        self.rows = {}
        self.seconds = 0.0
        os.makedirs(args.folder, exist_ok=True)
        if args.resume and os.path.exists(self.done_file):
            with open(self.done_file) as file:
                self.done = {entry["case"]: entry for entry in map(json.loads, file)}
        elif os.path.exists(self.done_file):
            os.remove(self.done_file)

    def say(self, line=""):
        print(line, flush=True)
        if self.stream:
            self.stream.write(line + "\n")
            self.stream.flush()

    def row(self, title, columns, cells, wrong):
        if title != self.title:
            self.title = title
            self.say(f"\n## {title}\n")
            self.say("| " + " | ".join(columns) + " |")
            self.say("|" + " --- |" * len(columns))
        self.say("| " + " | ".join(cells) + " |")
        self.rows[title] = self.rows.get(title, 0) + 1
        if wrong:
            self.bad.append(f"{title}, {cells[0]}: {'; '.join(wrong)}")

    def case(self, name, part, case):
        """Runs a case, or repeats its rows when it was done before."""
        columns, entry = [*part.columns, "verdict", "message"], self.done.get(name)
        if entry:
            for row in entry["rows"]:
                self.row(case.title, columns, row["cells"], row["wrong"])
        else:
            start, entry = cpu_seconds(), {"case": name, "rows": []}
            for result in case.run():
                wrong = result["wrong"]
                verdict = "**" + "; ".join(wrong) + "**" if wrong else "pass"
                cells = [
                    *part.cells(result), verdict, result["said"] if "said" in result else last_words(result["run"])
                ]
                entry["rows"].append({"cells": cells, "wrong": wrong})
                self.row(case.title, columns, cells, wrong)
            entry["seconds"] = cpu_seconds() - start
            with open(self.done_file, "a") as file:
                file.write(json.dumps(entry) + "\n")
        self.seconds += entry["seconds"]

    def end(self):
        self.say("\n## Cases\n\n| table | cases |\n| --- | --- |")
        for title, rows in self.rows.items():
            self.say(f"| {title} | {rows} |")
        self.say(f"\n{sum(self.rows.values())} cases, {self.seconds / 60:.0f} minutes of processor time; "
                 f"{len(self.bad)} are not as they must be")
        for line in self.bad:
            self.say(f"- {line}")
        if self.stream:
            self.stream.close()


class Part:
    """cases(args): what to run; columns and cells: how a result is shown."""

    def __init__(self, cases, columns, cells):
        self.cases, self.columns, self.cells = cases, columns, cells


def sweep_cells(r):
    run = r["run"]
    return [r["name"], run.status, *counts(run), gap(run), number(run.energy, ".9g"), number(r["drift"], ".1e")]


def barrier_cells(r):
    run = r["run"]
    return [
        r["name"], run.status,
        str(run.newton), " ".join(map(str, run.pcg)),
        number(r["bound"], ".0f"),
        number(r["spread"], ".1e"),
        number(run.last.get("kkt_error"), ".1e"),
        number(run.last.get("kkt_error_unscaled"), ".1e")
    ]


def unit_cells(r):
    return [r["name"], r["unit"], r["run"].status, *counts(r["run"]), number(r["difference"], ".1e"), r["of"]]


def step_cells(r):
    run = r["run"]
    return [
        r["name"],
        str(r["steps"]),
        str(r["updates"]), run.status, *counts(run),
        gap(run),
        number(r["displacement"], ".1e"),
        number(r["energy"], ".1e")
    ]


def clip_cells(r):
    return [r["name"], str(r["checks"]), f"{r['seconds']:.0f}"]


COUNTS = ["status", "Newton", "PCG mean", "PCG max"]
PARTS = {
    "sweeps": Part(sweeps.cases, ["case", *COUNTS, "true gap", "energy", "difference in energy"], sweep_cells),
    "barrier": Part(
        barrier.cases,
        ["case", "status", "Newton", "PCG of each Newton system", "bound", "D_max/D_min", "KKT error", "unscaled"],
        barrier_cells),
    "units": Part(units.cases, ["scene", "units", *COUNTS, "largest difference", "of"], unit_cells),
    "steps": Part(steps.cases, [
        "scene", "load steps", "contact updates allowed", *COUNTS, "true gap", "difference in displacement",
        "difference in energy"
    ], step_cells),
    "together": Part(together.cases, ["effects", "known", "run", "refused"], lambda r: [r["name"], *r["counts"]]),
    "clip": Part(clip.cases, ["case", "checks", "time [s]"], clip_cells),
}


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", default=list(PARTS), metavar="PART",
                        help=f"of {', '.join(PARTS)}; default all")
    parser.add_argument("--quick", action="store_true",
                        help="the rows that make check runs, and only whether they are as they should be")
    parser.add_argument("--resume", action="store_true", help="do not run again what is in --folder already")
    parser.add_argument("--only", default="*", help="cases whose name matches this pattern")
    parser.add_argument("--refine", type=int, default=1,
                        help="of the two blocks in the sweeps; 1 is the published mesh 1")
    parser.add_argument("--limit", type=int, default=600, help="of one run [CPU s]")
    parser.add_argument("--folder", default=os.path.join(AMGF_DIR, "build", "stress"),
                        help="for scenes, summaries and fields")
    parser.add_argument("--report", help="file for the tables")
    return parser.parse_args()


def main():
    args = parse()
    if args.quick:
        args.limit = 60
        for row in sweeps.rows(args.folder, 0):
            if row.quick:
                print(f"{row.group}, {row.name}: {'; '.join(sweeps.solve_row(args, row)['wrong']) or row.end}")
        for result in units.quick(args):
            print(f"{result['name']}, {result['unit']}: {'; '.join(result['wrong']) or 'the same answer'}")
        return 0
    report = Report(args)
    report.say(HEADER)
    for name in args.parts:
        for case in PARTS[name].cases(args):
            if fnmatch.fnmatch(f"{case.title}, {case.name}".lower(), args.only.lower()):
                report.case(f"{name}, {case.title}, {case.name}", PARTS[name], case)
    report.end()
    return 1 if report.bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
