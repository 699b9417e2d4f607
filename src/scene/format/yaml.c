/*
   Checks that a scene is YAML that can be read. YAML has anchors, &name, and aliases, *name. The reader replaces
   aliases by the anchored values: an anchor that contains its own alias would never end, and nested aliases could
   exhaust memory. Therefore anchored values must not contain aliases.
*/
#include "repeated.h"
#include <string.h>

/*
   Returns whether the event is an alias inside an anchored value. *anchored: number of mappings and lists that have
   begun since the outermost anchor and not ended; 0 outside of anchored values.
*/
static PetscBool YAMLIsNested(const yaml_event_t *event, PetscInt *anchored)
{
  const yaml_char_t *anchor = NULL;

  switch (event->type) {
  case YAML_ALIAS_EVENT: return *anchored ? PETSC_TRUE : PETSC_FALSE;
  case YAML_MAPPING_START_EVENT: anchor = event->data.mapping_start.anchor; break;
  case YAML_SEQUENCE_START_EVENT: anchor = event->data.sequence_start.anchor; break;
  case YAML_MAPPING_END_EVENT:
  case YAML_SEQUENCE_END_EVENT:
    if (*anchored) --*anchored;
    return PETSC_FALSE;
  default: return PETSC_FALSE;
  }
  if (*anchored || anchor) ++*anchored;
  return PETSC_FALSE;
}

/* Returns an explanation of the parser's error in words for authors of scenes. */
static const char *YAMLExplain(const char problem[])
{
  static const char *const words[][2] = {
    {"did not find expected key", "the indentation differs from that of the keys above, or a colon is missing"},
    {"did not find expected '-' indicator",
      "a list goes on or ends here, but the line is not indented like its dashes"},
    {"did not find expected ',' or ']'", "a bracket [ is not closed, or a comma is missing"},
    {"did not find expected ',' or '}'", "a brace { is not closed, or a comma is missing"},
    {"could not find expected ':'", "a key lacks its colon and the blank after it"},
    {"mapping values are not allowed in this context", "there is one colon too many, or the line is indented too far"},
    {"found unexpected end of stream", "a quotation mark is not closed"},
    {"found character that cannot start any token", "a value begins with a character that YAML reserves: quote it"},
  };

  for (size_t i = 0; problem && i < PETSC_STATIC_ARRAY_LENGTH(words); ++i) {
    if (!strcmp(problem, words[i][0])) return words[i][1];
  }
  return problem ? problem : "it cannot be read";
}

/*
   Raises the error of the parser. The error is at the line where the parser stopped, or between this line and the line
   where the bracket, the quotation or the indented block begins. text: the whole text.
*/
static PetscErrorCode YAMLRaise(const yaml_parser_t *parser, const char text[])
{
  const size_t line = parser->problem_mark.line + 1, start = parser->context ? parser->context_mark.line + 1 : line;
  PetscBool    tab;
  char         from[64] = "";

  PetscFunctionBegin;
  PetscCheck(parser->error != YAML_READER_ERROR, PETSC_COMM_SELF, PETSC_ERR_FILE_READ,
    "byte %zu: the file is not text: %s", parser->problem_offset + 1, parser->problem);
  for (size_t l = 1; l < line && strchr(text, '\n'); ++l) text = strchr(text, '\n') + 1;
  tab = (PetscBool)(text[strspn(text, " ")] == '\t' && strspn(text, " ") == parser->problem_mark.column);
  PetscCheck(!tab, PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "line %zu: it is indented by a tab; YAML needs spaces", line);
  if (start < line) (void)snprintf(from, sizeof(from), " (or above it, from line %zu on)", start);
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "line %zu%s: %s", line, from, YAMLExplain(parser->problem));
}

static PetscErrorCode YAMLReadEvents(yaml_parser_t *parser, const char text[], RepeatedKeys *keys)
{
  yaml_event_t   event;
  PetscInt       anchored = 0;
  PetscBool      end      = PETSC_FALSE, nested;
  size_t         line;
  PetscErrorCode ierr;

  PetscFunctionBegin;
  while (!end) {
    if (!yaml_parser_parse(parser, &event)) PetscCall(YAMLRaise(parser, text));
    end    = event.type == YAML_STREAM_END_EVENT ? PETSC_TRUE : PETSC_FALSE;
    nested = YAMLIsNested(&event, &anchored);
    line   = event.start_mark.line + 1;
    ierr   = nested ? 0 : RepeatedKeysRead(keys, &event);
    yaml_event_delete(&event);
    PetscCheck(!nested, PETSC_COMM_SELF, PETSC_ERR_FILE_READ,
      "line %zu: the value of an anchor (&name) holds an alias (*name), which is not allowed in scenes", line);
    PetscCall(ierr);
  }
  PetscCall(RepeatedKeysCheck(keys));
  PetscFunctionReturn(0);
}

/*
   Checks the text. *places: place of every key. Keys that are not names, or are repeated, raise PETSC_ERR_USER_INPUT.
*/
PetscErrorCode SceneCheckYAML(const char file[], size_t length, const char text[], ScenePlaces *places)
{
  yaml_parser_t  parser;
  RepeatedKeys   keys = {0};
  const size_t   mark = strncmp(text, "\xef\xbb\xbf", 3) ? 0 : 3; /* length of the UTF-8 byte order mark with which
                                                                     some editors begin files */
  PetscErrorCode ierr;

  PetscFunctionBegin;
  PetscCheck(yaml_parser_initialize(&parser), PETSC_COMM_SELF, PETSC_ERR_MEM, "not enough memory to parse it");
  yaml_parser_set_input_string(&parser, (const unsigned char *)text + mark, length - mark);
  yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
  ierr = YAMLReadEvents(&parser, text, &keys);
  yaml_parser_delete(&parser);
  PetscCall(RepeatedKeysGetPlaces(&keys, file, places));
  PetscCall(RepeatedKeysDestroy(&keys));
  PetscCall(ierr);
  PetscFunctionReturn(0);
}
