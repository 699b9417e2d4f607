/*
   Compiles a function for several instruction sets, among which the loader chooses. Sanitizers do not work with this,
   since they are not yet initialized when the loader chooses.
*/
#ifndef AMGF_CLONES_H
#define AMGF_CLONES_H

#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && defined(__x86_64__) && defined(__gnu_linux__) && \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(AMGF_PLAIN_C)
  #define AMGF_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
  #define AMGF_CLONES
#endif

#endif
