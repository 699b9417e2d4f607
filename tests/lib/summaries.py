"""What the checks of contact's summaries share."""
import json
import os
import re
import subprocess


def load(name):
    with open(name + ".json") as file:
        return json.load(file)


def say(what, good, seen):
    print(what + (": yes" if good else ": NO, " + str(seen)))


def within(value, target, tolerance):
    return abs(value - target) <= tolerance * abs(target)


def mean(values):
    return sum(values) / len(values)


def each(run, key):
    return [step[key] for step in run["steps"]]


def petsc_release():
    """(major, minor) of the PETSc that contact was compiled with"""
    program = os.path.join(os.environ["AMGF_DIR"], "bin", "contact")
    version = subprocess.run([program, "-version"], capture_output=True, text=True, check=True).stdout
    return tuple(int(number) for number in re.search(r"with PETSc (\d+)\.(\d+)", version).groups())


def say_same_steps(what, run, whole, keys, limit):
    """The two load steps of a restarted run have the values of the same steps of the whole run"""
    pairs = [(step, other) for step in run["steps"] for other in whole["steps"] if other["step"] == step["step"]]
    off = max(abs(step[key] / other[key] - 1) for step, other in pairs for key in keys)
    say(what, len(pairs) == 2 and off < limit, (len(pairs), off))
