/* Element types of Gmsh files of first and second order, by Gmsh's number */
#include "gmshimpl.h"

static const GmshType types[20] = {[1] = {"segment", 1, 2, 2},
  [2]                                  = {"triangle", 2, 3, 3},
  [3]                                  = {"quadrilateral", 2, 4, 4},
  [4]                                  = {"tetrahedron", 3, 4, 4},
  [5]                                  = {"hexahedron", 3, 8, 8},
  [6]                                  = {"triangular_prism", 3, 6, 6},
  [7]                                  = {"pyramid", 3, 5, 5},
  [8]                                  = {"segment", 1, 3, 2},
  [9]                                  = {"triangle", 2, 6, 3},
  [10]                                 = {"quadrilateral", 2, 9, 4},
  [11]                                 = {"tetrahedron", 3, 10, 4},
  [12]                                 = {"hexahedron", 3, 27, 8},
  [13]                                 = {"triangular_prism", 3, 18, 6},
  [14]                                 = {"pyramid", 3, 14, 5},
  [15]                                 = {"point", 0, 1, 1},
  [16]                                 = {"quadrilateral", 2, 8, 4},
  [17]                                 = {"hexahedron", 3, 20, 8},
  [18]                                 = {"triangular_prism", 3, 15, 6},
  [19]                                 = {"pyramid", 3, 13, 5}};

/* Returns the type, or NULL if it is neither of first nor of second order */
const GmshType *GmshGetType(PetscInt64 type)
{
  return type >= 1 && type < 20 ? &types[type] : NULL;
}
