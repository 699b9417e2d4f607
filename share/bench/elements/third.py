"""A third set of scenes that were not used to find the rule of auto: choice.py makes third.md of them"""

WORDS = """The rule for finite strain changed after the first two sets had been measured. These scenes were
measured once, afterwards.
"""
SCENES = {
    "roll squeezed by a quarter, finite strain, nu 0.3": ("force", """bodies:
  - roll: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.6, 1], angles: [90, 180], extent: [0, 0.1],
      cells: [3, 20, 1], material: neohookean, young: 10, poisson: 0.3, E}
  - plate: {lower: [-0.1, 0, -0.2], upper: [1.2, 0.1, 0], cells: [1, 1, 1], material: rigid}
symmetry: [roll.lmin, roll.lmax, roll.amax]
displacements:
  - plate: {body: plate, value: [0, 0, 0]}
  - down: {face: roll.amin, value: [free, free, -0.25]}
contact:
  - touch: {mortar: plate.zmax, nonmortar: roll.outer, distance: 0.4}
load: {steps: 4}
"""),
    "foam pad upset by a third between rough plates, nu 0.1": ("energy", """bodies:
  - pad: {lower: [0, 0, 0], upper: [1, 1, 0.8], cells: [4, 4, 4], material: neohookean, young: 2, poisson: 0.1, E}
symmetry: [pad.xmin, pad.ymin]
displacements:
  - low: {face: pad.zmin, value: [0, 0, 0]}
  - top: {face: pad.zmax, value: [0, 0, -0.27]}
load: {steps: 3}
"""),
    "bush sheared around a rigid pin, Mooney-Rivlin": ("energy", """bodies:
  - bush: {shape: tube_arc, axis: z, radii: [0.5, 1], angles: [0, 180], extent: [0, 0.2], cells: [4, 16, 1],
      material: mooney_rivlin, c10: 1, c01: 0.5, bulk: 10, E}
symmetry: [bush.amin, bush.amax, bush.lmin, bush.lmax]
displacements:
  - outer: {face: bush.outer, value: [0, 0, 0]}
  - pin: {face: bush.inner, value: [0.15, 0, 0]}
load: {steps: 2}
"""),
    "plate on two rollers, small strain, nu 0.3": ("force", """bodies:
  - plate: {lower: [0, 0, 0], upper: [4, 0.5, 0.4], cells: [14, 2, 2], young: 1000, poisson: 0.3, E}
  - roller: {shape: tube_arc, axis: y, center: [3, 0, -0.3], radii: [0.2, 0.3], angles: [-60, 60], extent: [0, 0.5],
      cells: [1, 24, 1], material: rigid}
symmetry: [plate.xmin, plate.ymin]
displacements:
  - roller: {body: roller, value: [0, 0, 0]}
  - push: {face: plate.xmin, value: [free, free, -0.1]}
contact:
  - rest: {mortar: roller.outer, nonmortar: plate.zmin, distance: 0.3}
"""),
    "collar shrunk on the end of a shaft, nu 0.3": ("energy", """bodies:
  - shaft: {shape: tube_arc, axis: z, radii: [0.4, 1], angles: [0, 90], extent: [-0.4, 0.9], cells: [3, 10, 6],
      young: 200, poisson: 0.3, E}
  - collar: {shape: tube_arc, axis: z, radii: [0.98, 1.4], angles: [0, 90], extent: [0, 0.5], cells: [3, 14, 4],
      young: 100, poisson: 0.35, E}
symmetry: [shaft.amin, shaft.amax, collar.amin, collar.amax]
displacements:
  - base: {face: shaft.lmin, value: [free, free, 0]}
  - end: {face: collar.lmin, value: [free, free, 0]}
contact:
  - fit: {mortar: shaft.outer, nonmortar: collar.inner, interference: 0.02}
"""),
}
