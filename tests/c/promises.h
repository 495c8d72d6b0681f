/* For the tests of the library for C: counts and prints broken promises. Each test is one file. */
#pragma once

#include <bihive.h>
#include <stdio.h>

static int failures = 0;

static void expect(int holds, const char* what, int line) {
  if (holds) return;
  ++failures;
  fprintf(stderr, "line %d: %s (last error: %s)\n", line, what, bihive_error_text());
}
#define EXPECT(condition) expect((condition) != 0, #condition, __LINE__)
