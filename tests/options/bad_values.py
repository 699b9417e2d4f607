"""Every key of every load, support, body, law and result with values that it cannot have: each ends with one sentence.
python bad_values.py [all]"""
import os
import subprocess
import sys

CONTACT = os.environ.get("CONTACT") or os.path.join(os.environ["AMGF_DIR"], "bin", "contact")
BODIES = """bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], %s}
  - top: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [1, 1, 1], young: 10, poisson: 0.3}
  - wall: {lower: [-1, 0, 0], upper: [0, 1, 1], cells: [1, 1, 1], material: rigid}
"""
HOLD = {
    "displacements": [
        "floor: {face: low.zmin, value: [0, 0, 0]}", "lid: {face: top.zmax, value: [0, 0, 0]}",
        "wall: {body: wall, value: [0, 0, 0]}"
    ],
}
LINEAR = "young: 10, poisson: 0.3, expansion: 1e-5"
# What is right: of each entry its list, and its keys with what they are
RIGHT = {
    "displacement": ("displacements", dict(face="low.xmax", value="[0, free, 0]", ramp="later")),
    "rotation": ("displacements", dict(face="low.xmax", value="[0, 0, 0]", rotation="[0, 10, 0]", center="[1, 0, 0]")),
    "point": ("displacements", dict(body="low", point="[1, 1, 1]", value="[0, free, 0]")),
    "edge": ("displacements", {"body": "low", "from": "[1, 0, 1]", "to": "[1, 1, 1]", "value": "[0, free, 0]"}),
    "plane": ("symmetry", dict(face="low.xmax", normal="[1, 1, 0]")),
    "pressure": ("pressures", dict(face="low.xmax", value="1", ramp="later")),
    "follower": ("pressures", dict(face="low.xmax", value="1", follows="true")),
    "traction": ("tractions", dict(face="low.xmax", value="[1, 0, 0]", ramp="later")),
    "force": ("forces", dict(face="low.xmax", value="[1, 0, 0]", moment="[0, 1, 0]", point="[0, 0, 0]", ramp="later")),
    "moment": ("forces", dict(face="low.xmax", moment="[0, 1, 0]")),
    "body force": ("body_forces", dict(body="low", value="[0, 0, -1]", ramp="later")),
    "springs": ("springs", dict(face="low.xmax", value="[1, 0, 2]")),
    "pad": ("springs", dict(face="low.zmax", to="top.zmin", value="[1, 0, 2]", distance="0.1")),
    "tie": ("ties", dict(mortar="low.zmax", nonmortar="top.zmin", distance="0.1")),
    "pair": ("contact", dict(mortar="low.zmax", nonmortar="top.zmin", friction="0.2", interference="0.01")),
    "temperature": ("temperatures", dict(body="low", value="10*x", ramp="later")),
    "probe": ("probes", dict(body="low", point="[0.5, 0.5, 0.5]")),
    "line": ("probes", {"body": "low", "from": "[0, 0, 0]", "to": "[1, 1, 1]", "points": "3"}),
    "table": ("ramps", dict(times="[0, 0.5, 1]", values="[0, 0.2, 1]")),
    "expression": ("ramps", dict(expression="s^2")),
    "factors": ("ramps", dict(factors="[0.5]")),
}
LAWS = {
    "linear": dict(material="linear", young="10", poisson="0.3", expansion="1e-5"),
    "neohookean": dict(material="neohookean", young="10", poisson="0.3"),
    "saint_venant": dict(material="saint_venant", young="10", poisson="0.3"),
    "mooney_rivlin": dict(material="mooney_rivlin", c10="1.5", c01="0.4", bulk="8"),
    "orthotropic": dict(material="orthotropic", first_axis="[1, 1, 0]", young="[12, 10, 8]", poisson="[0.3, 0.3, 0.25]",
                        shear="[4, 3, 3.5]", expansion="[1e-3, 2e-3, 3e-3]"),
}
NUMBERS = ["nan", "inf", "-inf", "1e999", "word", "[1, 2, 3, 4, 5, 6, 7]", '""', "{a: 1}", "0x", "1 2", "--1"]
# Of a key what else it cannot be
OTHERS = {
    "face": [
        "low.none", "none.zmin", "low", "7", '""', "[low.zmin, low.zmax]", "Low.zmin", "low.zmin.x", "wall.xmax.q"
    ],
    "body": ["none", "low.zmin", '""', "7", "[low, top]", "Low"],
    "ramp": ["none", '""', "7x"],
    "young": ["0", "-1"],
    "poisson": ["0.5", "0.6", "-1", "-2"],
    "points": ["0", "1", "-3", "2.5", "1e99"],
    "distance": ["-1"],
    "normal": ["[0, 0, 0]"],
    "first_axis": ["[0, 0, 0]"],
    "shear": ["[4, 3, 0]", "[4, -3, 3.5]"],
    "material": ["rubber", "7", '""'],
    "follows": ["maybe", "2", '""', "[true, true]"],
    "expression": ["s^", "s(2)", "q", "1/(s-1)", "(s", '""', "sqrt(-1)"],
    "times": ["[0, 1, 0.5]", "[0, 1]", "[0, 0, 1]", "[0, nan, 1]"],
    "values": ["[0, 1]", "[0, nan, 1]", "[]"],
    "factors": ["[1, 2]", "[nan]", "[word]", "[]"],
    "friction": ["-0.1"],
    "bulk": ["0", "-1"],
    "c10": ["-100"],
    "value": ["[1, 2]", "[nan, 0, 0]", "[word, 0, 0]"],
    "moment": ["[1, 2]", "[nan, 0, 0]"],
    "rotation": ["[1, 2]", "[nan, 0, 0]"],
}
OTHERS["mortar"] = OTHERS["nonmortar"] = OTHERS["to"] = OTHERS["face"]
WORDS = {"face", "body", "ramp", "mortar", "nonmortar", "material", "follows", "expression"}


def text(keys):
    return ", ".join("%s: %s" % item for item in keys.items())


def scene(law, lists):
    lists = {**HOLD, **lists}
    lists.setdefault("ramps", []).append("later: {factors: [0.5]}")
    return "problem: bad\n" + BODIES % law + "".join("%s:\n%s" % (name, "".join("  - %s\n" % entry
                                                                                for entry in entries))
                                                     for name, entries in lists.items())


def with_entry(section, keys):
    return scene("material: neohookean, young: 10, poisson: 0.3" if "follows" in keys else LINEAR,
                 {section: HOLD.get(section, []) + ["one: {%s}" % text(keys)]})


def changes(keys):
    """One key at a time: a value that it cannot have, another name of it, and without it"""
    for key in keys:
        others = OTHERS["face"][:6] if key == "to" and keys[key].startswith(
            "top") else [] if key == "to" else OTHERS.get(key, [])
        # A temperature is an expression of the place, which may have two signs, and is judged where it is evaluated
        for value in others + [
                number for number in (NUMBERS if key not in WORDS else [])
                if not (number in ("1e999", "--1") and keys[key] == "10*x")
        ]:
            yield "%s: %s" % (key, value), {**keys, key: value}
        yield "%s misspelt" % key, {(key + "x" if name == key else name): value for name, value in keys.items()}


def cases():
    for what, (section, keys) in RIGHT.items():
        yield what, True, with_entry(section, keys)
        for change, wrong in changes(keys):
            yield "%s, %s" % (what, change), False, with_entry(section, wrong)
    for what, keys in LAWS.items():
        yield what, True, scene(text(keys), {})
        for change, wrong in changes(keys):
            yield "%s, %s" % (what, change), False, scene(text(wrong), {})


def judge(right, contents):
    """What is wrong with how it ends; None: nothing"""
    with open("bad.yaml", "w") as file:
        file.write(contents)
    end = subprocess.run([CONTACT, "bad.yaml", "-scene_check"], capture_output=True, text=True, timeout=600)
    said = end.stderr.strip().split("\n")
    if right:
        return None if end.returncode == 0 else "refused: %s" % said
    if end.returncode == 0:
        return "taken"
    return None if end.returncode == 1 and len(said) == 1 and said[0].startswith(
        "contact: error: ") else "exit code %d, %s" % (end.returncode, said)


n, bad, begun = 0, 0, len(sys.argv) < 3
for number, (what, right, contents) in enumerate(cases()):
    begun = begun or what == sys.argv[2]
    if not begun or (len(sys.argv) < 2 and not right and number % 23):
        continue
    wrong = judge(right, contents)
    n += 1
    if wrong:
        bad += 1
        print("%s - %s" % (what, wrong))
print("each bad value ends with one sentence: %s" % ("no" if bad else "yes"))
if len(sys.argv) > 1:
    print(n, "scenes")
