/*
   The format of scene files: text to keys, keys to values. Nothing here knows what a scene is made of.
*/
#ifndef FORMATIMPL_H
#define FORMATIMPL_H

#include <model.h>
#include <rankerror.h>

/* Where keys stand in the file, counted from 1 */
typedef struct {
  PetscInt n;
  char   **keys;
  size_t  *lines;
} SceneKeyLines;

/* yaml.c. Not collective: an error if the text is no YAML that PETSc can read */
PETSC_INTERN PetscErrorCode SceneCheckYAML(size_t length, const char text[], SceneKeyLines *);

/* keys.c: the keys and values of a scene file. Every reader asks for a full key (nested keys joined with _); what
   nobody asked for is misspelt. A bad or missing value is stored, not raised, because a misspelt key explains it
   better. */
typedef struct {
  char    *name;
  Material material;
} SceneMaterial;

typedef struct {
  MPI_Comm                   comm;
  const char                *file;
  PetscOptions               options;
  PetscInt                   nasked, maxasked;
  char                     **asked;
  const struct _n_SceneList *list; /* that is being read */
  const struct _n_SceneKey  *top;  /* rows of the top level, for what is misspelt there */
  SceneKeyLines              lines;
  char                       complaint[1024]; /* the first; empty if none */
  PetscBool                  decides; /* which keys are known hangs on what is complained of: it comes before them */

  char           library[PETSC_MAX_PATH_LEN]; /* where materials come from, in words; empty: no library */
  PetscInt       nmaterials;                  /* that have names, once they are read */
  SceneMaterial *materials;
} * SceneKeys;

#define SCENE_KEY_LENGTH 256

PETSC_INTERN PetscErrorCode SceneKeysCreate(MPI_Comm, const char file[], SceneKeys *);
PETSC_INTERN PetscErrorCode SceneKeysGet(SceneKeys, PetscBool required, const char **value, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);
PETSC_INTERN PetscErrorCode SceneKeysComplain(SceneKeys, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
PETSC_INTERN PetscErrorCode SceneKeysCheck(SceneKeys);
/* Begins the complaint, if there is one, with the line of this key */
PETSC_INTERN PetscErrorCode SceneKeysAddLine(SceneKeys, const char key[]);
PETSC_INTERN PetscErrorCode SceneKeysDestroy(SceneKeys *);
/* A file's name, relative to the folder of the scene */
PETSC_INTERN PetscErrorCode SceneResolveFile(const char scene[], char **file);

/* parse.c: values; key is for the complaint. A list has exactly n entries, or any number where *n is PETSC_DECIDE on
   entry */
PETSC_INTERN PetscErrorCode SceneParseReal(SceneKeys, const char key[], const char text[], PetscReal *);
PETSC_INTERN PetscErrorCode SceneParseInt(SceneKeys, const char key[], const char text[], PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseEnum(SceneKeys, const char key[], const char text[], const char *const names[],
  PetscInt *);
PETSC_INTERN PetscErrorCode SceneParseAnswer(SceneKeys, const char key[], const char text[], PetscBool *);
PETSC_INTERN PetscErrorCode SceneParseList(SceneKeys, const char key[], const char text[], PetscInt *n, char ***words);
PETSC_INTERN PetscErrorCode SceneParseReals(SceneKeys, const char key[], const char text[], PetscInt n, PetscReal[]);
PETSC_INTERN PetscErrorCode SceneParseInts(SceneKeys, const char key[], const char text[], PetscInt n, PetscInt[]);
PETSC_INTERN PetscErrorCode SceneParseBody(SceneKeys, Scene, const char key[], const char text[], PetscInt *body);
PETSC_INTERN PetscErrorCode SceneParseRamp(SceneKeys, Scene, const char key[], const char text[], PetscInt *ramp);
PETSC_INTERN PetscBool      SceneIsName(const char[]);
PETSC_INTERN PetscErrorCode SceneGetNames(SceneKeys, const char key[], PetscBool required, PetscInt *n, char ***names);

/* numbers.c: a number such that it reads back the same; [values]; name: [values] */
PETSC_INTERN PetscErrorCode SceneViewReal(PetscViewer, PetscReal);
PETSC_INTERN PetscErrorCode SceneViewList(PetscViewer, PetscInt n, const PetscReal[]);
PETSC_INTERN PetscErrorCode SceneViewReals(PetscViewer, const char name[], PetscInt n, const PetscReal[]);

/* expression.c: a number that follows time; whether one that follows the place, which SceneEvaluatePlace() evaluates,
   makes sense */
PETSC_INTERN PetscErrorCode SceneEvaluate(SceneKeys, const char key[], const char text[], PetscReal time, PetscReal end,
  PetscReal *);
PETSC_INTERN PetscErrorCode SceneCheckExpression(SceneKeys, const char key[], const char text[]);

/* table.c: factors of a ramp at the ends of load steps, in dynamics also at the start, from an expression or a table of
   times and values; found: there is one or the other below the key */
PETSC_INTERN PetscErrorCode SceneReadProgram(SceneKeys, const char key[], Scene, SceneRamp *, PetscBool *found);

/*
   The table of keys, which sections/keytable.c has. A row is read into an entry, which is a struct of model.h, at so
   many bytes; is shown unless it is as it began; and frees the texts that it has.
*/
typedef enum {
  SCENE_REALS,
  SCENE_INTS,
  SCENE_ANSWER, /* true or false */
  SCENE_CHOICE, /* an enumeration, by its names */
  SCENE_AXIS,   /* the same, kept as PetscInt */
  SCENE_TEXT,
  SCENE_BODY, /* a body's name, kept as its number */
  SCENE_RAMP, /* a ramp's */
  SCENE_OWN,
  SCENE_SECTION /* read and shown by a file of sections/ */
} SceneKeyType;

typedef enum {
  SCENE_OPTIONAL,
  SCENE_SHOWN, /* may be missing, and is shown in any case */
  SCENE_REQUIRED
} SceneNeed;

typedef enum {
  SCENE_ANY,
  SCENE_ABOVE_0,
  SCENE_FROM_0
} SceneRange;

/* A value with a grammar of its own */
typedef struct {
  PetscErrorCode (*read)(SceneKeys, Scene, const char key[], const char text[], void *entry);
  PetscBool (*shown)(const void *entry);
  PetscErrorCode (*view)(Scene, PetscViewer, const void *entry);
  PetscInt ntexts; /* allocated, one after the other */
} SceneOwn;

typedef struct _n_SceneKey {
  const char        *name;
  const char        *of; /* the shapes or laws that have it, with blanks between; NULL: all */
  SceneKeyType       type;
  PetscInt           n; /* numbers */
  size_t             at;
  SceneNeed          need;
  SceneRange         range;
  const char *const *names; /* of an enumeration */
  const SceneOwn    *own;
  const char        *unit, *otherwise, *help; /* F force, L length; what holds without the key; a sentence */
} SceneKey;

typedef struct _n_SceneList {
  const char     *name;
  const SceneKey *rows;
  size_t          size;             /* of an entry, whose name comes first */
  size_t          count, entries;   /* where a scene has them; 0: it is read by a file of sections/ */
  const void     *initial;          /* entry; NULL: zeros */
  PetscBool       required, shared; /* it must not be empty; another list frees the entries */
  PetscErrorCode (*finish)(SceneKeys, Scene, const char owner[], void *entry); /* after the rows */
  PetscBool (*holds)(const void *entry);                                       /* of entries that are shared: its own */
  PetscBool (*hides)(const void *entry, const char key[]);
} SceneList;

/* rows.c: entries by the rows of the table */
PETSC_INTERN PetscBool      SceneRowIsOf(const SceneKey *, const char kind[]);
PETSC_INTERN PetscErrorCode SceneReadRows(SceneKeys, Scene, const char owner[], const SceneKey rows[],
  const char kind[], PetscBool listed, void *entry);
PETSC_INTERN PetscErrorCode SceneHasKey(SceneKeys, const char owner[], const char name[], PetscBool *has);
PETSC_INTERN PetscErrorCode SceneReadList(SceneKeys, Scene, const SceneList *, PetscInt *n, void *entries);
PETSC_INTERN PetscErrorCode SceneViewRow(Scene, PetscViewer, const SceneKey *, const void *entry, const void *initial);
PETSC_INTERN PetscErrorCode SceneViewRows(Scene, PetscViewer, const SceneKey rows[], const char kind[],
  const void *entry, const void *initial);
PETSC_INTERN PetscErrorCode SceneViewEntries(Scene, PetscViewer, const SceneList *, PetscInt n, const void *entries);
PETSC_INTERN PetscErrorCode SceneFreeRows(const SceneKey rows[], void *entry);

#endif
