"""make stress: bin/contact on the cases that break solvers, each a row of tests/stress/report.md."""
import argparse
import fnmatch
import os

import sweeps
from runner import AMGF_DIR


def number(value, form):
    return "" if value is None else format(value, form)


def sentence(run):
    if run.converged:
        return ""
    said = run.said.splitlines()
    return said[-1].replace("|", "/") if said else f"exit code {run.code}"


def row_of_table(row, run, reference, wrong):
    pcg = run.pcg
    cells = [row.name, run.status, str(run.newton), f"{sum(pcg) / len(pcg):.1f}" if pcg else "", str(max(pcg, default="")),
             number(run.gap_true, ".1e"), number(run.energy, ".9g"), number(sweeps.drift(run, reference), ".1e"),
             "pass" if not wrong else "**" + "; ".join(wrong) + "**", sentence(run)]
    return "| " + " | ".join(cells) + " |"


class Report:
    """Markdown, printed and kept."""

    def __init__(self, file):
        self.lines = []
        self.file = file

    def say(self, line=""):
        print(line, flush=True)
        self.lines.append(line)

    def write(self):
        if self.file:
            with open(self.file, "w") as stream:
                stream.write("\n".join(self.lines) + "\n")


def sweep(report, folder, wanted):
    columns = ["case", "status", "Newton", "PCG mean", "PCG max", "true gap", "energy", "drift", "judgement", "said"]
    group = [None]
    bad = []

    def done(row, run, reference, wrong):
        if row.group != group[0]:
            group[0] = row.group
            report.say(f"\n### {row.group}\n")
            report.say("| " + " | ".join(columns) + " |")
            report.say("| " + " | ".join(["---"] * len(columns)) + " |")
        report.say(row_of_table(row, run, reference, wrong))
        if wrong:
            bad.append(f"{row.group}, {row.name}: {'; '.join(wrong)}")

    report.say("## Sweeps")
    sweeps.sweep(folder, wanted, done)
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="the rows that make check runs, and only whether they pass")
    parser.add_argument("--only", default="*", help="rows whose 'group, name' match this pattern")
    parser.add_argument("--folder", default=os.path.join(AMGF_DIR, "build", "stress"), help="for scenes and summaries")
    parser.add_argument("--report", help="file for the tables")
    args = parser.parse_args()
    os.makedirs(args.folder, exist_ok=True)

    def wanted(row):
        return fnmatch.fnmatch(f"{row.group}, {row.name}".lower(), args.only.lower()) and (row.quick or not args.quick)

    if args.quick:
        sweeps.sweep(args.folder, wanted, lambda row, run, reference, wrong: print(f"{row.group}, {row.name}: {'; '.join(wrong) or row.end}"))
        return 0
    report = Report(args.report)
    bad = sweep(report, args.folder, wanted)
    report.say(f"\n{len(bad)} not as they should be")
    for line in bad:
        report.say(f"- {line}")
    report.write()
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
