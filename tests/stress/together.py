"""Effects of a scene, every two together and many three: tests/step/combinations.py with all of them."""
import os
import re
import subprocess
import sys

from runner import AMGF_DIR, Case

TRIPLES = 400


def compare(args, name, words):
    folder = os.path.join(args.folder, "together")
    os.makedirs(folder, exist_ok=True)
    command = [sys.executable, "-B", os.path.join(AMGF_DIR, "tests", "step", "combinations.py"), *words]
    done = subprocess.run(command, cwd=folder, env={**os.environ, "AMGF_DIR": AMGF_DIR}, capture_output=True, text=True)
    counts = re.search(r"(\d+) effects, (\d+) run, (\d+) refused", done.stdout)
    wrong = re.findall(r"^(?!\|).* - .*$", done.stdout, re.MULTILINE) if counts else [done.stderr[-300:]]
    yield {"name": name, "counts": counts.groups() if counts else ("", "", ""), "wrong": wrong, "said": ""}


def cases(args):
    for name, words in (("every two", ["table"]), (f"{TRIPLES} of three", ["triples", str(TRIPLES)])):
        yield Case("Effects together", name, lambda name=name, words=words: compare(args, name, words))
