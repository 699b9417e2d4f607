"""make stress: bin/contact on the cases that break solvers, as tables that are printed and kept."""
import argparse
import fnmatch
import os

import barrier
import steps
import sweeps
import units
from runner import AMGF_DIR


def number(value, form):
    return "" if value is None else format(value, form)


def counts(run):
    """Newton iterations, PCG iterations a system on average, and at most."""
    pcg = run.pcg
    return [str(run.newton), f"{sum(pcg) / len(pcg):.1f}" if pcg else "", str(max(pcg, default=""))]


def verdict(wrong):
    return "**" + "; ".join(wrong) + "**" if wrong else "pass"


def last_words(run):
    if run.converged:
        return ""
    said = run.said.splitlines()
    return said[-1].replace("|", "/") if said else f"exit code {run.code}"


class Report:
    """Markdown, printed line by line and kept in a file; what is wrong is repeated at the end."""

    def __init__(self, file):
        self.stream = open(file, "w") if file else None
        self.bad = []

    def say(self, line=""):
        print(line, flush=True)
        if self.stream:
            self.stream.write(line + "\n")
            self.stream.flush()

    def table(self, title, columns):
        self.say(f"\n## {title}\n")
        self.row(columns)
        self.row(["---"] * len(columns))

    def row(self, cells):
        self.say("| " + " | ".join(cells) + " |")

    def judge(self, name, wrong):
        if wrong:
            self.bad.append(f"{name}: {'; '.join(wrong)}")

    def end(self):
        self.say(f"\n{len(self.bad)} not as they should be")
        for line in self.bad:
            self.say(f"- {line}")
        if self.stream:
            self.stream.close()


def report_sweeps(report, args, wanted):
    group = [None]

    def done(row, run, reference, wrong):
        if row.group != group[0]:
            group[0] = row.group
            report.table(row.group, ["case", "status", "Newton", "PCG mean", "PCG max", "true gap", "energy", "drift", "judgement", "said"])
        report.row([row.name, run.status, *counts(run), number(run.gap_true, ".1e"), number(run.energy, ".9g"), number(sweeps.drift(run, reference), ".1e"),
                    verdict(wrong), last_words(run)])
        report.judge(f"{row.group}, {row.name}", wrong)

    sweeps.sweep(args.folder, lambda row: wanted(f"{row.group}, {row.name}"), done)


def report_barrier(report, args, wanted):
    report.table("The barrier to its end (two_block)", ["case", "status", "Newton", "PCG mean", "PCG max", "bound", "D_max/D_min", "KKT error", "unscaled", "judgement", "said"])

    def done(name, run, bound, spread, wrong):
        report.row([name, run.status, *counts(run), number(bound, ".0f"), number(spread, ".1e"), number(run.last.get("kkt_error"), ".1e"),
                    number(run.last.get("kkt_error_unscaled"), ".1e"), verdict(wrong), run.last.get("reason", last_words(run))])
        report.judge(name, wrong)

    for refine in args.barrier_refine:
        barrier.sweep(args.folder, refine, wanted, done, args.limit)


def report_units(report, args, wanted):
    report.table("Change of units (shipped scenes)", ["scene", "units", "status", "Newton", "PCG mean", "PCG max", "largest difference", "of", "judgement", "said"])

    def done(name, unit, run, worst, wrong):
        report.row([name, unit, run.status, *counts(run), number(worst[0], ".1e"), worst[1], verdict(wrong), last_words(run)])
        report.judge(f"units, {name}, {unit}", wrong)

    units.compare(args.folder, wanted, done, args.limit)


def report_steps(report, args, wanted):
    report.table("Number of load steps", ["scene", "steps", "updates allowed", "status", "Newton", "PCG mean", "PCG max", "true gap", "displacement off by", "energy off by", "judgement", "said"])

    def done(name, count, updates, run, off, wrong):
        report.row([name, str(count), str(updates), run.status, *counts(run), number(run.gap_true, ".1e"), number(off and off[0], ".1e"), number(off and off[1], ".1e"),
                    verdict(wrong), last_words(run)])
        report.judge(f"load steps, {name}, {count}", wrong)

    steps.compare(args.folder, wanted, done, args.limit)


PARTS = {"sweeps": report_sweeps, "barrier": report_barrier, "units": report_units, "steps": report_steps}


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", default=list(PARTS), metavar="PART", help=f"of {', '.join(PARTS)}; default all")
    parser.add_argument("--quick", action="store_true", help="the rows that make check runs, and only whether they are as they should be")
    parser.add_argument("--only", default="*", help="cases whose name matches this pattern")
    parser.add_argument("--limit", type=int, default=600, help="of one run outside the sweeps [s]")
    parser.add_argument("--barrier-refine", type=int, nargs="*", default=[1, 2], help="meshes of two_block")
    parser.add_argument("--folder", default=os.path.join(AMGF_DIR, "build", "stress"), help="for scenes, summaries and fields")
    parser.add_argument("--report", help="file for the tables")
    return parser.parse_args()


def main():
    args = parse()

    def wanted(name):
        return fnmatch.fnmatch(name.lower(), args.only.lower())

    if args.quick:
        sweeps.sweep(args.folder, lambda row: row.quick, lambda row, run, reference, wrong: print(f"{row.group}, {row.name}: {'; '.join(wrong) or row.end}"))
        return 0
    report = Report(args.report)
    report.say("# Stress report")
    for part in args.parts:
        PARTS[part](report, args, wanted)
    report.end()
    return 1 if report.bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
