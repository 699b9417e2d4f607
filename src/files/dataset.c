/*
   Writes one dataset of an HDF5 file, with the records of the ranks one after another. Its shape is that of VecView()
   and ISView(), so that VecLoad() and ISLoad() can read it. VecView() and ISView() flush the whole file to disk after
   each dataset, of which a load step has twenty, and write zeros first. Here a file is flushed once, when necessary.
*/
#include "filesimpl.h"

#define DATASET_HDF5(call) PetscCheck((call) >= 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "HDF5 failed: %s", #call)

/* Position of the records in a dataset, which is contiguous and not filled with zeros */
typedef struct {
  hid_t type, dataset, here,
    there;          /* type of a number in the file; the dataset; data spaces in memory (here) and in the file
                                         (there) */
  hsize_t n, first; /* number of records of this rank; number of records of the ranks before it */
} DatasetPlace;

static PetscErrorCode DatasetSelect(DatasetPlace *place, int dimensions, const hsize_t shape[2])
{
  const hsize_t start[2] = {place->first, 0}, count[2] = {place->n, shape[1]};

  PetscFunctionBegin;
  DATASET_HDF5(place->here = H5Screate_simple(dimensions, count, NULL));
  if (place->n) DATASET_HDF5(H5Sselect_hyperslab(place->there, H5S_SELECT_SET, start, NULL, count, NULL));
  else {
    DATASET_HDF5(H5Sselect_none(place->here));
    DATASET_HDF5(H5Sselect_none(place->there));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode DatasetPlaceCreate(MPI_Comm comm, PetscViewer viewer, const char name[], int dimensions,
  PetscInt n, PetscInt components, DatasetPlace *place)
{
  unsigned long long mine = (unsigned long long)n, before = 0, all;
  hsize_t            shape[2];
  hid_t              file, kind;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(&mine, &all, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm));
  place->n     = mine;
  place->first = before;
  shape[0]     = all;
  shape[1]     = (hsize_t)components;
  PetscCall(PetscViewerHDF5GetFileId(viewer, &file));
  DATASET_HDF5(place->there = H5Screate_simple(dimensions, shape, NULL));
  DATASET_HDF5(kind = H5Pcreate(H5P_DATASET_CREATE));
  DATASET_HDF5(H5Pset_fill_time(kind, H5D_FILL_TIME_NEVER));
  DATASET_HDF5(place->dataset = H5Dcreate2(file, name, place->type, place->there, H5P_DEFAULT, kind, H5P_DEFAULT));
  DATASET_HDF5(H5Pclose(kind));
  PetscCall(DatasetSelect(place, dimensions, shape));
  PetscFunctionReturn(0);
}

static PetscErrorCode DatasetPlaceDestroy(DatasetPlace *place)
{
  PetscFunctionBegin;
  DATASET_HDF5(H5Sclose(place->here));
  DATASET_HDF5(H5Sclose(place->there));
  DATASET_HDF5(H5Dclose(place->dataset));
  PetscFunctionReturn(0);
}

static PetscErrorCode DatasetWriteRecords(MPI_Comm comm, PetscViewer viewer, const char name[], PetscDataType type,
  int dimensions, PetscInt n, PetscInt components, const void *values)
{
  DatasetPlace place;
  PetscBool    single;
  hid_t        number;

  PetscFunctionBegin;
  PetscCall(PetscDataTypeToHDF5DataType(type, &number));
  PetscCall(PetscViewerHDF5GetSPOutput(viewer, &single));
  place.type = single && type == PETSC_SCALAR ? H5T_NATIVE_FLOAT : number;
  PetscCall(DatasetPlaceCreate(comm, viewer, name, dimensions, n, components, &place));
  DATASET_HDF5(H5Dwrite(place.dataset, number, place.here, place.there, H5P_DEFAULT, values));
  PetscCall(DatasetPlaceDestroy(&place));
  PetscFunctionReturn(0);
}

PetscErrorCode DatasetCreate(MPI_Comm comm, const char name[], PetscInt n, PetscInt components, Vec *field)
{
  PetscFunctionBegin;
  PetscCall(VecCreate(comm, field));
  PetscCall(VecSetSizes(*field, n * components, PETSC_DECIDE));
  PetscCall(VecSetBlockSize(*field, components));
  PetscCall(VecSetType(*field, VECSTANDARD));
  PetscCall(PetscObjectSetName((PetscObject)*field, name));
  PetscFunctionReturn(0);
}

/* Writes and destroys the field. A field with one component is written without a second dimension. */
PetscErrorCode DatasetWrite(Vec *field, PetscViewer viewer)
{
  const PetscScalar *values;
  const char        *name;
  PetscInt           n, components;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetName((PetscObject)*field, &name));
  PetscCall(VecGetLocalSize(*field, &n));
  PetscCall(VecGetBlockSize(*field, &components));
  PetscCall(VecGetArrayRead(*field, &values));
  PetscCall(DatasetWriteRecords(PetscObjectComm((PetscObject)*field), viewer, name, PETSC_SCALAR,
    components > 1 ? 2 : 1, n / components, components, values));
  PetscCall(VecRestoreArrayRead(*field, &values));
  PetscCall(VecDestroy(field));
  PetscFunctionReturn(0);
}

PetscErrorCode DatasetWriteIndices(IS is, PetscViewer viewer)
{
  const PetscInt *indices;
  const char     *name;
  PetscInt        n, components;
  PetscLayout     layout;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetName((PetscObject)is, &name));
  PetscCall(ISGetLayout(is, &layout));
  PetscCall(PetscLayoutGetBlockSize(layout, &components));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &indices));
  PetscCall(DatasetWriteRecords(PetscObjectComm((PetscObject)is), viewer, name, PETSC_INT, 2, n / components,
    components, indices));
  PetscCall(ISRestoreIndices(is, &indices));
  PetscFunctionReturn(0);
}
