"""Writes the page of a run: one HTML file that needs no other. `contact -report FILE.html` calls this.

    report.py --check                                     says which module is missing; exit code 0 or 1
    report.py FILE.html BASE SUMMARY.json SCENE.yaml COMMAND VERSIONS
"""
import base64
import csv
import datetime
import html
import importlib.util
import io
import json
import os
import re
import shutil
import sys
import tempfile

MODULES = {"numpy": "numpy", "matplotlib": "matplotlib", "h5py": "h5py", "vtkmodules": "vtk9"}  # Debian: python3-...
END = {
    0: "All load steps converged.",
    2: "A load step did not converge.",
    3: "A load step ended with an inconsistent contact gap.",
    4: "The requested accuracy was not reached.",
    5: "A signal ended the run.",
    6: "Results could not be written.",
}
PHASES = {
    "setup": "set-up",
    "contact_search": "contact: search for opposite facets",
    "contact_integrals": "contact: gaps",
    "contact": "contact: everything else",
    "amg_setup": "AMG: set-up",
    "amg_apply": "AMG: applications",
    "filter_setup": "filter: set-up",
    "filter_apply": "filter: applications",
    "directions": "subspace method: new directions",
    "reduced_factor": "subspace method: factorization on the contact unknowns",
    "reduced": "subspace method: rest of the reduced problem",
    "optimizer": "optimizer: everything else",
    "measures": "forces, stresses, penetration",
    "results": "probes and fields of files",
    "comparison": "comparison without contact",
}
STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; color: #222 }
h1 { margin-bottom: 0 } h2 { border-bottom: 1px solid #ccc; margin-top: 2em }
table { border-collapse: collapse; margin: 1em 0 } th, td { padding: .15em .7em; border-bottom: 1px solid #ddd }
td { text-align: right; font-variant-numeric: tabular-nums } td:first-child, th:first-child { text-align: left }
pre { background: #f5f5f5; padding: 1em; overflow-x: auto; font-size: 13px }
img { max-width: 100% } .good { color: #176b2c } .bad { color: #a11 } figcaption { color: #555 }
dt { font-weight: bold } dd { margin: 0 0 .5em 1.5em } input[type=range] { width: 60%; vertical-align: middle }
canvas { width: 100%; border: 1px solid #ddd; touch-action: none }
.steps img { display: none } .steps img.shown { display: block }
"""
SLIDER = """
function show(slider) {
  const box = slider.closest("figure"), images = box.querySelectorAll("img");
  images.forEach((image, k) => image.classList.toggle("shown", k == slider.value));
  box.querySelector("output").textContent = images[slider.value].alt;
}
"""
# A canvas that shows triangles and lines in parallel projection: dragging turns them, the wheel changes their size
TURN = """
function turn(canvas, model) {
  const gl = canvas.getContext("webgl", {alpha: false});
  if (!gl || !gl.getExtension("OES_element_index_uint")) {
    canvas.replaceWith("This browser has no WebGL.");
    return;
  }
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer;
  const program = gl.createProgram(), sources = {
    VERTEX_SHADER: `attribute vec3 place; attribute vec4 colour; varying vec4 shown; uniform mat3 rotation;
      uniform vec3 size; void main() { gl_Position = vec4(size * (rotation * place), 1.0); shown = colour; }`,
    FRAGMENT_SHADER: "precision mediump float; varying vec4 shown; void main() { gl_FragColor = shown; }"};
  for (const [kind, text] of Object.entries(sources)) {
    const shader = gl.createShader(gl[kind]);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const buffer = (kind, text) => {
    const made = gl.createBuffer();
    gl.bindBuffer(kind, made);
    gl.bufferData(kind, bytes(text), gl.STATIC_DRAW);
    return made;
  };
  const parts = model.map(part => ({...part, places: buffer(gl.ARRAY_BUFFER, part.places),
    colours: buffer(gl.ARRAY_BUFFER, part.colours), numbers: buffer(gl.ELEMENT_ARRAY_BUFFER, part.numbers)}));
  let azimuth = -Math.PI / 3, elevation = Math.PI / 9, zoom = 0;
  function fit(rotation) { // the largest size at which all points are on the canvas
    let [across, along] = [0, 0];
    for (const part of model) {
      const places = new Float32Array(bytes(part.places));
      for (let i = 0; i < places.length; i += 3) {
        const at = row => Math.abs([0, 1, 2].reduce((sum, k) => sum + rotation[row + 3 * k] * places[i + k], 0));
        [across, along] = [Math.max(across, at(0)), Math.max(along, at(1))];
      }
    }
    return 0.95 * Math.min(canvas.width / canvas.height / across, 1 / along);
  }
  function draw() {
    const [c, s, d, t] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    // Columns; the rows are to the right, up, and away from the viewer
    const rotation = [-s, -t * c, -d * c, c, -t * s, -d * s, 0, d, -t];
    zoom = zoom || fit(rotation);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 2);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, "rotation"), false, rotation);
    gl.uniform3f(gl.getUniformLocation(program, "size"), zoom * canvas.height / canvas.width, zoom, 0.1);
    for (const part of parts) {
      for (const [name, size, kind] of [["places", 3, gl.FLOAT], ["colours", 4, gl.UNSIGNED_BYTE]]) {
        const at = gl.getAttribLocation(program, name.slice(0, -1));
        gl.bindBuffer(gl.ARRAY_BUFFER, part[name]);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, kind, kind != gl.FLOAT, 0, 0);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.numbers);
      gl.depthMask(!part.clear);
      gl.drawElements(part.lines ? gl.LINES : gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
    }
    gl.depthMask(true);
  }
  canvas.onpointerdown = event => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = event => {
    if (!event.buttons) return;
    azimuth -= event.movementX / 150;
    elevation = Math.max(-1.57, Math.min(1.57, elevation + event.movementY / 150));
    draw();
  };
  canvas.onwheel = event => {
    event.preventDefault();
    zoom *= Math.exp(-event.deltaY / 800);
    draw();
  };
  draw();
}
"""
BIGGEST = 2_500_000  # bytes of the view that can be turned
SHOWN = 12  # largest number of load steps in the pictures
SMALL = 0.2  # largest size of a contact area that is magnified, relative to the model
LISTED = 8  # largest number of values in an answer
OPEN = 60  # largest number of largest values whose table is open
ROWS = 20  # largest number of rows of the table of load steps


def check():
    """Leaves with a sentence where something is missing"""
    for module, package in MODULES.items():
        if importlib.util.find_spec(module) is None:
            sys.exit(f"Python at {sys.executable} has no module {module} (Debian: python3-{package})")
    if not shutil.which("Xvfb") and not os.environ.get("DISPLAY"):
        sys.exit("VTK needs an X server for pictures: install Xvfb (Debian: xvfb)")


def text(value):
    """A cell of a table: numbers with five digits. Components of a vector below 1e-9 of the largest one are 0"""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.5g}"
    if isinstance(value, list):
        size = max((abs(part) for part in value if isinstance(part, (int, float))), default=0)
        return ", ".join(text(0 if isinstance(part, float) and abs(part) < 1e-9 * size else part) for part in value)
    return html.escape(str(value))


def table(headings, rows):
    head = "".join(f"<th>{html.escape(heading)}</th>" for heading in headings)
    body = "".join("<tr>" + "".join(f"<td>{text(cell)}</td>" for cell in row) + "</tr>\n" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table>\n"


def image(data, caption):
    encoded = base64.b64encode(data).decode()
    alt = html.escape(caption)
    return f'<figure><img alt="{alt}" src="data:image/png;base64,{encoded}"><figcaption>{alt}</figcaption></figure>\n'


def largest(run, quantity):
    """The entry of the list of largest values that is the largest of all bodies or pairs"""
    found = [figure for figure in run["figures"] if figure["quantity"] == quantity]
    return max(found, key=lambda figure: figure["value"], default=None)


def chosen_steps(run, files):
    """Load steps for a row of pictures: the one with the largest stress, the last one, and others between them"""
    numbers = sorted(files)
    chosen = {numbers[round(k * (len(numbers) - 1) / (SHOWN - 1))] for k in range(SHOWN)}
    stress = largest(run, "von Mises stress")
    if stress and stress["step"] in files:
        return sorted(chosen | {stress["step"]}), stress["step"]
    return sorted(chosen), numbers[-1]


def draw_steps(base, field, options, steps):
    """The pictures of a field in some load steps, in memory, and which of them hide the largest value"""
    import draw

    with tempfile.TemporaryDirectory() as folder:
        names = [os.path.join(folder, f"{step}.png") for step in steps]
        hidden = draw.draw_steps(draw.arguments([base, names[0], "--field", field, *options]), steps, names)
        images = []
        for name in names:
            with open(name, "rb") as stream:
                images.append(stream.read())
    return images, hidden


def section(base, run_files, place, step):
    """Von Mises stress on a section through a place, along the plane that is deepest inside of the bodies"""
    low, high = run_files.vertices.min(axis=0), run_files.vertices.max(axis=0)
    axis = max(range(3), key=lambda k: min(place[k] - low[k], high[k] - place[k]) / max(high[k] - low[k], 1e-300))
    plane = f"{'xyz'[axis]}={place[axis]:.9g}"
    images, _ = draw_steps(base, "nodal_von_mises", ["--section", plane], [step])
    return image(images[0], f"Von Mises stress, load step {step}, cut at {plane}")


def slides(images, captions, first):
    """Pictures of which a slider shows one"""
    tags = ""
    for k, (data, caption) in enumerate(zip(images, captions)):
        encoded, shown = base64.b64encode(data).decode(), ' class="shown"' * (k == first)
        tags += f'<img{shown} alt="{html.escape(caption)}" src="data:image/png;base64,{encoded}">'
    slider = (f'<label>load steps <input type="range" min="0" max="{len(captions) - 1}" value="{first}" '
              'oninput="show(this)"></label> ')
    caption = f"<figcaption>{slider}<output>{html.escape(captions[first])}</output></figcaption>"
    return f'<figure class="steps">{tags}{caption}</figure>\n'


def small_contact(files, step):
    """Whether the contact area is much smaller than the bodies, so that the picture shows its surroundings alone"""
    closed = files.vertices[files.in_contact(step)]
    return len(closed) and max(closed.max(axis=0) - closed.min(
        axis=0)) < SMALL * max(files.vertices.max(axis=0) - files.vertices.min(axis=0))


def pictures(base, run):
    """Stress over the load steps; displacement and pressure where they are largest; plastic strain of the last one"""
    from contact.files import Files

    run_files = Files(base)
    files = run_files.files
    steps, stressed = chosen_steps(run, files)
    last, pressure, moved = max(files), largest(run, "contact pressure"), largest(run, "displacement")
    pressed, farthest = (figure["step"] if figure and figure["step"] in files else last for figure in (pressure, moved))
    zoom = ["--around-contact", "3"] if pressure and small_contact(run_files, pressed) else []
    finite = run["finite_strain"]
    moves = ("Displacement to scale", "displacement", []) if finite else ("Displacement", "displacement",
                                                                          ["--scale", "auto"])
    wanted = [("Von Mises stress", "nodal_von_mises", [], steps), (*moves, [farthest])]
    if pressure:
        wanted.append(("Contact pressure", "contact_pressure", ["--contact-only", *zoom], [pressed]))
    if largest(run, "eq. plastic strain"):
        wanted.append(("Equivalent plastic strain", "equivalent_plastic_strain", [], [last]))
    for caption, field, options, chosen in wanted:
        try:
            images, hidden = draw_steps(base, field, options, chosen)
        except SystemExit as reason:
            yield f"<p>No picture: {caption.lower()}: {html.escape(str(reason.code))}.</p>\n"
            continue
        captions = [f"{caption}, load step {step}" for step in chosen]
        yield slides(images, captions, chosen.index(stressed)) if len(images) > 1 else image(images[0], captions[0])
        if field == "nodal_von_mises":
            if hidden[chosen.index(stressed)]:
                yield section(base, run_files, largest(run, "von Mises stress")["place"], stressed)
            yield turnable(base, run, stressed)


def encoded(values):
    return base64.b64encode(values.tobytes()).decode()


def model_part(data, colours, centre, radius, lines=False, clear=False):
    """Triangles or lines of VTK's data, as turn() takes them"""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = vtk_to_numpy(data.GetPoints().GetData())
    numbers = vtk_to_numpy((data.GetLines() if lines else data.GetPolys()).GetConnectivityArray())
    return {
        "places": encoded(((points - centre) / radius).astype(np.float32)),
        "colours": encoded(np.broadcast_to(colours, (len(points), 4)).astype(np.uint8)),
        "numbers": encoded(numbers.astype(np.uint32)), "count": len(numbers), "lines": lines, "clear": clear
    }


def triangles(data):
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter

    cut = vtkTriangleFilter()
    cut.SetInputData(data)
    cut.PassVertsOff()
    cut.PassLinesOff()
    cut.Update()
    return cut.GetOutput()


def turnable(base, run, step):
    """Von Mises stress of a load step on bodies that the reader can turn"""
    import draw
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    files = draw.Files(base)
    args = draw.arguments([base, "none.png", "--field", "nodal_von_mises"])
    cells, displacement = draw.chosen_cells(args, files), files.displacement(step)
    values = draw.field_values(args, files, step)
    skin, _, _, _ = draw.coloured_bodies(args, files, cells, values, displacement, 1)
    skin = triangles(skin)
    tools = [triangles(data) for data in draw.tool_surfaces(args, files, cells, displacement, 1)]
    points = np.concatenate([vtk_to_numpy(data.GetPoints().GetData()) for data in (skin, *tools)])
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    radius = np.linalg.norm(points.max(axis=0) - points.min(axis=0)) / 2
    shown = vtk_to_numpy(skin.GetPointData().GetArray("colour"))
    place = np.clip(shown / max(np.nanmax(values), 1e-300), 0, 1)
    scale = np.array(draw.VIRIDIS)
    colours = np.stack([np.interp(place, np.linspace(0, 1, len(scale)), scale[:, k]) for k in range(3)], axis=1)
    colours[np.isnan(shown)] = draw.GREY
    colours = np.concatenate([255 * colours, np.full((len(colours), 1), 255)], axis=1)
    parts = [model_part(skin, colours, centre, radius)]
    parts.append(model_part(draw.sharp_edges(skin), [25, 25, 25, 255], centre, radius, lines=True))
    for data in tools:
        parts.append(model_part(draw.sharp_edges(data), [90, 100, 115, 255], centre, radius, lines=True))
        parts.append(model_part(data, [140, 153, 168, 110], centre, radius, clear=True))
    text_of_parts = json.dumps([part for part in parts if part["count"]])
    if len(text_of_parts) > BIGGEST:
        return ""
    caption = (f"Von Mises stress, load step {step}, to scale. Drag to turn, wheel to enlarge. Colours are those of "
               "the picture above.")
    return ('<figure><canvas id="turn" width="1060" height="600"></canvas>'
            f"<figcaption>{caption}</figcaption></figure>\n"
            f'<script>turn(document.getElementById("turn"), {text_of_parts});</script>\n')


def amount(figure):
    return f"{text(figure['value'])} {html.escape(figure['unit'])}".strip()


def when(run, figure):
    return f", load step {figure['step']}" if len(run["steps"]) > 1 else ""


def listed(run, quantity):
    """The values of the owners of a quantity, in words; of many those with the largest ones"""
    found = [figure for figure in run["figures"] if figure["quantity"] == quantity]
    shown = found if len(found) <= LISTED else sorted(found, key=lambda figure: -figure["value"])[:LISTED]
    words = [f"{html.escape(figure['name'].removesuffix('.*'))}: {amount(figure)}{when(run, figure)}"
             for figure in shown]
    return "; ".join(words) + f"; and {len(found) - len(shown)} others" * (len(found) > len(shown))


def narrow(run):
    """The pairs whose area is only one facet wide, in words"""
    steps = {step["step"]: [pair["name"] for pair in step["pairs"] if pair["narrow"]] for step in run["steps"]}
    names = [figure["name"] for figure in run["figures"]
             if figure["quantity"] == "contact area" and figure["value"] and figure["name"] in steps[figure["step"]]]
    return (f". One facet wide, so that area and pressure depend on the mesh: {html.escape(', '.join(names))}."
            if names else "")


def yields(run):
    """Whether the material yields, in words"""
    strain = largest(run, "eq. plastic strain")
    found = [figure for figure in run["figures"] if figure["quantity"] == "safety against yield"]
    if not found:
        return "Not known: no yield stress is given (key <code>yield</code> of a material)."
    known = {figure["name"] for figure in found}
    others = [figure["name"] for figure in run["figures"]
              if figure["quantity"] == "von Mises stress" and figure["name"] not in known]
    rest = f" No yield stress is given for {html.escape(', '.join(others))}." if others else ""
    if strain:
        return f"Yes: {html.escape(strain['name'])}, largest equivalent plastic strain {text(strain['value'])}.{rest}"
    safety = min(found, key=lambda figure: figure["value"])
    name = html.escape(safety["name"])
    if safety["value"] < 1:
        times = text(1 / safety["value"])
        return f"It would: the stress of {name} is {times} times its yield stress. Its law is elastic.{rest}"
    return f"No: the smallest safety factor is {text(safety['value'])} ({name}).{rest}"


def answers(run, symmetric):
    """Six answers, each with an id"""
    stress, error = largest(run, "von Mises stress"), largest(run, "stress error, estimate")
    if not stress:
        return
    tools = [figure for figure in run["figures"] if figure["quantity"] == "reaction"]
    tools = [figure for figure in tools if figure["name"].endswith(".*")] or tools
    force = max(tools, key=lambda figure: figure["value"], default=None)
    normal, areas = listed(run, "normal force"), listed(run, "contact area")
    torques, bolts = listed(run, "torque"), listed(run, "bolt force")
    more = f". Torque of what turns: {torques}" * bool(torques) + f". Bolts: {bolts}" * bool(bolts)
    part = " (of the part that is modelled: there are symmetry planes)" * symmetric
    large = error["value"] if error else 0
    advice = " The stresses have no meaning." if large > 100 else " Refine the mesh." if large > 30 else ""
    mean = error and (
        f"The estimated error of the stresses is {error['value']:.{0 if error['value'] >= 10 else 1}f} % in "
        f"the mean{when(run, error)}, because of the mesh.{advice}")
    rows = [
        ("stress", "How large is the largest stress?", f"{amount(stress)} (von Mises)"),
        ("place", "Where is it?",
         f"{html.escape(stress['name'])}, at ({text(stress['place'])}), undeformed{when(run, stress)}"),
        ("yield", "Does the material yield?", yields(run)),
        ("force", "Which force does the tool or the support need?",
         f"{amount(force)} at {html.escape(force['name'].removesuffix('.*'))}{when(run, force)}{part}{more}"
         if force else "There is none." + f" Normal force of the contact: {normal}{part}" * bool(normal)),
        ("area", "How large is the contact area?", areas + part + narrow(run) if areas else "There is no contact."),
        ("accuracy", "How accurate is it?", mean or "Not estimated."),
    ]
    yield "<dl>\n" + "".join(f'<dt>{question}</dt><dd id="answer-{name}">{answer}</dd>\n'
                             for name, question, answer in rows) + "</dl>\n"


def results(run):
    """The largest values of the run; each row has an id, QUANTITY.NAME. A long table is closed"""
    long = len(run["figures"]) > OPEN
    yield f"<details><summary>{len(run['figures'])} largest values</summary>\n" * long
    yield "<table><thead><tr>" + "".join(f"<th>{head}</th>"
                                         for head in ("largest value of", "", "", "", "undeformed place, or components",
                                                      "load step")) + "</tr></thead>\n"
    for figure in run["figures"]:
        vectors = [figure[key] for key in ("place", "components") if figure[key][0] is not None]
        name = "-".join(figure["quantity"].replace(",", "").split()) + (f".{figure['name']}" if figure["name"] else "")
        cells = [figure["quantity"], figure["name"].removesuffix(".*"), text(figure["value"]), figure["unit"]]
        cells += [f"({text(vector)})" for vector in vectors] or [""]
        row = "".join(f"<td>{cell if i == 2 else html.escape(str(cell))}</td>" for i, cell in enumerate(cells))
        yield f'<tr id="{html.escape(name)}">{row}<td>{figure["step"]}</td></tr>\n'
    yield "</table>\n" + "</details>\n" * long
    if any(figure["quantity"].startswith("stress error") for figure in run["figures"]):
        yield ("<p>The stress error is the estimated error of the stresses in the mean over the model (energy norm), "
               "caused by the mesh. Its square is the relative error of the energy. Above 30&nbsp;% refine the mesh; "
               "above 100&nbsp;% the stresses have no meaning. At sharp edges the largest stress grows with each "
               "refinement.</p>\n")


def history(base):
    """Curves over time of energy and work, of each pair's normal force, and of reactions; none for one load step"""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    if not os.path.exists(base + ".csv"):
        return "<p>No load step was finished.</p>\n"
    with open(base + ".csv", newline="", encoding="utf-8") as file:
        heading, *lines = csv.reader(file)
    columns = {name: [float(line[i]) for line in lines] for i, name in enumerate(heading)}
    if len(lines) < 2:
        return "<p>The run has one load step: there are no curves.</p>\n"
    of_faces = [name for name in heading if name.count(".") == 2 and ".reaction_" in name]
    reactions = sorted(of_faces, key=lambda name: -peak(columns[name]))
    from contact.files import Files

    files = Files(base)
    force, length = files.unit("contact_force"), files.unit("displacement")
    groups = {
        f"energy and work of the loads [{force} {length}]": ["energy", "work"],
        f"normal force of each contact pair [{force}]": [name for name in heading if name.endswith(".normal_force")],
        f"largest reactions [{force}]": [name for name in reactions if peak(columns[name]) > 0][:4],
    }
    groups[next(iter(groups))] += [name for name in ("plastic_work", "contact_work") if peak(columns.get(name, []))]
    groups = {title: names for title, names in groups.items() if names}
    figure, axes = plt.subplots(len(groups), squeeze=False, sharex=True, figsize=(8, 2.6 * len(groups) + 0.6))
    for axis, (title, names) in zip(axes.ravel(), groups.items()):
        for name in names:
            axis.plot(columns["time"], columns[name], ".-", label=name.replace(".*", ""))
        axis.set_title(title, fontsize="medium")
        axis.legend(fontsize="small")
        axis.grid(alpha=0.3)
    axes[-1, 0].set_xlabel("time (load step k ends at time k)")
    figure.tight_layout()
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=110)
    return image(stream.getvalue(), "History of the run")


def peak(values):
    return max((abs(value) for value in values if value == value), default=0.0)


def forces(step):
    keys = ["force", "normal_force", "area", "pressure", "penetration"]
    heading = ["pair", "force on the nonmortar side (x, y, z)", "normal force", "contact area", "largest pressure"]
    heading += ["largest penetration"]
    if any(pair["shear_force"] or pair["dissipated"] for pair in step["pairs"]):
        keys += ["shear_force", "stick_area", "slip_area", "dissipated"]
        heading += ["shear force", "area that sticks", "area that slips", "work of friction"]
    if step["pairs"]:
        yield table(heading, [[pair["name"], *(pair[key] for key in keys)] for pair in step["pairs"]])
    yield table(["face", "reaction (x, y, z)", "moment"],
                [[face["name"].removesuffix(".*"), face["reaction"], face["moment"]] for face in step["faces"]])
    if step["rigid_bodies"]:
        keys = ["name", "position", "rotation"]
        yield table(["rigid body", "position (x, y, z)", "rotation since the start, degrees"],
                    [[body[key] for key in keys] for body in step["rigid_bodies"]])
    yield "<p>Forces on each body. Their resultant should be 0.</p>\n"
    keys = ["contact", "reaction", "load"]
    keys += [key for key in ("ties", "springs") if any(any(body[key]) for body in step["bodies"])]
    heading = ["body", *(f"{key} (x, y, z)" for key in keys), "resultant, relative to the sum of the magnitudes"]
    yield table(heading, [[body[key] for key in ("name", *keys, "balance")] for body in step["bodies"]])
    if step["bolts"]:
        yield table(["bolt", "force in its section", "shortening"],
                    [[bolt["name"], bolt["force"], bolt["shortening"]] for bolt in step["bolts"]])


def percent(fraction):
    return None if fraction is None else float(f"{100 * fraction:.2g}")


def accuracy(run, step):
    mesh = step["error_estimate"]
    solver = step["algebraic_error"]
    rows = [["the mesh (from stress recovery)", None if mesh is None else percent(mesh**2)],
            ["the solver", percent(solver)]]
    yield table(["error caused by", "estimated error of the energy [%]"], rows)
    if mesh is not None:
        yield ("<p>Contribution of each body to the error of the mesh in the energy norm. Refine the body with the "
               "largest one.</p>\n")
        yield table(["body", "error in the energy norm [%]"],
                    [[body, percent(error)] for body, error in step["body_errors"].items()])
    if run.get("accuracy"):
        asked = run["accuracy"]
        yield f"<p>Requested accuracy: {text(asked['target'])}. {html.escape(str(asked['end']))}</p>\n"
        keys = [key for key in asked["levels"][0] if not isinstance(asked["levels"][0][key], (list, dict))]
        yield table([key.replace("_", " ") for key in keys],
                    [[level[key] for key in keys] for level in asked["levels"]])
        yield ("<p>Errors of the meshes are relative to the energy, or to the force of a pair if that error is "
               "larger.</p>\n")


def steps(run):
    columns = {
        "step": "step",
        "load": "load factor",
        "constraints": "contact constraints",
        "contact_updates": "contact updates",
        "ip_iterations": "iterations",
        "amg_applications": "AMG applications",
        "cuts": "cuts",
        "energy": "energy",
        "plastic_work": "plastic work",
        "equilibrium": "unbalanced forces, relative",
        "gap_true": "smallest gap (negative: penetration)",
        "reason": "result",
    }
    if not any(step["plastic_work"] for step in run["steps"]):
        del columns["plastic_work"]
    rows = run["steps"]
    if len(rows) > ROWS:
        special = [step for step in rows if step["cuts"] or step["gap_unconverged"] or not step["converged"]]
        worst = max(step["equilibrium"] or 0 for step in rows)
        yield (
            f"<p>{len(rows) - len(special)} of {len(rows)} load steps converged without a cut. The unbalanced forces "
            f"are at most {worst:.1e} of the internal forces. {'The others are:' if special else ''}</p>\n")
        rows = special
    if rows:
        yield table(columns.values(), [[step[key] for key in columns] for step in rows])


def time_and_memory(run):
    total = run["time"]["total"]
    phases = [(PHASES.get(name, name.replace("_", " ")), seconds) for name, seconds in run["time"].items() if seconds]
    rows = [[name, f"{seconds:.3g}", f"{100 * seconds / total:.1f}" if total else None] for name, seconds in phases]
    yield table(["phase", "time [s]", "share [%]"], rows)
    memory = run["peak_memory_bytes"]
    yield f"<p>Peak memory: {memory / 1e6:.0f} MB, {memory / 1e3 / max(run['dofs'], 1):.2f} kB per unknown.</p>\n"


def page(base, run, scene, command, versions):
    """The parts of the page in turn"""
    good = run["exit_code"] == 0
    last = next((step for step in reversed(run["steps"]) if step["bodies"]), None)  # others ended before any forces
    yield "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    yield f"<title>{text(run['problem'])}</title>\n<style>{STYLE}</style>\n<script>{SLIDER}{TURN}</script>\n</head>\n"
    yield f"<body>\n<h1>{text(run['problem'])}</h1>\n"
    verdict = END.get(run["exit_code"], "The run failed.")
    yield f"<p class=\"{'good' if good else 'bad'}\"><b>{verdict}</b> {'' if good else text(run['reason'])}</p>\n"
    ranks = "1 rank" if run["ranks"] == 1 else f"{run['ranks']} ranks"
    units = f" Units: {text(run['units'])}." if run["units"] else ""
    yield f"<p>{run['dofs']:,} unknowns, {ranks}, {run['time']['total']:.1f} s.{units} {datetime.date.today()}</p>\n"
    yield "<h2>Warnings</h2>\n"
    warnings = "".join(f"<li>{text(warning)}</li>" for warning in run["warnings"])
    yield f"<ul>{warnings}</ul>\n" if warnings else "<p>None.</p>\n"
    yield "<h2>Results</h2>\n"
    with open(scene, encoding="utf-8", errors="replace") as file:
        written = file.read()
    if run["steps"] and run["steps"][0]["step"] > 1:
        yield f"<p>Largest values since the restart at the end of load step {run['steps'][0]['step'] - 1}.</p>\n"
    yield from answers(run, re.search(r"^(symmetry|cyclic)\s*:", written, re.M) is not None)
    yield from results(run)
    if any(step["converged"] for step in run["steps"]):
        yield "<h2>Pictures</h2>\n"
        yield from pictures(base, run)
    if last:
        yield "<h2>History</h2>\n" + history(base)
        number = f"load step {last['step']}" + ", which did not converge" * (not last["converged"])
        yield f"<h2>Forces, {number}</h2>\n"
        yield f"<p>In the units of the scene{': ' + text(run['units']) if run['units'] else ''}.</p>\n"
        yield from forces(last)
        yield f"<h2>Accuracy, {number}</h2>\n"
        yield from accuracy(run, last)
    if run["steps"]:
        yield "<h2>Load steps</h2>\n"
        yield from steps(run)
    yield "<h2>Time and memory</h2>\n"
    yield from time_and_memory(run)
    yield f"<h2>Scene</h2>\n<p><code>{html.escape(command)}</code></p>\n<pre>{html.escape(written)}</pre>\n"
    yield f"<h2>Versions</h2>\n<pre>{html.escape(versions)}</pre>\n</body>\n</html>\n"


def main():
    if sys.argv[1:] == ["--check"]:
        check()
        return
    file, base, summary, scene, command, versions = sys.argv[1:]
    check()
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    sys.path[:0] = [os.path.join(top, "plot"), os.path.join(top, "python")]
    with open(summary, encoding="utf-8") as stream:
        run = json.load(stream)
    parts = "".join(page(base, run, scene, command, versions))
    with open(file + ".part", "w", encoding="utf-8") as stream:
        stream.write(parts)
    os.replace(file + ".part", file)


if __name__ == "__main__":
    main()
