/*
   Is a scene YAML that PETSc can read? YAML has anchors, &name, and aliases, *name. PETSc's reader expands an alias where it stands, so that an anchor which holds its own
   alias never ends, and anchors of aliases of anchors outgrow any memory. Anchored values of a scene therefore hold no aliases.
*/
#include "sceneimpl.h"
#include <yaml.h>

/* anchored: brackets and indentations open since the outermost anchor, this one's included; 0 outside of anchored values */
static PetscBool YAMLIsNested(const yaml_event_t *event, PetscInt *anchored)
{
  const yaml_char_t *anchor = NULL;

  switch (event->type) {
  case YAML_ALIAS_EVENT:
    return *anchored ? PETSC_TRUE : PETSC_FALSE;
  case YAML_MAPPING_START_EVENT:
    anchor = event->data.mapping_start.anchor;
    break;
  case YAML_SEQUENCE_START_EVENT:
    anchor = event->data.sequence_start.anchor;
    break;
  case YAML_MAPPING_END_EVENT:
  case YAML_SEQUENCE_END_EVENT:
    if (*anchored) --*anchored;
    return PETSC_FALSE;
  default:
    return PETSC_FALSE;
  }
  if (*anchored || anchor) ++*anchored;
  return PETSC_FALSE;
}

PetscErrorCode SceneCheckYAML(size_t length, const char text[])
{
  yaml_parser_t parser;
  yaml_event_t  event;
  PetscInt      anchored      = 0;
  PetscBool     end           = PETSC_FALSE;
  char          sentence[256] = "";

  PetscFunctionBegin;
  PetscCheck(yaml_parser_initialize(&parser), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to parse it");
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
  while (!end && !sentence[0]) {
    if (yaml_parser_parse(&parser, &event)) {
      end = event.type == YAML_STREAM_END_EVENT ? PETSC_TRUE : PETSC_FALSE;
      if (YAMLIsNested(&event, &anchored)) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "line %zu: the value of an anchor (&name) holds an alias (*name), which scenes may not do", event.start_mark.line + 1));
      yaml_event_delete(&event);
    } else if (parser.error == YAML_READER_ERROR) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "byte %zu: %s", parser.problem_offset + 1, parser.problem));
    else PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "line %zu: %s", parser.problem_mark.line + 1, parser.problem ? parser.problem : "it cannot be read"));
  }
  yaml_parser_delete(&parser);
  PetscCheck(!sentence[0], PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "%s", sentence);
  PetscFunctionReturn(0);
}
