"""Damages scenes, meshes, checkpoints and option values at random, and runs each: python scene_mutations.py NUMBER
[SEED [FIRST]].

A run must end with a documented exit code and, where it is not 0, with one sentence for each cause; with 0 all numbers
of its summary must be finite.
What it refuses leaves the results of an earlier run as they are. Scenes: those of small_scenes.sh, in the present
folder."""
import copy
import glob
import hashlib
import json
import math
import os
import random
import resource
import shutil
import subprocess
import sys

import h5py
import numpy as np
import yaml

TOP = os.environ["AMGF_DIR"]
CONTACT = os.environ.get("CONTACT") or os.path.join(TOP, "bin", "contact")
MEMORY, SECONDS = 6 << 30, 240
VALUES = [
    "nan", "inf", "-inf", "1e308", "-1e308", "1e-308", "0", "-1", "1", "2.5", "1e6", "-1e-6", "99999999999", "word",
    "true", "", "~", "[]", "{}", "[nan]", "[0, 0, 0]", "[1, 2]", "[1, 2, 3, 4]", "{a: 1}", "free", "x", "1/0",
    "sqrt(-1)", "cube.zmin", "a b", "%s%n", "0x10", "1e", "2nd", "é"
]
OPTIONS = [
    "refine", "load_steps", "contact_updates", "contact_update_tol", "contact_gap_tol", "contact_gap", "accuracy",
    "accuracy_max_dofs", "accuracy_share", "load_max_cuts", "checkpoint_every", "tao_ipfilter_tol",
    "tao_max_it", "tao_ipfilter_mu_init", "elasticity_quadrature", "tao_ipfilter_scaling", "tao_type",
    "load_warm_start", "tao_ipfilter_subspace", "accuracy_of", "elasticity_ksp_rtol", "tao_ipfilter_pc_amgf_cycle",
    "tao_ipfilter_pc_amgf_factor", "restart", "summary"
]
OPTION_VALUES = [
    "nan", "inf", "-1", "0", "1", "3", "1e308", "1e-308", "abc", "99999999999999999999", "", "1,2", "true", "0.5",
    "-0.5", "1e-3", "2.5", "%s%n", "."
]


class Pair:

    def __init__(self, key, value):
        self.key, self.value = key, value


class Mapping(list):
    """Pairs, whose keys may occur twice"""


def flow(node):
    """A node as YAML in one line"""
    if isinstance(node, Pair):
        return "%s: %s" % (node.key, flow(node.value))
    text = ", ".join(map(flow, node)) if isinstance(node, list) else node
    return "{%s}" % text if isinstance(node, Mapping) else "[%s]" % text if isinstance(node, list) else text


def read(node):
    if isinstance(node, dict):
        return Mapping(Pair(key, read(value)) for key, value in node.items())
    return [read(entry) for entry in node] if isinstance(node, list) else str(node) or '""'


def places(node):
    """Every list or mapping that has an entry, with the entry's index"""
    for i, entry in enumerate(node if isinstance(node, list) else []):
        yield node, i
        yield from places(entry.value if isinstance(entry, Pair) else entry)


def change(scene, draw):
    """Changes one place of a scene. Returns what it did"""
    entries, i = draw.choice(list(places(scene)))
    entry, what = entries[i], draw.randrange(8)
    name = entry.key if isinstance(entry, Pair) else flow(entry)[:40]
    if what == 0:
        del entries[i]
        return "without " + name
    if what == 1:
        entries.insert(draw.randrange(len(entries) + 1), copy.deepcopy(entry))
        return "twice " + name
    if what == 2 and isinstance(entry, Pair) and name:
        at = draw.randrange(len(name))
        entry.key = name[:at] + draw.choice("xX_-9é ") + name[at + draw.randrange(2):]
        return "%s named %s" % (name, entry.key)
    value = draw.choice(VALUES)
    if what == 3:
        others, k = draw.choice(list(places(scene)))
        other = copy.deepcopy(others[k])
        value = other.value if isinstance(other, Pair) else other
    if isinstance(entry, Pair):
        entry.value = value
    else:
        entries[i] = value
    return "%s: %s" % (name, flow(value)[:40])


def spoil_text(text, draw):
    """A line of a text gone, twice, cut, or with another number"""
    lines = text.split("\n")
    i, what = draw.randrange(len(lines)), draw.randrange(5)
    words = lines[i].split() or [""]
    if what == 0:
        del lines[i]
    elif what == 1:
        lines.insert(draw.randrange(len(lines)), lines[i])
    elif what == 2:
        return "\n".join(lines[:i]) + "\n", "cut in line %d" % (i + 1)
    else:
        words[draw.randrange(len(words))] = draw.choice(
            ["nan", "-1", "0", "1e308", "99999999999", "word", "", "1e-30", "2.5", "\x00", "7"])
        lines[i] = " ".join(words)
    return "\n".join(lines), "line %d, change %d" % (i + 1, what)


def spoil_checkpoint(name, draw):
    """Bytes, or a number, a size or a name of a checkpoint, changed"""
    if draw.random() < 0.4:
        with open(name, "rb") as file:
            data = bytearray(file.read())
        if draw.random() < 0.3:
            data = data[:draw.randrange(len(data))]
        for _ in range(draw.randrange(1, 20)):
            if data:
                data[draw.randrange(len(data))] = draw.randrange(256)
        with open(name, "wb") as file:
            file.write(data)
        return "bytes"
    with h5py.File(name, "r+") as file:
        value = draw.choice([math.nan, math.inf, -1, 0, 1e308, 99999999, 1e-300])
        key = draw.choice(list(file.attrs) + list(file))
        what = draw.choice(["number", "gone", "size"])
        old = file.attrs[key] if key in file.attrs else file[key][...]
        numbers = np.issubdtype(np.asarray(old).dtype, np.number)
        new = np.array(old)
        if what == "size":
            new = new[:len(new) // 2] if new.ndim and len(new) else np.array([value] * 3)
        elif what == "number" and numbers and new.size:
            with np.errstate(all="ignore"):
                new.flat[draw.randrange(new.size)] = value if np.issubdtype(
                    new.dtype, np.floating) or math.isfinite(value) and abs(value) < 2**31 else -7
        where = file.attrs if key in file.attrs else file
        del where[key]
        if what != "gone":
            where[key] = new
        return "%s of %s" % (what, key)


def finite(node):
    if isinstance(node, dict):
        return all(map(finite, node.values()))
    return all(map(finite, node)) if isinstance(node, list) else not isinstance(node, float) or math.isfinite(node)


def sums(names):
    return {name: hashlib.md5(open(name, "rb").read()).hexdigest() for name in names}


def judge(end, before):
    """What is wrong with how a run ended; None: nothing"""
    said = [line for line in end.stderr.split("\n") if line.strip()]
    ours = [line for line in said if line.startswith("contact: ")]
    errors = [line for line in ours if not line.startswith("contact: warning: ")]
    strange = [
        line for line in said if line not in ours and "HDF5" not in line and not line.startswith(
            ("-----", "MPI_ABORT", "with errorcode", "NOTE:", "You may", "exactly when", "[vm", "mpiexec", "the job",
             "Primary", "a non-zero", "  Process", "  Exit"))
    ]
    if end.returncode not in range(7):
        return "exit code %d" % end.returncode
    if end.returncode and not errors:
        return "exit code %d without a sentence" % end.returncode
    if end.returncode == 1 and (len(errors) != 1 or not errors[0].startswith("contact: error: ")):
        return "%d sentences" % len(errors)
    if end.returncode == 1 and before and sums(before) != before:
        return "refused, and changes %s" % [name for name in before if sums([name]) != {name: before[name]}]
    if strange:
        return "says %s" % strange[:3]
    if end.returncode == 0 and os.path.exists("new.json"):
        with open("new.json") as file:
            text = file.read()
        if not finite(json.loads(text)):
            return "numbers that are not finite"
    return None


def run(command, ranks):
    if ranks > 1:
        command = ["mpiexec", "--oversubscribe", "-n", str(ranks)] + command
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    try:
        return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=SECONDS,
                              preexec_fn=limit if ranks == 1 else None)
    except subprocess.TimeoutExpired:
        return None


def attempt(number, seed, scenes):
    draw = random.Random("%s %d" % (seed, number))
    options, kind, what, name = [], draw.choice(["scene"] * 5 +
                                                ["option", "option", "mesh", "checkpoint"]), "", draw.choice(
                                                    sorted(scenes))
    ranks = 3 if draw.random() < 0.15 else 1
    if kind == "mesh":
        name = "gmsh_blocks"
    if kind == "checkpoint":
        name = "further"
        shutil.copy("rubber.h5", "bad.h5")
        what = spoil_checkpoint("bad.h5", draw)
        options = ["-restart", "bad.h5"]
    scene = read(yaml.load(scenes[name], yaml.BaseLoader))
    if kind == "scene":
        what = "; ".join(change(scene, draw) for _ in range(draw.choice([1, 1, 2])))
    text = "".join(flow(entry) + "\n" for entry in scene)
    if kind == "scene" and draw.random() < 0.08:
        text, more = spoil_text(text, draw)
        what += "; " + more
    if kind == "mesh":
        with open(os.path.join(TOP, "share", "gmsh", "two_blocks.msh")) as file:
            mesh, what = spoil_text(file.read(), draw)
        with open("two_blocks.msh", "w") as file:
            file.write(mesh)
        text = text.replace("../gmsh/", "")
    if kind == "option":
        what = "%s %s" % (draw.choice(OPTIONS), draw.choice(OPTION_VALUES))
        options = ["-" + what.split(" ")[0], what.split(" ", 1)[1]]
    with open("bad.yaml", "w", errors="replace") as file:
        file.write(text)
    before = sums(glob.glob("earlier*"))
    for file in glob.glob("new*"):
        os.remove(file)
    command = [CONTACT, "bad.yaml", "-quiet", *options]
    if draw.random() < 0.3:
        command += ["-output", "earlier", "-summary", "earlier.json"]
    elif options[:1] != ["-summary"]:
        command += ["-summary", "new.json"]
    end = run(command, ranks)
    wrong = "not done in %d s" % SECONDS if end is None else judge(end, before)
    if wrong:
        os.makedirs("found", exist_ok=True)
        for file in ["bad.yaml"] + {"checkpoint": ["bad.h5"], "mesh": ["two_blocks.msh"]}.get(kind, []):
            shutil.copy(file, "found/%d_%s" % (number, file))
        print(
            "%d: %s, %s, %s, ranks %d: %s\n  %s\n  %s" %
            (number, kind, name, what, ranks, wrong, " ".join(command[2:]), end.stderr.strip()[:600] if end else ""),
            flush=True)
    return kind, end.returncode if end else "limit", bool(wrong)


def main():
    scenes = {os.path.basename(name)[:-5]: open(name).read() for name in glob.glob("*.yaml") if name != "bad.yaml"}
    scenes["gmsh_blocks"] = open(os.path.join(TOP, "share", "scenes", "gmsh_blocks.yaml")).read().replace(
        "../gmsh/",
        os.path.join(TOP, "share", "gmsh") + "/")
    subprocess.run([CONTACT, "linear.yaml", "-quiet", "-output", "earlier", "-summary", "earlier.json"], check=True)
    subprocess.run([CONTACT, "rubber.yaml", "-quiet", "-checkpoint", "rubber.h5", "-checkpoint_every", "1"], check=True)
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    ends = [
        attempt(number, sys.argv[2] if len(sys.argv) > 2 else "1", scenes)
        for number in range(first, first + int(sys.argv[1]))
    ]
    if os.environ.get("COUNTS"):
        print({end: sum(e[1] == end for e in ends) for end in {e[1] for e in ends}})
    print("every run ends with a documented exit code and a sentence, and leaves earlier results: %s" %
          ("NO, %d of %d" % (sum(e[2] for e in ends), len(ends)) if any(e[2] for e in ends) else "yes"))


main()
