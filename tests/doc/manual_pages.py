"""Options that the plugin asks for, and options on its manual pages (/*@ @*/ and /*MC M*/): whatever stands on one side only is printed.

    python3 manual_pages.py TOP

Asked for: the first string of a call PetscOptions*(), and IP_REAL(NAME, member, default, ...) for -tao_ipfilter_NAME, whose default the page must give.
On a page: the items below "Options Database Key(s)". PETSc asks for the options of the inner solvers, which are known by their prefix, and for those that are not ours.
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
    """Not ours, or that of an inner solver: behind the prefix it has been given, "name_", with or without room for that of the outer one"""
    inner = ("-" + name + kind for name in re.findall(r'"(?:%s)?([a-z]\w*_)"', code) for kind in ("ksp_", "pc_", "mat_"))
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
    text = "".join(open(name).read() for name in sorted(glob.glob(os.path.join(top, folder, "**", "*.[ch]"), recursive=True)))
    code = strip_comments(text)
    options = asked(code)
    listed = [item for page in pages(text) for item in documented(page)]
    names = {option for option, _ in listed}
    findings = [option + ": on no manual page" for option in options if option not in names]
    findings += [option + ": on a manual page, but nothing asks for it" for option in names - set(options) if not asked_by_petsc(option, code)]
    findings += [f"{option}: the page says {printed}, the source {options[option]:g}" for option, printed in listed if options.get(option) is not None and wrong_default(options[option], printed)]
    print(f"{folder}: {'no options found' if not options else 'every option is on a manual page' if not findings else ''}")
    for finding in sorted(findings):
        print("  " + finding)


for folder in ("pc_amgf", "tao_ipfilter"):
    check(sys.argv[1], folder)
