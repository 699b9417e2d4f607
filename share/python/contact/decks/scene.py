"""The text of a scene"""
import numpy as np

BEGINS = "# Translated from "


def number(value):
    return f"{float(value):.12g}"


def word(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (float, np.floating)):
        return number(value)
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(word(one) for one in value) + "]"
    return str(value)


def entry(name, keys):
    return f"  - {name}: {{" + ", ".join(f"{key}: {word(value)}" for key, value in keys.items()) + "}"


def text(heading, single, sections):
    """heading: lines of comments; single: {key: value}; sections: {key: [(name, {key: value})]}"""
    lines = [f"# {line}".rstrip() for line in heading]
    lines += [f"{key}: {word(value)}" for key, value in single.items()]
    for key, entries in sections.items():
        if entries:
            lines += [f"{key}:", *(line if isinstance(line, str) else entry(*line) for line in entries)]
    return "\n".join(lines) + "\n"
