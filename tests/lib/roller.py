"""The scene of a rigid roller that is pressed on a block. CELLS of the block and the roller's MOTION are replaced."""
ROLLER = """bodies:
  - block: {lower: [0, 0, -1], upper: [1, 0.01, 0], CELLS,
            young: 1000, poisson: 0.3}
  - roller: {shape: half_ellipse, axis: y, depth: -z, half: x, center: [0, 0, 1], semi_axes: [1, 1], extent: [0, 0.01],
             patches: [4, 12, 4], layers: 1, material: rigid}
faces:
  - crown: {of: roller.arc, upper: [0.6, inf, 0.5]}
  - spot: {of: block.zmax, upper: [0.3, inf, inf]}
symmetry: [block.xmin, block.ymin, block.ymax]
displacements:
  - floor: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: roller, value: MOTION}
contact:
  - touch: {mortar: roller.crown, nonmortar: block.spot, distance: 0.2}
"""
