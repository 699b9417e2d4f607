"""A second set of scenes that were not used to find the rule of auto: choice.py makes second.md of them"""

WORDS = """`auto` gave bodies of finite strain with a Poisson's ratio of at most 0.4 the element `full` until
this page showed that `bbar` is better. Four of these scenes therefore decided that part of the
rule. [Five more scenes](third.md) were measured after the change.
"""
LAW = "material: neohookean, young: 1000, poisson: %s, E}"
# A strip and a rigid roller that is pressed into it. To be filled in: the strip's material, the depth [length]
STRIP = """bodies:
  - strip: {lower: [0, 0, -1], upper: [2, 0.2, 0], cells: [10, 1, 5], %s, E}
  - roller: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.8, 1], angles: [90, 200], extent: [0, 0.2],
      cells: [1, 24, 1], material: rigid}
symmetry: [strip.xmin, strip.ymin, strip.ymax]
displacements:
  - low: {face: strip.zmin, value: [0, 0, 0]}
  - roll: {body: roller, value: [0, 0, -%s]}
contact:
  - touch: {mortar: roller.outer, nonmortar: strip.zmax, distance: 0.5}
"""
SCENES = {
    "cantilever of finite strain, nu 0.3": ("energy", """bodies:
  - beam: {lower: [0, 0, 0], upper: [6, 1, 0.6], cells: [12, 2, 2], """ + LAW % 0.3 + """
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
  - end: {face: beam.xmax, value: [free, free, -0.6]}
load: {steps: 2}
"""),
    "foam block under a roller, finite strain, nu 0.2": ("force",
                                                         STRIP % ("material: neohookean, young: 1, poisson: 0.2", 0.2) +
                                                         "load: {steps: 2}\n"),
    "bar in torsion, nu 0.3": ("energy", """bodies:
  - bar: {lower: [0, 0, 0], upper: [4, 1, 1], cells: [8, 3, 3], young: 1000, poisson: 0.3, E}
displacements:
  - wall: {face: bar.xmin, value: [0, 0, 0]}
forces:
  - twist: {face: bar.xmax, moment: [1, 0, 0]}
"""),
    "elastic strip on a roller, nu 0.49": ("force", STRIP % ("young: 1, poisson: 0.49", 0.05)),
    "block pressed with friction 0.4, nu 0.3": ("force", """bodies:
  - block: {lower: [0, 0, 0], upper: [1, 0.2, 1], cells: [5, 1, 5], young: 100, poisson: 0.3, E}
  - die: {lower: [-0.5, 0, -0.2], upper: [1.5, 0.2, 0], cells: [1, 1, 1], material: rigid}
symmetry: [block.xmin, block.ymin, block.ymax]
displacements:
  - top: {face: block.zmax, value: [0, 0, -0.02]}
  - die: {body: die, value: [0, 0, 0]}
contact:
  - press: {mortar: die.zmax, nonmortar: block.zmin, friction: 0.4}
"""),
    "thin clip pressed on a stop, nu 0.35": ("force", """bodies:
  - clip: {lower: [0, 0, 0], upper: [10, 1, 0.3], cells: [10, 1, 1], young: 1000, poisson: 0.35, E}
  - stop: {lower: [9, 0, -0.5], upper: [10, 1, 0], cells: [2, 1, 1], material: rigid}
displacements:
  - wall: {face: clip.xmin, value: [0, 0, 0]}
  - stop: {body: stop, value: [0, 0, 0.3]}
contact:
  - touch: {mortar: stop.zmax, nonmortar: clip.zmin, distance: 0.5}
"""),
    "elastic and plastic bending, j2": ("energy", """bodies:
  - beam: {lower: [0, 0, 0], upper: [6, 0.5, 0.5], cells: [12, 1, 2], material: j2, young: 1000, poisson: 0.3,
      yield: 5, hardening: 50, E}
symmetry: [beam.ymin]
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
  - end: {face: beam.xmax, value: [free, free, -0.5]}
load: {steps: 4}
"""),
    "curved arch of skewed cells, nu 0.3": ("energy", """bodies:
  - arch: {shape: tube_arc, axis: y, radii: [3, 3.3], angles: [0, 90], extent: [0, 0.5], cells: [1, 10, 1],
      young: 1000, poisson: 0.3, E}
symmetry: [arch.lmin]
displacements:
  - foot: {face: arch.amin, value: [0, 0, 0]}
pressures:
  - load: {face: arch.outer, value: 0.01}
"""),
    "bar under its weight on a floor, nu 0.4": ("energy", """bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 1, 3], cells: [3, 3, 6], young: 10, poisson: 0.4, density: 1, E}
  - floor: {lower: [-1, -1, -0.5], upper: [2, 2, 0], cells: [1, 1, 1], material: rigid}
symmetry: [bar.xmin, bar.ymin]
displacements:
  - floor: {body: floor, value: [0, 0, 0]}
body_forces:
  - weight: {body: bar, value: [0.2, 0, -1]}
contact:
  - stand: {mortar: floor.zmax, nonmortar: bar.zmin}
"""),
    "tube under pressure, finite strain, nu 0.3": ("energy", """bodies:
  - tube: {shape: tube_arc, axis: z, radii: [1, 1.5], angles: [0, 90], extent: [0, 0.25], cells: [4, 10, 1],
      material: neohookean, young: 10, poisson: 0.3, E}
symmetry: [tube.amin, tube.amax, tube.lmin, tube.lmax]
pressures:
  - bore: {face: tube.inner, value: 0.5}
load: {steps: 2}
"""),
    "wheel of finite strain on a plate, coarse, nu 0.3": ("force", """bodies:
  - wheel: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.3, 1], angles: [90, 180], extent: [0, 0.1],
      cells: [5, 16, 1], """ + LAW % 0.3 + """
  - plate: {lower: [0, 0, -0.2], upper: [0.6, 0.1, 0], cells: [1, 1, 1], material: rigid}
symmetry: [wheel.lmin, wheel.lmax, wheel.amax]
displacements:
  - plate: {body: plate, value: [0, 0, 0]}
  - down: {face: wheel.amin, value: [free, free, -0.05]}
contact:
  - touch: {mortar: plate.zmax, nonmortar: wheel.outer, distance: 0.1}
load: {steps: 2}
"""),
}
