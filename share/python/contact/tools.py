"""The surfaces of rigid tools, which the mesh has as cubes of one cell: points and faces, moved with the cube."""
import numpy as np

# Places of the parameters in a note of BASE.xmf, those of the enum in include/model.h
POINT, AXIS, RADIUS, SECTION, ANGLE, ACROSS, OUTSIDE, PROFILE = 0, 3, 6, 7, 8, 10, 13, 16
AROUND = 96  # faces around a whole turn


def frame(shape, own):
    """Three unit vectors, the last one along the axis; see SurfaceFrame() in src/model/rigid_surface.c"""
    axis = own[AXIS:AXIS + 3] / np.linalg.norm(own[AXIS:AXIS + 3]) if own[AXIS:AXIS + 3].any() else np.eye(3)[2]
    first = own[ACROSS:ACROSS + 3] if shape == "rigid_extruded" else np.eye(3)[np.argmin(np.abs(axis))]
    first = first - (first @ axis) * axis
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(axis, first), axis])


def profile(own, size):
    """Points of the line at the distance `outside` from the profile; its two ends are prolonged by `size`"""
    corners = own[PROFILE + 1:PROFILE + 1 + int(own[PROFILE])].reshape(-1, 2)
    along = np.diff(corners, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    normals = np.stack([along[:, 1], -along[:, 0]], axis=1)
    off = own[OUTSIDE]
    line = [corners[0] + off * normals[0] - size * along[0]]
    for k in range(1, len(corners) - 1):
        before, after = normals[k - 1], normals[k]
        turn = np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after)
        if turn > 0:  # a convex corner: an arc about it
            angles = np.arctan2(before[1], before[0]) + turn * np.linspace(0, 1, 9 if off > 0 else 1)
            line += [corners[k] + off * np.array([np.cos(angle), np.sin(angle)]) for angle in angles]
        else:
            line.append(corners[k] + off * (before + after) / (1 + before @ after))
    line.append(corners[-1] + off * normals[-1] + size * along[-1])
    return np.array(line)


def section(shape, own, middle, size):
    """A line in the half plane of a surface of revolution: distances from the axis, and places along it"""
    turn = np.linspace(0, 2 * np.pi, AROUND + 1)
    if shape == "rigid_sphere":
        return own[RADIUS] * np.stack([np.sin(turn / 2), np.cos(turn / 2)], axis=1)
    if shape == "rigid_torus":
        return np.stack([own[RADIUS] + own[SECTION] * np.cos(turn), own[SECTION] * np.sin(turn)], axis=1)
    if shape == "rigid_cylinder":
        return np.array([[own[RADIUS], middle - size], [own[RADIUS], middle + size]])
    if shape == "rigid_cone":
        return size * np.array([[0, 0], [np.sin(np.radians(own[ANGLE])), np.cos(np.radians(own[ANGLE]))]])
    line = profile(own, size)
    return line[line[:, 0] >= 0]


def grid(points, closed=False):
    """Points of a grid, (m, n, 3), and its faces; closed: the last column is beside the first one"""
    m, n = points.shape[:2]
    number = np.arange(m * n).reshape(m, n)
    if closed:
        number = np.concatenate([number, number[:, :1]], axis=1)
    faces = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=-1)
    return points.reshape(-1, 3), faces.reshape(-1, 4)


def stl(words):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    scale, file = words.split(" ", 1)
    reader = vtkSTLReader()
    reader.SetFileName(file)
    reader.Update()
    data = reader.GetOutput()
    return float(scale) * vtk_to_numpy(data.GetPoints().GetData()), vtk_to_numpy(
        data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def surface(note, low, high):
    """Points and faces of a tool, undeformed. Infinite ones end a little outside of the model's box"""
    shape, words = note.split(" ", 1)
    if shape == "rigid_stl":
        return stl(words)
    own = np.array(words.split(), float)
    axes, point = frame(shape, own), own[POINT:POINT + 3]
    size = np.linalg.norm(high - low)
    at = axes @ ((low + high) / 2 - point)
    half = np.abs(axes) @ (high - low) / 2 + 0.08 * size
    if shape == "rigid_plane":
        local = np.array([[[at[0] + a, at[1] + b, 0.0] for b in (-half[1], half[1])] for a in (-half[0], half[0])])
    elif shape == "rigid_extruded":
        local = np.array([[[x, y, at[2] + z] for z in (-half[2], half[2])] for x, y in profile(own, 0.25 * size)])
    else:
        turn = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
        line = section(shape, own, at[2], half[2] if shape == "rigid_cylinder" else 0.5 * size)
        local = np.array([[[r * np.cos(a), r * np.sin(a), z] for a in turn] for r, z in line])
    points, faces = grid(local, shape not in ("rigid_plane", "rigid_extruded"))
    return point + points @ axes, faces


def moved(points, cube, displacement):
    """Displacements of points of a tool: its cube, (8, 3), moves as a whole"""
    middle, mean = cube.mean(axis=0), displacement.mean(axis=0)
    slope = np.linalg.lstsq(cube - middle, displacement - mean, rcond=None)[0]
    return mean + (points - middle) @ slope
