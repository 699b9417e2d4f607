"""Draws 20 sentences of pages, 20 comments and 20 messages at random: sample.py [SEED]

The same seed draws the same sentences. A reader who does not know the code says what each one means; what is
misunderstood is rewritten, and its neighbours with it.
"""
import glob
import os
import random
import re
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOURCES = ("apps", "include", "pc_amgf", "tao_ipfilter", "src")
NUMBER = 20
WORDS = 5  # fewer make no sentence
ABBREVIATIONS = r"(?<!\b[A-Z])(?<!e\.g)(?<!i\.e)(?<!\bal)"  # a dot after one of these ends no sentence


def text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def sources():
    for folder in SOURCES:
        for path in sorted(glob.glob(os.path.join(TOP, folder, "**", "*.[ch]"), recursive=True)):
            yield os.path.relpath(path, TOP), text(path)


def place(path, content, offset):
    return f"{path}:{content.count(chr(10), 0, offset) + 1}"


def sentences_of(prose):
    """Sentences, each with where it begins. A colon ends none, since what follows it cannot be read alone"""
    for match in re.finditer(r"\S.*?(?:" + ABBREVIATIONS + r"[.?!](?=\s|$)|\n\s*\n|\f|$)", prose, flags=re.S):
        sentence = " ".join(match[0].split())
        if len(sentence.split()) >= WORDS:
            yield match.start(), sentence


def blank(match):
    """As many lines without text"""
    return re.sub(r"[^\n]", " ", match[0])


def pages():
    names = glob.glob(os.path.join(TOP, "*.md")) + glob.glob(os.path.join(TOP, "share", "*", "*.md"))
    for name in sorted(names + [os.path.join(TOP, "tests", "README.md")]):
        path, content = os.path.relpath(name, TOP), text(name)
        if "changelog" in path or path.startswith("share/bench"):
            continue
        prose = re.sub(r"^## (?:References|Relatives)$.*?(?=^## |\Z)", blank, content, flags=re.S | re.M)
        prose = re.sub(r"^(    |\||#|!\[|- \[|<!--).*$", blank, prose, flags=re.M)
        prose = re.sub(r"^```.*?^```", blank, prose, flags=re.S | re.M)
        prose = re.sub(r"\n(?=\s*(?:[-*]|\d+\.) )", "\n\f", prose)  # an item of a list ends the one before it
        for offset, sentence in sentences_of(prose):
            yield place(path, prose, offset), sentence
        heads = ""
        for row in re.finditer(r"^\|(.*)\|$", content, flags=re.M):
            cells = [cell.strip() for cell in row[1].split(" | ")]
            if content.startswith("\n| ---", row.end()):
                heads = " | ".join(cells)
            elif max(len(cell.split()) for cell in cells) >= 2 * WORDS:
                yield place(path, content, row.start()), " | ".join(cells) + f"\n      (columns: {heads})"


def comments():
    for path, content in sources():
        for match in re.finditer(r"/\*(.*?)\*/", content, flags=re.S):
            if match[1].startswith("@"):
                continue  # manual pages have their own form
            prose = re.sub(r"^\s*\*? ?", "", match[1], flags=re.M)
            code = content[content.rfind("\n", 0, match.start()) + 1:match.start()].strip()
            if len(prose.split()) >= WORDS:
                yield place(path, content,
                            match.start()), " ".join(prose.split()) + (f"\n      (beside: {code})" if code else "")


def messages():
    words = ("Check", "Require", "Error", "ERRQ", "Info", "rintf", "Warn", "Fail", "Say", "Reason", "PetscOptions")
    calls = rf"\w*(?:{'|'.join(words)})\w*"
    for path, content in sources():
        content = re.sub(r"/\*.*?\*/", lambda comment: re.sub(r"\S", " ", comment[0]), content, flags=re.S)
        for match in re.finditer(calls + r"\s*\((.*?)\);", content, flags=re.S):
            if re.search(r"@\w+{", match[1]):  # a citation
                continue
            call = re.sub(r'"\s*"', "", re.sub(r'"\s*PetscInt(?:64)?_FMT\s*"?', "d", match[1]))
            for piece in re.findall(r'"((?:[^"\\]|\\.)*)"', call):
                # neither XML nor the headings of columns
                if len(re.findall(r"[a-z]{2,}", piece)) >= WORDS and piece[:1] not in "-<" and not re.search(
                        r"<\w+ |  .*  .*  ", piece):
                    yield place(path, content, match.start()), piece


def main():
    seed = sys.argv[1] if len(sys.argv) > 1 else str(random.randrange(10**6))
    generator = random.Random(seed)
    print("seed", seed)
    for name, kind in (("pages", pages), ("comments", comments), ("messages", messages)):
        found = list(dict.fromkeys(kind()))
        print(f"\n{name}, {NUMBER} of {len(found)}")
        for where, sentence in sorted(generator.sample(found, min(NUMBER, len(found)))):
            print(f"  {where}\n    {sentence}")


if __name__ == "__main__":
    main()
