// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "Check.h"

// Two strips of triangles, each of two rows of vertices: 0 1 2 ... above, and as many below.
enum { kLength = 12, kVertices = 2 * kLength, kTriangles = 2 * (kLength - 1), kEdges = 4 * kLength - 3, kMeshes = 2 };

static uint32_t corners[3 * kTriangles];
static double starts[kMeshes][3 * kVertices];
static double ends[kMeshes][3 * kVertices];

/// An element: its vertices, numbered through both meshes, and its box.
typedef struct Element {
  uint32_t vertices[3];
  size_t count;
  double box[6];
} Element;

static void makeStrip(void) {
  for (uint32_t i = 0; i + 1 < kLength; ++i) {
    const uint32_t two[6] = {i, i + 1, kLength + i, i + 1, kLength + i + 1, kLength + i};
    memcpy(&corners[(size_t)6 * i], two, sizeof two);
  }
}

static void placeVertices(uint32_t seed) {
  for (size_t mesh = 0; mesh < kMeshes; ++mesh) {
    for (size_t i = 0; i < 3 * kVertices; ++i) {
      starts[mesh][i] = checkRandom(&seed, 9);
      ends[mesh][i] = starts[mesh][i] + checkRandom(&seed, 3);
    }
  }
}

static Element elementOf(const uint32_t* vertices, size_t count) {
  Element element = {{0, 0, 0}, count, {HUGE_VAL, HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  for (size_t k = 0; k < count; ++k) {
    const uint32_t mesh = vertices[k] / kVertices, vertex = vertices[k] % kVertices;
    element.vertices[k] = vertices[k];
    for (size_t axis = 0; axis < 3; ++axis) {
      const double a = starts[mesh][3 * vertex + axis], b = ends[mesh][3 * vertex + axis];
      element.box[axis] = fmin(element.box[axis], fmin(a, b));
      element.box[axis + 3] = fmax(element.box[axis + 3], fmax(a, b));
    }
  }
  return element;
}

static bool areCandidates(const Element* a, const Element* b, double margin) {
  for (size_t i = 0; i < a->count; ++i) {
    for (size_t j = 0; j < b->count; ++j) {
      if (a->vertices[i] == b->vertices[j]) return false;
    }
  }
  return checkMeet(a->box, b->box, margin);
}

static size_t makeElements(allpairs_elements* elements, allpairs_candidates kind, bool isSecond, Element* made) {
  size_t count = 0;
  if (kind == ALLPAIRS_VERTEX_FACE && !isSecond) {
    for (uint32_t i = 0; i < kMeshes * kVertices; ++i) made[count++] = elementOf(&i, 1);
  } else if (kind == ALLPAIRS_EDGE_EDGE) {
    allpairs_pairs edges;
    ALLPAIRS_CHECK(allpairs_elements_edges(elements, &edges) == ALLPAIRS_OK && edges.count == kMeshes * kEdges);
    for (size_t i = 0; i < edges.count; ++i) {
      const uint32_t two[2] = {edges.data[i].first, edges.data[i].second};
      made[count++] = elementOf(two, 2);
    }
  } else {
    for (uint32_t i = 0; i < kMeshes * kTriangles; ++i) {
      uint32_t three[3];
      for (size_t k = 0; k < 3; ++k) {
        three[k] = i / kTriangles * kVertices + corners[(size_t)3 * (i % kTriangles) + k];
      }
      made[count++] = elementOf(three, 3);
    }
  }
  return count;
}

static bool countPairs(void* context, allpairs_pairs batch) {
  *(uint64_t*)context += batch.count;
  return true;
}

static bool stop(void* context, allpairs_pairs batch) {
  (void)context;
  (void)batch;
  return false;
}

/// All candidates of a kind, in order, against the double loop; and as many by counting and by batches.
static void checkKind(allpairs_elements* elements, allpairs_candidates kind, double margin) {
  static Element first[kMeshes * kEdges], second[kMeshes * kEdges];
  const size_t firsts = makeElements(elements, kind, false, first),
               seconds = makeElements(elements, kind, true, second);
  allpairs_pairs found;
  size_t next = 0;
  ALLPAIRS_CHECK(allpairs_elements_find(elements, kind, &found) == ALLPAIRS_OK && found.count > 0);
  for (uint32_t i = 0; i < firsts; ++i) {
    for (uint32_t j = kind == ALLPAIRS_VERTEX_FACE ? 0 : i + 1; j < seconds; ++j) {
      if (!areCandidates(&first[i], &second[j], margin)) continue;
      ALLPAIRS_CHECK(next < found.count && found.data[next].first == i && found.data[next].second == j);
      ++next;
    }
  }
  uint64_t counted = 0, streamed = 0;
  const allpairs_visitor visitor = {countPairs, &streamed, 0}, stopping = {stop, NULL, 0};
  ALLPAIRS_CHECK(next == found.count);
  ALLPAIRS_CHECK(allpairs_elements_count(elements, kind, &counted) == ALLPAIRS_OK && counted == next);
  ALLPAIRS_CHECK(allpairs_elements_stream(elements, kind, visitor) == ALLPAIRS_OK && streamed == next);
  ALLPAIRS_CHECK(allpairs_elements_stream(elements, kind, stopping) == ALLPAIRS_STOPPED);
}

static void checkCounts(const allpairs_elements* elements) {
  allpairs_element_counts counts;
  ALLPAIRS_CHECK(allpairs_elements_before(elements, 1, &counts) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(counts.vertices == kVertices && counts.edges == kEdges && counts.triangles == kTriangles);
  ALLPAIRS_CHECK(allpairs_elements_before(elements, kMeshes, &counts) == ALLPAIRS_OK && counts.edges == 2 * kEdges);
  ALLPAIRS_CHECK(allpairs_elements_before(elements, kMeshes + 1, &counts) == ALLPAIRS_INVALID_ARGUMENT);
}

static void nonsenseIsRefused(allpairs_elements* elements) {
  const uint32_t beyond[3] = {0, 1, 2};
  const allpairs_mesh mesh = {2, beyond, 1};
  allpairs_elements_options options = {.struct_size = 0};
  allpairs_elements* none = NULL;
  allpairs_pairs pairs;
  ALLPAIRS_CHECK(allpairs_elements_create(&mesh, 1, NULL, &none) == ALLPAIRS_INVALID_ARGUMENT && none == NULL);
  options.struct_size = sizeof options + 8;
  ALLPAIRS_CHECK(allpairs_elements_create(NULL, 0, &options, &none) == ALLPAIRS_INVALID_ARGUMENT && none == NULL);
  ALLPAIRS_CHECK(allpairs_elements_move_f64(elements, kMeshes, starts[0], ends[0]) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_elements_move_f64(elements, 0, NULL, ends[0]) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_elements_find(elements, (allpairs_candidates)3, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_elements_destroy(NULL);
}

int main(void) {
  makeStrip();
  const allpairs_mesh mesh = {kVertices, corners, kTriangles};
  const allpairs_mesh meshes[kMeshes] = {mesh, mesh};
  const allpairs_elements_options options = {.struct_size = sizeof options, .distance = 0.5, .threads = 2};
  allpairs_elements* elements = NULL;
  ALLPAIRS_CHECK(allpairs_elements_create(meshes, kMeshes, &options, &elements) == ALLPAIRS_OK);
  checkCounts(elements);
  for (uint32_t seed = 1; seed < 6; ++seed) {
    placeVertices(seed);
    for (size_t i = 0; i < kMeshes; ++i) {
      ALLPAIRS_CHECK(allpairs_elements_move_f64(elements, i, starts[i], ends[i]) == ALLPAIRS_OK);
    }
    checkKind(elements, ALLPAIRS_VERTEX_FACE, options.distance);
    checkKind(elements, ALLPAIRS_EDGE_EDGE, options.distance);
    checkKind(elements, ALLPAIRS_FACE_FACE, options.distance);
  }
  nonsenseIsRefused(elements);
  allpairs_elements_destroy(elements);
  return EXIT_SUCCESS;
}
