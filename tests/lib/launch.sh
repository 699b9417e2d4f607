#!/bin/sh
# launch.sh MPIEXEC [FLAG ...] -n RANKS PROGRAM [ARGUMENT ...]: one rank runs without MPIEXEC, which takes a quarter of a second to start
launcher=
while [ "$1" != -n ]; do launcher="$launcher $1"; shift; done
if [ "$2" = 1 ]; then shift 2; launcher=; fi
exec $launcher "$@"
