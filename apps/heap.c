/*
   The heap of the program. Large arrays are put into huge pages of the system. The AMG and matrices allocate and free
   hundreds of megabytes; in pages of 4 kB a quarter of their time would be spent on page faults and missing addresses.
   glibc has a setting for this, but only in the environment of a program that starts. So this program wraps glibc's
   functions.
*/
#define _DEFAULT_SOURCE /* declares madvise() */
#include "appsimpl.h"
#if defined(__GLIBC__)
  #include <malloc.h>
#endif
#if defined(__has_feature)
  #define HEAP_HAS(feature) __has_feature(feature)
#else
  #define HEAP_HAS(feature) 0
#endif
/* Sanitizers have allocators of their own */
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
  !HEAP_HAS(address_sanitizer) && !HEAP_HAS(memory_sanitizer) && !HEAP_HAS(thread_sanitizer)
  #include <errno.h>
  #include <stdint.h>
  #include <sys/mman.h>

/* Size of a huge page [byte]. With another size, on other processors, advice for such ranges is still valid. */
  #define HEAP_HUGE ((uintptr_t)1 << 21)

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
extern void  __libc_free(void *);

/* Asks the system for huge pages where an array covers them entirely. Returns the array. */
static void *HeapAdvise(void *array, size_t size)
{
  const uintptr_t first = ((uintptr_t)array + HEAP_HUGE - 1) & ~(HEAP_HUGE - 1);
  const uintptr_t end   = ((uintptr_t)array + size) & ~(HEAP_HUGE - 1);
  const int       error = errno;

  if (!array || size < HEAP_HUGE || end <= first) return array;
  (void)madvise((void *)first, end - first, MADV_HUGEPAGE);
  errno = error; /* a system without huge pages refuses, which does no harm */
  return array;
}

void *malloc(size_t size)
{
  return HeapAdvise(__libc_malloc(size), size);
}

void *calloc(size_t n, size_t size)
{
  return HeapAdvise(__libc_calloc(n, size), n * size);
}

void *realloc(void *array, size_t size)
{
  return HeapAdvise(__libc_realloc(array, size), size);
}

/* These belong to the same allocator, even if another one is loaded before glibc */
void free(void *array)
{
  __libc_free(array);
}

void *memalign(size_t alignment, size_t size)
{
  return HeapAdvise(__libc_memalign(alignment, size), size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
  return memalign(alignment, size);
}

int posix_memalign(void **array, size_t alignment, size_t size)
{
  void *new;

  if (alignment % sizeof(void *) || !alignment || alignment & (alignment - 1)) return EINVAL;
  new = memalign(alignment, size);
  if (!new) return ENOMEM;
  *array = new;
  return 0;
}
#endif

/*
   AppLimitHeap - limits the fragmentation of the heap

   Large arrays of the AMG and of matrices are freed and allocated again; in a heap they would leave holes. (two_block
   on mesh 2 would need 4.9 kB per unknown instead of 4.0.) Arrays of 16 MB or more are therefore mapped, and free
   memory at the end of the heap is returned to the system. With 1 MB, two_block needs 1 % less memory, but three times
   the page faults. SuperLU_DIST, which PETSc may link, switches mapping and returning off when it is loaded, by
   mallopt(M_MMAP_MAX, 0) and mallopt(M_TRIM_THRESHOLD, -1).
*/
void AppLimitHeap(void)
{
#if defined(__GLIBC__)
  (void)mallopt(M_MMAP_MAX, 1 << 16);
  (void)mallopt(M_MMAP_THRESHOLD, 1 << 24);
  (void)mallopt(M_TRIM_THRESHOLD, 1 << 24);
#endif
}
