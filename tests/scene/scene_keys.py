"""The reference of keys in share/scenes/README.md is what contact -scene_keys prints: python scene_keys.py
check|write."""
import os
import subprocess
import sys

TOP = os.environ.get("AMGF_DIR", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PAGE = os.path.join(TOP, "share", "scenes", "README.md")
BEGIN, END = "<!-- contact -scene_keys -->\n", "<!-- end of contact -scene_keys -->\n"


def main(action):
    printed = subprocess.run([os.path.join(TOP, "bin", "contact"), "-scene_keys"], capture_output=True, text=True,
                             check=True).stdout
    with open(PAGE) as file:
        before, _, rest = file.read().partition(BEGIN)
    written, _, after = rest.partition(END)
    if action == "write":
        with open(PAGE, "w") as file:
            file.write(before + BEGIN + "\n" + printed + "\n" + END + after)
    else:
        same = written.strip() == printed.strip()
        print("the page's reference of keys is what -scene_keys prints:",
              "yes" if same else "NO: python3 tests/scene/scene_keys.py write")
        for line in () if same else [line for line in printed.splitlines() if line not in written.splitlines()][:5]:
            print("  missing:", line)
        without = [line for line in printed.splitlines() if line.startswith("| `") and not line.split("|")[4].strip()]
        print("keys without a meaning:", without or "none")
        print("keys:", "more than 100" if printed.count("| `") > 100 else printed.count("| `"))


if __name__ == "__main__":
    main(sys.argv[1])
