// SPDX-License-Identifier: MIT
//
// The interface of Allpairs for C, and for every language that can call C. docs/c.md shows it in use.
//
// Every function that can fail returns a status; what went wrong is then said by allpairs_error_message(). No exception
// leaves the library, and it never prints or aborts. Handles are made by ..._create, given back by ..._destroy, which
// takes null too, and used by one thread at a time, unless they are const. Null where a handle or a result is asked for
// is an ALLPAIRS_INVALID_ARGUMENT.
//
// A call that fails, for want of memory or because a visitor stopped it, leaves what its handle holds as it was, and the
// handle can be used on: the next allpairs_world_step() tells what has changed since the last one that succeeded. A
// callback may use other handles; its own answers ALLPAIRS_INVALID_ARGUMENT, and must not be destroyed.
//
// Structures may grow at their end: struct_size says which of their fields the caller knows, and all fields may be 0.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// NOLINTBEGIN: names and forms are C's.

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define ALLPAIRS_C_API
#else
#define ALLPAIRS_C_API __attribute__((visibility("default")))
#endif

/// How a call went.
typedef enum allpairs_status {
  ALLPAIRS_OK = 0,
  ALLPAIRS_INVALID_ARGUMENT = 1,  ///< An argument or a setting that makes no sense.
  ALLPAIRS_INVALID_BOX = 2,       ///< A box, or a value of one; allpairs_error_index() says which.
  ALLPAIRS_LIMIT_EXCEEDED = 3,    ///< More pairs than max_pairs; allpairs_error_index() is how many had been found.
  ALLPAIRS_STOPPED = 4,           ///< A visitor asked for no more.
  ALLPAIRS_OUT_OF_MEMORY = 5,
  ALLPAIRS_INTERNAL = 6  ///< Anything else: a bug, of which the message may say more.
} allpairs_status;

/// One line about the last call that failed in this thread; empty before the first one. Valid until the next failure.
ALLPAIRS_C_API const char* allpairs_error_message(void);

/// The index that belongs to the last failure in this thread: of a box, or a count of pairs; otherwise 0.
ALLPAIRS_C_API uint64_t allpairs_error_index(void);

/// The version of the library: "0.1.0".
ALLPAIRS_C_API const char* allpairs_version(void);

/// Two boxes by index. Within one set first < second; between two sets, first is of the first set.
typedef struct allpairs_pair {
  uint32_t first;
  uint32_t second;
} allpairs_pair;

/// Pairs that belong to the handle that gave them.
typedef struct allpairs_pairs {
  const allpairs_pair* data;
  size_t count;
} allpairs_pairs;

// Sets of boxes.

/// A checked view of n boxes in the caller's memory, which must outlive it and stay unchanged while it is in use.
///
/// Geometry:  boxes are closed; min > max on an axis means empty; infinite bounds are allowed.
/// Bad input: a NaN is an ALLPAIRS_INVALID_BOX.
/// Threads:   const use from any number of threads.
typedef struct allpairs_set allpairs_set;

/// Where one corner of each box lies: coordinate `axis` of box i is data[i * box_stride + axis * axis_stride]. Strides
/// count numbers, not bytes, and may be negative.
typedef struct allpairs_corner_f32 {
  const float* data;
  ptrdiff_t box_stride;
  ptrdiff_t axis_stride;
} allpairs_corner_f32;

typedef struct allpairs_corner_f64 {
  const double* data;
  ptrdiff_t box_stride;
  ptrdiff_t axis_stride;
} allpairs_corner_f64;

/// From rows of 6: minx miny minz maxx maxy maxz, `count` rows one after the other.
ALLPAIRS_C_API allpairs_status allpairs_set_create_f32(const float* rows, size_t count, allpairs_set** set);
ALLPAIRS_C_API allpairs_status allpairs_set_create_f64(const double* rows, size_t count, allpairs_set** set);

/// From corners in any strided layout, such as two arrays, or columns of a larger table.
ALLPAIRS_C_API allpairs_status allpairs_set_create_strided_f32(size_t count, allpairs_corner_f32 min,
                                                               allpairs_corner_f32 max, allpairs_set** set);
ALLPAIRS_C_API allpairs_status allpairs_set_create_strided_f64(size_t count, allpairs_corner_f64 min,
                                                               allpairs_corner_f64 max, allpairs_set** set);

ALLPAIRS_C_API void allpairs_set_destroy(allpairs_set* set);

ALLPAIRS_C_API size_t allpairs_set_size(const allpairs_set* set);

/// How far every box reaches beyond its bounds, on all sides.
ALLPAIRS_C_API allpairs_status allpairs_set_margin(allpairs_set* set, double margin);

/// The same for each box, as many as there are boxes; null takes them back. The memory stays the caller's.
ALLPAIRS_C_API allpairs_status allpairs_set_margins(allpairs_set* set, const double* margins);

// Searches.

typedef enum allpairs_strategy {
  ALLPAIRS_AUTOMATIC = 0,
  ALLPAIRS_EXHAUSTIVE = 1,  ///< Every pair is tested.
  ALLPAIRS_BVH = 2          ///< A bounding volume hierarchy: groups of boxes are tested by their bounds first.
} allpairs_strategy;

typedef enum allpairs_order {
  ALLPAIRS_BY_FIRST = 0,   ///< Ascending by (first, second).
  ALLPAIRS_BY_SECOND = 1,  ///< Ascending by (second, first).
  ALLPAIRS_UNORDERED = 2   ///< As found; the same each time.
} allpairs_order;

/// As many threads as the machine runs at once.
#define ALLPAIRS_ALL_THREADS SIZE_MAX

/// What the boxes of one set say about whom they may pair with; null, or as long as the set.
typedef struct allpairs_filter {
  const uint32_t* categories;  ///< What a box is, as bits; null: every bit.
  const uint32_t* masks;       ///< Which categories it accepts; null: every bit. Both of a pair must accept the other.
  const uint32_t* groups;      ///< Boxes of the same non-zero group are no pair.
} allpairs_filter;

/// Says whether a pair that passed the rest is wanted. Called in no particular order and, with threads, from several.
typedef bool (*allpairs_accept)(void* context, uint32_t first, uint32_t second);

/// Where the memory of a handle comes from: its working memory and its results. All null: aligned operator new, with large
/// pages for large blocks where the system has them. Either both functions are given or none.
///
/// Fixed when the handle is made, which it must outlive; called from several threads if the handle has some. docs/memory.md
/// says what lies elsewhere.
typedef struct allpairs_memory {
  void* (*allocate)(void* context, size_t bytes, size_t alignment);  ///< Null if there is no memory.
  void (*deallocate)(void* context, void* memory, size_t bytes, size_t alignment);
  void* context;
} allpairs_memory;

/// Settings of a search. All zeros, but for struct_size, are the defaults.
typedef struct allpairs_options {
  size_t struct_size;  ///< sizeof(allpairs_options)
  allpairs_strategy strategy;
  allpairs_order order;
  double distance;         ///< Boxes at most this far apart on every axis are a pair; margins are added.
  const double* region;    ///< Six numbers, or null: boxes outside of it are left out. Read when options are set.
  allpairs_filter first;   ///< Of the set, or of the first of two.
  allpairs_filter second;  ///< Of the second of two sets; a search of one set refuses it.
  allpairs_accept accept;  ///< May be null.
  void* accept_context;
  size_t threads;          ///< 0 and 1: the calling one. ALLPAIRS_ALL_THREADS: all. The result is the same.
  uint64_t max_pairs;      ///< More are an ALLPAIRS_LIMIT_EXCEEDED, found, counted or streamed; 0: no limit.
  allpairs_memory memory;  ///< Setting options of a search that was made with other memory is refused.
} allpairs_options;

/// The default settings.
static inline allpairs_options allpairs_default_options(void) {
#ifdef __cplusplus
  allpairs_options options{};
#else
  allpairs_options options = {0};
#endif
  options.struct_size = sizeof(allpairs_options);
  return options;
}

/// Finds overlapping boxes, and keeps its working memory from one search to the next.
typedef struct allpairs_search allpairs_search;

/// What options point to must outlive their use, but for the region. Null options are the defaults.
ALLPAIRS_C_API allpairs_status allpairs_search_create(const allpairs_options* options, allpairs_search** search);
ALLPAIRS_C_API allpairs_status allpairs_search_set_options(allpairs_search* search, const allpairs_options* options);
ALLPAIRS_C_API void allpairs_search_destroy(allpairs_search* search);

/// Gives back the memory that is kept for the next search. The pairs of the last one stay valid.
ALLPAIRS_C_API allpairs_status allpairs_search_shrink(allpairs_search* search);

/// All overlapping pairs of one set, each once; valid until the next search or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_find(allpairs_search* search, const allpairs_set* set, allpairs_pairs* pairs);

/// All pairs of a box of `first` and a box of `second` that overlap.
ALLPAIRS_C_API allpairs_status allpairs_find_between(allpairs_search* search, const allpairs_set* first,
                                                     const allpairs_set* second, allpairs_pairs* pairs);

/// How many pairs there are, in memory that does not depend on it.
ALLPAIRS_C_API allpairs_status allpairs_count(allpairs_search* search, const allpairs_set* set, uint64_t* count);
ALLPAIRS_C_API allpairs_status allpairs_count_between(allpairs_search* search, const allpairs_set* first,
                                                      const allpairs_set* second, uint64_t* count);

/// Takes pairs, a batch at a time, on the calling thread. They are valid during the call.
typedef struct allpairs_visitor {
  bool (*visit)(void* context, allpairs_pairs batch);  ///< false: no more; the search returns ALLPAIRS_STOPPED.
  void* context;
  size_t batch_size;  ///< How many pairs it gets at a time, at most; 0: 65536.
} allpairs_visitor;

/// Hands the pairs of allpairs_find() to a visitor, in memory that does not depend on how many there are.
ALLPAIRS_C_API allpairs_status allpairs_stream(allpairs_search* search, const allpairs_set* set,
                                               allpairs_visitor visitor);
ALLPAIRS_C_API allpairs_status allpairs_stream_between(allpairs_search* search, const allpairs_set* first,
                                                       const allpairs_set* second, allpairs_visitor visitor);

// Boxes that move.

/// The id that no box has.
#define ALLPAIRS_NO_BOX UINT32_MAX

/// What a box of a world is besides its place. A pair of boxes stays if each one's mask has a bit of the other's
/// category, they are not of the same non-zero group, and not both static.
typedef struct allpairs_properties {
  uint32_t category;
  uint32_t mask;
  uint32_t group;
  double margin;
  bool is_static;
} allpairs_properties;

/// Every category, accepting every other; no group, no margin, moving.
static inline allpairs_properties allpairs_default_properties(void) {
  allpairs_properties properties = {UINT32_MAX, UINT32_MAX, 0, 0.0, false};
  return properties;
}

typedef struct allpairs_world_options {
  size_t struct_size;  ///< sizeof(allpairs_world_options)
  double distance;
  allpairs_order order;    ///< Of the lists of a step; ALLPAIRS_UNORDERED is refused.
  allpairs_accept accept;  ///< Its answer must stay the same until a box of the pair is changed or invalidated.
  void* accept_context;
  size_t threads;  ///< As in allpairs_options.
  allpairs_memory memory;
} allpairs_world_options;

/// The pairs of a step, of ids, first < second, each list in the order of the options; valid until the next step.
typedef struct allpairs_step {
  allpairs_pairs pairs;      ///< All pairs.
  allpairs_pairs began;      ///< Those that were none in the last step.
  allpairs_pairs persisted;  ///< Those that were.
  allpairs_pairs ended;      ///< Those of the last step that are none now.
} allpairs_step;

/// Boxes that are added, moved and removed by id, their pairs step by step, and queries.
///
/// Bad input: an id that is not in the world, or a NaN, is an ALLPAIRS_INVALID_BOX; nothing of the call has been done.
typedef struct allpairs_world allpairs_world;

ALLPAIRS_C_API allpairs_status allpairs_world_create(const allpairs_world_options* options, allpairs_world** world);
ALLPAIRS_C_API void allpairs_world_destroy(allpairs_world* world);

/// Gives back the memory that neither the boxes nor the lists of the last step need; results of queries end.
ALLPAIRS_C_API allpairs_status allpairs_world_shrink(allpairs_world* world);

/// Ids, and what each is given: boxes, properties.
typedef struct allpairs_ids {
  const uint32_t* data;
  size_t count;
} allpairs_ids;

/// Adds boxes with the same properties (null: the defaults) and writes their ids, as many as the set has boxes. Margins
/// of the set are not looked at.
ALLPAIRS_C_API allpairs_status allpairs_world_add(allpairs_world* world, const allpairs_set* boxes,
                                                  const allpairs_properties* properties, uint32_t* ids);

/// Gives boxes new bounds: box k of the set becomes that of ids[k].
ALLPAIRS_C_API allpairs_status allpairs_world_move(allpairs_world* world, allpairs_ids ids, const allpairs_set* boxes);

/// Gives boxes the bounds that hold them from where they start to where they end.
ALLPAIRS_C_API allpairs_status allpairs_world_move_swept(allpairs_world* world, allpairs_ids ids,
                                                         const allpairs_set* starts, const allpairs_set* ends);

ALLPAIRS_C_API allpairs_status allpairs_world_remove(allpairs_world* world, allpairs_ids ids);

/// Gives boxes other properties, as many as ids.
ALLPAIRS_C_API allpairs_status allpairs_world_set_properties(allpairs_world* world, allpairs_ids ids,
                                                             const allpairs_properties* properties);

/// Has the next step ask `accept` again about the pairs of these boxes.
ALLPAIRS_C_API allpairs_status allpairs_world_invalidate(allpairs_world* world, allpairs_ids ids);

ALLPAIRS_C_API size_t allpairs_world_size(const allpairs_world* world);
ALLPAIRS_C_API bool allpairs_world_contains(const allpairs_world* world, uint32_t id);

/// Writes the six bounds of a box.
ALLPAIRS_C_API allpairs_status allpairs_world_box(const allpairs_world* world, uint32_t id, double* bounds);

/// Finds the pairs of the boxes as they are now.
ALLPAIRS_C_API allpairs_status allpairs_world_step(allpairs_world* world, allpairs_step* step);

/// Which boxes a query looks at: those whose category has a bit of `mask` and whose mask has a bit of `category`.
typedef struct allpairs_query_filter {
  uint32_t category;
  uint32_t mask;
  bool skip_static;
  bool skip_moving;
} allpairs_query_filter;

/// The boxes that overlap a box of six numbers, by ascending id; valid until the next such query. Null filter: all.
ALLPAIRS_C_API allpairs_status allpairs_world_find_overlapping(allpairs_world* world, const double* box,
                                                               const allpairs_query_filter* filter, allpairs_ids* ids);

/// The points origin + t * direction with 0 <= t <= length.
typedef struct allpairs_ray {
  double origin[3];
  double direction[3];
  double length;
} allpairs_ray;

/// A box and the least t at which a ray meets it.
typedef struct allpairs_hit {
  uint32_t id;
  double t;
} allpairs_hit;

/// The first box that a ray meets, of several at the same t the one with the least id; id is ALLPAIRS_NO_BOX where there
/// is none.
ALLPAIRS_C_API allpairs_status allpairs_world_find_first(allpairs_world* world, const allpairs_ray* ray,
                                                         const allpairs_query_filter* filter, allpairs_hit* hit);

/// Hits that belong to the world that gave them.
typedef struct allpairs_hits {
  const allpairs_hit* data;
  size_t count;
} allpairs_hits;

/// All boxes that a ray meets, by ascending (t, id); valid until the next call of this or of allpairs_world_sweep_all().
ALLPAIRS_C_API allpairs_status allpairs_world_find_all(allpairs_world* world, const allpairs_ray* ray,
                                                       const allpairs_query_filter* filter, allpairs_hits* hits);

/// A box of six numbers on its way: moved by t * motion with 0 <= t <= length.
typedef struct allpairs_sweep {
  double box[6];
  double motion[3];
  double length;
} allpairs_sweep;

/// What find_first and find_all are for a ray, for a box that moves.
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_first(allpairs_world* world, const allpairs_sweep* sweep,
                                                          const allpairs_query_filter* filter, allpairs_hit* hit);
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_all(allpairs_world* world, const allpairs_sweep* sweep,
                                                        const allpairs_query_filter* filter, allpairs_hits* hits);

/// A box and its Euclidean distance from a point; 0 for a point in it.
typedef struct allpairs_neighbor {
  uint32_t id;
  double distance;
} allpairs_neighbor;

/// Neighbors that belong to the world that gave them.
typedef struct allpairs_neighbors {
  const allpairs_neighbor* data;
  size_t count;
} allpairs_neighbors;

/// A point of three numbers, and how many of the boxes nearest to it are wanted.
typedef struct allpairs_nearest {
  double point[3];
  size_t count;
} allpairs_nearest;

/// The boxes nearest to a point, or all if there are fewer, by ascending (distance, id); valid until the next such query.
ALLPAIRS_C_API allpairs_status allpairs_world_find_nearest(allpairs_world* world, const allpairs_nearest* nearest,
                                                           const allpairs_query_filter* filter,
                                                           allpairs_neighbors* neighbors);

// Many queries in one call: each is answered as if it were asked alone, in less time, and on the threads of the world.
// Lists are valid until the next query, of one or of many, that gives the same kind of result. A query that makes no
// sense is an ALLPAIRS_INVALID_ARGUMENT whose message says which one it is; then none is answered.

/// Ids for each of `count` queries: those of query i are data[offsets[i]] to data[offsets[i + 1] - 1].
typedef struct allpairs_id_lists {
  const size_t* offsets;
  const uint32_t* data;
  size_t count;
} allpairs_id_lists;

/// Hits for each of `count` queries, as in allpairs_id_lists.
typedef struct allpairs_hit_lists {
  const size_t* offsets;
  const allpairs_hit* data;
  size_t count;
} allpairs_hit_lists;

/// Neighbors for each of `count` queries, as in allpairs_id_lists.
typedef struct allpairs_neighbor_lists {
  const size_t* offsets;
  const allpairs_neighbor* data;
  size_t count;
} allpairs_neighbor_lists;

typedef struct allpairs_rays {
  const allpairs_ray* data;
  size_t count;
} allpairs_rays;

typedef struct allpairs_sweeps {
  const allpairs_sweep* data;
  size_t count;
} allpairs_sweeps;

/// Points in rows of three numbers, and how many of the boxes nearest to each are wanted.
typedef struct allpairs_nearest_many {
  const double* points;
  size_t point_count;
  size_t count;
} allpairs_nearest_many;

/// For each box of a set what allpairs_world_find_overlapping() gives. Margins of the set are not looked at.
ALLPAIRS_C_API allpairs_status allpairs_world_find_overlapping_many(allpairs_world* world, const allpairs_set* boxes,
                                                                    const allpairs_query_filter* filter,
                                                                    allpairs_id_lists* lists);

/// Writes the first hit of each ray, as many as there are rays.
ALLPAIRS_C_API allpairs_status allpairs_world_find_first_many(allpairs_world* world, allpairs_rays rays,
                                                              const allpairs_query_filter* filter, allpairs_hit* hits);
ALLPAIRS_C_API allpairs_status allpairs_world_find_all_many(allpairs_world* world, allpairs_rays rays,
                                                            const allpairs_query_filter* filter,
                                                            allpairs_hit_lists* lists);

/// Writes the first hit of each box that moves, as many as there are.
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_first_many(allpairs_world* world, allpairs_sweeps sweeps,
                                                               const allpairs_query_filter* filter, allpairs_hit* hits);
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_all_many(allpairs_world* world, allpairs_sweeps sweeps,
                                                             const allpairs_query_filter* filter,
                                                             allpairs_hit_lists* lists);

ALLPAIRS_C_API allpairs_status allpairs_world_find_nearest_many(allpairs_world* world,
                                                                const allpairs_nearest_many* nearest,
                                                                const allpairs_query_filter* filter,
                                                                allpairs_neighbor_lists* lists);

/// All pairs of a box of `world` (first) and one of `other` that overlap at the mean of the distances of the two; ordered,
/// and valid until the next such query of `world`.
ALLPAIRS_C_API allpairs_status allpairs_world_find_between(allpairs_world* world, allpairs_world* other,
                                                           allpairs_pairs* pairs);

// Deforming triangle meshes.

/// How many vertices a mesh has, and which of them its triangles join: rows of 3 indices.
typedef struct allpairs_mesh {
  size_t vertex_count;
  const uint32_t* triangles;
  size_t triangle_count;
} allpairs_mesh;

/// Which candidates are wanted, and how they are found. All zeros, but for struct_size, are the defaults.
typedef struct allpairs_elements_options {
  size_t struct_size;  ///< sizeof(allpairs_elements_options)
  double distance;     ///< Elements whose boxes are at most this far apart on every axis are candidates.
  bool skip_within;    ///< No two elements of one mesh.
  bool skip_between;   ///< No two elements of different meshes.
  allpairs_order order;
  size_t threads;          ///< As in allpairs_options.
  allpairs_memory memory;  ///< Of candidates and the search; meshes and the boxes of elements lie elsewhere.
} allpairs_elements_options;

/// Which two kinds of element make a candidate.
typedef enum allpairs_candidates {
  ALLPAIRS_VERTEX_FACE = 0,  ///< (vertex, triangle).
  ALLPAIRS_EDGE_EDGE = 1,    ///< (edge, edge), first < second.
  ALLPAIRS_FACE_FACE = 2     ///< (triangle, triangle), first < second.
} allpairs_candidates;

/// The pairs of elements of meshes that may touch while vertices move on straight lines through a step.
///
/// Elements are numbered through: those of the first mesh, then those of the second, and so on. Triangles keep their
/// order; edges are unique, ascending by their two vertices.
/// Geometry:  the box of an element is that of its vertices at start and end, compared exactly, in double. Two elements
///            that have a vertex in common are no candidates.
/// Bad input: positions that are not finite, and a vertex or mesh that isn't there, are an ALLPAIRS_INVALID_ARGUMENT.
typedef struct allpairs_elements allpairs_elements;

/// The meshes are read now, and need not outlive the call. Null options are the defaults.
ALLPAIRS_C_API allpairs_status allpairs_elements_create(const allpairs_mesh* meshes, size_t count,
                                                        const allpairs_elements_options* options,
                                                        allpairs_elements** elements);
ALLPAIRS_C_API void allpairs_elements_destroy(allpairs_elements* elements);

/// Gives back the memory that is kept for the next search. Candidates that were found stay valid.
ALLPAIRS_C_API allpairs_status allpairs_elements_shrink(allpairs_elements* elements);

/// How many elements of each kind there are, or come before a mesh.
typedef struct allpairs_element_counts {
  size_t vertices;
  size_t edges;
  size_t triangles;
} allpairs_element_counts;

/// How many elements come before those of a mesh; with the number of meshes, how many there are in all.
ALLPAIRS_C_API allpairs_status allpairs_elements_before(const allpairs_elements* elements, size_t mesh,
                                                        allpairs_element_counts* counts);

/// The edges as two vertices each, the smaller first; valid as long as the handle.
ALLPAIRS_C_API allpairs_status allpairs_elements_edges(const allpairs_elements* elements, allpairs_pairs* edges);

/// Says where the vertices of a mesh are at the start and at the end of the step, in rows of 3, as many as it has
/// vertices. They are read now. Meshes that are not mentioned stay where they were.
ALLPAIRS_C_API allpairs_status allpairs_elements_move_f32(allpairs_elements* elements, size_t mesh, const float* start,
                                                          const float* end);
ALLPAIRS_C_API allpairs_status allpairs_elements_move_f64(allpairs_elements* elements, size_t mesh, const double* start,
                                                          const double* end);

/// All candidates of a kind, each once; valid until the next search for the same kind or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_elements_find(allpairs_elements* elements, allpairs_candidates kind,
                                                      allpairs_pairs* pairs);

/// How many there are, and all of them by batches, in memory that does not depend on their number.
ALLPAIRS_C_API allpairs_status allpairs_elements_count(allpairs_elements* elements, allpairs_candidates kind,
                                                       uint64_t* count);
ALLPAIRS_C_API allpairs_status allpairs_elements_stream(allpairs_elements* elements, allpairs_candidates kind,
                                                        allpairs_visitor visitor);

#ifdef __cplusplus
}  // extern "C"
#endif

// NOLINTEND
