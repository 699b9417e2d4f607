/* Shared by nlp_tao.c and nlp_ipopt.c: the problems of ipfilter_nlp.h, and those of a file that nlp.py writes, a
   field a line */
#ifndef NLP_READ_H
#define NLP_READ_H

#define EXPRESSION_MAX 50
#define FORMULAS_MAX   100

#include <petscsys.h>
#include "../tao_ipfilter/ipfilter_nlp.h"

#define NLP_FIELDS 5

/* Field k of a problem */
static inline const char **NLPField(NLP *p, int k)
{
  const char **fields[NLP_FIELDS] = {&p->objective, &p->inequalities, &p->equalities, &p->bounds, &p->start};

  return fields[k];
}

/* The next line without its end, to be freed; NULL: there is none */
static inline char *NLPLine(FILE *file)
{
  char   *line   = NULL;
  size_t  size   = 0;
  ssize_t length = getline(&line, &size, file);

  if (length > 0 && line[length - 1] == '\n') line[length - 1] = '\0';
  if (length >= 0) return line;
  free(line);
  return NULL;
}

/* The next problem of a file; false: there is none. Its optimum is known to nlp.py, which judges. */
static inline int NLPRead(FILE *file, NLP *p)
{
  *p      = (NLP){0};
  p->name = NLPLine(file);
  for (int k = 0; k < NLP_FIELDS && p->name; k++) *NLPField(p, k) = NLPLine(file);
  return p->name && p->start;
}

static inline void NLPFree(NLP *p)
{
  free((char *)p->name);
  for (int k = 0; k < NLP_FIELDS; k++) free((char *)*NLPField(p, k));
}

#endif
