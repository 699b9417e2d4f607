#!/usr/bin/env python3
"""make bench: what accuracy costs in time. Runs what has not been run with these sources, then writes tables, figures and the page.

    share/bench/run.py [--size tiny|quick|full] [--only STUDY ...] [--folder build/bench] [--no-run] [--plan]

An interrupted bench goes on where it stopped. The references, which no machine changes, are kept in share/bench/references.json;
--size full --only references works them out anew.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
import time

import machine
import references
from problems import TOP
from store import CONTACT, Store
from studies import SIZES, studies

TRUST = 20.0  # [s] for which expectations are taken at their word
# Bytes of the working sets of the triad: the matrices of the smallest meshes to far beyond the caches
TRIAD = (3e6, 3e7, 3e8, 3e9)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--size", choices=SIZES, default="full")
    parser.add_argument("--only", nargs="*", default=[], help="names of studies; references: what they are held against")
    parser.add_argument("--folder", default=os.path.join(TOP, "build", "bench"))
    parser.add_argument("--no-run", action="store_true", help="tables and figures of what has been run")
    parser.add_argument("--plan", action="store_true", help="what would be run, and how long it may take")
    return parser.parse_args()


def known(option):
    return f"{option} " in subprocess.run([CONTACT, "-help"], capture_output=True, text=True, errors="replace").stdout


def clock(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


class Progress:
    """A line a run; what is left is what was expected of it, at the rate at which expectations have held so far"""

    def __init__(self, cases, store):
        self.expected = {case.key: store.expected(case) for case in cases}
        self.total, self.done, self.left = len(cases), 0, sum(self.expected.values())
        self.spent = self.foreseen = 0.0

    def start(self, case):
        self.done += 1
        print(f"[{self.done}/{self.total}] {case.problem}, mesh {case.level} {' '.join((*map(' '.join, case.body), *case.options))[:90]} ...", end=" ", flush=True)

    def end(self, case, record):
        self.spent += record["elapsed"]
        self.foreseen += self.expected[case.key]
        self.left -= self.expected[case.key]
        rate = (self.spent + TRUST) / (self.foreseen + TRUST)
        print(f"{record['status']}, {clock(record['elapsed'])} (expected {clock(self.expected[case.key])}); about {clock(max(0.0, self.left * rate))} left", flush=True)


def missing_cases(cases, store):
    """Each once, with the most generous limit"""
    missing = {}
    for case in cases:
        if store.get(case) is None and (case.key not in missing or missing[case.key].limit < case.limit):
            missing[case.key] = case
    return list(missing.values())


def run_all(cases, store):
    missing = missing_cases(cases, store)
    progress = Progress(missing, store)
    if missing:
        print(f"{len(missing)} runs, about {clock(progress.left)}", flush=True)
    for case in missing:
        progress.start(case)
        progress.end(case, store.run(case))


def show_plan(cases, store):
    missing = missing_cases(cases, store)
    for case in missing:
        print(f"{clock(store.expected(case)):>8}  {' '.join(store.command(case, 'SUMMARY'))}")
    print(f"{len(missing)} runs, about {clock(sum(map(store.expected, missing)))}")


def update_references(store):
    """Extrapolates from the meshes that could be solved, three at least"""
    entries = references.load()
    for name, cases in references.reference_cases().items():
        records = [record for case in cases if (record := store.get(case)) and record["status"] == "converged"]
        if len(records) >= 3:
            entries[name] = references.extrapolate(references.PROBLEMS[name], records)
    with open(references.FILE, "w") as file:
        json.dump(entries, file, indent=1)
        file.write("\n")


def wanted(args):
    """Studies to be made, and a word about those that cannot be"""
    chosen, skipped = [], []
    for study in studies(args.size):
        if args.only and study.name not in args.only:
            continue
        if study.needs and not known(study.needs):
            skipped.append(f"{study.title}: `contact` has no option `{study.needs}`")
        else:
            chosen.append(study)
    if args.only and not chosen and not skipped and args.only != ["references"]:
        sys.exit(f"run.py: no study of size {args.size} is called {' or '.join(args.only)}: they are {', '.join(s.name for s in studies(args.size))}")
    return chosen, skipped


def report(args, store, chosen, skipped):
    """Imported here: without figures nothing needs matplotlib"""
    import page
    import plots
    import results

    entries = references.load()
    data = {"size": args.size, "date": time.strftime("%Y-%m-%d"), "version": store.version, "short": store.short, "machine": machine.describe(), "references": entries}
    data["triad"] = machine.triad(TRIAD if args.size != "tiny" else TRIAD[:2]) if any(s.kind == "roofline" for s in chosen) else []
    data["rows"] = results.collect(chosen, store, references.values(entries))
    data["growth"] = results.growth_table(data["rows"])
    data["roofline"] = results.roofline_table(chosen, store, data["triad"])
    results.write_csv(os.path.join(args.folder, "bench.csv"), data["rows"])
    results.write_json(os.path.join(args.folder, "bench.json"), data)
    drawn = plots.draw(chosen, data, args.folder)
    page.write(os.path.join(args.folder, "README.md"), chosen, data, drawn, skipped)
    print(f"{len(data['rows'])} rows, {len(drawn)} figures: {os.path.relpath(args.folder)}/README.md")


def main():
    args = arguments()
    store = Store(args.folder, short={"tiny": 0.0, "quick": 0.5, "full": 2.0}[args.size])
    chosen, skipped = wanted(args)
    for line in skipped:
        print("not run: " + line)
    finding = args.size == "full" and "references" in args.only
    cases = [case for group in references.reference_cases().values() for case in group] if finding else []
    cases += [case for study in chosen for case in study.cases()]
    if args.plan:
        return show_plan(cases, store)
    if not args.no_run:
        run_all(cases, store)
    if finding:
        update_references(store)
    report(args, store, chosen, skipped)


def interrupt(*_):
    raise KeyboardInterrupt


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, interrupt)  # so that the run under way ends, too
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\nrun.py: interrupted; the same command goes on from here")
