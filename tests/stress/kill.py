"""A run that is killed at any time, or finds the disk full from then on, goes on from its newest checkpoint to the
answer that it would have come to."""
import glob
import json
import os
import random
import resource
import signal
import subprocess
import time

from runner import CONTACT, Case, solve

EVENTS = {"SIGKILL": 50, "full disk": 10}  # how often
TOLERANCE = {1: 1e-12, 2: 1e-9}  # by the ranks of the run that goes on
OPTIONS = ["-quiet", "-tao_ipfilter_tol", "1e-12", "-contact_update_tol", "1e-12"]
CUBE = {
    "lower": [0, 0, 0], "upper": [1, 1, 1], "cells": [3, 3, 3], "material": "neohookean", "young": 1, "poisson": 0.3
}
SCENE = {
    "problem": "press",
    "bodies": [{"cube": CUBE}, {
        "lid": {"lower": [0, 0, 1.01], "upper": [1.5, 1.5, 1.5], "cells": [2, 2, 2], "young": 5, "poisson": 0.3}
    }],
    "symmetry": ["cube.xmin", "cube.ymin", "cube.zmin", "lid.xmin", "lid.ymin"],
    "displacements": [{"top": {"face": "lid.zmax", "value": ["free", "free", -0.2]}}],
    "contact": [{"joint": {"mortar": "lid.zmin", "nonmortar": "cube.zmax"}}],
    "load": {"steps": 10},
}


def struck(base, event, seconds):
    """Leaves what a run does to which this happens after so many seconds"""
    for name in glob.glob(base + ".h5") + glob.glob(base + ".h5.*.part"):
        os.remove(name)
    command = [CONTACT, base + ".yaml", *OPTIONS, "-checkpoint_every", "1", "-checkpoint", base + ".h5"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    begun = time.time()
    while event != "SIGKILL" and not os.path.exists(base +
                                                    ".h5") and process.poll() is None and time.time() < begun + 60:
        time.sleep(0.01)  # MPI writes files of its own when it begins, and ends with pages of its own where it cannot
    time.sleep(seconds)
    if event == "SIGKILL":
        process.kill()
    else:
        try:
            resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (16384, 16384))  # no signal says so: writing fails
        except ProcessLookupError:
            pass
    said = process.communicate()[1].strip()
    return None if process.returncode in (0, -signal.SIGKILL) or (
        process.returncode == 6 and "\n" not in said) else f"exit code {process.returncode}, {said}"


def go_on(base, ranks, limit):
    """How the run that goes on ends, what it says, and its last load step"""
    command = [
        *(["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []), CONTACT, base + ".yaml", *OPTIONS,
        "-restart", base + ".h5", "-summary", base + "_on.json"
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=10 * limit)
    said = [line for line in done.stderr.splitlines() if line.startswith("contact: ")]
    if done.returncode:
        return done.returncode, said, None
    with open(base + "_on.json") as file:
        return 0, said, json.load(file)["steps"][-1]


def difference(a, b):
    """Largest relative difference of energy, work and contact force"""
    values = [(step["energy"], step["work"], step["pairs"][0]["force"][2]) for step in (a, b)]
    return max(abs(x / y - 1) for x, y in zip(*values))


def compare(args, event, ranks):
    whole = solve(os.path.join(args.folder, "kill"), f"press_{ranks}", SCENE, OPTIONS, args.limit)
    times, base = random.Random(ranks), whole.base
    result = {
        "name": event, "ranks": ranks, "times": EVENTS[event], "went_on": 0, "before": 0, "done": 0, "worst": 0.0,
        "wrong": [], "said": ""
    }
    for _ in range(EVENTS[event]):
        seconds = times.uniform(0.0, 1.1 * whole.seconds)
        bad = struck(base, event, seconds)
        code, said, step = go_on(base, ranks, args.limit)
        if bad:
            result["wrong"].append(f"after {seconds:.2f} s: {bad}")
        if code == 0:
            off = difference(step, whole.last)
            result["went_on"] += 1
            result["worst"] = max(result["worst"], off)
            if off > TOLERANCE[ranks]:
                result["wrong"].append(f"after {seconds:.2f} s it goes on to an answer that is off by {off:.1e}")
        elif code == 1 and len(said) == 1 and "there is no checkpoint" in said[0] and not os.path.exists(base + ".h5"):
            result["before"] += 1
        elif code == 1 and len(said) == 1 and "the analysis is already complete" in said[0]:
            result["done"] += 1
        else:
            result["wrong"].append(f"after {seconds:.2f} s: exit code {code}, {' '.join(said)}")
    yield result


def cases(args):
    for event in EVENTS:
        for ranks in TOLERANCE:
            yield Case("Restart after a run was killed", f"{event}, {ranks} ranks",
                       lambda event=event, ranks=ranks: compare(args, event, ranks))
