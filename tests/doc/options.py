"""Holds the list of options that are ours, in src/options/known.c, against the sources that ask for them: what stands
on one side only is printed. Each must be set by a test, an options file, a measurement or a page."""
import glob
import os
import re

TOP = os.environ["AMGF_DIR"]
OF_PETSC = {"pc_type"}  # asked for beforehand, on behalf of an inner solver


def code(*patterns):
    paths = sorted(path for pattern in patterns for path in glob.glob(os.path.join(TOP, pattern)))
    return re.sub(r"/\*.*?\*/", "", "".join(open(path).read() for path in paths), flags=re.S)


sources = code("pc_amgf/*.c", "pc_amgf/*/*.c", "tao_ipfilter/*.c", "tao_ipfilter/*/*.c", "src/*/*.c", "src/*/*/*.c",
               "apps/*.c")
asked = set(re.findall(r'\bPetscOptions(?!HasName|Set|Clear)\w+\([^"();]*"-(\w+)"',
                       sources)) | {"tao_ipfilter_" + name
                                    for name in re.findall(r'\bIP_REAL\(\s*"(\w+)"', sources)}
calls = re.findall(r'\bPetscOptions(?:Get)?(Bool|Int|BoundedInt|String|Enum|EList|FList)\([^"();]*"-(\w+)"', sources)
rows = re.findall(r'\{"(\w+)",\s*OPTION_(\w+),\s*\{([^}]*)\}\}', code("src/options/known.c"))
listed = [name for name, _, _ in rows]
print("options: at most 70" if len(listed) <= 70 else "options: %d" % len(listed))
print("the list is sorted, without repetition:", "yes" if listed == sorted(set(listed)) else "NO")
print("asked for, but not in the list:", ", ".join(sorted(asked - OF_PETSC - set(listed))) or "none")
print("in the list, but not asked for:", ", ".join(sorted(set(listed) - asked)) or "none")
kinds = {
    "Bool": "SWITCH", "Int": "COUNT", "BoundedInt": "COUNT", "String": "WORD", "Enum": "WORD", "EList": "WORD",
    "FList": "WORD"
}
kind_asked = {name: kinds[call] for call, name in calls if name not in OF_PETSC}
kind_listed = {name: kind for name, kind, _ in rows}
print("of another kind than asked for:",
      ", ".join(sorted(name for name, kind in kind_asked.items() if kind_listed.get(name) != kind)) or "none")
print("of a kind that is not asked for:",
      ", ".join(sorted(name for name, kind in kind_listed.items() if kind != kind_asked.get(name, "NUMBER"))) or "none")
choices = {name: re.findall(r'"(\w+)"', words) for name, _, words in rows if '"' in words}
enumerated = {name for call, name in calls if call in ("Enum", "EList")}
print("enumerated, and without a list of words:", ", ".join(sorted(enumerated ^ set(choices))) or "none")
arrays = [re.findall(r'"(\w+)"', words) for words in re.findall(r"\*const +\w+\[\] *= \{(.*?)\}", sources, flags=re.S)]
print(
    "with other words than the sources have:",
    ", ".join(name for name, words in choices.items()
              if not any(words == array[:len(words)] and len(array) in (len(words), len(words) + 2)
                         for array in arrays)) or "none")
users = "".join(
    open(path, errors="replace").read()
    for folder in ("tests", "share")
    for path in glob.glob(os.path.join(TOP, folder, "**", "*.*"), recursive=True)
    if path.endswith((".c", ".sh", ".py", ".opts", ".yaml", ".md")) and not path.endswith("changelog.md")) + open(
        os.path.join(TOP, "README.md")).read()
print(
    "set by no test and no page:", ", ".join(
        name for name in listed
        if not re.search(r"(-|\b)%s\b" % name if name.startswith(("tao_", "pc_amgf_",
                                                                  "contact_")) else r"-%s\b" % name, users)) or "none")
