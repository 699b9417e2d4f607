#define FUZZ_TARGET FuzzMeshGmsh
#include "libfuzzer.h"
