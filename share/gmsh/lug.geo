// A flat bar pulled by a pin in its hole, with a shoulder of fillets: a quarter of it, bar and pin in one file, tetrahedra with 10 nodes.
//
//   gmsh -3 share/gmsh/lug.geo -setnumber size 1.4 -o lug.msh                 tetrahedra, as shipped
//   gmsh -3 share/gmsh/lug.geo -setnumber hexahedra 1 -o lug_hexahedra.msh    hexahedra with 27 nodes, on sweeps of quadrilaterals
//   gmsh -3 share/gmsh/lug.geo -setnumber size 0.7 -o lug_fine.msh            smaller ones
//   gmsh -3 share/gmsh/lug.geo -setnumber thick 0.2 -o lug_thin.msh           another thickness, or width (narrow), or radius (fillet)
//
// Physical volumes are the names for a scene's `volume`, physical surfaces become the faces bar.hole, pin.round, ...

If (!Exists(hexahedra)) hexahedra = 0; EndIf
If (!Exists(size)) size = 1; EndIf
If (!Exists(narrow)) narrow = 7.5; EndIf // half widths
If (!Exists(fillet)) fillet = 2; EndIf
If (!Exists(thick)) thick = 2; EndIf    // half of it
Mesh.ElementOrder = 2;
Mesh.MshFileVersion = 4.1;
If (hexahedra)
  Mesh.SubdivisionAlgorithm = 1;
  Mesh.RecombineAll = 1;
EndIf

wide = 15; shoulder = 45; end = 85; // along the bar
hole = 6; pin = 5.9;                // radii
coarse = 4 * size; fine = 0.5 * size; near = 0.9 * size;

Point(1) = {-20, 0, 0, coarse};
Point(2) = {-hole, 0, 0, near};
Point(3) = {0, 0, 0, near};
Point(4) = {0, hole, 0, near};
Point(5) = {hole, 0, 0, 2 * near};
Point(6) = {end, 0, 0, coarse};
Point(7) = {end, narrow, 0, coarse};
Point(8) = {shoulder + fillet + 4, narrow, 0, 3 * fine};
Point(9) = {shoulder + fillet, narrow, 0, fine};
Point(10) = {shoulder + fillet, narrow + fillet, 0, fine};
Point(11) = {shoulder, narrow + fillet, 0, fine};
Point(12) = {shoulder, wide, 0, coarse};
Point(13) = {-20, wide, 0, coarse};
Line(1) = {1, 2}; Circle(2) = {2, 3, 4}; Circle(3) = {4, 3, 5}; Line(4) = {5, 6}; Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 9};
Circle(8) = {9, 10, 11}; Line(9) = {11, 12}; Line(10) = {12, 13}; Line(11) = {13, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
Plane Surface(1) = {1};

// The pin touches the hole on the left
shift = pin - hole;
Point(21) = {shift - pin, 0, 0, near};
Point(22) = {shift, 0, 0, 2 * near};
Point(23) = {shift, pin, 0, near};
Point(24) = {shift + pin, 0, 0, 2 * near};
Line(21) = {21, 24}; Circle(22) = {24, 22, 23}; Circle(23) = {23, 22, 21};
Curve Loop(21) = {21, 22, 23};
Plane Surface(21) = {21};

If (hexahedra)
  bar[] = Extrude {0, 0, thick} { Surface{1}; Layers{1}; Recombine; };
  bolt[] = Extrude {0, 0, thick} { Surface{21}; Layers{1}; Recombine; };
Else
  bar[] = Extrude {0, 0, thick} { Surface{1}; };
  bolt[] = Extrude {0, 0, thick} { Surface{21}; };
EndIf

Physical Volume("bar") = {bar[1]};
Physical Volume("pin") = {bolt[1]};
Physical Surface("middle") = {1, 21};               // z = 0
Physical Surface("axis") = {bar[2], bar[5], bolt[2]}; // y = 0
Physical Surface("hole") = {bar[3], bar[4]};
Physical Surface("end") = {bar[6]};
Physical Surface("fillet") = {bar[9]};
Physical Surface("round") = {bolt[3], bolt[4]};
