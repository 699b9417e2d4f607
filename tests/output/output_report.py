"""Parses a summary as strict JSON (no NaN, no Infinity) and prints it with its keys in order, lists of numbers on one
line."""
import json
import re
import sys


def refuse(word):
    raise SystemExit(f"{word} is not JSON")


with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file, parse_constant=refuse)
print(re.sub(r"\[([^\[\]{}\"]*)\]", lambda m: "[" + " ".join(m[1].split()) + "]", json.dumps(report, indent=1)))
