"""Holds the documents below AMGF_DIR to what there is: links, columns of the tables, options, manual pages. Prints the
guide's commands with --commands FOLDER, after writing its files there."""
import glob
import os
import re
import sys

TOP = os.environ["AMGF_DIR"]
COLUMNS = 100  # of a page
LINES = 130  # of the first page
PAGES = sorted(
    os.path.relpath(path, TOP)
    for pattern in ("*.md", "share/*/*.md", "tests/README.md", "apps/README.md", "pc_amgf/**/README.md",
                    "tao_ipfilter/**/README.md", "src/**/README.md")
    for path in glob.glob(os.path.join(TOP, pattern), recursive=True))


def text(path):
    with open(os.path.join(TOP, path)) as file:
        return file.read()


def anchors(page):
    """As GitHub and pandoc make them of headings"""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text(page), flags=re.S | re.M), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links():
    for page in PAGES:
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"^```.*?^```", "", text(page), flags=re.S | re.M)):
            if re.match(r"https?:", target):
                continue
            path, _, anchor = target.partition("#")
            path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(os.path.join(TOP, path)):
                yield f"{page}: there is no {target}"
            elif anchor and anchor not in anchors(path):
                yield f"{page}: {path} has no heading #{anchor}"


def columns():
    """Headings of the tables, above and below in one"""
    for above, below in re.findall(r'COLUMN\(TABLE_\w+, "([^"]*)", "([^"]*)"', text("src/output/schema.c")):
        yield " ".join((above + " " + below).split())


def monitor_columns():
    for line in re.findall(r'"(iter [^"]*)\\n"',
                           text("tao_ipfilter/driver/monitor.c") + text("tao_ipfilter/subspace/monitor.c")):
        yield from line.split()


def unexplained():
    quoted = {piece.replace("\\|", "|") for piece in re.findall(r"`([^`]*)`", text("share/doc/guide.md"))}
    yield from sorted({column for column in (*columns(), *monitor_columns()) if column and column not in quoted})


def unknown_options():
    known = set(re.findall(r'"(\w+)"', text("src/options/known.c")))
    petsc = ("ksp_", "log_", "viewer_hdf5_", "tao_view", "dll_append", "pc_type", "tao_ipfilter_pc_amgf_",
             "options_file", "help", "n")
    for page in ("share/doc/guide.md", "share/doc/modelling.md", "share/doc/output.md", "share/doc/theory.md",
                 "share/doc/scale.md"):
        prose = re.sub(r"^```.*?^```", "", text(page), flags=re.S | re.M)
        code = re.findall(r"`((?:-|contact |bin/contact )[^`]*)`", prose)
        for option in re.findall(r"(?<![\w-])-([a-z]\w*)", " ".join(code)):
            if option not in known and not option.startswith(petsc) and "-" + option not in text("apps/options.c"):
                yield f"{page}: -{option}"


def unknown_targets():
    """Of make, in code"""
    rules = text("makefile") + text("tests/makefile") + "".join(
        text(os.path.relpath(path, TOP)) for path in glob.glob(os.path.join(TOP, "share", "*.mk")))
    for page in PAGES:
        for code in re.findall(r"`([^`\n]*)`|^    (.*)$", text(page), flags=re.M):
            for target in re.findall(r"^make ([a-z][\w-]*)", "".join(code)):
                if not re.search(rf"^(?:[\w -]+ )?{target}(?: [\w -]+)?:", rules, flags=re.M):
                    yield f"{page}: make {target}"


def wide_lines():
    """Of prose; a table's row cannot be broken"""
    for page in PAGES:
        prose = re.sub(r"^```.*?^```", lambda block: re.sub(".+", "", block[0]), text(page), flags=re.S | re.M)
        for number, line in enumerate(prose.splitlines(), 1):
            if len(line) > COLUMNS and not line.startswith(("|", "    ", "#")) and " " in line.strip():
                yield f"{page}:{number}: {len(line)} columns"


def unknown_tests():
    """In the table of features"""
    there = {os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(TOP, "tests", "*", "*.*"))}
    table = text("tests/README.md").split("## Features")[1].split("##")[0]
    yield from sorted(set(re.findall(r"`(\w+)`", table)) - there)


def missing_pages(folder):
    names = set(re.findall(r"PetscErrorCode (\w+)\(", text("include/petscamgf.h"))) | {"PCAMGF", "TAOIPFILTER"}
    there = {os.path.basename(path)[:-2] for path in glob.glob(os.path.join(folder, "man3", "*.3"))}
    yield from sorted(names - there)
    yield from ["contact(1)"] * (not os.path.exists(os.path.join(folder, "man1", "contact.1")))


def say(what, findings):
    findings = list(findings)
    print(f"{what}: {'none' if not findings else ''}", *findings, sep="\n  ")


def write_commands(folder):
    for kind, block in re.findall(r"^```(\w+)\n(.*?)^```", text("share/doc/guide.md"), flags=re.S | re.M):
        if kind == "sh":
            print(block, end="")
        elif block.startswith("# "):
            with open(os.path.join(folder, block.split()[1]), "w") as file:
                file.write(block)


if sys.argv[1] == "--commands":
    write_commands(sys.argv[2])
else:
    print("columns found:", "many" if len(set(columns())) > 40 else len(set(columns())))
    say("broken links", broken_links())
    say("columns that the guide does not explain", unexplained())
    say("options that are none", unknown_options())
    say("targets of make that are none", unknown_targets())
    say(f"lines wider than {COLUMNS} columns", wide_lines())
    lines = len(text("README.md").splitlines())
    say(f"README.md has more than {LINES} lines", [f"{lines} lines"] * (lines > LINES))
    say("tests of features that are none", unknown_tests())
    say("calls without a manual page", missing_pages(sys.argv[1]))
