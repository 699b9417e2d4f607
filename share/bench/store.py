"""One run of bin/contact on a problem of the bench, and what is kept of it. A run is known by its scene, options, ranks
and the version of the sources, so that what was interrupted goes on where it stopped, and what has changed is run
again."""
import functools
import hashlib
import json
import os
import time
from dataclasses import dataclass

from problems import PROBLEMS, TOP
from runner import execute, last_words, read_summary, user_seconds

CONTACT = os.path.join(TOP, "bin", "contact")
OPTIONS = os.path.join(TOP, "share", "options")
SOURCES = ("include", "pc_amgf", "tao_ipfilter", "src", "apps", "share/toolchain.mk")
REPEATS = 3


@dataclass(frozen=True)
class Case:
    """A problem on a mesh with options, and keys of every body"""

    problem: str
    level: str
    options: tuple = ()
    body: tuple = ()
    ranks: int = 1
    limit: float = 600.0

    def scene(self):
        return PROBLEMS[self.problem].scene(self.level, self.body)

    @property
    def arguments(self):
        return ("-refine", str(PROBLEMS[self.problem].levels[self.level].refine), *self.options)

    @property
    def key(self):
        """Of what decides the answer; an options file counts by what it holds"""
        parts = [self.scene(), str(self.ranks)]
        for argument in self.arguments:
            path = os.path.join(OPTIONS, argument)
            parts.append(open(path).read() if argument.endswith(".opts") else argument)
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def source_files():
    for part in SOURCES:
        path = os.path.join(TOP, part)
        if os.path.isfile(path):
            yield path
        for folder, _, names in sorted(os.walk(path)):
            for name in sorted(names):
                if name.endswith((".c", ".h")):
                    yield os.path.join(folder, name)


@functools.cache
def source_version():
    digest = hashlib.sha256()
    for path in source_files():
        with open(path, "rb") as file:
            digest.update(os.path.relpath(path, TOP).encode() + b"\0" + file.read())
    return digest.hexdigest()[:12]


class Store:
    """Records in `folder`/runs, a file a run; short [s]: quicker runs are repeated, and the quickest counts"""

    def __init__(self, folder, short):
        self.folder = folder
        self.short = short
        self.version = source_version()
        for part in ("runs", "scenes", "fields"):
            os.makedirs(os.path.join(folder, part), exist_ok=True)

    def path(self, case):
        return os.path.join(self.folder, "runs", f"{case.key}-{self.version}.json")

    def get(self, case):
        """The record, or None; a run that a shorter limit ended does not count"""
        if not os.path.exists(self.path(case)):
            return None
        with open(self.path(case)) as file:
            record = json.load(file)
        return None if record["status"] == "time limit" and record["limit"] < case.limit else record

    def command(self, case, base):
        scene = os.path.join(self.folder, "scenes", case.key + ".yaml")
        with open(scene, "w") as file:
            file.write(case.scene())
        arguments = [os.path.join(OPTIONS, a) if a.endswith(".opts") else a for a in case.arguments]
        command = ["mpiexec", "--oversubscribe", "--bind-to", "core", "-n", str(case.ranks)] if case.ranks > 1 else []
        command += [CONTACT, scene, "-quiet", "-summary", base + ".json", *arguments]
        return command + (["-output", base] if PROBLEMS[case.problem].fields else [])

    def run(self, case):
        """Runs, repeats what is short, keeps and returns the record"""
        base = os.path.join(self.folder, "fields", case.key)
        record = self.run_once(case, base)
        while record["status"] == "converged" and record["seconds"] < self.short and record["repeats"] < REPEATS:
            again = self.run_once(case, base)
            again["repeats"] = record["repeats"] + 1
            record = min(record, again, key=lambda r: r["seconds"]
                         if r["summary"] else float("inf")) | {"repeats": again["repeats"]}
        self.remove_fields(case)
        with open(self.path(case) + ".part", "w") as file:
            json.dump(record, file, indent=1)
        os.replace(self.path(case) + ".part", self.path(case))
        return record

    def run_once(self, case, base):
        if os.path.exists(base + ".json"):
            os.remove(base + ".json")
        command = self.command(case, base)
        begin, used = time.time(), user_seconds()
        code, said, limited = execute(command, case.limit)
        record = {
            "problem": case.problem, "level": case.level, "options": list(case.options),
            "body": [list(b) for b in case.body], "ranks": case.ranks
        }
        record |= {
            "command": [os.path.relpath(c, TOP) if c.startswith(TOP) else c for c in command], "version": self.version,
            "key": case.key, "repeats": 1
        }
        record |= {
            "limit": case.limit, "wall": time.time() - begin, "seconds": user_seconds() - used,
            "load": os.getloadavg()[0], "code": code, "said": last_words(said), "summary": read_summary(base),
            "measure": None
        }
        record["status"] = self.status(record, limited)
        if record["status"] == "converged":
            record["measure"] = PROBLEMS[case.problem].measure(base, record["summary"])
        return record

    @staticmethod
    def status(record, limited):
        if record["code"] in (0, 4) and record["summary"] and record["summary"]["converged"]:
            return "converged"
        if record["code"] == 3 and record["summary"]:
            return "inconsistent gap"
        if limited:
            return "time limit"
        return "failed" if record["summary"] else "crashed" if record["code"] not in (1, 2) else "refused"

    def remove_fields(self, case):
        folder = os.path.join(self.folder, "fields")
        for name in os.listdir(folder):
            if name.startswith(case.key):
                os.remove(os.path.join(folder, name))
