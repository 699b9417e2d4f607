"""Parses a summary as strict JSON (no NaN, no Infinity) and prints it with its keys in order, a paragraph an entry."""
import json
import sys
import textwrap


def refuse(word):
    raise SystemExit(f"{word} is not JSON")


with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file, parse_constant=refuse)
for key, value in report.items():
    for part in value if isinstance(value, list) else [value]:
        print(textwrap.fill(f"{key}: {json.dumps(part)}", 118, break_on_hyphens=False, subsequent_indent="  "))
