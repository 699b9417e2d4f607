/* The format of scene files: reads keys from text, and values from keys. Independent of the contents of scenes. */
#ifndef FORMATIMPL_H
#define FORMATIMPL_H

#include <model.h>
#include <rankerror.h>

/* Line of each key in the file, from 1 */
typedef struct {
  PetscInt n;
  char   **keys;
  size_t  *lines;
} SceneKeyLines;

/* yaml.c. Not collective: error if the text is not YAML that can be read */
PETSC_INTERN PetscErrorCode SceneCheckYAML(size_t length, const char text[], SceneKeyLines *);

/* values.c: the values by their full keys, sorted; initialize with zeros */
typedef struct {
  char     *key, *text;
  PetscInt  place; /* in the file */
  PetscBool used;
} SceneValue;

typedef struct {
  PetscInt    n, max;
  SceneValue *values;
} SceneValues;

PETSC_INTERN PetscErrorCode SceneValuesRead(const char text[], SceneValues *);
PETSC_INTERN const char    *SceneValuesUse(SceneValues *, const char key[]);
PETSC_INTERN PetscErrorCode SceneValuesDestroy(SceneValues *);

/* keys.c: the keys and values of a scene file. Each reader asks for a full key (nested keys joined with _); keys
   that no reader asked for are reported as unknown. A bad or missing value is recorded, not raised at once, because
   an unknown key often explains it better. */
typedef struct {
  char    *name;
  Material material;
} SceneMaterial;

typedef struct {
  MPI_Comm                   comm;
  const char                *file;
  SceneValues                values;
  PetscInt                   nasked, maxasked;
  char                     **asked;
  const struct _n_SceneList *list; /* the list that is being read */
  const struct _n_SceneKey  *top;  /* rows of the top level, for messages about unknown keys */
  SceneKeyLines              lines;
  char                       error[1024]; /* the first error; empty: none */
  PetscBool                  decides;     /* the error decides which keys are valid, so it is reported before unknown
                                         keys */

  char           library[PETSC_MAX_PATH_LEN]; /* where materials may come from, as text; empty: no library */
  PetscInt       nmaterials;                  /* materials with names that have been read */
  SceneMaterial *materials;
} * SceneKeys;

#define SCENE_KEY_LENGTH 256

PETSC_INTERN PetscErrorCode SceneKeysCreate(MPI_Comm, const char file[], SceneKeys *);
PETSC_INTERN PetscErrorCode SceneKeysGet(SceneKeys, PetscBool required, const char **value, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
/* Records an error, unless there is one. The message begins with the key, or names it or an entry, as body "slab", as
   its first quotation: so its line is found */
PETSC_INTERN PetscErrorCode SceneKeysError(SceneKeys, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
/* Records an error in the key owner_key: its name and the text `wrong` */
PETSC_INTERN PetscErrorCode SceneKeysErrorOf(SceneKeys, const char owner[], const char key[], const char wrong[]);
PETSC_INTERN PetscErrorCode SceneKeysCheck(SceneKeys);
PETSC_INTERN PetscErrorCode SceneKeysDestroy(SceneKeys *);
/* Makes a file's name relative to the folder of the scene */
PETSC_INTERN PetscErrorCode SceneResolveFile(const char scene[], char **file);

/* lines.c: line of a key, 0 if unknown; puts the line of what a message is about before it, if it is known; raises an
   error of work on the scene, if there is one, with file and line */
PETSC_INTERN size_t         SceneKeysGetLine(SceneKeys, const char key[]);
PETSC_INTERN PetscErrorCode SceneKeysAddLine(SceneKeys, size_t size, char message[]);
PETSC_INTERN PetscErrorCode SceneKeysRaise(SceneKeys, const RankError *);

/* parse.c: converts values; key is for error messages. A list must have n entries, or any number if *n is
   PETSC_DECIDE on entry */
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

/* numbers.c: prints a number so that it reads back the same; [values]; name: [values] */
PETSC_INTERN PetscErrorCode SceneViewReal(PetscViewer, PetscReal);
PETSC_INTERN PetscErrorCode SceneViewList(PetscViewer, PetscInt n, const PetscReal[]);
PETSC_INTERN PetscErrorCode SceneViewReals(PetscViewer, const char name[], PetscInt n, const PetscReal[]);

/* expression.c: evaluates an expression of time; checks the syntax of an expression of position, which
   SceneEvaluatePlace() evaluates */
PETSC_INTERN PetscErrorCode SceneEvaluate(SceneKeys, const char key[], const char text[], PetscReal time, PetscReal end,
  PetscReal *);
PETSC_INTERN PetscErrorCode SceneCheckExpression(SceneKeys, const char key[], const char text[]);

/* table.c: factors of a ramp at the ends of load steps, in dynamics also at time 0, from an expression or a table of
   times and values. found: the key has one of them */
PETSC_INTERN PetscErrorCode SceneReadProgram(SceneKeys, const char key[], Scene, SceneRamp *, PetscBool *found);

/*
   The table of keys (rows in sections/keytable.c). A row describes one key: it is read into a member (at a byte offset)
   of a struct of model.h, printed unless it has its initial value, and freed if it owns text.
*/
typedef enum {
  SCENE_REALS,
  SCENE_INTS,
  SCENE_ANSWER, /* true or false */
  SCENE_CHOICE, /* an enumeration, by its names */
  SCENE_AXIS,   /* the same, stored as PetscInt */
  SCENE_TEXT,
  SCENE_EXPRESSION, /* of the place; stored as text */
  SCENE_BODY,       /* a body's name, stored as its number */
  SCENE_RAMP,       /* a ramp's */
  SCENE_OWN,
  SCENE_SECTION /* read and printed by a file in sections/ */
} SceneKeyType;

typedef enum {
  SCENE_OPTIONAL,
  SCENE_SHOWN, /* optional, and always printed */
  SCENE_REQUIRED
} SceneNeed;

typedef enum { SCENE_ANY, SCENE_ABOVE_0, SCENE_FROM_0, SCENE_UNBOUNDED /* infinite, too */ } SceneRange;

/* A value with a syntax of its own */
typedef struct {
  PetscErrorCode (*read)(SceneKeys, Scene, const char key[], const char text[], void *entry);
  PetscBool (*shown)(const void *entry);
  PetscErrorCode (*view)(Scene, PetscViewer, const void *entry);
  PetscInt ntexts; /* number of allocated texts, stored consecutively */
} SceneOwn;

typedef struct _n_SceneKey {
  const char        *name;
  const char        *of; /* shapes or material laws that have the key, separated by blanks; NULL: all */
  SceneKeyType       type;
  PetscInt           n; /* numbers */
  size_t             at;
  SceneNeed          need;
  SceneRange         range;
  const char *const *names; /* names of an enumeration */
  const SceneOwn    *own;
  const char        *unit, *otherwise, *help; /* unit (F force, L length); value without the key; one-sentence help */
} SceneKey;

typedef struct _n_SceneList {
  const char     *name;
  const SceneKey *rows;
  size_t          size;             /* size of an entry; its first member is its name */
  size_t          count, entries;   /* offsets in the scene of count and array; 0: read by a file in sections/ */
  const void     *initial;          /* initial value of an entry; NULL: zeros */
  PetscBool       required, shared; /* required: must not be empty; shared: another list frees the entries */
  /* called after the rows of an entry were read */
  PetscErrorCode (*finish)(SceneKeys, Scene, const char owner[], void *entry);
  /* shared lists: whether an entry belongs to this list */
  PetscBool (*holds)(const void *entry);
  PetscBool (*hides)(const void *entry, const char key[]);
} SceneList;

/* rows.c: reads, prints and frees entries by the rows of the table */
PETSC_INTERN PetscBool      SceneRowIsOf(const SceneKey *, const char kind[]);
PETSC_INTERN PetscErrorCode SceneReadRows(SceneKeys, Scene, const char owner[], const SceneKey rows[],
  const char kind[], PetscBool listed, void *entry);
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
