/* Creates contact pairs and ties from the scene's rules */
#include "detectimpl.h"
#include <string.h>

/*
   Lists the rigid surfaces without facets. The mesh shows each of them by some cells; the first facet of these cells
   represents the surface in the search. The area of the surface is set to PETSC_MAX_REAL, because it extends beyond
   these cells.
*/
static PetscErrorCode ModelAddRigidSurfaces(PetscInt nbodies, DetectModel *m)
{
  const MeshSurfaces *s = &m->surfaces;

  PetscFunctionBegin;
  m->ntools = 0;
  PetscCall(PetscMalloc1(nbodies, &m->tool));
  for (PetscInt f = 0; f < s->n; ++f) {
    const PetscInt surface = s->surface[f];

    if (!SceneBodyIsSurface(&m->bodies[s->body[surface]]) || m->area[surface] == PETSC_MAX_REAL) continue;
    m->area[surface]     = PETSC_MAX_REAL;
    m->tool[m->ntools++] = f;
  }
  PetscFunctionReturn(0);
}

/* Computes the masses of the bodies from their volumes, and the size of the box of all bodies */
static void ModelWeigh(PetscInt nbodies, const PetscReal volume[], DetectModel *m)
{
  PetscReal diagonal[3];

  for (PetscInt b = 0; b < nbodies; ++b) {
    const SceneBody *body = &m->bodies[b];

    m->mass[b] = SceneBodyIsSurface(body) ? body->own[SURFACE_MASS] : body->material.density * volume[b];
  }
  for (PetscInt c = 0; c < 3; ++c) {
    PetscReal lower = PETSC_MAX_REAL, upper = PETSC_MIN_REAL;

    for (PetscInt b = 0; b < nbodies; ++b) {
      lower = PetscMin(lower, m->box[6 * b + c]);
      upper = PetscMax(upper, m->box[6 * b + 3 + c]);
    }
    diagonal[c] = upper - lower;
  }
  m->size = VectorNorm(diagonal);
}

/* Collective. Collects the facets of all bodies and computes the sizes of surfaces and bodies */
static PetscErrorCode ModelCreate(MPI_Comm comm, Scene scene, DetectModel *m)
{
  MeshSurfaces *s = &m->surfaces;
  PetscReal    *volume;

  PetscFunctionBegin;
  m->comm   = comm;
  m->bodies = scene->bodies;
  PetscCall(MeshSurfacesCreate(comm, scene->nbodies, scene->bodies, s));
  PetscCall(PetscCalloc3(s->nsurfaces, &m->area, s->nsurfaces, &m->nfacets, s->nsurfaces, &m->bulge));
  PetscCall(PetscMalloc1(12 * s->n, &m->normal));
  PetscCall(DetectNormals(s, m->normal));
  PetscCall(PetscCalloc3(scene->nbodies, &m->thickness, 6 * scene->nbodies, &m->box, scene->nbodies, &m->fine));
  PetscCall(PetscCalloc1(scene->nbodies, &volume));
  PetscCall(PetscCalloc1(scene->nbodies, &m->mass));
  for (PetscInt i = 0; i < 6 * scene->nbodies; ++i) m->box[i] = i % 6 < 3 ? PETSC_MAX_REAL : PETSC_MIN_REAL;
  for (PetscInt f = 0; f < s->n; ++f) {
    const PetscReal *x    = &s->x[12 * f];
    const PetscInt   body = s->body[s->surface[f]], order = scene->bodies[body].order;
    const PetscReal  origin[3] = {s->x[0], s->x[1], s->x[2]}, middle[2] = {0.0, 0.0},
                    height = PetscAbsReal(DetectBulge(x, &m->normal[12 * f], middle));
    PetscReal n[3], mass[4], box[6];

    ContactFacetAreaVector(x, n);
    for (PetscInt c = 0; c < 3; ++c)
      volume[body] += n[c] * (x[c] + x[3 + c] + x[6 + c] + x[9 + c] - 4.0 * origin[c]) / 12.0;
    m->thickness[body] += ContactFacetMass(x, mass); /* the sum of the areas, converted to a thickness below */
    m->area[s->surface[f]] += ContactFacetMass(x, mass);
    ++m->nfacets[s->surface[f]];
    m->bulge[s->surface[f]] = PetscMax(m->bulge[s->surface[f]], height);
    m->fine[body]           = order == 2 || (!order && ContactFacetIsTriangle(x)) ? 0.25 : 1.0;
    ContactFacetBox(x, box);
    for (PetscInt c = 0; c < 3; ++c) {
      m->box[6 * body + c]     = PetscMin(m->box[6 * body + c], box[c]);
      m->box[6 * body + 3 + c] = PetscMax(m->box[6 * body + 3 + c], box[3 + c]);
    }
  }
  PetscCall(ModelAddRigidSurfaces(scene->nbodies, m));
  for (PetscInt b = 0; b < scene->nbodies; ++b) m->thickness[b] = 2.0 * volume[b] / m->thickness[b];
  ModelWeigh(scene->nbodies, volume, m);
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

static PetscErrorCode ModelDestroy(DetectModel *m)
{
  PetscFunctionBegin;
  PetscCall(MeshSurfacesDestroy(&m->surfaces));
  PetscCall(PetscFree3(m->area, m->nfacets, m->bulge));
  PetscCall(PetscFree(m->normal));
  PetscCall(PetscFree3(m->thickness, m->box, m->fine));
  PetscCall(PetscFree(m->mass));
  PetscCall(PetscFree(m->tool));
  PetscFunctionReturn(0);
}

/* Creates a name that no contact pair and no tie has: the names of the nonmortar and of the mortar body, and a number
   from 2 on if needed */
static PetscErrorCode RuleMakeName(Scene scene, const char nonmortar[], const char mortar[], char **name)
{
  char      text[PETSC_MAX_PATH_LEN];
  PetscBool taken = PETSC_TRUE, same;

  PetscFunctionBegin;
  for (PetscInt k = 1; taken; ++k) {
    PetscCall(PetscSNPrintf(text, sizeof(text), "%s_%s", nonmortar, mortar));
    if (k > 1) PetscCall(PetscSNPrintf(text, sizeof(text), "%s_%s_%" PetscInt_FMT, nonmortar, mortar, k));
    taken = PETSC_FALSE;
    for (PetscInt p = 0; p < scene->npairs + scene->nties; ++p) {
      PetscCall(
        PetscStrcasecmp(text, p < scene->npairs ? scene->pairs[p].name : scene->ties[p - scene->npairs].name, &same));
      taken = (PetscBool)(taken || same);
    }
  }
  PetscCall(PetscStrallocpy(text, name));
  PetscFunctionReturn(0);
}

/* Appends to the scene a contact pair or, if `tied` is positive, a tie of facets up to this distance [length] */
static PetscErrorCode RuleJoin(Scene scene, const SceneContactPair *rule, const char mortar[], const char nonmortar[],
  const char name[], PetscReal tied, const char why[], PetscReal apart)
{
  PetscFunctionBegin;
  if (tied > 0.0) {
    SceneTie *tie;

    PetscCall(PetscRealloc(sizeof(*tie) * (scene->nties + 1), &scene->ties));
    tie  = &scene->ties[scene->nties++];
    *tie = (SceneTie){.place = rule->place, .distance = tied};
    PetscCall(PetscStrallocpy(name, &tie->name));
    PetscCall(PetscStrallocpy(mortar, &tie->mortar));
    PetscCall(PetscStrallocpy(nonmortar, &tie->nonmortar));
  } else {
    SceneContactPair *pair;

    PetscCall(PetscRealloc(sizeof(*pair) * (scene->npairs + 1), &scene->pairs));
    pair         = &scene->pairs[scene->npairs++];
    *pair        = *rule;
    pair->why    = why;
    pair->apart  = apart;
    pair->tie    = 0.0;
    pair->except = NULL;
    pair->self   = NULL;
    PetscCall(PetscStrallocpy(name, &pair->name));
    PetscCall(PetscStrallocpy(mortar, &pair->mortar));
    PetscCall(PetscStrallocpy(nonmortar, &pair->nonmortar));
  }
  PetscFunctionReturn(0);
}

/* Adds a pair for each body that a rule with the key `self` brings into contact with itself */
static PetscErrorCode RuleAddSelf(Scene scene, const SceneContactPair *rule)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody  *body = &scene->bodies[b];
    SceneContactPair *pair;

    if (!DetectWantsSelf(scene, rule, body)) continue;
    PetscCall(PetscRealloc(sizeof(*pair) * (scene->npairs + 1), &scene->pairs));
    pair         = &scene->pairs[scene->npairs];
    *pair        = *rule;
    pair->why    = "it comes into contact with itself";
    pair->apart  = PETSC_MAX_REAL;
    pair->tie    = 0.0;
    pair->except = NULL;
    PetscCall(RuleMakeName(scene, body->name, "self", &pair->name));
    PetscCall(PetscStrallocpy(body->name, &pair->self));
    PetscCall(SceneContactPairSetSelf(scene->nbodies, scene->bodies, pair));
    ++scene->npairs;
  }
  PetscFunctionReturn(0);
}

/* Decides which side of a pair is nonmortar, and whether the surfaces are tied: *tied is then positive, the distance up
   to which their facets are joined [length]. They are tied if all facets of one
   surface are within the rule's distance for ties of the other surface. */
static PetscErrorCode RuleApply(const DetectModel *model, Scene scene, const SceneContactPair *rule,
  const DetectPair *found, SceneContactPair *pair, PetscReal *tied)
{
  const MeshSurfaces *s    = &model->surfaces;
  PetscInt            side = DetectNonmortar(model, scene, found, &pair->why);

  PetscFunctionBegin;
  if (rule->mortar) {
    side      = strcmp(rule->nonmortar, scene->bodies[s->body[found->surface[0]]].name) ? 1 : 0;
    pair->why = "the scene says so";
  }
  *tied = 0.0;
  for (PetscInt turn = 0; turn < 2 && *tied == 0.0; ++turn) {
    const PetscInt  k     = turn ? 1 - side : side;
    const PetscBool rigid = (PetscBool)(scene->bodies[s->body[found->surface[k]]].material.type == MATERIAL_RIGID);

    if (rigid || found->tied[k] != model->nfacets[found->surface[k]]) continue;
    *tied = rule->tie + model->bulge[found->surface[0]] + model->bulge[found->surface[1]];
    side  = k;
  }
  SceneCheck(*tied > 0.0 || (!found->tied[0] && !found->tied[1]), model->comm, PETSC_ERR_USER_INPUT, rule,
    "contact rule \"%s\": only parts of the faces %s and %s are within the distance tie = %g of each other: define "
    "faces that consist of these parts, and list the tie of these faces",
    rule->name, s->name[found->surface[0]], s->name[found->surface[1]], (double)rule->tie);
  pair->nonmortar = s->name[found->surface[side]];
  pair->mortar    = s->name[found->surface[1 - side]];
  PetscCall(RuleMakeName(scene, scene->bodies[s->body[found->surface[side]]].name,
    scene->bodies[s->body[found->surface[1 - side]]].name, &pair->name));
  PetscFunctionReturn(0);
}

/* Raises an error if a rule that names two bodies and a distance for ties has tied no surfaces of them */
static PetscErrorCode RulesCheckTies(const DetectModel *model, Scene scene, PetscInt n,
  const SceneContactPair *const rules[], const PetscReal tied[])
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    const SceneContactPair *rule = &scene->rules[r];
    PetscBool               any  = PETSC_FALSE;

    for (PetscInt i = 0; i < n; ++i) any = (PetscBool)(any || (rules[i] == rule && tied[i] > 0.0));
    SceneCheck(any || !rule->mortar || rule->tie == 0.0, model->comm, PETSC_ERR_USER_INPUT, rule,
      "contact rule \"%s\": no surface of %s or %s is within the distance tie = %g of the other body: increase tie, or "
      "list the tie of two faces under ties",
      rule->name, rule->nonmortar, rule->mortar, (double)rule->tie);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode RulesDestroy(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    PetscCall(PetscFree(scene->rules[r].name));
    PetscCall(PetscFree(scene->rules[r].mortar));
    PetscCall(PetscFree(scene->rules[r].nonmortar));
    PetscCall(PetscFree(scene->rules[r].except));
    PetscCall(PetscFree(scene->rules[r].self));
  }
  PetscCall(PetscFree(scene->rules));
  scene->nrules = 0;
  PetscFunctionReturn(0);
}

/* Raises the error that no surfaces face each other. If only exceptions hide them, it names the exceptions. */
static PetscErrorCode DetectRaiseNone(MPI_Comm comm, const DetectModel *model, Scene scene)
{
  const char *except = NULL;
  DetectPair *found;
  PetscInt    n;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    if (!scene->rules[r].except) continue;
    except                 = scene->rules[r].except;
    scene->rules[r].except = NULL;
  }
  PetscCall(DetectFacing(model, scene, &n, &found));
  PetscCheck(!except || !n, comm, PETSC_ERR_USER_INPUT,
    "contact: auto finds no two surfaces of the scene \"%s\" that face each other, except those that the key except "
    "excludes, [%s]: shorten the list, or list the contact pairs",
    scene->name, except);
  SETERRQ(comm, PETSC_ERR_USER_INPUT,
    "contact: auto finds no two surfaces of the scene \"%s\" that face each other within the search distance: increase "
    "the key distance, or list the contact pairs",
    scene->name);
}

/*@
  ContactDetect - Finds the contact pairs and ties that a scene's rules leave open (`contact: auto`), and adds them to
  the scene

  Collective

  Input Parameters:
+ comm  - communicator
- scene - the scene, the same on all ranks

  Level: intermediate

  Notes:
  Without rules, or if they have been applied before, this does nothing. The scene then has pairs and ties as if the
  file listed them; `SceneView()` prints them, too.

  From five points of each facet at refinement level 0 a ray goes along the normal. The first facet that it hits, of
  another body and with an opposing normal, makes a pair of the two surfaces if it is within the distance. The distance
  of a rigid surface without facets is that from the start of the ray. This is done for the undeformed bodies, and for
  up to 32 states of the load program with the bodies moved as prescribed, or in dynamics as in free flight. Bodies in
  between hide what is behind them.
  The cost is O(N log N) in the number of facets, divided by the number of ranks.

  With `self` each body of finite strain, too, gets a pair in contact with itself.

  It is an error if no surfaces face each other, and the scene lists no pairs either.

.seealso: `SceneLoad()`, `ContactCreate()`
@*/
PetscErrorCode ContactDetect(MPI_Comm comm, Scene scene)
{
  DetectModel              model;
  DetectPair              *found;
  const SceneContactPair **rules;
  SceneContactPair        *pairs;
  PetscReal               *tied;
  PetscBool                self = PETSC_FALSE;
  PetscInt                 n;

  PetscFunctionBegin;
  if (!scene->nrules) PetscFunctionReturn(0);
  PetscCall(ModelCreate(comm, scene, &model));
  PetscCall(DetectFacing(&model, scene, &n, &found));
  for (PetscInt r = 0; r < scene->nrules; ++r) self = (PetscBool)(self || scene->rules[r].self);
  if (!n && !self && !scene->npairs && !scene->nties) PetscCall(DetectRaiseNone(comm, &model, scene));
  PetscCall(PetscMalloc3(n, &rules, n, &pairs, n, &tied));
  /* All rules are looked up before pairs are added, because bodies with a listed pair have no rule. */
  for (PetscInt i = 0; i < n; ++i) rules[i] = DetectFindRule(&model, scene, found[i].surface[0], found[i].surface[1]);
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(RuleApply(&model, scene, rules[i], &found[i], &pairs[i], &tied[i]));
    PetscCall(RuleJoin(scene, rules[i], pairs[i].mortar, pairs[i].nonmortar, pairs[i].name, tied[i], pairs[i].why,
      found[i].apart));
    PetscCall(PetscFree(pairs[i].name));
  }
  PetscCall(RulesCheckTies(&model, scene, n, rules, tied));
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    if (scene->rules[r].self) PetscCall(RuleAddSelf(scene, &scene->rules[r]));
  }
  PetscCall(PetscFree3(rules, pairs, tied));
  PetscCall(PetscFree(found));
  PetscCall(ModelDestroy(&model));
  PetscCall(RulesDestroy(scene));
  PetscFunctionReturn(0);
}
