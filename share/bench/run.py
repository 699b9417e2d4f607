#!/usr/bin/env python3
"""The pages about settings: runs what has not been run with these sources, then writes a page with tables and figures
for each group of settings.

    share/bench/run.py [--size tiny|quick|full] [--only PAGE ...] [--folder build/bench] [--no-run] [--plan]

An interrupted bench goes on where it stopped. Errors are relative to the references that front.py found.
"""
import argparse
import os
import signal
import sys

import references
from problems import TOP
from store import Store
from studies import PAGES, SIZES, studies


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--size", choices=SIZES, default="quick")
    parser.add_argument("--only", nargs="*", default=[], help="pages: " + ", ".join(PAGES))
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    parser.add_argument("--no-run", action="store_true", help="tables and figures of what has been run")
    parser.add_argument("--plan", action="store_true", help="what would be run")
    parsed = parser.parse_args()
    if unknown := [name for name in parsed.only if name not in PAGES]:
        sys.exit(f"run.py: no page is called {' or '.join(unknown)}: they are {', '.join(PAGES)}")
    return parsed


def missing_cases(cases, store):
    """Each once, with the most generous limit"""
    missing = {}
    for case in cases:
        if store.get(case) is None and (case.key not in missing or missing[case.key].limit < case.limit):
            missing[case.key] = case
    return list(missing.values())


def run_all(cases, store):
    """A line a run"""
    missing = missing_cases(cases, store)
    for index, case in enumerate(missing, 1):
        print((f"[{index}/{len(missing)}] {case.problem}, mesh {case.level} "
               f"{' '.join((*map(' '.join, case.body), *case.options))[:90]} ..."), end=" ", flush=True)
        record = store.run(case)
        print(f"{record['status']}, {record['seconds']:.2f} s", flush=True)


def show_plan(cases, store):
    missing = missing_cases(cases, store)
    for case in missing:
        print(" ".join(store.command(case, "SUMMARY")))
    print(f"{len(missing)} runs")


def report(args, store, pages):
    """Imported here: without figures nothing needs matplotlib"""
    import page
    import plots
    import results

    folder = os.path.join(args.folder, "pages", "knobs")
    os.makedirs(folder, exist_ok=True)
    for name, chosen in pages.items():
        rows = results.collect(chosen, store, references.load(args.folder))
        if not rows:
            continue
        growths = results.growth_table(rows)
        drawn = plots.draw(chosen, rows, growths, folder)
        page.write(os.path.join(folder, name + ".md"), PAGES[name][0], chosen, rows, growths, drawn)
        results.write_csv(os.path.join(folder, name + ".csv"), rows)
        print(f"{len(rows)} rows, {len(drawn)} figures: {os.path.relpath(folder)}/{name}.md", flush=True)


def main():
    args = arguments()
    store = Store(args.folder, short={"tiny": 0.0, "quick": 0.5, "full": 2.0}[args.size])
    pages = {name: studies(args.size, name) for name in PAGES if not args.only or name in args.only}
    if args.plan:
        return show_plan([case for chosen in pages.values() for study in chosen for case in study.cases()], store)
    for name, chosen in pages.items():
        if not args.no_run:
            run_all([case for study in chosen for case in study.cases()], store)
        report(args, store, {name: chosen})


def interrupt(*_):
    raise KeyboardInterrupt


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, interrupt)  # so that the run under way ends, too
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\nrun.py: interrupted; the same command goes on from here")
