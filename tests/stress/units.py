"""The shipped scenes in other units: the same iterations, and the same fields after scaling back."""
import os

import numpy as np
import yaml

from runner import DIRECT, SCENES, Case, solve

# factors of length and pressure; powers of two change no digit, so that nothing at all may differ
UNITS = {
    "m, Pa": (1.0, 1.0), "mm, MPa": (1e3, 1e-6), "lengths x 1e-6": (1e-6, 1.0), "powers of two": (2.0**-20, 2.0**10)
}

# What keeps a run within seconds
OPTIONS = {
    "two_block": ["-refine", 0],
    "ironing": ["-refine", 0, "-contact_updates", 1, "-contact_quadrature", 8],
    "gmsh_blocks": ["-refine", 0],
    "beam_sphere_linear": ["-load_steps", 2, "-contact_updates", 1, "-contact_quadrature", 8],
    "beam_sphere_neo_hookean": ["-load_steps", 6, "-contact_updates", 1, "-contact_quadrature", 8],
}

LENGTHS = {
    "lower", "upper", "center", "radii", "radius", "inner_radius", "outer_radius", "extent", "semi_axes", "distance",
    "interference", "inner_center", "outer_center", "cap_center", "cap_radius", "point", "points", "tip", "size",
    "outside", "section_radius"
}
PRESSURES = {"young", "c10", "c01", "bulk", "yield", "hardening", "kinematic", "saturation", "yield_stresses"}
# powers of length and pressure
FIELDS = {
    "displacement": (1, 0), "contact_gap": (1, 0), "contact_pressure": (0, 1), "contact_area": (2, 0),
    "contact_force": (2, 1), "stress": (0, 1)
}
TOLERANCE = 1e-9
# Two runs agree to rounding only where they take the same steps: the inexact solver stops at other PCG iterations after
# another rounding, MUMPS with a prescribed sequence of mu does not. This tolerance is tight enough: the last steps to a
# tighter one multiply rounding by D. One linearization: where the next one is placed by secants of the last two, their
# quotients multiply rounding. And a quadrature whose error is of its size: where corners of an overlap coincide,
# rounding chooses the one that its triangles begin at
EXACT = [
    "-options_file", DIRECT, "-tao_ipfilter_subspace", "false", "-tao_ipfilter_barrier", "monotone",
    "-tao_ipfilter_tol", 1e-4, "-elasticity_ksp_rtol", 1e-12, "-contact_updates", 1, "-contact_quadrature", 8
]


def value_of(text):
    """A number as scenes have it: a fraction is a string in YAML, and so is 1e6."""
    if isinstance(text, str):
        parts = text.split("/")
        return float(parts[0]) / float(parts[1]) if len(parts) == 2 else float(text)
    return float(text)


def scaled(value, factor):
    if isinstance(value, list):
        return [scaled(v, factor) for v in value]
    try:
        number = value_of(value)
    except ValueError:
        return value  # free
    return str(value) if not np.isfinite(number) else number * factor


def scale_lengths(item, length):
    """Every length in a body or face, however deep."""
    if isinstance(item, dict):
        return {
            key: scaled(value, length) if key in LENGTHS else scale_lengths(value, length)
            for key, value in item.items()
        }
    return item


def scale_values(scene, key, factor):
    for entry in scene.get(key, []):
        for values in entry.values():
            values["value"] = scaled(values["value"], factor)


def scale_mesh(path, target, length):
    """Coordinates of an ASCII Gmsh 4.1 file."""
    with open(path) as file:
        lines = file.read().split("\n")
    at = lines.index("$Nodes") + 2
    for _ in range(int(lines[at - 1].split()[0])):
        count = int(lines[at].split()[3])
        for k in range(at + 1 + count, at + 1 + 2 * count):
            lines[k] = " ".join(repr(float(x) * length) for x in lines[k].split())
        at += 1 + 2 * count
    with open(target, "w") as file:
        file.write("\n".join(lines))


def in_units(shipped, folder, length, pressure):
    with open(os.path.join(SCENES, shipped + ".yaml")) as file:
        scene = yaml.safe_load(file)
    for key in ("bodies", "faces", "contact"):
        scene[key] = [{name: scale_lengths(values, length)
                       for name, values in item.items()}
                      for item in scene.get(key, [])]
        if not scene[key]:
            del scene[key]
    for body in scene["bodies"]:
        for values in body.values():
            values.update({key: scaled(values[key], pressure) for key in PRESSURES & values.keys()})
            if "mesh" in values:
                scale_mesh(os.path.join(SCENES, values["mesh"]), os.path.join(folder, "scaled.msh"), length)
                values["mesh"] = "scaled.msh"
    scene.pop("probes", None)
    scale_values(scene, "displacements", length)
    scale_values(scene, "pressures", pressure)
    scale_values(scene, "body_forces", pressure / length)
    return scene


def difference(run, base, length, pressure):
    """Largest difference of any field in any step after scaling back, relative to the field's largest value, and
    which."""
    worst = (0.0, "")
    for step in range(1, len(base.steps) + 1):
        ours, theirs = run.fields(step), base.fields(step)
        for name, (of_length, of_pressure) in FIELDS.items():
            if name not in theirs:
                continue
            a, b = np.nan_to_num(ours[name] / (length**of_length * pressure**of_pressure)), np.nan_to_num(theirs[name])
            # a closed gap has no size of its own
            size = np.nanmax(np.abs(theirs["displacement" if name == "contact_gap" else name]))
            if size > 0:
                worst = max(worst, (np.abs(a - b).max() / size, f"{name}, step {step}"))
    return worst


def compare(args, name, units=UNITS):
    """Iterations as the scene is shipped, fields solved as exactly as can be."""
    base = exact_base = None
    for unit in units:
        length, pressure = UNITS[unit]
        where = os.path.join(args.folder, "units", f"{name}_{len(unit)}")
        os.makedirs(where, exist_ok=True)
        scene, options = in_units(name, where, length, pressure), OPTIONS.get(name, [])
        run = solve(where, name, scene, options, args.limit)
        exact = solve(where, name + "_exact", scene, options + EXACT, args.limit, write=True)
        base, exact_base = base or run, exact_base or exact
        wrong, worst = [], (None, "")
        if not (run.converged and exact.converged and base.converged and exact_base.converged):
            wrong.append(f"{run.status}, to rounding {exact.status}")
        else:
            worst = difference(exact, exact_base, length, pressure)
            off = max(abs(a["ip_iterations"] - b["ip_iterations"]) for a, b in zip(run.steps, base.steps))
            if off > 1:
                wrong.append(f"Newton iterations of a step differ by {off}")
            if not worst[0] <= TOLERANCE:
                wrong.append(f"{worst[1]} differs by {worst[0]:.1e}")
        yield {"name": name, "unit": unit, "run": run, "difference": worst[0], "of": worst[1], "wrong": wrong}


def quick(args):
    """Two scenes in one other unit, with a decision on a limit that their meshes meet but for rounding, and mesh lines
    through vertices."""
    for name in ("two_block", "beam_sphere_linear"):
        yield list(compare(args, name, ("m, Pa", "lengths x 1e-6")))[1]


def is_static(name):
    with open(os.path.join(SCENES, name + ".yaml")) as file:
        return "dynamics" not in yaml.safe_load(file)


def cases(args):
    """All scenes whose units have no time"""
    for name in filter(is_static, sorted(file[:-5] for file in os.listdir(SCENES) if file.endswith(".yaml"))):
        yield Case("Change of units (shipped scenes)", name, lambda name=name: compare(args, name))
