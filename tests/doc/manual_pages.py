"""Manual pages (/*@ @*/ and /*MC M*/) beside the code: options that are only asked for, or only documented; pages of
functions that lack a part.

    python3 manual_pages.py TOP

Asked for: the first string of a call PetscOptions*(), and IP_REAL(NAME, member, default, ...) for -tao_ipfilter_NAME,
whose default the page must give.
On a page: the items below "Options Database Key(s)". PETSc asks for the options of the inner solvers, which are known
by their prefix, and for those that are not ours.
"""
import glob
import os
import re
import sys


def strip_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)


def asked(code):
    """Option -> default, or None where the source does not tell it"""
    options = {name: None for name in re.findall(r'\bPetscOptions\w+\(\s*(?:NULL\s*,\s*)*"(-\w+)"', code)}
    for name, default in re.findall(r'\bIP_REAL\("(\w+)",\s*\w+,\s*([^,]+),', code):
        options["-tao_ipfilter_" + name] = eval(default)
    return options


OURS = ("-pc_amgf_", "-amgf_", "-tao_ipfilter_")


def asked_by_petsc(option, code):
    """Not ours, or that of an inner solver: behind the prefix it has been given, "name_", with or without room for that
    of the outer one"""
    inner = ("-" + name + kind
             for name in re.findall(r'"(?:%s)?([a-z]\w*_)"', code)
             for kind in ("ksp_", "pc_", "mat_"))
    return not option.startswith(OURS) or option.startswith(tuple(inner))


def pages(text):
    return re.findall(r"/\*(?:@C?|MC|E|S)\n.*?(?:@|M|E|S)\*/", text, flags=re.S)


def documented(page):
    """(option, default) of the items below the heading, up to an empty line; the default as it is printed, or None"""
    for section in re.findall(r"Options Database Keys?:\n(.*?)(?:\n\s*\n|\Z)", page, flags=re.S):
        for item in re.findall(r"^\s*[+.-]\s+(-\w.*?)(?:\s-\s|$)", section, flags=re.M):
            default = re.search(r"<([^>]*)>", item)
            for option in re.findall(r"(?<![\w<])-[a-z]\w*", item):
                yield option, default and default.group(1)


def wrong_default(expected, printed):
    try:
        return abs(float(printed) - expected) > 5e-3 * abs(expected)
    except (TypeError, ValueError):
        return True


def check(top, folder):
    text = "".join(
        open(name).read() for name in sorted(glob.glob(os.path.join(top, folder, "**", "*.[ch]"), recursive=True)))
    code = strip_comments(text)
    options = asked(code)
    listed = [item for page in pages(text) for item in documented(page)]
    names = {option for option, _ in listed}
    findings = [option + ": on no manual page" for option in options if option not in names]
    findings += [
        option + ": on a manual page, but nothing asks for it"
        for option in names - set(options)
        if not asked_by_petsc(option, code)
    ]
    findings += [
        f"{option}: the page says {printed}, the source {options[option]:g}" for option, printed in listed
        if options.get(option) is not None and wrong_default(options[option], printed)
    ]
    print(
        f"{folder}: {'no options found' if not options else 'every option is on a manual page' if not findings else ''}"
    )
    for finding in sorted(findings):
        print("  " + finding)


def parameters(signature):
    """Names of the parameters of a function"""
    text = " ".join(signature.split())
    parts, depth = [""], 0
    for c in text[text.index("(") + 1:text.rindex(")")]:
        depth += (c in "([") - (c in ")]")
        if c == "," and not depth:
            parts.append("")
        else:
            parts[-1] += c
    found = (re.search(r"\(\*\s*(\w+)", p) or re.search(r"(\w+)\s*(?:\[[^\]]*\])*\)?$", p.strip())
             for p in parts
             if p.strip() != "void")
    return [match.group(1) for match in found]


def faults(page, signature):
    """What PETSc's format of a manual page asks for and this page of a function does not have"""
    name = re.search(r"(\w+)\(", signature).group(1)
    listed, section = [], ""
    for line in page.split("\n"):
        heading = re.match(r"\s*(\w[\w /]*):$", line)
        item = re.match(r"\s*[+.-]\s*(\w+)\s+-\s", line)
        section = heading.group(1) if heading else section
        if item and re.match(r"(In|Out)put", section):
            listed.append(item.group(1))
    if sorted(set(listed)) != sorted(parameters(signature)):
        yield f"the page lists the parameters {' '.join(listed)}, the function has {' '.join(parameters(signature))}"
    for what, pattern in (("first line NAME - Sentence", rf"\s*{name} - [A-Z]"),
                          ("Level", r"(?s).*Level: (beginner|intermediate|advanced|developer)"),
                          ("Collective", r"(?s).*\n\s*(Not |Logically |)Collective"), (".seealso",
                                                                                       r"(?s).*\n\.seealso: ")):
        if not re.match(pattern, page):
            yield "no " + what


def check_functions(top, folder):
    findings, n = [], 0
    for path in sorted(glob.glob(os.path.join(top, folder, "**", "*.c"), recursive=True)):
        for page, signature in re.findall(r"/\*@C?\n(.*?)@\*/\n(.*?)\n\{", open(path).read(), flags=re.S):
            n += 1
            findings += [
                f"{os.path.relpath(path, top)}: {signature.split('(')[0].split()[-1]}: {fault}"
                for fault in faults(page, signature)
            ]
    print(
        f"{folder}: "
        f"{'no manual pages found' if not n else 'every page has the parts of a manual page' if not findings else ''}")
    for finding in findings:
        print("  " + finding)


for folder in ("pc_amgf", "tao_ipfilter"):
    check(sys.argv[1], folder)
for folder in ("pc_amgf", "tao_ipfilter", "src"):
    check_functions(sys.argv[1], folder)
