"""The scenes on other meshes, as edits of their text: Hertz's two with coarser ones, whose cells at the contact are
larger by sqrt(2) each.

python meshes.py hertz_sphere|hertz_cylinder coarse|medium   prints the scene
"""
import os
import re
import sys

SCENES = os.path.dirname(os.path.abspath(__file__))


def edited(name, edits):
    """The text of a scene after edits, each a pattern and what takes its place"""
    with open(os.path.join(SCENES, name + ".yaml")) as file:
        text = file.read()
    for pattern, value in edits:
        text, n = re.subn(pattern, value, text, flags=re.M)
        if not n:
            raise ValueError(f"{name}.yaml has nothing like {pattern}")
    return text


def face_cells(patches, grading, even):
    """Edits of a curved body's cells along its three axes: how many, how they are graded, how many are equal"""
    keys = {"patches": patches, "grading": grading, "even": even}
    return tuple((rf"^ *{key}: .*", f"      {key}: {list(value)}") for key, value in keys.items())


def ball_cells(patch, grading, even, layers, layer_grading, layer_even):
    depth = {"layers": layers, "layer_grading": layer_grading, "layer_even": layer_even}
    return face_cells((patch, patch, 1), (grading, grading, 1), (even, even, 1)) + tuple(
        (f"{key}: .*", f"{key}: {value}") for key, value in depth.items())


def cylinder_cells(around, grading, even, ring, ring_grading, ring_even):
    """Around the arc, and in the ring"""
    return face_cells((8, around, ring), (1, grading, ring_grading), (1, even, ring_even))


MESHES = {
    "hertz_sphere": {
        "coarse": ball_cells(11, 312.5, 5, 9, 0.005304, 3), "medium": ball_cells(15, 334.5, 6, 12, 0.004552, 4)
    },
    "hertz_cylinder": {
        "coarse": cylinder_cells(19, 361.2, 6, 14, 0.004865, 2), "medium": cylinder_cells(28, 432.9, 9, 20, 0.00386, 3)
    },
}

if __name__ == "__main__":
    print(edited(sys.argv[1], MESHES[sys.argv[1]][sys.argv[2]]), end="")
