// Two bodies that touch without sharing nodes: a slab, and a round stamp standing on it. Both are hexahedra with 8 nodes.
//
//   gmsh -3 share/gmsh/two_blocks.geo -o share/gmsh/two_blocks.msh
//
// Physical volumes are the names for a scene's `volume`, physical surfaces become the faces slab.bottom, stamp.top, ...

Mesh.SubdivisionAlgorithm = 1; // recombined surfaces hold quadrilaterals only
Mesh.RecombineAll = 1;
Mesh.MshFileVersion = 4.1;

// Slab
length = 4; width = 4; height = 1;
Point(1) = {-length/2, -width/2, -height};
Point(2) = { length/2, -width/2, -height};
Point(3) = { length/2,  width/2, -height};
Point(4) = {-length/2,  width/2, -height};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 4;
Transfinite Curve {2, 4} = 4;
Transfinite Surface {1};
slab[] = Extrude {0, 0, height} { Surface{1}; Layers{2}; Recombine; };

// Stamp, its underside at the slab's top
radius = 0.6; tall = 0.8;
Point(101) = {0, 0, 0, 0.6};
Point(102) = { radius, 0, 0, 0.6};
Point(103) = {0,  radius, 0, 0.6};
Point(104) = {-radius, 0, 0, 0.6};
Point(105) = {0, -radius, 0, 0.6};
Circle(101) = {102, 101, 103}; Circle(102) = {103, 101, 104};
Circle(103) = {104, 101, 105}; Circle(104) = {105, 101, 102};
Curve Loop(101) = {101, 102, 103, 104};
Plane Surface(101) = {101};
stamp[] = Extrude {0, 0, tall} { Surface{101}; Layers{3}; Recombine; };

Physical Volume("slab") = {slab[1]};
Physical Volume("stamp") = {stamp[1]};
Physical Surface("bottom") = {1};
Physical Surface("contact") = {slab[0], 101};
Physical Surface("top") = {stamp[0]};
Physical Surface("side") = {stamp[2], stamp[3], stamp[4], stamp[5]};
