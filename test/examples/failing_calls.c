// SPDX-License-Identifier: GPL-3.0-or-later
/* For LD_PRELOAD: the n-th system call that makes, writes or keeps a file fails.
 *
 * FAILING_CALL   which one, from 1; 0, or nothing: none
 * FAILING_ERROR  errno then
 * FAILING_MORE   1: so do all after it
 * FAILING_COUNT  a file that the number of calls is written to at the end
 *
 * Or the process sends itself a signal within a write:
 *
 * FAILING_SIGNAL  which signal
 * FAILING_WRITE   within which write, from 1
 * FAILING_START   only those count whose bytes begin so
 * FAILING_SHARE   of its bytes this many thousandths are written before
 *
 * A failing write of more than a byte has written half before, as a full disk does; the next fails then.
 * Calls on the standard streams do not count. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <sys/file.h>
#include <sys/stat.h>

static atomic_long calls;

static long number(const char *name) {
  const char *text = getenv(name);
  return text ? atol(text) : 0;
}

/* Whether this call fails; errno is set then. */
static int fails(void) {
  const long n = number("FAILING_CALL"), call = atomic_fetch_add(&calls, 1) + 1;
  if (n == 0 || call < n || (call > n && !number("FAILING_MORE")))
    return 0;
  errno = (int)number("FAILING_ERROR");
  return 1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((destructor)) static void tell(void) {
  const char *path = getenv("FAILING_COUNT");
  if (!path)
    return;
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld\n", atomic_load(&calls)), file = REAL(open)(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0 && REAL(write)(file, text, (size_t)length) == length)
    close(file);
}

/* Whether the signal comes within this write. */
static int is_interrupted(const void *bytes, size_t size) {
  static atomic_long writes;
  const long n = number("FAILING_WRITE");
  const char *start = getenv("FAILING_START");
  if (n == 0 || (start && (size < strlen(start) || memcmp(bytes, start, strlen(start)) != 0)))
    return 0;
  return atomic_fetch_add(&writes, 1) + 1 == n;
}

ssize_t write(int file, const void *bytes, size_t size) {
  static _Thread_local int is_short; /* half of a write has been made, and the rest is to fail */
  if (file <= 2)
    return REAL(write)(file, bytes, size);
  if (is_interrupted(bytes, size)) {
    const ssize_t part = REAL(write)(file, bytes, size * (size_t)number("FAILING_SHARE") / 1000);
    raise((int)number("FAILING_SIGNAL"));
    return part; /* the caller goes on with the rest */
  }
  if (is_short) {
    is_short = 0;
    errno = (int)number("FAILING_ERROR");
    return -1;
  }
  if (!fails())
    return REAL(write)(file, bytes, size);
  if (size < 2)
    return -1;
  is_short = 1;
  return REAL(write)(file, bytes, size / 2);
}

static int open_or_fail(int (*real)(const char *, int, ...), const char *path, int flags, mode_t mode) {
  return fails() ? -1 : real(path, flags, mode);
}
int open(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_or_fail(REAL(open), path, flags, mode);
}
int open64(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_or_fail(REAL(open64), path, flags, mode);
}
int fsync(int file) { return fails() ? -1 : REAL(fsync)(file); }
int fdatasync(int file) { return fails() ? -1 : REAL(fdatasync)(file); }
int rename(const char *from, const char *to) { return fails() ? -1 : REAL(rename)(from, to); }
int ftruncate(int file, off_t size) { return fails() ? -1 : REAL(ftruncate)(file, size); }
int ftruncate64(int file, off64_t size) { return fails() ? -1 : REAL(ftruncate64)(file, size); }
int fchmod(int file, mode_t mode) { return fails() ? -1 : REAL(fchmod)(file, mode); }
int flock(int file, int operation) { return fails() ? -1 : REAL(flock)(file, operation); }
