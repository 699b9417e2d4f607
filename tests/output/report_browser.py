"""Checks the document that a browser made of the page of a run: python3 report_browser.py NAME BYTES."""
import html
import json
import re
import sys

name, size = sys.argv[1], int(sys.argv[2])
with open(name + ".json", encoding="utf-8") as file:
    run = json.load(file)
with open(name + ".dom", encoding="utf-8") as file:
    document = file.read()
with open(name + ".moved.dom", encoding="utf-8") as file:
    moved = file.read()


def figures(quantity):
    return [figure for figure in run["figures"] if figure["quantity"] == quantity]


def answer(key):
    found = re.findall(rf'<dd id="answer-{key}">(.*?)</dd>', document, flags=re.S)
    if len(found) != 1:
        print(f"{name}: {len(found)} elements with the id answer-{key}")
    return html.unescape(re.sub("<[^>]*>", "", "".join(found)))


def expect(key, *words):
    text = answer(key)
    for word in words:
        if word not in text:
            print(f"{name}: answer-{key} is '{text}', without '{word}'")


stress = max(figures("von Mises stress"), key=lambda figure: figure["value"])
expect("stress", f"{stress['value']:.5g}", stress["unit"])
expect("place", stress["name"], *(f"{part:.5g}" for part in stress["place"] if abs(part) > 1e-9))
safety = min((figure["value"] for figure in figures("safety against yield")), default=None)
strain = max((figure["value"] for figure in figures("eq. plastic strain")), default=0)
expect("yield", "Yes" if strain else "Not known" if safety is None else "No:" if safety > 1 else "It would")
tools = [figure for figure in figures("reaction") if figure["name"].endswith(".*")] or figures("reaction")
expect("force", f"{max(figure['value'] for figure in tools):.5g}" if tools else "none")
expect("force", *(f"{figure['value']:.5g} {figure['unit']}" for figure in figures("torque") + figures("bolt force")))
expect("area", *(f"{figure['value']:.5g}" for figure in figures("contact area")))
error = figures("stress error, estimate")[0]["value"]
expect("accuracy", f"{error:.{0 if error >= 10 else 1}f} %")
shown = re.findall(r'<figure class="steps">.*?</figure>', moved, flags=re.S)
if (len(run["steps"]) > 1) != bool(shown):
    print(f"{name}: {len(shown)} rows of pictures of {len(run['steps'])} load steps")
for box in shown:
    images = re.findall(r"<img[^>]*>", box)
    if ['class="shown"' in image for image in images] != [True] + [False] * (len(images) - 1):
        print(f"{name}: the slider does not show the first picture")
finite = run["finite_strain"]
if f">Displacement{' to scale' * finite}, load step" not in document:
    print(f"{name}: the displacement{' of finite strain is not' * finite} drawn to scale")
turned = re.findall(r'data-turned="([^"]*)"', moved)
if turned != ["true,false"]:
    print(f"{name}: the bodies that can be turned: {turned}")
if size > 5e6:
    print(f"{name}: the page has {size} bytes")
