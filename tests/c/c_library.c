/* The library for C, from C11: what each function of bihive.h promises. Prints the first broken promise, and returns 1.
 */
#include <bihive.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "promises.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define EXPECT_ERROR(call, text)                         \
  do {                                                   \
    EXPECT((call) == 1);                                 \
    EXPECT(strstr(bihive_error_text(), (text)) != NULL); \
  } while (0)

/* Three unit spheres along x, and one inside of the second. */
static const double kPlaces[] = {0, 0, 0, 4, 0, 0, 8, 0, 0, 4, 0, 0};
static const double kRadii[] = {1, 1, 1, 0.5};

static void test_rays(const bihive_tree* tree) {
  const float origins[] = {-5, 0, 0, 4, 0, 9, 0, 5, 0, 0, 0, 1};
  const float directions[] = {1, 0, 0, 0, 0, -2, 0, 1, 0, 0, 0, -1};
  const int64_t leaves[] = {-1, -1, -1, 0};
  const uint8_t inside[] = {0, 0, 0, 1};
  const double t_max[] = {INFINITY, INFINITY, INFINITY, 2};
  bihive_rays rays = {4, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
  double t[4];
  int64_t spheres[4];
  uint8_t hidden[4];
  bihive_lists* lists = NULL;
  rays.origins = origins;
  rays.directions = directions;
  rays.leaves = leaves;
  rays.inside = inside;
  rays.t_max = t_max;

  EXPECT(bihive_closest(tree, &rays, 1, t, spheres) == 0);
  EXPECT(spheres[0] == 0 && t[0] == 4);
  EXPECT(spheres[1] == 1 && t[1] == 4);
  EXPECT(spheres[2] == -1 && isinf(t[2]));
  EXPECT(spheres[3] == 0 && t[3] == 2); /* through the sphere on which it starts */
  EXPECT(bihive_occluded(tree, &rays, 2, hidden) == 0);
  EXPECT(hidden[0] == 1 && hidden[1] == 1 && hidden[2] == 0 && hidden[3] == 1);

  EXPECT(bihive_all_hits(tree, &rays, 0, &lists) == 0);
  if (lists != NULL) {
    const int64_t* begin = bihive_lists_begin(lists);
    const int64_t* ids = bihive_lists_spheres(lists);
    const double* at = bihive_lists_distances(lists);
    EXPECT(begin[0] == 0 && begin[1] == 4 && begin[2] == 6 && begin[3] == 6 && begin[4] == 7);
    EXPECT(ids[0] == 0 && ids[1] == 1 && ids[2] == 3 && ids[3] == 2 && ids[4] == 1 && ids[5] == 3 && ids[6] == 0);
    EXPECT(at[0] == 4 && at[1] == 8 && at[2] == 8.5 && at[3] == 12 && at[4] == 4 && at[5] == 4.25 && at[6] == 2);
  }
  bihive_lists_free(lists);

  rays.count = 0;
  EXPECT(bihive_closest(tree, &rays, 0, NULL, NULL) == 0);
  rays.count = -1;
  EXPECT_ERROR(bihive_closest(tree, &rays, 0, t, spheres), "negative");
  EXPECT_ERROR(bihive_closest(NULL, &rays, 0, t, spheres), "NULL");
  EXPECT_ERROR(bihive_occluded(tree, NULL, 0, hidden), "NULL");
}

/* What a tree answers after it has been moved is what a new tree answers. */
static void test_update(void) {
  const double moved[] = {0, 0, 0, 4, 3, 0, 8, 0, 0, 4, 3, 0}, larger[] = {1, 2, 1, 0.5};
  const double away[] = {0, 0, 0, NAN, 3, 0, 8, 0, 0, 4, 3, 0};
  const double vectors[] = {10, 0, 0, 0, 0, 0, 0, 0, 0}, wider[] = {20, 0, 0, 0, 0, 0, 0, 0, 0};
  const double point[] = {4, 3, 2}, beside[] = {-11, 0, 0};
  double distance = 0;
  int64_t id = -1;
  bihive_tree *tree = NULL, *in_cell = NULL;
  EXPECT(bihive_tree_new(kPlaces, kRadii, 4, 1, &tree) == 0);
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT(bihive_tree_update(tree, moved, NULL, 4, NULL, 1) == 0);
    EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_SURFACE, NULL, 1, &distance, &id) == 0);
    EXPECT(id == 1 && distance == 1);
    EXPECT(bihive_tree_update(tree, moved, larger, 4, NULL, 1) == 0);
    EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_SURFACE, NULL, 1, &distance, &id) == 0);
    EXPECT(id == 1 && distance == 0);
    EXPECT(bihive_tree_update(tree, kPlaces, kRadii, 4, NULL, 1) == 0);
    EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &distance, &id) == 0);
    EXPECT(id == 1 && distance == sqrt(13));
  }

  /* A refused update changes nothing. */
  EXPECT_ERROR(bihive_tree_update(tree, moved, NULL, 3, NULL, 1), "4 spheres");
  EXPECT_ERROR(bihive_tree_update(tree, moved, kRadii, 3, NULL, 1), "4 spheres");
  EXPECT_ERROR(bihive_tree_update(tree, away, NULL, 4, NULL, 1), "sphere 1");
  EXPECT_ERROR(bihive_tree_update(tree, NULL, NULL, 4, NULL, 1), "NULL");
  EXPECT_ERROR(bihive_tree_update(NULL, moved, NULL, 4, NULL, 1), "NULL");
  EXPECT_ERROR(bihive_tree_update(tree, moved, NULL, 4, vectors, 1), "bihive_tree_new_in_cell");
  EXPECT(bihive_tree_size(tree) == 4);
  EXPECT(bihive_nearest(tree, point, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &distance, &id) == 0);
  EXPECT(id == 1 && distance == sqrt(13));
  bihive_tree_free(tree);

  /* The cell stays, or gets other vectors. The image of sphere 2 at -12, and the one of sphere 0 at -10. */
  EXPECT(bihive_tree_new_in_cell(moved, kRadii, 4, vectors, 1, &in_cell) == 0);
  EXPECT(bihive_tree_update(in_cell, kPlaces, NULL, 4, NULL, 1) == 0);
  EXPECT(bihive_nearest(in_cell, beside, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &distance, &id) == 0);
  EXPECT(id == 0 && distance == 1);
  EXPECT(bihive_tree_update(in_cell, kPlaces, NULL, 4, wider, 1) == 0);
  EXPECT(bihive_nearest(in_cell, beside, 1, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, &distance, &id) == 0);
  EXPECT(id == 2 && distance == 1);
  bihive_tree_free(in_cell);
}

/* Far from 0 no digit is lost that the set's own extent has room for. */
static void test_far_spheres(void) {
  const double places[] = {500000.03, 5400000.01, 100, 500000.23, 5400000.01, 100};
  const double radii[] = {0.05, 0.05}, wide_places[] = {-1e6, 0, 0, 1e6 + 0.03, 0, 0};
  const double origins[] = {500000.03, 5400000.01, 90, 500000.23, 5400000.01, 90};
  const float directions[] = {0, 0, 1, 0, 0, 1};
  bihive_rays rays = {2, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
  bihive_tree* tree = NULL;
  double t[2], distances[2];
  int64_t spheres[2];
  rays.origins64 = origins;
  rays.directions = directions;
  EXPECT(bihive_tree_new(places, radii, 2, 1, &tree) == 0);
  EXPECT(strcmp(bihive_tree_warning(tree), "") == 0);
  EXPECT(bihive_closest(tree, &rays, 1, t, spheres) == 0);
  EXPECT(spheres[0] == 0 && fabs(t[0] - 9.95) < 1e-6);
  EXPECT(spheres[1] == 1 && fabs(t[1] - 9.95) < 1e-6);
  EXPECT(bihive_nearest(tree, places, 2, 1, INFINITY, BIHIVE_CENTRE, NULL, 1, distances, spheres) == 0);
  EXPECT(spheres[0] == 0 && distances[0] < 1e-7 && spheres[1] == 1 && distances[1] < 1e-7);
  bihive_tree_free(tree);
  EXPECT(bihive_tree_new(wide_places, radii, 2, 1, &tree) == 0);
  EXPECT(strstr(bihive_tree_warning(tree), "moves 1 of 2 centres") != NULL);
  bihive_tree_free(tree);
}

/* More rays than one part of them holds: each column of a comb meets the sphere below it, on any number of threads. */
static void test_many_rays(const bihive_tree* tree) {
  const int64_t count = 300000;
  float* origins = malloc((size_t)count * 3 * sizeof(float));
  float* directions = malloc((size_t)count * 3 * sizeof(float));
  double* t = malloc((size_t)count * sizeof(double));
  int64_t* spheres = malloc((size_t)count * sizeof(int64_t));
  bihive_rays rays = {0, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
  int64_t i, wrong = 0, hits = 0;
  bihive_lists* lists = NULL;
  if (origins == NULL || directions == NULL || t == NULL || spheres == NULL) exit(3);
  for (i = 0; i < count; ++i) {
    origins[3 * i] = (float)(i % 3) * 4;
    origins[3 * i + 1] = (float)(i % 7) * 0.25f;
    origins[3 * i + 2] = 5;
    directions[3 * i] = directions[3 * i + 1] = 0;
    directions[3 * i + 2] = -1;
  }
  rays.count = count;
  rays.origins = origins;
  rays.directions = directions;
  EXPECT(bihive_closest(tree, &rays, 2, t, spheres) == 0);
  for (i = 0; i < count; ++i) {
    const int64_t expected = i % 7 <= 4 ? i % 3 : -1;
    wrong += spheres[i] != expected;
    hits += expected < 0 ? 0 : expected == 1 && i % 7 <= 2 ? 2 : 1;
  }
  EXPECT(wrong == 0);
  EXPECT(bihive_all_hits(tree, &rays, 2, &lists) == 0);
  if (lists != NULL) {
    EXPECT(bihive_lists_begin(lists)[count] == hits);
    for (i = 0, wrong = 0; i < count; ++i)
      if (bihive_lists_begin(lists)[i] < bihive_lists_begin(lists)[i + 1])
        wrong += bihive_lists_spheres(lists)[bihive_lists_begin(lists)[i]] != spheres[i];
    EXPECT(wrong == 0);
  }
  bihive_lists_free(lists);
  free(origins);
  free(directions);
  free(t);
  free(spheres);
}

/* One sphere in the primitive cell of a face-centred cubic crystal: twelve neighbours, all of them its images. */
static void test_cells(void) {
  const double place[] = {0, 0, 0}, radius = 0.1;
  const double vectors[] = {0, 1, 1, 1, 0, 1, 1, 1, 0}, limit = 1.5, infinite = INFINITY;
  double broken[] = {1, 0, 0, 0, 1, 0, 0, 0, NAN};
  double distances[13];
  int64_t spheres[13];
  const float origin[] = {-1, 0, 0}, channel[] = {0, 0.5f, 0}, along[] = {1, 0, 0};
  const double ray_begin = 8, ray_end = 11;
  bihive_rays rays = {1, origin, along, &ray_begin, NULL, NULL, NULL, NULL};
  uint8_t hidden[1];
  bihive_lists* lists = NULL;
  bihive_tree* tree = NULL;
  EXPECT(bihive_tree_new_in_cell(place, &radius, 1, vectors, 0, &tree) == 0);
  EXPECT(bihive_within(tree, place, 1, &limit, BIHIVE_CENTRE, NULL, 0, &lists) == 0);
  if (lists != NULL) EXPECT(bihive_lists_begin(lists)[1] == 13 && bihive_lists_spheres(lists)[12] == 0);
  bihive_lists_free(lists);
  double porosity = 0, error = 1;
  EXPECT(bihive_porosity(tree, 0.2, NULL, 0, &porosity, &error) == 0 && error < 1e-12);
  EXPECT(fabs(porosity - (1 - 4 * 3.14159265358979323846 / 3 * 0.027 / 2)) < 1e-8);
  EXPECT(bihive_nearest(tree, place, 1, 13, INFINITY, BIHIVE_CENTRE, NULL, 0, distances, spheres) == 0);
  EXPECT(distances[0] == 0 && distances[1] == sqrt(2) && distances[12] == sqrt(2) && spheres[12] == 0);
  const int64_t itself = 0; /* its images count */
  EXPECT(bihive_within_others(tree, place, 1, &limit, BIHIVE_CENTRE, NULL, &itself, 0, &lists) == 0);
  if (lists != NULL) EXPECT(bihive_lists_begin(lists)[1] == 12 && bihive_lists_distances(lists)[0] > 1);
  bihive_lists_free(lists);
  EXPECT_ERROR(bihive_within(tree, place, 1, &infinite, BIHIVE_CENTRE, NULL, 0, &lists), "million images");
  EXPECT(bihive_closest(tree, &rays, 0, distances, spheres) == 0);
  EXPECT(spheres[0] == 0 && fabs(distances[0] - 8.9) < 1e-6);
  double at[3], normal[3], exit_at;
  EXPECT(bihive_surfaces(tree, &rays, distances, spheres, 0, at, normal, &exit_at) == 0);
  EXPECT(fabs(at[0] - 7.9) < 1e-6 && at[1] == 0 && normal[0] == -1 && fabs(exit_at - 9.1) < 1e-6);
  distances[1] = nextafter(distances[0], 0);
  EXPECT_ERROR(bihive_surfaces(tree, &rays, distances + 1, spheres, 0, at, NULL, NULL), "not that of its ray");
  EXPECT(bihive_occluded(tree, &rays, 0, hidden) == 0 && hidden[0] == 1);
  EXPECT_ERROR(bihive_all_hits(tree, &rays, 0, &lists), "ray 0 passes more than 16384 periodic cells");
  rays.t_max = &ray_end;
  EXPECT(bihive_all_hits(tree, &rays, 0, &lists) == 0);
  if (lists != NULL) EXPECT(bihive_lists_begin(lists)[1] == 2);
  bihive_lists_free(lists);
  rays.origins = channel;
  EXPECT(bihive_closest(tree, &rays, 0, distances, spheres) == 0 && spheres[0] == -1);
  rays.t_max = NULL;
  EXPECT_ERROR(bihive_closest(tree, &rays, 0, distances, spheres), "without an end");
  EXPECT_ERROR(bihive_occluded(tree, &rays, 0, hidden), "without an end");
  bihive_tree_free(tree);
  EXPECT_ERROR(bihive_tree_new_in_cell(place, &radius, 1, broken, 0, &tree), "finite");
  EXPECT_ERROR(bihive_tree_new_in_cell(place, &radius, 1, NULL, 0, &tree), "NULL");
  EXPECT(tree == NULL);
}

static void test_measures(const bihive_tree* tree) {
  const uint8_t mask[] = {1, 0, 0, 0};
  double area = 0, volume = 0, whole = 0, areas[4];
  EXPECT(bihive_measure(tree, 0.5, mask, 1, &area, &volume, areas) == 0);
  EXPECT(fabs(area - 4 * 3.14159265358979323846 * 1.5 * 1.5) < 1e-13 && areas[0] == area && areas[1] == 0);
  EXPECT(fabs(volume - area * 1.5 / 3) < 1e-13);
  EXPECT(bihive_measure(tree, 0, NULL, 0, &whole, NULL, areas) == 0);
  EXPECT(fabs(whole - (areas[0] + areas[1] + areas[2] + areas[3])) < 1e-12);
  EXPECT_ERROR(bihive_measure(tree, -1, NULL, 0, &area, NULL, NULL), "at least 0");
  EXPECT_ERROR(bihive_measure(tree, 0, NULL, -1, &area, NULL, NULL), "threads is negative");
  EXPECT_ERROR(bihive_measure(NULL, 0, NULL, 0, &area, NULL, NULL), "NULL");
  EXPECT_ERROR(bihive_porosity(tree, 0, NULL, 0, &area, NULL), "cell");

  /* Two spheres that meet in a disc of radius sqrt(3) / 2, and one apart. */
  const double places[] = {0, 0, 0, 1, 0, 0, 9, 0, 0}, radii[] = {1, 1, 1}, kPi = 3.14159265358979323846;
  const int32_t groups[] = {0, 1, -1}, bad_groups[] = {0, 2, -1};
  double volumes[3], by_centre[9], by_radius[3], buried[4];
  bihive_lists* lists = NULL;
  bihive_tree* two = NULL;
  EXPECT(bihive_tree_new(places, radii, 3, 0, &two) == 0);
  EXPECT(bihive_sphere_volumes(two, 0, NULL, 0, volumes) == 0);
  EXPECT(fabs(volumes[0] - (4 * kPi / 3 - kPi / 3 * 0.25 * 2.5)) < 1e-14 && fabs(volumes[2] - 4 * kPi / 3) < 1e-14);
  EXPECT(bihive_contacts(two, 0, NULL, 0, &lists) == 0);
  if (lists != NULL) {
    EXPECT(bihive_lists_begin(lists)[1] == 1 && bihive_lists_begin(lists)[3] == 1);
    EXPECT(bihive_lists_spheres(lists)[0] == 1 && fabs(bihive_lists_distances(lists)[0] - 0.75 * kPi) < 1e-14);
  }
  bihive_lists_free(lists);
  EXPECT(bihive_measure_derivatives(two, 0, NULL, 0, by_centre, by_radius, NULL, NULL) == 0);
  EXPECT(fabs(by_centre[3] - 2 * kPi) < 1e-13 && by_centre[6] == 0 && fabs(by_radius[2] - 8 * kPi) < 1e-13);
  EXPECT(bihive_buried_areas(two, 0, groups, 2, 0, buried) == 0);
  EXPECT(fabs(buried[0] - 4 * kPi) < 1e-13 && fabs(buried[1] - 2 * kPi) < 1e-13 && buried[2] == buried[1]);
  EXPECT_ERROR(bihive_buried_areas(two, 0, bad_groups, 2, 0, buried), "from -1 to below");
  EXPECT_ERROR(bihive_contacts(two, 0, NULL, 0, NULL), "NULL");
  bihive_tree_free(two);
}

static void test_points(const bihive_tree* tree) {
  const double points[] = {4, 0, 0, 2, 0, 0, 6.5, 0, 0};
  const double limits[] = {-0.75, 1, 1};
  const double bad[] = {0, NAN, 0};
  const uint8_t mask[] = {1, 0, 1, 1};
  double distances[6];
  int64_t spheres[6];
  bihive_lists* lists = NULL;

  EXPECT(bihive_nearest(tree, points, 3, 2, INFINITY, BIHIVE_SURFACE, NULL, 0, distances, spheres) == 0);
  EXPECT(spheres[0] == 1 && spheres[1] == 3 && distances[0] == -1 && distances[1] == -0.5);
  EXPECT(spheres[2] == 0 && spheres[3] == 1 && distances[2] == 1 && distances[3] == 1);
  EXPECT(spheres[4] == 2 && spheres[5] == 1 && distances[4] == 0.5 && distances[5] == 1.5);
  EXPECT(bihive_nearest(tree, points, 1, 2, 0.25, BIHIVE_CENTRE, mask, 1, distances, spheres) == 0);
  EXPECT(spheres[0] == 3 && distances[0] == 0 && spheres[1] == -1 && isinf(distances[1]));

  EXPECT(bihive_within(tree, points, 3, NULL, BIHIVE_SURFACE, NULL, 0, &lists) == 0);
  if (lists != NULL) {
    const int64_t* begin = bihive_lists_begin(lists);
    EXPECT(begin[1] == 2 && begin[2] == 2 && begin[3] == 2);
    EXPECT(bihive_lists_spheres(lists)[0] == 1 && bihive_lists_spheres(lists)[1] == 3);
    EXPECT(bihive_lists_distances(lists)[1] == -0.5);
  }
  bihive_lists_free(lists);
  EXPECT(bihive_within(tree, points, 3, limits, BIHIVE_SURFACE, NULL, 2, &lists) == 0);
  if (lists != NULL) {
    const int64_t* begin = bihive_lists_begin(lists);
    EXPECT(begin[1] == 1 && begin[2] == 3 && begin[3] == 4);
  }
  bihive_lists_free(lists);

  int64_t counts[3];
  EXPECT(bihive_count_within(tree, points, 3, limits, BIHIVE_SURFACE, NULL, 0, counts) == 0);
  EXPECT(counts[0] == 1 && counts[1] == 2 && counts[2] == 1);
  EXPECT(bihive_count_within(tree, points, 3, NULL, BIHIVE_SURFACE, mask, 0, counts) == 0);
  EXPECT(counts[0] == 1 && counts[1] == 0 && counts[2] == 0);
  const int64_t exclude[] = {1, -1, 2};
  EXPECT(bihive_nearest_others(tree, points, 3, 1, INFINITY, BIHIVE_SURFACE, NULL, exclude, 0, distances, spheres) ==
         0);
  EXPECT(spheres[0] == 3 && spheres[1] == 0 && spheres[2] == 1 && distances[2] == 1.5);
  EXPECT(bihive_count_others_within(tree, points, 3, limits, BIHIVE_SURFACE, NULL, exclude, 0, counts) == 0);
  EXPECT(counts[0] == 0 && counts[1] == 2 && counts[2] == 0);
  EXPECT_ERROR(bihive_count_within(tree, points, 3, NULL, BIHIVE_SURFACE, NULL, 0, NULL), "no place for the counts");

  EXPECT(bihive_pairs(tree, 2, BIHIVE_SURFACE, NULL, 0, &lists) == 0);
  if (lists != NULL) {
    const int64_t* begin = bihive_lists_begin(lists);
    const int64_t* others = bihive_lists_spheres(lists);
    EXPECT(begin[0] == 0 && begin[1] == 1 && begin[2] == 3 && begin[4] == 3);
    EXPECT(others[0] == 1 && others[1] == 2 && others[2] == 3);
    EXPECT(bihive_lists_distances(lists)[0] == 2 && bihive_lists_distances(lists)[2] == -1.5);
  }
  bihive_lists_free(lists);
  EXPECT_ERROR(bihive_pairs(tree, NAN, BIHIVE_CENTRE, NULL, 0, &lists), "must be a number");

  EXPECT_ERROR(bihive_nearest(tree, bad, 1, 1, 1, BIHIVE_SURFACE, NULL, 0, distances, spheres),
               "point 0: y must be finite");
  EXPECT_ERROR(bihive_nearest(tree, points, 3, 0, 1, BIHIVE_SURFACE, NULL, 0, distances, spheres), "at least 1");
  EXPECT_ERROR(bihive_nearest(tree, points, 3, 1, 1, 7, NULL, 0, distances, spheres), "BIHIVE_CENTRE");
  lists = (bihive_lists*)&lists;
  EXPECT_ERROR(bihive_within(tree, bad, 1, NULL, BIHIVE_SURFACE, NULL, 0, &lists), "point 0");
  EXPECT(lists == NULL);
}

static void test_structures(const bihive_tree* tree) {
  const double vectors[] = {40, 0, 0, 0, 40, 0, 0, 0, 40};
  char* json = NULL;
  bihive_tree *none = NULL, *in_cell = NULL;
  EXPECT(bihive_compare(tree, "bih,octree", "random", 64, 1, &json) == 0);
  if (json != NULL) EXPECT(strstr(json, "\"octree\"") != NULL && strstr(json, "\"same_bits\": true") != NULL);
  bihive_text_free(json);
  EXPECT(bihive_tune(tree, "bvh-lbvh", "random,points", 16, 1, &json) == 0);
  if (json != NULL) EXPECT(strstr(json, "\"bvh-lbvh\"") != NULL && strstr(json, "\"gain\"") != NULL);
  bihive_text_free(json);
  bihive_text_free(NULL);
  json = (char*)&json;
  EXPECT_ERROR(bihive_compare(tree, "bhi", NULL, 64, 1, &json), "did you mean bih");
  EXPECT(json == NULL);
  EXPECT_ERROR(bihive_compare(tree, "bih,bih", "random", 64, 1, &json), "bih stands twice");
  EXPECT_ERROR(bihive_compare(tree, NULL, "random,random", 64, 1, &json), "twice");
  EXPECT_ERROR(bihive_compare(tree, NULL, "sideways", 64, 1, &json), "there are primary, random");
  EXPECT_ERROR(bihive_compare(tree, NULL, NULL, 0, 1, &json), "1 to 1073741824");
  EXPECT_ERROR(bihive_compare(tree, NULL, NULL, 64, 1, NULL), "no place");
  EXPECT_ERROR(bihive_compare(NULL, NULL, NULL, 64, 1, &json), "NULL");
  EXPECT_ERROR(bihive_tune(tree, "brute", NULL, 64, 1, &json), "brute");
  EXPECT_ERROR(bihive_tune(tree, NULL, NULL, 64, -1, &json), "negative");
  EXPECT(bihive_tree_new(NULL, NULL, 0, 0, &none) == 0);
  EXPECT_ERROR(bihive_tune(none, NULL, NULL, 64, 1, &json), "no sphere");
  EXPECT(bihive_tree_new_in_cell(kPlaces, kRadii, 4, vectors, 0, &in_cell) == 0);
  EXPECT_ERROR(bihive_compare(in_cell, NULL, NULL, 64, 1, &json), "without a cell");
  bihive_tree_free(none);
  bihive_tree_free(in_cell);
}

static void test_trees(void) {
  bihive_tree* tree = NULL;
  const double infinite[] = {0, INFINITY, 0}, negative = -1, one = 1;
  EXPECT(bihive_tree_new(NULL, NULL, 0, 0, &tree) == 0);
  EXPECT(bihive_tree_size(tree) == 0);
  bihive_tree_free(tree);
  EXPECT_ERROR(bihive_tree_new(infinite, &one, 1, 0, &tree), "sphere 0: y must be finite");
  EXPECT(tree == NULL);
  EXPECT_ERROR(bihive_tree_new(kPlaces, &negative, 1, 0, &tree), "radius must not be negative");
  EXPECT_ERROR(bihive_tree_new(NULL, kRadii, 4, 0, &tree), "NULL");
  bihive_tree_free(NULL);

  EXPECT(bihive_tree_new(kPlaces, kRadii, 4, 1, &tree) == 0);
  EXPECT(bihive_tree_size(tree) == 4);
  if (tree == NULL) return;
  test_rays(tree);
  test_many_rays(tree);
  test_points(tree);
  test_measures(tree);
  test_structures(tree);
  bihive_tree_free(tree);
}

enum { kWidth = 96, kHeight = 64 };

static const uint8_t* pixel(const uint8_t* rgba, int x, int y) {
  return rgba + 4 * (y * kWidth + x);
}

static void test_pictures(void) {
  static uint8_t one[kWidth * kHeight * 4], other[kWidth * kHeight * 4];
  const double places[] = {-2, 0, 0, 2, 0, 0}, radii[] = {1, 1};
  const uint8_t colours[] = {255, 0, 0, 0, 0, 255};
  const char* json = "{\"bihive_scene\": 1, \"spheres\": [[0, 0, 0, 1]]}";
  const char* xyz = "2\ntwo\nO 0 0 0\nC 3 0 0\n";
  const char* spins = "x,y,z,r,sx,sy,sz\n0,0,0,0.4,0,1,0\n";
  const char* of_arrows[] = {"arrows", "arrow_scale", "arrow_share", "arrow_radius", "arrow_colour", "arrow_pivot"};
  bihive_scene* scene = NULL;

  EXPECT(bihive_scene_methods(NULL) == NULL);
  EXPECT(bihive_scene_new(places, radii, colours, 2, "plain", &scene) == 0);
  EXPECT(bihive_scene_methods(scene) == NULL);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 1, one) == 0);
  EXPECT(strstr(bihive_scene_methods(scene), "2 spheres, style plain, perspective") != NULL);
  EXPECT(strstr(bihive_scene_methods(scene), "@misc{bihive,") != NULL);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 2, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  EXPECT(pixel(one, 24, 32)[0] > pixel(one, 24, 32)[2] + 50); /* the red one is left in front */
  EXPECT(pixel(one, 72, 32)[2] > pixel(one, 72, 32)[0] + 50);
  EXPECT(pixel(one, 0, 0)[0] == 255 && pixel(one, 0, 0)[1] == 255 && pixel(one, 0, 0)[3] == 255);
  EXPECT(bihive_scene_view_from(scene, "back") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(pixel(other, 24, 32)[2] > pixel(other, 24, 32)[0] + 50);
  EXPECT_ERROR(bihive_scene_view_from(scene, "below"), "iso");

  /* Parameters by name: a picture with outlines is another one, and the scene's own comes back. */
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, one) == 0);
  EXPECT(bihive_scene_set(scene, "outline", "3") == 0);
  EXPECT(bihive_scene_set(scene, "outline_colour", "#00ff00") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) != 0);
  EXPECT(bihive_scene_set(scene, "outline_px", NULL) == 0 && bihive_scene_set(scene, "outline_colour", NULL) == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  EXPECT_ERROR(bihive_scene_set(scene, "ligth_points", "3"), "did you mean light_points");
  EXPECT_ERROR(bihive_scene_set(scene, "width_px", "20"), "arguments of bihive_render");
  EXPECT_ERROR(bihive_scene_set(scene, "outline_colour", "reddish"), "the name of a colour");
  EXPECT(bihive_scene_set(scene, "cell", "true") == 0);
  EXPECT_ERROR(bihive_render(scene, kWidth, kHeight, 1, 0, other), "no periodic cell");
  EXPECT(bihive_scene_set(scene, "cell", NULL) == 0);
  EXPECT_ERROR(bihive_scene_set(scene, "light_points", "0"), "a whole number from 1 to 1024");
  EXPECT_ERROR(bihive_scene_set(scene, "fog", NULL) || bihive_scene_set(NULL, "fog", "1"), "NULL");

  /* Camera, appearance and lights by name, in their order; NULL takes them back. */
  EXPECT(bihive_scene_set(scene, "turn", "30,20") == 0 && bihive_scene_set(scene, "light", "headlight") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) != 0);
  EXPECT(bihive_scene_set(scene, "turn", NULL) == 0 && bihive_scene_set(scene, "light", NULL) == 0);
  EXPECT(bihive_scene_set(scene, "select", "x > 0") == 0 && bihive_scene_set(scene, "hide", "true") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) != 0);
  EXPECT(bihive_scene_set(scene, "select", "x < 0") == 0 && bihive_scene_set(scene, "outline", "4") == 0);
  EXPECT(bihive_scene_set(scene, "select", NULL) == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  EXPECT_ERROR(bihive_scene_set(scene, "zoom", "-1"), "zoom: ");
  EXPECT_ERROR(bihive_scene_set(scene, "select", "x >"), "select: ");
  EXPECT_ERROR(bihive_scene_set(scene, "hide", "maybe"), "true or false");
  EXPECT_ERROR(bihive_scene_set(scene, "radius", "2"), "is for files");
  EXPECT(bihive_scene_set(scene, "periodic", "false") == 0 && bihive_scene_set(scene, "periodic", "true") == 0);
  EXPECT(bihive_scene_set(scene, "no_periodic", "true") == 0 && bihive_scene_set(scene, "no_periodic", NULL) == 0);
  EXPECT(bihive_scene_set(scene, "periodic", NULL) == 0);
  EXPECT_ERROR(bihive_scene_set(scene, "radius_scale", "2"), "is for files");
  EXPECT_ERROR(bihive_scene_set(scene, "crop", "0,0,1,1"), "whole pictures");
  EXPECT(bihive_scene_set(scene, "view", "tree") == 0 && bihive_scene_set(scene, "max_prims", "1") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(bihive_scene_set(scene, "view", NULL) == 0 && bihive_scene_set(scene, "max_prims", NULL) == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  EXPECT_ERROR(bihive_render(scene, 0, 10, 1, 0, other), "65535");
  EXPECT_ERROR(bihive_render(scene, 10, 10, 5000, 0, other), "4096");
  EXPECT_ERROR(bihive_render(scene, 10, 10, 1, 0, NULL), "no place");
  bihive_scene_free(scene);

  EXPECT(bihive_scene_from_bytes(xyz, strlen(xyz), "two.xyz", NULL, &scene) == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 0, 0, one) == 0);
  EXPECT(strstr(bihive_scene_methods(scene), " of two.xyz (SHA-256 ") != NULL);
  bihive_scene_free(scene);
  EXPECT(bihive_scene_from_bytes(json, strlen(json), "one.json", NULL, &scene) == 0);
  if (scene != NULL) EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, one) == 0);
  bihive_scene_free(scene);

  /* Arrows along columns: up, in a picture whose sphere is small, green where they are. */
  EXPECT(bihive_scene_from_bytes(spins, strlen(spins), "spins.csv", "plain", &scene) == 0);
  EXPECT(bihive_scene_set(scene, "eye", "0,0,20") == 0 && bihive_scene_set(scene, "look_at", "0,0,0") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, one) == 0);
  EXPECT(bihive_scene_set(scene, "arrows", "sx,sy,sz") == 0 && bihive_scene_set(scene, "arrow_scale", "3") == 0);
  EXPECT(bihive_scene_set(scene, "arrow_radius", "0.5") == 0 &&
         bihive_scene_set(scene, "arrow_colour", "#00ff00") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(pixel(one, 48, 22)[0] == 255 && pixel(other, 48, 22)[1] > pixel(other, 48, 22)[0] + 50);
  EXPECT(memcmp(pixel(one, 48, 50), pixel(other, 48, 50), 4) == 0); /* not below */
  EXPECT(bihive_scene_set(scene, "arrow_pivot", "middle") == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(pixel(other, 48, 38)[1] > pixel(other, 48, 38)[0] + 50);
  EXPECT_ERROR(bihive_scene_set(scene, "arrow_scale", "0"), "arrow_scale");
  EXPECT(bihive_scene_set(scene, "arrows", "sx,sy,nowhere") == 0);
  EXPECT_ERROR(bihive_render(scene, kWidth, kHeight, 1, 0, other), "nowhere");
  for (size_t i = 0; i < COUNT(of_arrows); ++i) EXPECT(bihive_scene_set(scene, of_arrows[i], NULL) == 0);
  EXPECT(bihive_render(scene, kWidth, kHeight, 1, 0, other) == 0);
  EXPECT(memcmp(one, other, sizeof one) == 0);
  bihive_scene_free(scene);

  EXPECT_ERROR(bihive_scene_from_bytes("{", 1, "broken.json", NULL, &scene), "broken.json:1");
  EXPECT(scene == NULL);
  EXPECT_ERROR(bihive_scene_new(places, radii, NULL, 2, "nonsense", &scene), "nonsense");
  EXPECT_ERROR(bihive_scene_new(places, radii, NULL, 0, NULL, &scene), "at least one");
  bihive_scene_free(NULL);
}

/* A sphere at 0, one at 4, and between them a stick; then a cone along z with its point at 9. */
static void test_bodies(void) {
  const double places[] = {0, 0, 0, 4, 0, 0}, radii[] = {1, 1};
  const double ends[] = {0, 0, 0, 4, 0, 0, 20, 0, 0, 20, 0, 9}, end_radii[] = {0.25, 0.25, 1, 0};
  const float origins[] = {2, 9, 0, 0, 9, 0, 20, 9, 3, 2, 9, 5, 3, 9, 0};
  const float directions[] = {0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0};
  const double t_max[] = {100, 100, 100, 100, 8};
  bihive_rays rays = {5, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
  bihive_bodies* bodies = NULL;
  double t[5], along[5];
  uint8_t kinds[5], hidden[5];
  int64_t ids[5];
  rays.origins = origins;
  rays.directions = directions;
  rays.t_max = t_max;
  EXPECT(bihive_bodies_new(places, radii, 2, ends, end_radii, 2, 1, &bodies) == 0);
  EXPECT(bihive_bodies_closest(bodies, &rays, 1, t, kinds, ids, along) == 0);
  EXPECT(kinds[0] == BIHIVE_STICK && ids[0] == 0 && t[0] == 8.75 && along[0] == 0.5);
  EXPECT(kinds[1] == BIHIVE_SPHERE && ids[1] == 0 && t[1] == 8 && along[1] == 0);
  EXPECT(kinds[2] == BIHIVE_STICK && ids[2] == 1 && fabs(along[2] - 0.325) < 1e-9);
  EXPECT(fabs(t[2] - (9 - sqrt(0.45))) < 1e-9);
  EXPECT(kinds[3] == BIHIVE_NOTHING && ids[3] == -1 && isinf(t[3]));
  EXPECT(kinds[4] == BIHIVE_NOTHING && ids[4] == -1); /* it ends before */
  EXPECT(bihive_bodies_occluded(bodies, &rays, 0, hidden) == 0);
  EXPECT(hidden[0] == 1 && hidden[1] == 1 && hidden[2] == 1 && hidden[3] == 0 && hidden[4] == 0);
  {
    bihive_lists* lists = NULL;
    EXPECT(bihive_bodies_all_hits(bodies, &rays, 1, &lists) == 0);
    {
      const int64_t* const begin = bihive_lists_begin(lists);
      const int64_t* const numbers = bihive_lists_spheres(lists);
      const uint8_t* const kind = bihive_lists_kinds(lists);
      EXPECT(begin[0] == 0 && begin[1] == 1 && begin[2] == 3 && begin[3] == 4 && begin[4] == 4 && begin[5] == 4);
      EXPECT(kind[0] == BIHIVE_STICK && numbers[0] == 0 && bihive_lists_along(lists)[0] == 0.5);
      /* The second ray meets the sphere, and the stick that begins in it. */
      EXPECT(kind[1] == BIHIVE_SPHERE && numbers[1] == 0 && bihive_lists_distances(lists)[1] == 8);
      EXPECT(kind[2] == BIHIVE_STICK && numbers[2] == 0 && bihive_lists_distances(lists)[2] == 8.75);
      EXPECT(kind[3] == BIHIVE_STICK && numbers[3] == 1 && bihive_lists_distances(lists)[3] == t[2]);
    }
    bihive_lists_free(lists);
    EXPECT_ERROR(bihive_bodies_all_hits(bodies, &rays, 1, NULL), "no place");
    EXPECT_ERROR(bihive_bodies_all_hits(NULL, &rays, 1, &lists), "NULL");
    EXPECT(lists == NULL);
  }
  EXPECT_ERROR(bihive_bodies_closest(bodies, &rays, 1, t, NULL, ids, along), "no place");
  EXPECT_ERROR(bihive_bodies_occluded(bodies, NULL, 1, hidden), "NULL");
  bihive_bodies_free(bodies);
  bihive_bodies_free(NULL);

  EXPECT_ERROR(bihive_bodies_new(places, radii, 0, ends, end_radii, 2, 1, &bodies), "at least one sphere");
  EXPECT(bodies == NULL);
  EXPECT_ERROR(bihive_bodies_new(places, radii, 2, NULL, end_radii, 2, 1, &bodies), "NULL");
  {
    const double no_radii[] = {0, 0, 1, 0};
    EXPECT_ERROR(bihive_bodies_new(places, radii, 2, ends, no_radii, 2, 1, &bodies), "radius above 0");
  }
  EXPECT(bihive_bodies_new(places, radii, 2, NULL, NULL, 0, 1, &bodies) == 0);
  EXPECT(bihive_bodies_closest(bodies, &rays, 1, t, kinds, ids, along) == 0);
  EXPECT(kinds[0] == BIHIVE_NOTHING && kinds[1] == BIHIVE_SPHERE);
  bihive_bodies_free(bodies);
}

int main(int argc, char** argv) {
  EXPECT(strcmp(bihive_error_text(), "") == 0);
  test_trees();
  test_update();
  test_far_spheres();
  test_cells();
  test_bodies();
  test_pictures();
  /* The picture of a file, for comparison with that of `bihive render`: c_library FILE STYLE OUT [NAME VALUE]..., raw
   * RGBA. */
  if (argc >= 4) {
    static char bytes[1 << 20];
    static uint8_t rgba[160 * 120 * 4];
    FILE* file = fopen(argv[1], "rb");
    const size_t size = file == NULL ? 0 : fread(bytes, 1, sizeof bytes, file);
    bihive_scene* scene = NULL;
    EXPECT(size > 0);
    if (file != NULL) fclose(file);
    EXPECT(bihive_scene_from_bytes(bytes, size, argv[1], argv[2], &scene) == 0);
    for (int i = 4; i + 1 < argc; i += 2) EXPECT(bihive_scene_set(scene, argv[i], argv[i + 1]) == 0);
    EXPECT(bihive_render(scene, 160, 120, 2, 0, rgba) == 0);
    bihive_scene_free(scene);
    file = fopen(argv[3], "wb");
    EXPECT(file != NULL);
    if (file != NULL) {
      EXPECT(fwrite(rgba, 1, sizeof rgba, file) == sizeof rgba);
      EXPECT(fclose(file) == 0);
    }
  }
  printf("bihive %s from C: %d broken promises, %d spheres\n", bihive_version(), failures, (int)COUNT(kRadii));
  return failures == 0 ? 0 : 1;
}
