"""Lists the numbers that are compiled in, with the comment beside each, and counts them by folder: numbers.py

Counted are constants with a name, which are limits, tolerances, shares and counts of attempts. The sizes of arrays, and
numbers inside formulas and formats, are not counted, nor are integers that multiply something or depend on a condition,
such as 3 components a node, and 3 corners of a triangle or 4. Factors of formulas are not counted either: halves,
quarters and small whole numbers that multiply something, as in a mean of two values, and the degrees of a circle.
"""
import collections
import re

from sample import sources

NUMBER = r"[-(]*\d[\d.]*(?:[eE][-+]?\d+)?"
FORMULAS = {"0", "0.0", "1", "1.0", "-1", "-1.0", "360.0"}
FACTORS = {"0.25", "0.5", "2.0", "3.0", "4.0", "(2.0"}
DEFINED = re.compile(rf"^#define (\w+)\s+(?:\\\n\s*)?({NUMBER})\b", re.M)
CONSTANT = re.compile(r"\bconst\s+(PetscReal|PetscInt|double|int)\s+([^;{]*);", re.S)
PART = re.compile(rf"\b(\w+)\s*=\s*([^,?]*\?\s*)?({NUMBER})(?:\s*:\s*{NUMBER})?\s*(\*[^,]*)?(?=,|$)")


def blank(comment):
    return re.sub(r"\S", " ", comment[0])


def numbers():
    files = {path: (content, re.sub(r"/\*.*?\*/", blank, content, flags=re.S)) for path, content in sources()}
    brackets = re.findall(r"\[[^\[\]]*\]", "".join(code for _, code in files.values()))
    sizes = set(re.findall(r"[A-Z][A-Z0-9_]+", " ".join(brackets)))
    for path, (content, code) in files.items():
        found = [(match.start(), match[1], match[2]) for match in DEFINED.finditer(code) if match[1] not in sizes]
        for match in CONSTANT.finditer(code):
            for part in PART.finditer(match[2]):
                whole = match[1] not in ("PetscReal", "double")
                if not (whole and part[2] or part[4] and (whole or part[3] in FACTORS)):
                    found.append((match.start(2) + part.start(), part[1], part[3]))
        for offset, name, value in sorted(found):
            if value.strip("(") not in FORMULAS:
                line = code.count("\n", 0, offset)
                comment = re.search(r"/\*\s*(.*?)\s*(?:\*/|$)", content.splitlines()[line])
                yield path, f"{path}:{line + 1}: {name} = {value}" + (f" ({comment[1]})" if comment else "")


def main():
    count = collections.Counter()
    for path, line in numbers():
        count["/".join(path.split("/")[:2])] += 1
        print(line)
    for folder, n in count.most_common():
        print(f"{n:5} {folder}")
    print(f"{sum(count.values()):5} in all")


if __name__ == "__main__":
    main()
