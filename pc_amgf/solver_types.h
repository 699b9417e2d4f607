/* The factorization of tao_ipfilter/friction in a PETSc without MUMPS */
#ifndef AMGF_SOLVER_TYPES_H
#define AMGF_SOLVER_TYPES_H

#define MATSOLVERAMGF MATSOLVERCHOLMOD

#endif
