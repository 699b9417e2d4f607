"""Checks the page of a run: self-contained, well-formed, and with the figures of the summary."""
import html.parser
import json
import re
import sys

VOID = {"meta", "img", "br", "input"}


class Page(html.parser.HTMLParser):
    """Text and images; complains about what is not closed"""

    def __init__(self, content):
        super().__init__()
        self.open, self.images, self.words, self.faults = [], 0, [], []
        self.feed(content)
        self.faults += self.open

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.images += dict(attributes)["src"].startswith("data:image/png;base64,")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)

    def handle_data(self, data):
        self.words.append(data)


name, images = sys.argv[1], int(sys.argv[2])
with open(name + ".html", encoding="utf-8") as file:
    content = file.read()
with open(name + ".json", encoding="utf-8") as file:
    run = json.load(file)
page = Page(content)
words = "\n".join(page.words)
print("tags:", "closed" if not page.faults else page.faults)
print("images:", page.images if page.images != images else "all")
print("other files:", re.findall(r"(?:src|href)=\"(?!data:)[^\"]*|@import|url\(", content) or "none")
last = run["steps"][-1]
wanted = [run["problem"], f"{run['dofs']:,} unknowns", *run["warnings"], *(step["reason"] for step in run["steps"])]
wanted += [item["name"] for key in ("pairs", "faces", "bodies") for item in last[key]]
wanted += [f"{pair['normal_force']:.5g}" for pair in last["pairs"]] + [f"{last['energy']:.5g}"]
wanted += re.findall("petsc", words, re.IGNORECASE)[:1] or ["the release of PETSc"]
moved = [figure for figure in run["figures"] if figure["quantity"] == "displacement"]
if moved:
    wanted.append(f"Displacement, load step {max(moved, key=lambda figure: figure['value'])['step']}")
ids = re.findall(r' id="([^"]*)"', content)
for figure in run["figures"]:
    name = "-".join(figure["quantity"].replace(",", "").split()) + "." * bool(figure["name"]) + figure["name"]
    wanted.append(f"{figure['value']:.5g}")
    if ids.count(name) != 1:
        print("ids of", name, ids.count(name))
print("not in the page:", [word for word in wanted if word not in words] or "nothing")
