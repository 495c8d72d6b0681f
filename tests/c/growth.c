/* The library for C: calls on several threads do not make the process grow, on a machine that is busy either. Prints kB
 * per call, and returns 1 if they are too many. */
#define _GNU_SOURCE
#include <bihive.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { kSpheres = 2000, kPoints = 600, kThreads = 2, kBusy = 2, kWarmUp = 100, kCalls = 400, kRounds = 4 };

/* An arena of oneTBB per call was 7 kB. */
static const double kMostPerCall = 0.5;

static double xyz[3 * kSpheres], radii[kSpheres], points[3 * kPoints];

static long resident_kb(void) {
  char line[256];
  long kb = 0;
  FILE* const file = fopen("/proc/self/status", "r");
  if (file == NULL) return 0;
  while (fgets(line, sizeof line, file) != NULL)
    if (strncmp(line, "VmRSS:", 6) == 0) kb = atol(line + 6);
  fclose(file);
  return kb;
}

/* Takes processor time until the parent ends. */
static pid_t start_busy(void) {
  const pid_t child = fork();
  if (child != 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (volatile unsigned long i = 0;; ++i)
    ;
}

static int nearest(const bihive_tree* tree) {
  static double distances[kPoints];
  static int64_t ids[kPoints];
  return bihive_nearest(tree, points, kPoints, 1, INFINITY, 0, 0, kThreads, distances, ids);
}

static int new_tree(const bihive_tree* unused) {
  bihive_tree* tree = NULL;
  (void)unused;
  if (bihive_tree_new(xyz, radii, kSpheres, kThreads, &tree) != 0) return 1;
  bihive_tree_free(tree);
  return 0;
}

static int picture(const bihive_tree* unused) {
  static uint8_t rgba[4 * 96 * 72];
  static bihive_scene* scene = NULL;
  (void)unused;
  if (scene == NULL && bihive_scene_new(xyz, radii, NULL, kSpheres, "plain", &scene) != 0) return 1;
  return bihive_render(scene, 96, 72, 1, kThreads, rgba);
}

/* The smallest growth of some rounds: what grows with each call grows in all of them. */
static int grows(const char* name, int (*call)(const bihive_tree*), const bihive_tree* tree) {
  double least = INFINITY;
  for (int i = 0; i < kWarmUp; ++i)
    if (call(tree) != 0) return fprintf(stderr, "%s: %s\n", name, bihive_error_text()), 1;
  for (int round = 0; round < kRounds && least > kMostPerCall; ++round) {
    const long before = resident_kb();
    for (int i = 0; i < kCalls; ++i)
      if (call(tree) != 0) return fprintf(stderr, "%s: %s\n", name, bihive_error_text()), 1;
    least = fmin(least, (double)(resident_kb() - before) / kCalls);
  }
  printf("%s: %.2f kB per call\n", name, least);
  return least > kMostPerCall;
}

int main(void) {
  pid_t busy[kBusy];
  bihive_tree* tree = NULL;
  int failures = 0;
  for (int i = 0; i < 3 * kSpheres; ++i) xyz[i] = rand() / (double)RAND_MAX;
  for (int i = 0; i < kSpheres; ++i) radii[i] = 0.01;
  for (int i = 0; i < 3 * kPoints; ++i) points[i] = rand() / (double)RAND_MAX;
  for (int i = 0; i < kBusy; ++i) busy[i] = start_busy();
  if (bihive_tree_new(xyz, radii, kSpheres, kThreads, &tree) != 0) {
    fprintf(stderr, "%s\n", bihive_error_text());
    failures = 1;
  } else {
    failures += grows("bihive_nearest", nearest, tree);
    failures += grows("bihive_tree_new", new_tree, tree);
    failures += grows("bihive_render", picture, tree);
  }
  bihive_tree_free(tree);
  for (int i = 0; i < kBusy; ++i)
    if (busy[i] > 0) {
      kill(busy[i], SIGKILL);
      waitpid(busy[i], NULL, 0);
    }
  return failures != 0;
}
