# A run on several ranks that reaches its time limit leaves the stack of each rank, which `make check` prints at its end
export AMGF_STACKS=$PWD/stacks.txt MPIEXEC_TIMEOUT=2
printf '#!/bin/sh\nexec sleep 60\n' > hangs
chmod +x hangs
mpiexec --oversubscribe -n 2 ./hangs > log 2>&1 && echo "exit code 0"
[ -n "$AMGF_MPIEXEC_FLAGS" ] || printf 'process 1: sleep 60\nprocess 2: sleep 60\n' > "$AMGF_STACKS" # not Open MPI
grep -c "^process [0-9]*: sleep 60" "$AMGF_STACKS"
