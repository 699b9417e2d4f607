# Limit loads of flat punches on a metal without hardening: Prandtl's strip, (2 + pi) k, and a circular punch, between
# Shield's loads of the two Tresca solids that bound von Mises's
contact=$AMGF_DIR/bin/contact
"$PYTHON" - <<'PY'
import math

METAL = "material: j2, young: 1000, poisson: 0.3, yield: 1, element: bbar"
angle = math.radians(5)


# cells of size 1/n up to 1.25 punches, from there on each a quarter longer than the one before, up to 3.5
def mesh(n):
    even, growth, far = 5 * n // 4, 0, 1.25
    while far < 3.5:
        growth += 1
        far += 1.25**growth / n
    ratio = 1.25**growth
    return far, (f"cells: [{even + growth}, 1, {even + growth}], grading: [{ratio}, 1, {1 / ratio}], even: [{even}, 1, "
                 f"{even}]")


for n in 4, 8:
    far, cells = mesh(n)
    open(f"strip{n}.yaml", "w").write(f"""bodies:
  - block: {{lower: [0, 0, {-far}], upper: [{far}, 0.1, 0], {cells}, {METAL}}}
faces:
  - punch: {{of: block.zmax, upper: [1, inf, inf]}}
displacements:
  - floor: {{face: block.zmin, value: [0, 0, 0]}}
  - side: {{face: block.xmax, value: [0, free, free]}}
  - back: {{face: block.ymax, value: [free, 0, free]}}
  - punch: {{face: block.punch, value: [free, free, -0.08]}}
symmetry: [block.xmin, block.ymin]
load: {{factors: [0.5, 1]}}
""")
    open(f"circle{n}.yaml", "w").write(f"""bodies:
  - block: {{shape: tube_arc, axis: z, radii: [1e-5, {far}], angles: [0, 5], extent: [{-far}, 0], {cells}, {METAL}}}
faces:
  - punch: {{of: block.lmax, upper: [1, inf, inf]}}
displacements:
  - floor: {{face: block.lmin, value: [0, 0, 0]}}
  - side: {{face: block.outer, value: [0, 0, free]}}
  - axis: {{face: block.inner, value: [0, 0, free]}}
  - punch: {{face: block.punch, value: [free, free, -0.08]}}
symmetry:
  - begin: {{face: block.amin, normal: y}}
  - end: {{face: block.amax, normal: [{-math.sin(angle)}, {math.cos(angle)}, 0]}}
load: {{factors: [0.5, 1]}}
""")
PY
for scene in strip4 strip8 circle4 circle8; do
  "$contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json 2> /dev/null || echo "$scene: exit $?"; done
"$PYTHON" - <<'PY'
import math
from summaries import load, say, within

areas = {"strip": 0.1, "circle": math.radians(5) / 2}


def pressure(name, step):
    """Mean pressure of the last mesh and of meshes that have no end: a punch is wider by half a cell than its nodes"""
    found = [
        abs(face["reaction"][2]) / areas[name]
        for n in (4, 8)
        for face in load(f"{name}{n}")["steps"][step]["faces"]
        if face["name"].endswith("punch")
    ]
    return found[1], 2 * found[1] - found[0]


for name in areas:
    half, full = pressure(name, 0), pressure(name, 1)
    say(name + ": at its limit, the load grows by less than 1 % while the punch sinks to twice the depth",
        within(full[0], half[0], 1e-2), (half, full))
k = 1 / math.sqrt(3)
say("strip: (2 + pi) k to 1 %", within(pressure("strip", 1)[1], (2 + math.pi) * k, 1e-2),
    (pressure("strip", 1), (2 + math.pi) * k))
low, high = 5.69 / 2, 5.69 * k
say("circle: between 5.69 times Y/2 and 5.69 times k", low < pressure("circle", 1)[1] < high,
    (low, pressure("circle", 1), high))
PY
