/* Adds the file and the line to messages about entries of a scene */
#include "sceneimpl.h"
#include <string.h>

/* Messages about options begin with a dash. The file does not contain what they are about. */
void SceneAddPlace(Scene scene, size_t size, char message[])
{
  const size_t line = scene->file && message[0] != '-' ? SceneLinesFind(&scene->lines, message) : 0;
  char         copy[1024];

  if (!line || !strncmp(message, scene->file, strlen(scene->file))) return;
  (void)snprintf(copy, sizeof(copy), "%s", message);
  (void)snprintf(message, size, "%.255s: line %zu: %.760s", scene->file, line, copy);
}
