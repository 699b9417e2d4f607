#define FUZZ_TARGET FuzzMeshScene
#include "libfuzzer.h"
