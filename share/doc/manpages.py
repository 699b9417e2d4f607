"""Manual pages for man(1), made of those in the sources and of the help text of contact: python3 manpages.py TOP FOLDER
VERSION"""
import glob
import os
import re
import sys

TOP, FOLDER, VERSION = sys.argv[1:]
LIBRARY = "library"  # functions of the mechanics library: their names are too common for section 3 of a system


def escape(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r"`([^`]*)`", r"\\fB\1\\fR", text)
    return "\\&" + text if text[:1] in (".", "'") else text


def page(name, section, description, body, below=""):
    folder = os.path.join(FOLDER, below, f"man{section}")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, f"{name}.{section}"), "w") as file:
        file.write(f'.TH {name} {section} "" "petscamgf {VERSION}"\n.SH NAME\n{name} \\- {escape(description)}\n{body}')


def items(lines):
    """Lists "+ name - text", "." and "-" alike, and paragraphs"""
    for line in lines:
        item = re.match(r"\s*[+.-]\s+(\S.*?)\s+-(?:\s+(.*))?$", line)
        if item:
            yield ".TP\n\\fB" + escape(item[1]) + "\\fR"
            yield escape(item[2] or "")
        elif re.match(r"\s*[+.-]?\s*\* - ", line):
            yield ".IP \\(bu 2\n" + escape(re.sub(r"^\s*[+.-]?\s*\* - ", "", line))
        elif line.strip():
            yield escape(line.strip())
        else:
            yield ".PP"


def header(name):
    """The installed header that declares a function"""
    for path in sorted(glob.glob(os.path.join(TOP, "include", "*.h"))):
        with open(path) as file:
            if re.search(rf"\b{name}\(", file.read()):
                base = os.path.basename(path)
                return base if base.startswith("petsc") else "contact/" + base
    return "petscamgf.h"


def from_source(comment, synopsis):
    lines = comment.strip("\n").split("\n")
    name, description = (part.strip() for part in lines[0].split(" - ", 1))
    name = name.split()[0]  # of a type: PCAMGF = "amgf"
    body = [f".SH SYNOPSIS\n.nf\n#include <{header(name)}>\n" + escape(synopsis) + "\n.fi"] if synopsis else []
    body.append(".SH DESCRIPTION")
    for line in lines[1:]:
        heading = re.match(r"\s*([A-Z][A-Za-z ]*):$", line)
        seealso = re.match(r"\s*\.seealso:\s*(.*)", line)
        if heading:
            body.append(".SH " + heading[1].upper())
        elif seealso:
            body += [".SH SEE ALSO", escape(seealso[1])]
        else:
            body += items([line])
    page(name, 3, description, "\n".join(body) + "\n", "" if header(name) == "petscamgf.h" else LIBRARY)


sources = [
    path for folder in ("pc_amgf", "src", "tao_ipfilter")
    for path in glob.glob(os.path.join(TOP, folder, "**", "*.c"), recursive=True)
]
for path in sorted(sources + [os.path.join(TOP, "include", "petscamgf.h")]):
    with open(path) as file:
        text = file.read()
    for match in re.finditer(r"/\*(@C?|MC|E)\n(.*?)\n(?:@|M|E)\*/\n(.*?)\n(?:\{|$)", text, flags=re.S):
        from_source(match[2], match[3] if match[1].startswith("@") else "")

with open(os.path.join(TOP, "apps", "help.c")) as file:
    help_text = re.search(r'AppHelp\[\] = "(.*?)\\n\\n";', file.read(),
                          flags=re.S)[1].replace("\\n\\\n", "\n").replace('\\"', '"')
help_text = re.sub(r"\n {5,}(?=\S)", " ", help_text)  # what goes on in a line of its own
summary, rest = help_text.split("\n", 1)
options, codes = rest.split("Exit code\n")
body = [(".SH SYNOPSIS\n.B contact\nSCENE.yaml [options]\n.br\nmpiexec \\-n N\n.B contact\nSCENE.yaml [options]\n"
         ".SH DESCRIPTION\n"
         "The scene is a YAML file. The folder share/amgf/scenes has examples; its README.md lists all keys.\n"
         ".SH OPTIONS")]
for line in options.splitlines():
    if not line.startswith(" "):
        body.append(".SS " + escape(line))
        continue
    name, text = re.match(r"\s+(\S.*?)\s{2,}(.*)", line).groups()
    body += [".TP\n\\fB" + escape(name) + "\\fR", escape(text)]
body.append(".PP\nAll options of PETSc, PCAMGF(3) and TAOIPFILTER(3) are accepted, too.\n.SH EXIT STATUS")
for line in codes.splitlines():
    code, text = line.split(None, 1)
    body += [f".TP\n\\fB{code}\\fR", escape(text)]
body.append(".SH SEE ALSO\nPCAMGF(3), TAOIPFILTER(3)")
page("contact", 1, summary.split(":")[0].rstrip("."), "\n".join(body) + "\n")
