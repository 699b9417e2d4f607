"""Holds the sources below AMGF_DIR, and their objects in AMGF_DIR/build, to the rules of the tree's structure."""
import collections
import glob
import os
import re
import shutil
import subprocess

TOP = os.environ["AMGF_DIR"]
FOLDERS = ("pc_amgf", "pc_amgf/*", "tao_ipfilter", "tao_ipfilter/*", "src/*", "src/*/*", "apps")
COLUMNS = 120  # of a line of code
FORMATTED_BY = "14."  # another release of clang-format breaks lines elsewhere
FILES = 20  # of a folder, C sources
# The lowest first: a file calls files of its own folder and of those before it, and includes their headers alone
LAYERS = """
pc_amgf pc_amgf/blockamg
tao_ipfilter/solver tao_ipfilter/problem tao_ipfilter/residuals tao_ipfilter/system tao_ipfilter/linear
tao_ipfilter/iteration tao_ipfilter/driver
tao_ipfilter/subspace tao_ipfilter/friction tao_ipfilter
src/plugin
src/error src/options src/files src/material src/model src/report
src/mesh/shapes src/mesh/query src/mesh/gmsh src/mesh/refine src/mesh src/mesh/supports
src/scene/format src/scene/sections src/scene
src/elasticity/elements src/elasticity/faces src/elasticity/recovery src/elasticity
src/contact/geometry src/contact/surface src/contact/search src/contact/self src/contact/detect src/contact/smooth
src/contact/assembly src/contact/gaps src/contact
src/loads src/constraints src/dynamics src/state src/measure src/step/problem src/step/contact_update src/step src/run
src/output src/checkpoint
apps
""".split()
# Public headers, by the lowest folder that defines what they declare
PUBLIC = {
    "rankerror.h": "src/error", "options.h": "src/options", "material.h": "src/material", "formulation.h": "src/model",
    "model.h": "src/model", "report.h": "src/report", "mesh.h": "src/mesh/shapes", "scene.h": "src/scene",
    "elasticity.h": "src/elasticity/elements", "contact.h": "src/contact/geometry", "step.h": "src/state",
    "accuracy.h": "src/run", "output.h": "src/output", "checkpoint.h": "src/state"
}

DEFINITION = re.compile(r"^(?!typedef|struct|enum|union)(?P<static>static )?[\w *]*?\b(?P<name>\w+)\([^;{}]*\)\n\{\n",
                        re.M)
DECLARATION = re.compile(r"^(?:PETSC_INTERN|PETSC_EXTERN)\s[^;{}=]*?\b(\w+)\(", re.M)
SECTION = re.compile(r"^/\*\s+(\w+\.c(?:, \w+\.c)*)\b", re.M)  # a comment that begins with one file's name, or several
# Functions of the C library that apps/heap.c wraps
ALLOCATOR = {"malloc", "calloc", "realloc", "free", "memalign", "aligned_alloc", "posix_memalign"}


def sources(kind):
    """Paths below the top"""
    return sorted(
        os.path.relpath(path, TOP) for folder in FOLDERS for path in glob.glob(os.path.join(TOP, folder, "*." + kind)))


def text(path):
    with open(os.path.join(TOP, path)) as file:
        return file.read()


def functions(path):
    """(name, whether it is static)"""
    for match in DEFINITION.finditer(text(path)):
        yield match["name"], bool(match["static"])


def symbols():
    """source file: what its object defines, and what it takes from others"""
    paths = sources("c")
    objects = {os.path.join(TOP, "build", path[:-1] + "o"): path for path in paths}
    defined, taken = {path: set() for path in paths}, {path: set() for path in paths}
    for line in subprocess.run(["nm", "-A", *objects], capture_output=True, text=True, check=True).stdout.splitlines():
        place, row = line.split(":", 1)
        kind, name = row.split()[-2:]
        if kind == "U":
            taken[objects[place]].add(name)
        elif kind in "TDBRCi":
            defined[objects[place]].add(name)
    return defined, taken


def calls(defined, taken):
    """file: the files that it takes something from, and what"""
    home = {name: path for path, names in defined.items() for name in names - ALLOCATOR}
    graph = {path: collections.defaultdict(set) for path in defined}
    for path, names in taken.items():
        for name in names:
            if name in home:
                graph[path][home[name]].add(name)
    return graph


def reachable(graph, start):
    seen, stack = set(), [start]
    while stack:
        for path in graph[stack.pop()]:
            if path not in seen:
                seen.add(path)
                stack.append(path)
    return seen


def circles(graph):
    """Groups of files each of which reaches all others, and the calls that make them so"""
    reach = {path: reachable(graph, path) for path in graph}
    groups = {
        tuple(sorted(other
                     for other in graph
                     if other == path or other in reach[path] and path in reach[other]))
        for path in graph
    }
    for group in sorted(group for group in groups if len(group) > 1):
        yield ", ".join(group)
        for a in group:
            yield from (f"  {a} -> {b}: {', '.join(sorted(graph[a][b]))}" for b in group if b in graph[a])


def calls_upwards(graph):
    """Calls from a folder to one above it, and files in no layer"""
    layer = {path: LAYERS.index(os.path.dirname(path)) for path in graph if os.path.dirname(path) in LAYERS}
    yield from (f"{path} is in no layer" for path in sorted(graph) if path not in layer)
    for path in sorted(layer):
        yield from (f"{path} -> {other}: {', '.join(sorted(names))}" for other, names in graph[path].items()
                    if layer.get(other, -1) > layer[path])


def includes_upwards():
    """A file includes its own folder's header and those of folders before it, by their path from the top, and public
    headers of these"""
    for path in sources("c") + sources("h"):
        folder = os.path.dirname(path)
        if folder not in LAYERS:
            continue
        for mark, name in re.findall(r'#\s*include ([<"])([^>"]+)', text(path)):
            home = PUBLIC.get(name) if mark == "<" else os.path.dirname(name) or folder
            if home and (home not in LAYERS or LAYERS.index(home) > LAYERS.index(folder)):
                yield f"{path} includes {name}"


def crowded_folders():
    count = collections.Counter(os.path.dirname(path) for path in sources("c"))
    yield from (f"{folder} has {n} source files, more than {FILES}" for folder, n in sorted(count.items()) if n > FILES)


def readmes():
    """Every folder has a README.md of a screen that names its files"""
    for folder in sorted({os.path.dirname(path) for path in sources("c") + sources("h")}):
        if not os.path.exists(os.path.join(TOP, folder, "README.md")):
            yield f"{folder} has no README.md"
            continue
        page = text(folder + "/README.md")
        lines = len(page.splitlines())
        if not 8 <= lines <= 40:
            yield f"{folder}/README.md has {lines} lines, not 8 to 40"
        named = set(re.findall(r"`(\w+\.c)`", page))
        own = {os.path.basename(path) for path in sources("c") if os.path.dirname(path) == folder}
        yield from (f"{folder}/README.md does not name {name}" for name in sorted(own - named))
        yield from (f"{folder}/README.md names {name}, which is not there" for name in sorted(named - own))


def written():
    """Paths of all sources and headers, public ones too"""
    return sources("c") + sources("h") + sorted(
        os.path.relpath(path, TOP) for path in glob.glob(os.path.join(TOP, "include", "*.h")))


def scripts():
    """Paths of all Python, shell and make files"""
    for folder, subfolders, names in os.walk(TOP):
        subfolders[:] = sorted(name for name in subfolders if not name.startswith(".") and name != "build")
        yield from (os.path.relpath(os.path.join(folder, name), TOP)
                    for name in sorted(names)
                    if name == "makefile" or name.endswith((".py", ".sh", ".mk", ".sh.in")))


def wide_lines():
    """The arguments of a test cannot be broken: PETSc's harness reads them from one line"""
    tests = [os.path.relpath(path, TOP) for path in sorted(glob.glob(os.path.join(TOP, "tests", "*", "*.[ch]")))]
    for path in written() + tests + list(scripts()):
        for number, line in enumerate(text(path).splitlines(), 1):
            if len(line) > COLUMNS and not line.lstrip().startswith("args:"):
                yield f"{path}:{number}: {len(line)} columns, more than {COLUMNS}"


def unformatted():
    """Files that `make format` would change; none where there is no clang-format of the release that the style is
    for"""
    tool = shutil.which("clang-format")
    if not tool or f"version {FORMATTED_BY}" not in subprocess.run([tool, "--version"], capture_output=True,
                                                                   text=True).stdout:
        return
    paths = [os.path.join(TOP, path) for path in written()]
    found = subprocess.run([tool, "--dry-run", *paths], capture_output=True, text=True, cwd=TOP).stderr
    yield from sorted({
        os.path.relpath(line.split(":")[0], TOP)
        for line in found.splitlines()
        if "-Wclang-format-violations" in line
    })


def repeated_statics():
    found = collections.defaultdict(list)
    for path in sources("c"):
        for name, static in functions(path):
            if static:
                found[name].append(path)
    for name, files in sorted(found.items()):
        if len(files) > 1:
            yield f"static {name}() stands in {', '.join(files)}"


def private_headers():
    """A folder's is called after the folder, one file's after the file; what only adapts PETSc declares nothing"""
    for path in sources("h"):
        folder, name = os.path.split(path)
        own = re.sub("^(pc|tao)_", "", os.path.basename(folder)) + "impl.h"
        if name != own and DECLARATION.search(text(path)) and not os.path.exists(os.path.join(TOP, path[:-1] + "c")):
            yield f"{path} should be {own}, or called after the file whose functions it declares"


def misplaced_declarations(defined):
    """Under the name of a file stands what that file defines"""
    for path in sources("h"):
        folder, content = os.path.dirname(path), text(path)
        sections = [(match.start(), match[1]) for match in SECTION.finditer(content)]
        for match in DECLARATION.finditer(content):
            above = [names for start, names in sections if start < match.start()]
            names = above[-1].split(", ") if above else []
            homes = [
                where for where in defined
                if os.path.basename(where) in names and where.split("/")[0] == folder.split("/")[0]
            ]
            if homes and not any(match[1] in defined.get(home, ()) for home in homes):
                real = [where for where, names in defined.items() if match[1] in names]
                yield f"{path}: {match[1]} stands under {above[-1]}, is defined in {', '.join(real) or 'no file'}"


def main():
    defined, taken = symbols()
    graph = calls(defined, taken)
    rules = {
        "no files call each other in a circle": circles(graph),
        "no folder calls one above it": calls_upwards(graph),
        "no folder includes a header of one above it": includes_upwards(),
        f"no folder has more than {FILES} source files": crowded_folders(),
        "every folder has a README that names its files": readmes(),
        f"no line is wider than {COLUMNS} columns": wide_lines(),
        "the sources are as `make format` writes them": unformatted(),
        "no two static functions have one name": repeated_statics(),
        "private headers are called after their folder or file": private_headers(),
        "functions are declared under the file that defines them": misplaced_declarations(defined),
    }
    for rule, violations in rules.items():
        lines = list(violations)
        print(f"{rule}: {'NO' if lines else 'sound'}", *lines, sep="\n  ")


main()
