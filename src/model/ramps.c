/* The load program: factors of ramps at a given time */
#include <model.h>

/*@C
   SceneGetFactor - Factor of a ramp at a time

   Not Collective

   Input Parameters:
+  scene - the scene
.  ramp  - index of the ramp; 0 is the load itself
-  time  - load step k, counted from 1, ends at time k; 0 is the start

   Output Parameter:
.  factor - linear between the ends of the load steps; at time 0 that of the start, which is 0 in a static analysis

   Level: intermediate

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneGetFactor(Scene scene, PetscInt ramp, PetscReal time, PetscReal *factor)
{
  const PetscReal *end = scene->ramps[ramp].factor;
  /* index of the load step that contains the time */
  const PetscInt step = PetscMin(scene->nsteps - 1, (PetscInt)PetscFloorReal(time));

  PetscFunctionBegin;
  if (time >= (PetscReal)scene->nsteps) *factor = end[scene->nsteps - 1];
  else {
    const PetscReal from = step ? end[step - 1] : scene->ramps[ramp].start;

    *factor = from + (time - (PetscReal)step) * (end[step] - from);
  }
  PetscFunctionReturn(0);
}
