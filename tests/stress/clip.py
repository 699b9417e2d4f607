"""A million pairs of facets, random and adversarial, on one rank and on three: tests/contact/contact_clip.c with more
pairs than `make check` takes."""
import os
import subprocess
import time

from runner import AMGF_DIR, Case

PROGRAM = os.path.join(AMGF_DIR, "build", "tests", "tests", "contact_clip")
EXPECTED = os.path.join(AMGF_DIR, "tests", "output", "contact_clip_1.out")
PAIRS = 1000000


def compare(ranks):
    launch = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    start = time.time()
    done = subprocess.run([*launch, PROGRAM, "-pairs", str(PAIRS)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    with open(EXPECTED) as file:
        expected = file.read().splitlines()
    seen = done.stdout.splitlines()
    wrong = [f"{a} instead of {b}" for a, b in zip(seen, expected) if a != b]
    if done.returncode or len(seen) != len(expected):
        wrong.append(f"exit code {done.returncode}, {len(seen)} of {len(expected)} lines")
    yield {
        "name": f"{PAIRS:,} pairs, {ranks} ranks", "checks": len(expected), "seconds": time.time() - start,
        "wrong": wrong, "said": ""
    }


def cases(args):
    for ranks in (1, 3):
        yield Case("Clipping and mortar integrals", f"{ranks} ranks", lambda ranks=ranks: compare(ranks))
