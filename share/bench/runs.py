"""Runs of scenes that are given as text: what the front page and the pages of elements are made from. A run is known by
its scene, its options and the version of the sources. Each is kept in a file when it ends, so that an interrupted bench
goes on where it stopped."""
import functools
import hashlib
import json
import os

from problems import TOP
from runner import execute, last_words, read_summary, user_seconds

CONTACT = os.path.join(TOP, "bin", "contact")
SOURCES = ("include", "pc_amgf", "tao_ipfilter", "src", "apps", "share/toolchain.mk")
SHORT = 0.5  # user seconds; a shorter run is repeated until all have taken as long, and the fastest counts
ANSWERS = (0, 4)  # exit codes of runs whose answer counts; 4: short of the requested accuracy


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


class Runs:
    """Records in `folder`; limit: seconds of a run. A run without an answer is a record too: `failed` says why"""

    def __init__(self, folder, limit):
        self.folder, self.limit, self.version, self.loads = folder, limit, source_version(), []
        os.makedirs(folder, exist_ok=True)

    def get(self, name, text, options=(), limit=None):
        base = os.path.join(self.folder, "".join(c if c.isalnum() or c in "-." else "_" for c in name))
        words = [open(word).read() if word.endswith(".opts") else word for word in options]
        key = hashlib.sha256("\0".join((self.version, text, *words)).encode()).hexdigest()[:16]
        record = self.kept(base + ".kept", key)
        if record is None:
            record = self.run(base, text, options, limit or self.limit) | {"key": key}
            print(f"{name}: {record['failed'] or format(record['seconds'], '.2f') + ' s'}", flush=True)
            with open(base + ".part", "w") as file:
                json.dump(record, file)
            os.replace(base + ".part", base + ".kept")
        self.loads.append(record["load"])
        return record

    @staticmethod
    def kept(path, key):
        if not os.path.exists(path):
            return None
        with open(path) as file:
            record = json.load(file)
        return record if record["key"] == key else None

    @staticmethod
    def run(base, text, options, limit):
        if os.path.exists(base + ".json"):
            os.remove(base + ".json")
        with open(base + ".yaml", "w") as file:
            file.write(text)
        estimate = () if "-accuracy" in options else ("-error_estimate", "0")
        seconds, spent = limit, 0
        while spent == 0 or (spent < SHORT and not limited):
            before = user_seconds()
            code, said, limited = execute(
                [CONTACT, base + ".yaml", "-quiet", *estimate, *options, "-summary", base + ".json"], limit)
            spent += user_seconds() - before
            seconds = min(seconds, user_seconds() - before)
        summary = read_summary(base)
        steps = summary["steps"] if summary else []
        said = last_words(said).replace(base + ".yaml: ", "").replace("contact: error: ", "")
        failed = f"time limit {limit:g} s" if limited else "" if code in ANSWERS and steps else (
            f"{'refused' if code == 1 else f'exit code {code}'}: "
            f"{said}")
        record = {
            "failed": failed, "code": code, "seconds": seconds, "load": os.getloadavg()[0],
            "unknowns": summary["dofs"] if summary else 0
        }
        if not failed:
            forces = steps[-1]["contact_force"]
            record |= {
                "energy": steps[-1]["energy"], "forces": forces, "force": sum(f**2 for f in forces)**0.5,
                "updates": steps[-1]["contact_updates"]
            }
        return record
