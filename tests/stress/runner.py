"""Runs bin/contact on a scene with a time limit and keeps what the run said about itself."""
import json
import os
import resource
import signal
import subprocess
import time

import h5py

AMGF_DIR = os.environ.get("AMGF_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CONTACT = os.environ.get("CONTACT") or os.path.join(AMGF_DIR, "bin", "contact")
DIRECT = os.path.join(AMGF_DIR, "share", "options", "direct.opts")
SCENES = os.path.join(AMGF_DIR, "share", "scenes")


class Case:
    """What is run at once: run() yields its results, dictionaries that hold at least the run and what is wrong with
    it."""

    def __init__(self, title, name, run):
        self.title, self.name, self.run = title, name, run


class Run:
    """One run: how it ended, its summary and, if it was asked to write, its fields."""

    def __init__(self, base, code, seconds, said, summary):
        self.base = base
        self.code = code
        self.seconds = seconds
        self.said = said
        self.summary = summary
        self.steps = summary["steps"] if summary else []

    @property
    def last(self):
        return self.steps[-1] if self.steps else {}

    @property
    def converged(self):
        return self.code == 0 and bool(self.summary) and self.summary["converged"]

    @property
    def status(self):
        """converged; failed (said so and stopped); refused (scene or mesh not accepted); time limit; crashed"""
        if self.converged:
            return "converged"
        if self.code is None:
            return "time limit"
        if self.code in (2, 3, 5) and self.summary and not self.summary["converged"]:
            return "failed"
        if self.code == 1 and self.said.startswith("contact: error: "):
            return "refused"
        return "crashed"

    @property
    def newton(self):
        return sum(step["ip_iterations"] for step in self.steps)

    @property
    def pcg(self):
        return [n for step in self.steps for n in step["ksp_iterations"]]

    @property
    def energy(self):
        return self.last.get("energy")

    @property
    def gap_true(self):
        """None where no faces are within reach of each other."""
        return self.last.get("gap_true")

    def fields(self, step):
        """Point fields of the body meshes and of the contact surface, by name."""
        fields = {}
        with h5py.File(f"{self.base}_{step:04d}.h5", "r") as file:
            file.visititems(lambda name, item: fields.update({name: item[...]})
                            if isinstance(item, h5py.Dataset) else None)
        return fields


def solve(folder, name, scene, options=(), limit=60, write=False):
    """scene: a dict, written as JSON, which is YAML; or the path of a file. limit: CPU seconds; ten times as many by
    the clock."""
    os.makedirs(folder, exist_ok=True)
    base = os.path.join(folder, name)
    path = scene
    if isinstance(scene, dict):
        path = base + ".yaml"
        with open(path, "w") as file:
            json.dump(scene, file, indent=1)
    command = [CONTACT, path, "-quiet", "-summary", base + ".json", *(str(option) for option in options)]
    if write:
        command += ["-output", base]
    if os.path.exists(base + ".json"):
        os.remove(base + ".json")
    start = time.time()
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=10 * limit, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
        code, said = done.returncode, done.stdout.strip()
        if code in (-signal.SIGXCPU, -signal.SIGKILL):
            code, said = None, f"ended by the limit of {limit} s"
    except subprocess.TimeoutExpired:
        code, said = None, f"ended by the limit of {10 * limit} s by the clock"
    summary = None
    if os.path.exists(base + ".json"):
        with open(base + ".json") as file:
            summary = json.load(file)
    return Run(base, code, time.time() - start, said, summary)
