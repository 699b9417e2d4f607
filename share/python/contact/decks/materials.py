"""Materials of a deck as laws of a scene."""
import numpy as np

from ..meshes.model import MeshError

INCOMPRESSIBLE = "incompressible: the bulk modulus is 1,000 times the shear modulus"


class Material:
    """What the keywords of a material say: {keyword: (where, parameters, rows of numbers)}"""

    def __init__(self, name, where):
        self.name, self.where, self.said = name, where, {}

    def rows(self, keyword):
        return self.said[keyword][2]

    def constants(self, keyword, count):
        """The numbers of one line; lines for other temperatures must have the same numbers"""
        where, _, rows = self.said[keyword]
        numbers = [row[:count] for row in rows]
        if not numbers or len(numbers[0]) < count:
            raise MeshError(f"{where}: *{keyword} has fewer than {count} numbers")
        if any(row != numbers[0] for row in numbers[1:]):
            raise MeshError(f"{where}: *{keyword} depends on temperature, which is not supported")
        return numbers[0]


def law(material, finite, orientation, notes):
    """{key: value} of a material. finite: whether a step has NLGEOM"""
    said = material.said
    keys = {}
    if "HYPERELASTIC" in said:
        keys = hyperelastic(material, notes)
    elif "ELASTIC" in said:
        keys = elastic(material, finite, orientation, notes)
    else:
        raise MeshError(f"{material.where}: the material \"{material.name}\" has neither *ELASTIC nor *HYPERELASTIC")
    if "PLASTIC" in said:
        keys = plastic(material, finite, keys, notes)
    if "EXPANSION" in said:
        add_expansion(material, keys, notes)
    if "DENSITY" in said:
        keys["density"] = material.constants("DENSITY", 1)[0]
    return keys


def elastic(material, finite, orientation, notes):
    where, parameters, rows = material.said["ELASTIC"]
    kind = parameters.get("TYPE", "ISOTROPIC").upper()
    if kind == "ISO":
        kind = "ISOTROPIC"
    if kind == "ISOTROPIC":
        young, poisson = material.constants("ELASTIC", 2)
        return {"law": "saint_venant" if finite else "linear", "young": young, "poisson": poisson}
    numbers = [value for row in rows for value in row if value is not None]
    if kind in ("ENGINEERING CONSTANTS", "ENGINEERINGCONSTANTS"):
        e1, e2, e3, n12, n13, n23, g12, g13, g23 = numbers[:9]
    elif kind in ("ORTHO", "ORTHOTROPIC"):
        d11, d12, d22, d13, d23, d33, g12, g13, g23 = numbers[:9]
        s = np.linalg.inv(np.array([[d11, d12, d13], [d12, d22, d23], [d13, d23, d33]]))
        e1, e2, e3 = 1 / np.diag(s)
        n12, n13, n23 = -s[0, 1] * e1, -s[0, 2] * e1, -s[1, 2] * e2
    else:
        raise MeshError(f"{where}: *ELASTIC of type {kind} is not supported: isotropic, orthotropic and engineering "
                        f"constants are")
    if finite:
        notes.approximate("ELASTIC", where, "orthotropic at small strain although a step has NLGEOM")
    keys = {"law": "orthotropic", "young": [e1, e2, e3], "poisson": [n12, n23, n13], "shear": [g12, g23, g13]}
    if orientation is not None:
        keys["first_axis"], keys["second_axis"] = orientation
    return keys


def hyperelastic(material, notes):
    where, parameters, _ = material.said["HYPERELASTIC"]
    if "NEO HOOKE" in parameters:
        c10, d1 = material.constants("HYPERELASTIC", 2)
        shear, bulk = 2 * c10, (2 / d1 if d1 else 1000 * 2 * c10)
        if not d1:
            notes.approximate("HYPERELASTIC", where, INCOMPRESSIBLE)
        return {
            "law": "neohookean", "young": 9 * bulk * shear / (3 * bulk + shear),
            "poisson": (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)
        }
    if "MOONEY-RIVLIN" in parameters:
        c10, c01, d1 = material.constants("HYPERELASTIC", 3)
        if not d1:
            notes.approximate("HYPERELASTIC", where, INCOMPRESSIBLE)
        return {"law": "mooney_rivlin", "c10": c10, "c01": c01, "bulk": 2 / d1 if d1 else 2000 * (c10 + c01)}
    raise MeshError(f"{where}: *HYPERELASTIC is supported with NEO HOOKE and MOONEY-RIVLIN")


def plastic(material, finite, keys, notes):
    where, parameters, rows = material.said["PLASTIC"]
    if parameters.get("HARDENING", "ISOTROPIC").upper() not in ("ISOTROPIC", "ISO"):
        raise MeshError(f"{where}: *PLASTIC with HARDENING={parameters['HARDENING']} is not supported: isotropic is")
    if keys["law"] not in ("linear", "saint_venant"):
        raise MeshError(f"{where}: *PLASTIC with {keys['law']} elasticity is not supported")
    if len({row[2] for row in rows if len(row) > 2}) > 1:
        raise MeshError(f"{where}: *PLASTIC depends on temperature, which is not supported")
    stresses, strains = [row[0] for row in rows], [row[1] if len(row) > 1 else 0.0 for row in rows]
    keys = {**keys, "law": "j2_finite" if finite else "j2"}
    if len(rows) == 1:
        return {**keys, "yield": stresses[0]}
    return {**keys, "plastic_strains": strains, "yield_stresses": stresses}


def add_expansion(material, keys, notes):
    where, parameters, _ = material.said["EXPANSION"]
    if parameters.get("TYPE", "ISO").upper() not in ("ISO", "ISOTROPIC"):
        raise MeshError(f"{where}: *EXPANSION of type {parameters['TYPE']} is not supported: isotropic is")
    value = material.constants("EXPANSION", 1)[0]
    if value == 0.0:
        return
    if keys["law"] == "saint_venant":
        keys["law"] = "linear"
        notes.approximate("EXPANSION", where, "thermal expansion at small strain although a step has NLGEOM")
    if keys["law"] not in ("linear", "j2"):
        raise MeshError(f"{where}: *EXPANSION with the law {keys['law']} is not supported: small strain is")
    keys["expansion"] = value
