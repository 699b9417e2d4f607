/* The place of an entry in the scene file, for messages about what only the mesh shows */
#include <model.h>

const char *ScenePlace(Scene scene, size_t line, char text[PETSC_MAX_PATH_LEN])
{
  text[0] = 0;
  if (scene->file && line) (void)snprintf(text, PETSC_MAX_PATH_LEN, "%s: line %zu: ", scene->file, line);
  return text;
}
