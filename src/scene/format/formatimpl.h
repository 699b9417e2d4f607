/*
   Format of scene files: reads keys from text, and values from keys. The functions do not depend on the keys that a
   scene has.
*/
#ifndef FORMATIMPL_H
#define FORMATIMPL_H

#include <model.h>
#include <rankerror.h>

/* yaml.c: Not collective. Raises an error if the text is not YAML that can be read */
PETSC_INTERN PetscErrorCode SceneCheckYAML(const char file[], size_t length, const char text[], ScenePlaces *);

/* values.c: values sorted by their full keys. Initialize SceneValues with zeros. */
typedef struct {
  char     *key, *text;
  PetscInt  place; /* position in the file: number of values before it */
  PetscBool used;
} SceneValue;

typedef struct {
  PetscInt    n, max;
  SceneValue *values;
} SceneValues;

PETSC_INTERN PetscErrorCode SceneValuesRead(const char text[], SceneValues *);
PETSC_INTERN const char    *SceneValuesUse(SceneValues *, const char key[]);
PETSC_INTERN PetscErrorCode SceneValuesDestroy(SceneValues *);

/*
   keys.c: keys and values of a scene file. Each reader asks for a full key, in which nested keys are joined with _.
   Keys for which no reader asked are reported as unknown. A wrong or missing value is recorded instead of raised at
   once, because an unknown key often explains the error better.
*/
typedef struct {
  char       *name;
  const char *place;
  Material    material;
} SceneMaterial;

typedef struct {
  MPI_Comm                   comm;
  const char                *file;
  SceneValues                values;
  PetscInt                   nasked, maxasked;
  char                     **asked;
  const struct _n_SceneList *list; /* list that is being read */
  const struct _n_SceneKey  *top;  /* rows of the top level, for messages about unknown keys */
  ScenePlaces                places;
  char                       error[1024]; /* first error; empty if there is none */
  PetscBool                  decides;     /* true if the error concerns a value that determines which keys are valid;
                                             such an error is reported before unknown keys */

  char           library[PETSC_MAX_PATH_LEN]; /* text that says where materials may be defined; empty if there is no
                                                 library */
  PetscInt       nmaterials;                  /* number of named materials that have been read */
  SceneMaterial *materials;
} * SceneKeys;

#define SCENE_KEY_LENGTH 256

PETSC_INTERN PetscErrorCode SceneKeysCreate(MPI_Comm, const char file[], SceneKeys *);
PETSC_INTERN PetscErrorCode SceneKeysGet(SceneKeys, PetscBool required, const char **value, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
/*
   Records an error unless one has been recorded. It is about the key <owner>_<key>, or about `owner` if `key` is NULL.
   The message is the place and the name of the key, and then the text.
*/
PETSC_INTERN PetscErrorCode SceneKeysError(SceneKeys, const char owner[], const char key[], const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode SceneKeysCheck(SceneKeys);
PETSC_INTERN PetscErrorCode SceneKeysDestroy(SceneKeys *);
/* Makes a file name relative to the folder of the scene. */
PETSC_INTERN PetscErrorCode SceneResolveFile(const char scene[], char **file);

/*
   key_places.c: SceneFindPlace() returns the place of a key; NULL: the file does not have it. SceneGetPlace() returns
   the place of a key, or else of the entry or list to which it belongs, or else the file.
*/
PETSC_INTERN const char    *SceneFindPlace(const ScenePlaces *, const char key[]);
PETSC_INTERN const char    *SceneGetPlace(const ScenePlaces *, const char key[]);
PETSC_INTERN PetscErrorCode SceneDestroyPlaces(ScenePlaces *);

/*
   nested.c: SceneKeysSay() writes a full key as a user writes it: bodies_slab_young is key "young" of body "slab".
   bare: a key of the top level has no quotation marks. SceneKeyOf() returns the last part of a full key.
*/
PETSC_INTERN const char *SceneKeyOf(SceneKeys, const char key[]);
PETSC_INTERN void        SceneKeysSay(SceneKeys, const char key[], PetscBool bare, size_t size, char text[]);

/*
   parse.c: converts texts to values. key: key for error messages. A list must have *n entries, or any number of entries
   if *n is PETSC_DECIDE on entry.
*/
PETSC_INTERN PetscErrorCode SceneParseReal(SceneKeys, const char key[], const char text[], PetscReal *);
PETSC_INTERN PetscErrorCode SceneParseInt(SceneKeys, const char key[], const char text[], PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseEnum(SceneKeys, const char key[], const char text[], const char *const names[],
  PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseAnswer(SceneKeys, const char key[], const char text[], PetscBool *);
PETSC_INTERN PetscErrorCode SceneParseList(SceneKeys, const char key[], const char text[], PetscInt *n, char ***words);
PETSC_INTERN PetscErrorCode SceneParseReals(SceneKeys, const char key[], const char text[], PetscInt n, PetscReal[]);
PETSC_INTERN PetscErrorCode SceneParseBounds(SceneKeys, const char key[], const char text[], PetscInt n, PetscReal[]);
PETSC_INTERN PetscErrorCode SceneParseInts(SceneKeys, const char key[], const char text[], PetscInt n, PetscInt[]);
PETSC_INTERN PetscErrorCode SceneParseBody(SceneKeys, Scene, const char key[], const char text[], PetscInt *body);
PETSC_INTERN PetscErrorCode SceneParseRamp(SceneKeys, Scene, const char key[], const char text[], PetscInt *ramp);
PETSC_INTERN PetscBool      SceneIsName(const char[]);
PETSC_INTERN PetscErrorCode SceneGetNames(SceneKeys, const char key[], PetscBool required, PetscInt *n, char ***names);

/*
   numbers.c: SceneViewReal() prints a number such that the same number is read back; SceneViewList() prints [values];
   SceneViewReals() prints name: [values]
*/
PETSC_INTERN PetscErrorCode SceneViewReal(PetscViewer, PetscReal);
PETSC_INTERN PetscErrorCode SceneViewList(PetscViewer, PetscInt n, const PetscReal[]);
PETSC_INTERN PetscErrorCode SceneViewReals(PetscViewer, const char name[], PetscInt n, const PetscReal[]);

/*
   expression.c: evaluates expressions of time; checks the syntax of expressions of position, which SceneEvaluatePlace()
   evaluates
*/
PETSC_INTERN PetscErrorCode SceneEvaluate(SceneKeys, const char key[], const char text[], PetscReal time, PetscReal end,
  PetscReal *);
PETSC_INTERN PetscErrorCode SceneCheckExpression(SceneKeys, const char key[], const char text[]);

/*
   table.c: reads the factors of a ramp at the ends of the load steps, and in a dynamic analysis at time 0, from an
   expression or from a table of times and values. *found: true if the key has either
*/
PETSC_INTERN PetscErrorCode SceneReadProgram(SceneKeys, const char key[], Scene, SceneRamp *, PetscBool *found);

/*
   Table of keys, whose rows are in sections/keytable.c. A row describes one key. Its value is read into a member (at a
   byte offset) of a struct of model.h, printed unless it has its initial value, and freed if it is a text.
*/
typedef enum {
  SCENE_REALS,
  SCENE_INTS,
  SCENE_ANSWER, /* true or false */
  SCENE_CHOICE, /* enumeration, given by names */
  SCENE_AXIS,   /* enumeration of axes, given by names and stored as PetscInt */
  SCENE_TEXT,
  SCENE_EXPRESSION, /* expression of position, stored as text */
  SCENE_BODY,       /* name of a body, stored as its number */
  SCENE_RAMP,       /* name of a ramp, stored as its number */
  SCENE_OWN,
  SCENE_SECTION /* read and printed by a file in sections/ */
} SceneKeyType;

typedef enum {
  SCENE_OPTIONAL,
  SCENE_SHOWN, /* optional, but always printed */
  SCENE_REQUIRED
} SceneNeed;

typedef enum { SCENE_ANY, SCENE_ABOVE_0, SCENE_FROM_0, SCENE_UNBOUNDED /* may be infinite */ } SceneRange;

/* Functions for a value with its own syntax. */
typedef struct {
  PetscErrorCode (*read)(SceneKeys, Scene, const char key[], const char text[], void *entry);
  PetscBool (*shown)(const void *entry);
  PetscErrorCode (*view)(Scene, PetscViewer, const void *entry);
  PetscInt ntexts; /* number of texts that `read` allocates, which are stored one after the other */
} SceneOwn;

typedef struct _n_SceneKey {
  const char        *name;
  const char        *of; /* shapes or material laws that have the key, separated by blanks; NULL: all */
  SceneKeyType       type;
  PetscInt           n; /* number of values */
  size_t             at;
  SceneNeed          need;
  SceneRange         range;
  const char *const *names; /* names of an enumeration */
  const SceneOwn    *own;
  const char        *unit, *otherwise, *help; /* unit with F for force and L for length; default if the key is
                                                 missing; meaning in one sentence */
} SceneKey;

typedef struct _n_SceneList {
  const char     *name;
  const SceneKey *rows;
  size_t          size;             /* size of an entry, whose first member is its name */
  size_t          count, entries;   /* offsets in the scene of the number of entries and of the array; 0: a file in
                                       sections/ reads the list */
  const void     *initial;          /* initial value of an entry; NULL: zeros */
  PetscBool       required, shared; /* required: true if the list must not be empty; shared: true if another list
                                       frees the entries */
  /* called after the rows of an entry have been read; may be NULL */
  PetscErrorCode (*finish)(SceneKeys, Scene, const char owner[], void *entry);
  /* holds: returns whether an entry of a shared array belongs to this list; hides: returns whether a key is not
     printed; both may be NULL */
  PetscBool (*holds)(const void *entry);
  PetscBool (*hides)(const void *entry, const char key[]);
} SceneList;

/* table_rows.c: reads, prints and frees entries with the rows of the table */
PETSC_INTERN PetscErrorCode SceneReadRows(SceneKeys, Scene, const char owner[], const SceneKey rows[],
  const char kind[], void *entry);
PETSC_INTERN PetscErrorCode SceneHasKey(SceneKeys, const char owner[], const char name[], PetscBool *has);
PETSC_INTERN PetscErrorCode SceneHasOneOf(SceneKeys, const char owner[], const char kind[], const char first[],
  const char second[], PetscBool *has_second);
PETSC_INTERN PetscErrorCode SceneReadList(SceneKeys, Scene, const SceneList *, PetscInt *n, void *entries);
PETSC_INTERN PetscErrorCode SceneViewRow(Scene, PetscViewer, const SceneKey *, const void *entry, const void *initial);
PETSC_INTERN PetscErrorCode SceneViewRows(Scene, PetscViewer, const SceneKey rows[], const char kind[],
  const void *entry, const void *initial);
PETSC_INTERN PetscErrorCode SceneViewEntries(Scene, PetscViewer, const SceneList *, PetscInt n, const void *entries);
PETSC_INTERN PetscErrorCode SceneFreeRows(const SceneKey rows[], void *entry);

#endif
