"""Parses a summary as strict JSON (no NaN, no Infinity) and prints it with its keys in order."""
import json
import sys


def refuse(word):
    raise SystemExit(f"{word} is not JSON")


with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file, parse_constant=refuse)
print(json.dumps(report, ensure_ascii=True, indent=1))
