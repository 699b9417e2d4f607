"""The scene of leaves that bend and slide on each other, for the tests of friction."""


def leaves(n, law, steps=1):
    """Leaves clamped at one end, and bent at the tip of the last; they touch all along, and bend by far more than their
    surfaces give. law: of their faces; empty: tied"""
    bodies = displacements = pairs = ""
    for i in range(n):
        bodies += (
            f"  - leaf{i}: "
            f"{{lower: [0, 0, {0.3 * i:.6g}], upper: [10, 1, {0.3 * (i + 1):.6g}], cells: [20, 2, 1], young: 1000, "
            f"poisson: 0.3, element: incompatible}}\n")
        displacements += f"  - clamp{i}: {{face: leaf{i}.xmin, value: [0, 0, 0]}}\n"
        pairs += f"  - j{i}: {{mortar: leaf{i - 1}.zmax, nonmortar: leaf{i}.zmin{law}}}\n" if i else ""
    tip = f"  - tip: {{face: leaf{n - 1}.xmax, value: [free, free, -1]}}\n"
    return (f"problem: leaves\nbodies:\n{bodies}displacements:\n{displacements}{tip}{'contact' if law else 'ties'}:\n"
            f"{pairs}load: {{steps: {steps}}}\n")
