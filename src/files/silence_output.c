/* Suppresses the output of libraries while a file is written. HDF5 prints a page for each error, and MPI-IO a line. */
#define _POSIX_C_SOURCE 200809L /* declares dup() and dup2() */
#include "filesimpl.h"
#include <fcntl.h>
#include <unistd.h>

void SilenceOutputBegin(SilencedOutput *mute)
{
  const int nowhere = open("/dev/null", O_WRONLY);

  for (int stream = 0; stream < 2; ++stream) mute->kept[stream] = nowhere < 0 ? -1 : dup(1 + stream);
  (void)fflush(stdout);
  (void)fflush(stderr);
  for (int stream = 0; stream < 2; ++stream) {
    if (mute->kept[stream] >= 0) (void)dup2(nowhere, 1 + stream);
  }
  if (nowhere >= 0) (void)close(nowhere);
}

void SilenceOutputEnd(SilencedOutput *mute)
{
  (void)fflush(stdout);
  (void)fflush(stderr);
  for (int stream = 0; stream < 2; ++stream) {
    if (mute->kept[stream] < 0) continue;
    (void)dup2(mute->kept[stream], 1 + stream);
    (void)close(mute->kept[stream]);
  }
}
