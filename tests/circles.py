"""Files of a folder that call each other in a circle, found in the symbols of their objects (nm); data counts as a call.

    python3 circles.py TOP FOLDER...      with the objects in TOP/build/FOLDER
"""
import glob
import os
import subprocess
import sys


def symbols(name):
    """What an object defines for others, and what it wants of them"""
    defined, wanted = set(), set()
    for line in subprocess.run(["nm", "-g", name], capture_output=True, text=True, check=True).stdout.splitlines():
        kind, symbol = line.split()[-2:]
        (wanted if kind == "U" else defined).add(symbol)
    return defined, wanted


def calls(top, folder):
    """file -> {file it calls: symbols}"""
    stems = sorted(os.path.splitext(os.path.basename(name))[0] for name in glob.glob(os.path.join(top, folder, "*.c")))
    objects = {stem: symbols(os.path.join(top, "build", folder, stem + ".o")) for stem in stems}
    graph = {a: {b: objects[a][1] & objects[b][0] for b in stems if b != a} for a in stems}
    return {a: {b: shared for b, shared in edges.items() if shared} for a, edges in graph.items()}


def reached(graph, start):
    found, todo = set(), list(graph[start])
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += graph[name]
    return found


def report(top, folder):
    graph = calls(top, folder)
    reach = {a: reached(graph, a) for a in graph}
    circle = sorted(a for a in graph if a in reach[a])
    print(f"{folder}: {'no sources' if not graph else 'calls go one way' if not circle else 'calls go in circles'}")
    for a in circle:
        for b in sorted(graph[a]):
            if a in reach[b]:
                print(f"  {a} -> {b}: {' '.join(sorted(graph[a][b]))}")


for folder in sys.argv[2:]:
    report(sys.argv[1], folder)
