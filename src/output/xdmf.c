/* Writes the XDMF file, which describes the HDF5 files with one grid per load step. */
#include "outputimpl.h"
#include <string.h>

/* Returns the file name without its folder, since all files of an output are in one folder. */
static const char *XDMFFileName(const char path[])
{
  const char *slash = strrchr(path, '/');

  return slash ? slash + 1 : path;
}

/* Writes a text that is part of an XML attribute or element, with special characters replaced by XML entities. */
static void XDMFWriteEscaped(FILE *stream, const char text[])
{
  for (const char *c = text; *c; ++c) {
    if (*c == '&') fputs("&amp;", stream);
    else if (*c == '<') fputs("&lt;", stream);
    else if (*c == '>') fputs("&gt;", stream);
    else if (*c == '"') fputs("&quot;", stream);
    else fputc(*c, stream);
  }
}

static void XDMFWriteDataItem(FILE *stream, const char file[], const char dataset[], PetscBool integer, PetscInt n,
  PetscInt components)
{
  fprintf(stream, "          <DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%" PetscInt_FMT,
    integer ? "Int" : "Float", integer ? (int)sizeof(PetscInt) : (int)sizeof(PetscReal), n);
  /* PETSc stores an index set with two dimensions, but a vector with one component per row with one dimension. */
  if (integer || components > 1) fprintf(stream, " %" PetscInt_FMT, components);
  fputs("\">", stream);
  XDMFWriteEscaped(stream, XDMFFileName(file));
  fprintf(stream, ":/%s</DataItem>\n", dataset);
}

static void XDMFWriteAttribute(FILE *stream, const char file[], const char name[], const char type[],
  const char center[], PetscBool integer, PetscInt n, PetscInt components)
{
  fprintf(stream, "        <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n", name, type, center);
  XDMFWriteDataItem(stream, file, name, integer, n, components);
  fputs("        </Attribute>\n", stream);
}

static void XDMFWriteMeshGrid(FILE *stream, Output output, const char file[])
{
  fprintf(stream, "        <Topology TopologyType=\"%s\" NumberOfElements=\"%" PetscInt_FMT "\">\n",
    output->mixed ? "Mixed" : "Hexahedron", output->ncells);
  XDMFWriteDataItem(stream, file, OutputCellsName(output), PETSC_TRUE,
    output->mixed ? output->nindices : output->ncells, output->mixed ? 1 : 8);
  fputs("        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n", stream);
  XDMFWriteDataItem(stream, file, "vertices", PETSC_FALSE, output->nvertices, 3);
  fputs("        </Geometry>\n", stream);
  XDMFWriteAttribute(stream, file, "body", "Scalar", "Cell", PETSC_TRUE, output->ncells, 1);
}

/*
   Writes references to the contact fields. pair: name of the pair, which is part of the names of its fields; NULL for
   the fields of all pairs together.
*/
static PetscErrorCode XDMFWriteContact(FILE *stream, Output output, const char file[], const char pair[])
{
  static const struct {
    const char *name;
    PetscBool   vector, friction;
  } fields[] = {
    {"contact_pressure", PETSC_FALSE, PETSC_FALSE},
    {"contact_gap", PETSC_FALSE, PETSC_FALSE},
    {"contact_area", PETSC_FALSE, PETSC_FALSE},
    {"contact_status", PETSC_FALSE, PETSC_FALSE},
    {"contact_force", PETSC_TRUE, PETSC_FALSE},
    {"contact_shear", PETSC_TRUE, PETSC_TRUE},
    {"contact_slip", PETSC_TRUE, PETSC_TRUE},
    {"contact_slip_path", PETSC_FALSE, PETSC_TRUE},
  };

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(fields); ++i) {
    const PetscBool vector = fields[i].vector;
    char            name[256];

    if (fields[i].friction && !output->friction) continue;
    PetscCall(PetscSNPrintf(name, sizeof(name), "%s%s%s", fields[i].name, pair ? "_" : "", pair ? pair : ""));
    XDMFWriteAttribute(stream, file, name, vector ? "Vector" : "Scalar", "Node", PETSC_FALSE, output->nvertices,
      vector ? 3 : 1);
  }
  PetscFunctionReturn(0);
}

static void XDMFWriteNodalStress(FILE *stream, Output output, const char file[])
{
  XDMFWriteAttribute(stream, file, "strain_energy_density", "Scalar", "Cell", PETSC_FALSE, output->ncells, 1);
  XDMFWriteAttribute(stream, file, "nodal_stress", "Tensor6", "Node", PETSC_FALSE, output->nvertices, 6);
  XDMFWriteAttribute(stream, file, "nodal_von_mises", "Scalar", "Node", PETSC_FALSE, output->nvertices, 1);
  XDMFWriteAttribute(stream, file, "principal_stress", "Vector", "Node", PETSC_FALSE, output->nvertices, 3);
}

static void XDMFBeginStep(FILE *stream, const OutputStep *step)
{
  fprintf(stream,
    "      <Grid Name=\"step %" PetscInt_FMT "\" GridType=\"Uniform\">\n        <Time Value=\"%.17g\"/>\n", step->step,
    (double)step->time);
}

static void XDMFWriteNote(FILE *stream, const char name[], const char value[])
{
  fprintf(stream, "    <Information Name=\"%s\" Value=\"", name);
  XDMFWriteEscaped(stream, value);
  fputs("\"/>\n", stream);
}

static PetscErrorCode XDMFWriteDocument(FILE *stream, const void *ctx)
{
  Output output = (Output)ctx;
  char   mesh[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  PetscCall(OutputGetMeshFile(output, mesh, sizeof(mesh)));
  fputs("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n", stream);
  for (PetscInt b = 0; b < output->nbodies; ++b) {
    char name[32];

    PetscCall(PetscSNPrintf(name, sizeof(name), "body %" PetscInt_FMT, b));
    XDMFWriteNote(stream, name, output->bodynames[b]);
    if (!output->surfaces[b]) continue;
    PetscCall(PetscSNPrintf(name, sizeof(name), "surface %" PetscInt_FMT, b));
    XDMFWriteNote(stream, name, output->surfaces[b]);
  }
  if (output->units) XDMFWriteNote(stream, "units", output->units);
  fputs("    <Grid Name=\"load steps\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", stream);
  for (PetscInt s = 0; s < output->nsteps; ++s) {
    PetscCall(OutputGetStepFile(output, output->steps[s].step, file, sizeof(file)));
    XDMFBeginStep(stream, &output->steps[s]);
    XDMFWriteMeshGrid(stream, output, mesh);
    XDMFWriteAttribute(stream, file, "displacement", "Vector", "Node", PETSC_FALSE, output->nvertices, 3);
    if (output->moving)
      XDMFWriteAttribute(stream, file, "velocity", "Vector", "Node", PETSC_FALSE, output->nvertices, 3);
    PetscCall(XDMFWriteContact(stream, output, file, NULL));
    for (PetscInt p = 0; p < output->npairs; ++p)
      PetscCall(XDMFWriteContact(stream, output, file, output->pairnames[p]));
    XDMFWriteAttribute(stream, file, "stress", "Tensor6", "Cell", PETSC_FALSE, output->ncells, 6);
    XDMFWriteAttribute(stream, file, "von_mises", "Scalar", "Cell", PETSC_FALSE, output->ncells, 1);
    if (output->plastic) {
      XDMFWriteAttribute(stream, file, "plastic_strain", "Tensor6", "Cell", PETSC_FALSE, output->ncells, 6);
      XDMFWriteAttribute(stream, file, "equivalent_plastic_strain", "Scalar", "Cell", PETSC_FALSE, output->ncells, 1);
    }
    if (output->nodes) {
      XDMFWriteNodalStress(stream, output, file);
      XDMFWriteAttribute(stream, file, "reaction", "Vector", "Node", PETSC_FALSE, output->nvertices, 3);
    }
    fputs("      </Grid>\n", stream);
  }
  fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", stream);
  PetscFunctionReturn(0);
}

/* Writes an XDMF file with the quadrature points of each load step at their undeformed positions. ctx: the Output. */
static PetscErrorCode XDMFWriteCloud(FILE *stream, const void *ctx)
{
  Output output = (Output)ctx;
  char   file[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  fputs("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"load steps\" "
        "GridType=\"Collection\" CollectionType=\"Temporal\">\n",
    stream);
  for (PetscInt s = 0; s < output->nsteps; ++s) {
    PetscCall(OutputGetStepFile(output, output->steps[s].step, file, sizeof(file)));
    XDMFBeginStep(stream, &output->steps[s]);
    fprintf(stream,
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%" PetscInt_FMT "\" NodesPerElement=\"1\">\n",
      output->nquadrature);
    XDMFWriteDataItem(stream, file, "gauss_cells", PETSC_TRUE, output->nquadrature, 1);
    fputs("        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n", stream);
    XDMFWriteDataItem(stream, file, "gauss_points", PETSC_FALSE, output->nquadrature, 3);
    fputs("        </Geometry>\n", stream);
    XDMFWriteAttribute(stream, file, "gauss_stress", "Tensor6", "Node", PETSC_FALSE, output->nquadrature, 6);
    fputs("      </Grid>\n", stream);
  }
  fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", stream);
  PetscFunctionReturn(0);
}

PetscErrorCode OutputWriteXDMF(Output output)
{
  char file[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(file, sizeof(file), "%s.xmf", output->base));
  PetscCall(FileWriteText(output->comm, file, XDMFWriteDocument, output));
  if (!output->nquadrature) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(file, sizeof(file), "%s_gauss.xmf", output->base));
  PetscCall(FileWriteText(output->comm, file, XDMFWriteCloud, output));
  PetscFunctionReturn(0);
}
