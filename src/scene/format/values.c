/*
   Values of a scene file by their full keys. Nested keys are joined with _; a list becomes its entries separated by
   commas. A list entry that is a mapping with one key is named by this key, and its values are nested under the list.
   The result is that of PetscOptionsInsertStringYAML(), but the number of keys is not limited.
*/
#include "formatimpl.h"
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <yaml.h>

#define VALUES_DEPTH 25 /* largest number of nested mappings */

static const char *ValuesText(const yaml_node_t *node)
{
  return (const char *)node->data.scalar.value;
}

static PetscErrorCode ValuesAdd(SceneValues *v, const char prefix[], const char key[], const char text[])
{
  SceneValue *value;
  size_t      length;

  PetscFunctionBegin;
  if (v->n == v->max) {
    v->max = 2 * v->max + 64;
    PetscCall(PetscRealloc(v->max * sizeof(*v->values), &v->values));
  }
  value  = &v->values[v->n];
  *value = (SceneValue){.place = v->n++};
  length = strlen(prefix) + strlen(key) + 1;
  PetscCall(PetscMalloc1(length, &value->key));
  PetscCall(PetscSNPrintf(value->key, length, "%s%s", prefix, key));
  PetscCall(PetscStrallocpy(text, &value->text));
  PetscFunctionReturn(0);
}

static PetscErrorCode ValuesReadMapping(SceneValues *, yaml_document_t *, const yaml_node_t *, PetscInt depth,
  const char prefix[]);

/* Reads the values of a mapping that is nested under a key. */
static PetscErrorCode ValuesReadNested(SceneValues *v, yaml_document_t *doc, const yaml_node_t *node, PetscInt depth,
  const char prefix[], const char key[])
{
  const size_t length = strlen(prefix) + strlen(key) + 2;
  char        *nested;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(length, &nested));
  PetscCall(PetscSNPrintf(nested, length, "%s%s_", prefix, key));
  PetscCall(ValuesReadMapping(v, doc, node, depth + 1, nested));
  PetscCall(PetscFree(nested));
  PetscFunctionReturn(0);
}

static PetscErrorCode ValuesAppend(const char word[], size_t *length, char **list)
{
  const size_t more = strlen(word);

  PetscFunctionBegin;
  if (!more) PetscFunctionReturn(0);
  PetscCall(PetscRealloc(*length + more + 2, list));
  if (*length) (*list)[(*length)++] = ',';
  PetscCall(PetscArraycpy(*list + *length, word, more + 1));
  *length += more;
  PetscFunctionReturn(0);
}

static PetscErrorCode ValuesReadSequence(SceneValues *v, yaml_document_t *doc, const yaml_node_t *node, PetscInt depth,
  const char prefix[], const char key[])
{
  char  *list;
  size_t length = 0;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(1, &list));
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; ++i) {
    const yaml_node_t      *item = yaml_document_get_node(doc, *i);
    const yaml_node_pair_t *pair;
    const yaml_node_t      *name;

    if (item->type == YAML_SCALAR_NODE) {
      PetscCall(ValuesAppend(ValuesText(item), &length, &list));
      continue;
    }
    PetscCheck(item->type == YAML_MAPPING_NODE, PETSC_COMM_SELF, PETSC_ERR_SUP,
      "line %zu: a list in a list is not expected here", item->start_mark.line + 1);
    pair = item->data.mapping.pairs.start;
    PetscCheck(item->data.mapping.pairs.top - pair <= 1, PETSC_COMM_SELF, PETSC_ERR_SUP,
      "line %zu: an entry of a list has one name: - name: {key: value, ...}", item->start_mark.line + 1);
    if (item->data.mapping.pairs.top == pair) continue;
    name = yaml_document_get_node(doc, pair->key);
    PetscCheck(name->type == YAML_SCALAR_NODE, PETSC_COMM_SELF, PETSC_ERR_SUP, "line %zu: a name is expected here",
      name->start_mark.line + 1);
    PetscCheck(strcmp(ValuesText(name), "<<"), PETSC_COMM_SELF, PETSC_ERR_SUP,
      "line %zu: a merge key, <<, is not an entry of a list", name->start_mark.line + 1);
    PetscCall(ValuesReadNested(v, doc, item, depth, prefix, key));
    PetscCall(ValuesAppend(ValuesText(name), &length, &list));
  }
  PetscCall(ValuesAdd(v, prefix, key, list));
  PetscCall(PetscFree(list));
  PetscFunctionReturn(0);
}

/* Reads the value of a merge key, <<, whose keys become keys of the mapping that contains it. */
static PetscErrorCode ValuesReadMerged(SceneValues *v, yaml_document_t *doc, const yaml_node_t *node, PetscInt depth,
  const char prefix[])
{
  PetscFunctionBegin;
  if (node->type != YAML_SEQUENCE_NODE) {
    PetscCall(ValuesReadMapping(v, doc, node, depth + 1, prefix));
    PetscFunctionReturn(0);
  }
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; ++i)
    PetscCall(ValuesReadMapping(v, doc, yaml_document_get_node(doc, *i), depth + 1, prefix));
  PetscFunctionReturn(0);
}

static PetscErrorCode ValuesReadMapping(SceneValues *v, yaml_document_t *doc, const yaml_node_t *node, PetscInt depth,
  const char prefix[])
{
  PetscFunctionBegin;
  PetscCheck(depth < VALUES_DEPTH, PETSC_COMM_SELF, PETSC_ERR_SUP, "more than %d mappings are nested", VALUES_DEPTH);
  if (node->type == YAML_SCALAR_NODE && !ValuesText(node)[0]) PetscFunctionReturn(0);
  PetscCheck(node->type == YAML_MAPPING_NODE, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "line %zu: keys with values are expected here, as in problem: name; a mesh is read by a body with "
    "shape: gmsh, mesh: FILE in a scene",
    node->start_mark.line + 1);
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key), *value = yaml_document_get_node(doc, p->value);

    PetscCheck(key->type == YAML_SCALAR_NODE, PETSC_COMM_SELF, PETSC_ERR_SUP, "line %zu: a key is expected here",
      key->start_mark.line + 1);
    if (!strcmp(ValuesText(key), "<<")) PetscCall(ValuesReadMerged(v, doc, value, depth, prefix));
    else if (value->type == YAML_SCALAR_NODE) PetscCall(ValuesAdd(v, prefix, ValuesText(key), ValuesText(value)));
    else if (value->type == YAML_SEQUENCE_NODE)
      PetscCall(ValuesReadSequence(v, doc, value, depth, prefix, ValuesText(key)));
    else PetscCall(ValuesReadNested(v, doc, value, depth, prefix, ValuesText(key)));
  }
  PetscFunctionReturn(0);
}

/* Compares values by their keys, regardless of upper and lower case. */
static int ValuesCompareKeys(const void *a, const void *b)
{
  return strcasecmp(((const SceneValue *)a)->key, ((const SceneValue *)b)->key);
}

/* Compares values by their keys; of two values with the same key, the one that comes later in the file is the first. */
static int ValuesCompare(const void *a, const void *b)
{
  const int order = ValuesCompareKeys(a, b);

  return order ? order : ((const SceneValue *)a)->place < ((const SceneValue *)b)->place ? 1 : -1;
}

/* Sorts the values. Of several values with the same key only the last in the file remains. */
static PetscErrorCode ValuesSort(SceneValues *v)
{
  PetscInt n = 0;

  PetscFunctionBegin;
  if (v->n) qsort(v->values, (size_t)v->n, sizeof(*v->values), ValuesCompare);
  for (PetscInt i = 0; i < v->n; ++i) {
    if (n && !ValuesCompareKeys(&v->values[n - 1], &v->values[i])) {
      PetscCall(PetscFree(v->values[i].key));
      PetscCall(PetscFree(v->values[i].text));
    } else v->values[n++] = v->values[i];
  }
  v->n = n;
  PetscFunctionReturn(0);
}

/* Not collective. Reads the values of a text that SceneCheckYAML() has checked. v: initialized with zeros. */
PetscErrorCode SceneValuesRead(const char text[], SceneValues *v)
{
  yaml_parser_t   parser;
  yaml_document_t doc;
  PetscErrorCode  ierr = 0;
  PetscBool       more = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCheck(yaml_parser_initialize(&parser), PETSC_COMM_SELF, PETSC_ERR_MEM, "not enough memory to parse it");
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, strlen(text));
  while (more && !ierr) {
    if (!yaml_parser_load(&parser, &doc)) {
      const PetscBool undefined = (PetscBool)(parser.problem && !strcmp(parser.problem, "found undefined alias"));
      const size_t    line      = parser.problem_mark.line + 1;
      const char     *problem   = parser.problem ? parser.problem : "it cannot be read";

      yaml_parser_delete(&parser); /* the problem is a text of the library */
      SETERRQ(PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "line %zu: %s", line,
        undefined ? "the alias (*name) has no anchor (&name) before it; quote a value that begins with *" : problem);
    }
    more = (PetscBool)(yaml_document_get_root_node(&doc) != NULL);
    if (more) ierr = ValuesReadMapping(v, &doc, yaml_document_get_root_node(&doc), 0, "");
    yaml_document_delete(&doc);
  }
  yaml_parser_delete(&parser);
  PetscCall(ierr);
  PetscCall(ValuesSort(v));
  PetscFunctionReturn(0);
}

/* Marks the value of a key as used, and returns its text. NULL: there is no such key. */
const char *SceneValuesUse(SceneValues *v, const char key[])
{
  const SceneValue wanted = {.key = (char *)key};
  SceneValue      *value =
    v->n ? (SceneValue *)bsearch(&wanted, v->values, (size_t)v->n, sizeof(wanted), ValuesCompareKeys) : NULL;

  if (!value) return NULL;
  value->used = PETSC_TRUE;
  return value->text;
}

PetscErrorCode SceneValuesDestroy(SceneValues *v)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < v->n; ++i) {
    PetscCall(PetscFree(v->values[i].key));
    PetscCall(PetscFree(v->values[i].text));
  }
  PetscCall(PetscFree(v->values));
  *v = (SceneValues){0};
  PetscFunctionReturn(0);
}
