/* Checks that go on after a failure and count. */
#ifndef CDFP_TESTS_CHECK_H
#define CDFP_TESTS_CHECK_H

#include <stdio.h>
#include <string.h>

#include "cdfp/cdfp.h"

static int failures = 0;

#define CHECK(condition)                                              \
  do {                                                                \
    if (!(condition)) {                                               \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      ++failures;                                                     \
    }                                                                 \
  } while (0)

static const char* last_error(void) {
  static char text[4096];
  int64_t length = 0;
  cdfp_last_error(text, sizeof text, &length);
  return text;
}

/* The call is refused with this status, and the message holds these words. */
#define REFUSED(call, status, words)                                                                     \
  do {                                                                                                   \
    const int32_t got = (call);                                                                          \
    if (got != (status) || !strstr(last_error(), words)) {                                               \
      fprintf(stderr, "%s:%d: status %d, message '%s'; wanted %d, '%s'\n", __FILE__, __LINE__, (int)got, \
              last_error(), (int)(status), words);                                                       \
      ++failures;                                                                                        \
    }                                                                                                    \
  } while (0)

#define DONE(call)                                                                           \
  do {                                                                                       \
    const int32_t got = (call);                                                              \
    if (got != CDFP_OK) {                                                                    \
      fprintf(stderr, "%s:%d: status %d: %s\n", __FILE__, __LINE__, (int)got, last_error()); \
      ++failures;                                                                            \
    }                                                                                        \
  } while (0)

#endif
