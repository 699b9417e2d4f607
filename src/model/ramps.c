/* The load program: factors of ramps at a given time. */
#include <model.h>

/*@C
   SceneGetFactor - Factor of a ramp at a time

   Not Collective

   Input Parameters:
+  scene - the scene
.  ramp  - index of the ramp; 0 is the load itself
-  time  - load step k, counted from 1, ends at time k; 0 is the start

   Output Parameter:
.  factor - linear between the ends of the load steps, 0 at time 0

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
    const PetscReal from = step ? end[step - 1] : 0.0;

    *factor = from + (time - (PetscReal)step) * (end[step] - from);
  }
  PetscFunctionReturn(0);
}
