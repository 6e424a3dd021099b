// SPDX-License-Identifier: MIT
//
// The interface of Allpairs for C, and for every language that can call C. docs/c.md shows it in use.
//
// Every function that can fail returns a status; allpairs_error_message() then describes the failure. No exception
// leaves the library, and it never prints or aborts. Handles are created by ..._create and destroyed by ..._destroy,
// which accepts null. One thread at a time may use a handle, unless it is const. Null for a required handle or result
// is an ALLPAIRS_INVALID_ARGUMENT.
//
// A call that fails, because memory is exhausted or a callback stopped it, leaves its handle as it was and usable: the
// next allpairs_world_step() reports what has changed since the last one that succeeded. Only what an allpairs_search
// found before, or an allpairs_elements of the same kind of candidates, is lost by a search that fails, as by one that
// succeeds. A callback may use other handles, and what takes a const one; else using the handle that is calling it, of
// allpairs_world_find_between() both, is an ALLPAIRS_INVALID_ARGUMENT, and it must not destroy that handle.
//
// What a failed call would have written, a handle or a structure, is as it was, except the counts of memory of the
// caller's; arrays of the caller's may have been written to. So set a handle to null before it is created.
//
// Structures may grow at their end: struct_size tells the library which fields the caller has. All other fields of
// options may be 0. A category or mask of 0 is none: begin properties and filters of queries with their defaults.
// A struct_size that is 0, beyond this library's, or no multiple of a structure's alignment is an
// ALLPAIRS_INVALID_ARGUMENT; other sizes that end within a field are not noticed.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// NOLINTBEGIN: names and forms are C's.

#ifdef __cplusplus
extern "C" {
#endif

#if defined(ALLPAIRS_C_EXPORTS)
#define ALLPAIRS_C_API __declspec(dllexport)
#elif defined(_WIN32)
#define ALLPAIRS_C_API __declspec(dllimport)
#else
#define ALLPAIRS_C_API __attribute__((visibility("default")))
#endif

/// The result of a call.
typedef enum allpairs_status {
  ALLPAIRS_OK = 0,
  ALLPAIRS_INVALID_ARGUMENT = 1,  ///< An invalid argument or setting.
  ALLPAIRS_INVALID_BOX = 2,       ///< An invalid box, per-box value or id; allpairs_error_index() is its index in what
                                  ///< was passed: in the set, or in the ids.
  ALLPAIRS_LIMIT_EXCEEDED = 3,  ///< More pairs than max_pairs, or than there is room for: allpairs_error_index() is the
                                ///< number found so far, or in all.
  ALLPAIRS_STOPPED = 4,         ///< A visitor, or `stop` of the options, ended the search.
  ALLPAIRS_OUT_OF_MEMORY = 5,
  ALLPAIRS_INTERNAL = 6  ///< Any other failure; allpairs_error_message() may say more.
} allpairs_status;

/// One line about the last failed call in this thread; empty before the first failure. Valid until the next failure.
ALLPAIRS_C_API const char* allpairs_error_message(void);

/// The index that belongs to the last failure in this thread: that of a box, or a number of pairs; otherwise 0.
ALLPAIRS_C_API uint64_t allpairs_error_index(void);

/// The version of the library: "0.1.0".
ALLPAIRS_C_API const char* allpairs_version(void);

/// The names of the instruction sets that both this processor and this library support, best first; "SCALAR" is always
/// the last. Null for an index that is not below their number. The text stays valid.
ALLPAIRS_C_API const char* allpairs_instruction_set(size_t index);

/// Two boxes by index. Within one set first < second; between two sets, first is of the first set.
typedef struct allpairs_pair {
  uint32_t first;
  uint32_t second;
} allpairs_pair;

/// Pairs in memory of the handle that returned them.
typedef struct allpairs_pairs {
  const allpairs_pair* data;
  size_t count;
} allpairs_pairs;

// Sets of boxes.

/// A validated view of n boxes in the caller's memory, which must outlive it and stay unchanged while it is in use.
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

/// Sets how far every box extends beyond its bounds, on all sides.
ALLPAIRS_C_API allpairs_status allpairs_set_margin(allpairs_set* set, double margin);

/// Sets one margin per box, as many as there are boxes, in place of that of allpairs_set_margin(); null removes them, and
/// that one holds again. The memory stays the caller's.
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
  ALLPAIRS_UNORDERED = 2   ///< In the order of discovery; the same in every run.
} allpairs_order;

/// One thread per hardware thread.
#define ALLPAIRS_ALL_THREADS SIZE_MAX

/// Filter data of the boxes of one set; each array is null, or as long as the set.
typedef struct allpairs_filter {
  const uint32_t* categories;  ///< What a box is, as bits; null: every bit.
  const uint32_t* masks;   ///< Which categories it accepts; null: every bit. Each box of a pair must accept the other.
  const uint32_t* groups;  ///< Boxes of the same non-zero group are never paired.
} allpairs_filter;

/// Decides whether to keep a pair that passed all other filters. Called in unspecified order, from several threads if
/// the search has them.
typedef bool (*allpairs_accept)(void* context, uint32_t first, uint32_t second);

/// Says whether to end a call, which is then ALLPAIRS_STOPPED: for a time limit, or for what another thread or a signal
/// handler has written to an atomic variable. Asked every few hundredths of a second and once in some thousand pairs,
/// by several threads at once if the handle has them; a call about few boxes may end first.
typedef bool (*allpairs_stop)(void* context);

/// The allocator of a handle, for its working memory and its results. All null: aligned operator new, with large pages
/// for large blocks where the system has them. Set both functions or none.
///
/// Fixed when the handle is created; must outlive the handle; called from several threads if the handle has them.
/// docs/memory.md lists what is allocated elsewhere.
typedef struct allpairs_memory {
  void* (*allocate)(void* context, size_t bytes, size_t alignment);  ///< Null if there is no memory.
  void (*deallocate)(void* context, void* memory, size_t bytes, size_t alignment);
  void* context;
} allpairs_memory;

/// Settings of a search. All fields except struct_size are 0 by default.
typedef struct allpairs_options {
  size_t struct_size;  ///< sizeof(allpairs_options)
  allpairs_strategy strategy;
  allpairs_order order;
  double distance;         ///< Boxes at most this far apart on every axis are a pair; margins are added.
  const double* region;    ///< Six numbers, or null: excludes boxes outside it. Read when options are set.
  allpairs_filter first;   ///< Of the set, or of the first of two sets.
  allpairs_filter second;  ///< Of the second of two sets; an error for a search of one set.
  allpairs_accept accept;  ///< May be null.
  void* accept_context;
  size_t threads;          ///< 0 and 1: the calling one. ALLPAIRS_ALL_THREADS: all. The result is the same.
  uint64_t max_pairs;      ///< More pairs, found, counted or streamed, are an ALLPAIRS_LIMIT_EXCEEDED; 0: no limit.
  allpairs_memory memory;  ///< Setting options with different memory later is an error.
  const char* instruction_set;  ///< One of allpairs_instruction_set(), or null: the best. Read when options are set.
  allpairs_stop stop;           ///< May be null, and then costs nothing.
  void* stop_context;
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

/// Finds overlapping boxes, and keeps its working memory between searches.
typedef struct allpairs_search allpairs_search;

/// What the options point to, except the region and the name of the instruction set, must outlive their use. Null
/// options are the defaults. A distance or region that is none is an ALLPAIRS_INVALID_ARGUMENT of the searches that use
/// it.
ALLPAIRS_C_API allpairs_status allpairs_search_create(const allpairs_options* options, allpairs_search** search);
ALLPAIRS_C_API allpairs_status allpairs_search_set_options(allpairs_search* search, const allpairs_options* options);
ALLPAIRS_C_API void allpairs_search_destroy(allpairs_search* search);

/// Releases the memory kept for the next search. The pairs of the last search stay valid, those of worlds do not.
ALLPAIRS_C_API allpairs_status allpairs_search_shrink(allpairs_search* search);

/// Numbers of a search, of one set, of two or of worlds. Set struct_size.
typedef struct allpairs_overlap_statistics {
  size_t struct_size;    ///< sizeof(allpairs_overlap_statistics)
  uint64_t pairs;        ///< The number of pairs in the result; each is counted once, in rows too.
  uint64_t box_tests;    ///< Tests of two boxes, each in one lane of a vector.
  uint64_t group_tests;  ///< Tests of the bounds of two groups, or of a box and a group.
  uint64_t exact_tests;  ///< Candidates that float could not decide, and that were tested in double.
} allpairs_overlap_statistics;

/// Writes the statistics of the last search: all 0 if it failed, or there was none; a search that was an
/// ALLPAIRS_INVALID_ARGUMENT may count as none at all. All but `pairs` depend on the instruction set.
ALLPAIRS_C_API allpairs_status allpairs_search_statistics(const allpairs_search* search,
                                                          allpairs_overlap_statistics* statistics);

/// All overlapping pairs of one set, each once; valid until the next search or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_find(allpairs_search* search, const allpairs_set* set, allpairs_pairs* pairs);

/// All pairs of a box of `first` and a box of `second` that overlap.
ALLPAIRS_C_API allpairs_status allpairs_find_between(allpairs_search* search, const allpairs_set* first,
                                                     const allpairs_set* second, allpairs_pairs* pairs);

/// Memory of the caller for pairs. The library writes `count`, which is the number of pairs also if there is no room
/// for them, and 0 if the search has failed otherwise, such as at max_pairs.
typedef struct allpairs_pair_memory {
  allpairs_pair* data;
  size_t capacity;
  size_t count;
} allpairs_pair_memory;

/// Writes the pairs of allpairs_find() to memory of the caller. Count them first.
///
/// Bad input: more pairs than the capacity are an ALLPAIRS_LIMIT_EXCEEDED; unordered pairs, or those of an exhaustive
///            search, may then have been written.
ALLPAIRS_C_API allpairs_status allpairs_find_into(allpairs_search* search, const allpairs_set* set,
                                                  allpairs_pair_memory* memory);
ALLPAIRS_C_API allpairs_status allpairs_find_between_into(allpairs_search* search, const allpairs_set* first,
                                                          const allpairs_set* second, allpairs_pair_memory* memory);

/// In which rows a pair of boxes of one set is.
typedef enum allpairs_rows_kind {
  ALLPAIRS_FULL_ROWS = 0,  ///< In those of both boxes: row i has all partners of box i.
  ALLPAIRS_HALF_ROWS = 1   ///< In that of the lower index: read one after the other, the rows are the pairs in order.
} allpairs_rows_kind;

/// Compressed sparse rows in memory of the search: row i is indices[offsets[i]] to indices[offsets[i + 1] - 1],
/// ascending.
typedef struct allpairs_rows {
  const uint64_t* offsets;  ///< One more than there are rows.
  const uint32_t* indices;
  size_t count;  ///< The number of rows: that of the boxes.
} allpairs_rows;

/// The pairs of allpairs_find() as rows of the partners of each box, whatever the options' order; max_pairs counts a
/// pair once. Valid until the next search, or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_find_neighbors(allpairs_search* search, const allpairs_set* set,
                                                       allpairs_rows_kind kind, allpairs_rows* rows);

/// The partners in `second` of each box of `first`.
ALLPAIRS_C_API allpairs_status allpairs_find_neighbors_between(allpairs_search* search, const allpairs_set* first,
                                                               const allpairs_set* second, allpairs_rows* rows);

/// Memory of the caller for rows: `offsets` for one more than there are boxes, `indices` for the pairs, twice in full
/// rows. The library writes `count`, which is the number of indices also if there is no room for them, and 0 if the
/// search has failed otherwise, such as at max_pairs.
typedef struct allpairs_rows_memory {
  uint64_t* offsets;
  uint32_t* indices;
  size_t capacity;  ///< Of indices.
  size_t count;
} allpairs_rows_memory;

/// Writes the rows of allpairs_find_neighbors() to memory of the caller.
///
/// Bad input: more indices than the capacity are an ALLPAIRS_LIMIT_EXCEEDED; nothing has been written then.
ALLPAIRS_C_API allpairs_status allpairs_find_neighbors_into(allpairs_search* search, const allpairs_set* set,
                                                            allpairs_rows_kind kind, allpairs_rows_memory* memory);
ALLPAIRS_C_API allpairs_status allpairs_find_neighbors_between_into(allpairs_search* search, const allpairs_set* first,
                                                                    const allpairs_set* second,
                                                                    allpairs_rows_memory* memory);

/// The number of pairs; uses memory independent of that number.
ALLPAIRS_C_API allpairs_status allpairs_count(allpairs_search* search, const allpairs_set* set, uint64_t* count);
ALLPAIRS_C_API allpairs_status allpairs_count_between(allpairs_search* search, const allpairs_set* first,
                                                      const allpairs_set* second, uint64_t* count);

/// Receives pairs in batches, on the calling thread. A batch is valid during the call only.
typedef struct allpairs_visitor {
  bool (*visit)(void* context, allpairs_pairs batch);  ///< false stops the search, which returns ALLPAIRS_STOPPED.
  void* context;
  size_t batch_size;  ///< The maximum number of pairs in a batch; 0: 65536.
} allpairs_visitor;

/// Passes the pairs of allpairs_find() to a visitor; uses memory independent of their number.
ALLPAIRS_C_API allpairs_status allpairs_stream(allpairs_search* search, const allpairs_set* set,
                                               allpairs_visitor visitor);
ALLPAIRS_C_API allpairs_status allpairs_stream_between(allpairs_search* search, const allpairs_set* first,
                                                       const allpairs_set* second, allpairs_visitor visitor);

// Many worlds in one call.

/// The boxes of worlds: those of a world follow each other, and boxes of different worlds are never pairs. All fields
/// except struct_size and boxes may be 0.
typedef struct allpairs_worlds {
  size_t struct_size;  ///< sizeof(allpairs_worlds)
  const allpairs_set* boxes;
  size_t count;           ///< The number of worlds.
  const uint64_t* begin;  ///< World k has the boxes [begin[k], begin[k + 1]): count + 1 offsets. Null: equally divided.
  const allpairs_pair* ignored;  ///< Boxes, numbered within a world, that are never a pair, in no world.
  size_t ignored_count;
  const allpairs_set* shared;  ///< If set, boxes that are in every world: pairs (box of the world, one of these).
  bool filter_is_of_one;  ///< The arrays of the search's `first` filter are of one world, for all of an equal size.
} allpairs_worlds;

/// The pairs of world k are data[begin[k]] up to data[begin[k + 1]], boxes numbered within the world; in memory of the
/// search.
typedef struct allpairs_world_pairs {
  allpairs_pairs pairs;
  const uint64_t* begin;  ///< One more than there are worlds.
} allpairs_world_pairs;

/// What allpairs_find() would find in each world alone, in the same order; with shared boxes, what
/// allpairs_find_between() would. Valid until the next such search, allpairs_search_shrink() or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_find_in_worlds(allpairs_search* search, const allpairs_worlds* worlds,
                                                       allpairs_world_pairs* pairs);

/// Where each world's pairs begin, without storing them: writes one number more than there are worlds.
ALLPAIRS_C_API allpairs_status allpairs_count_in_worlds(allpairs_search* search, const allpairs_worlds* worlds,
                                                        uint64_t* begin);

/// Writes the pairs to memory of the caller, where `begin` says, which allpairs_count_in_worlds() has written.
///
/// Bad input: other numbers are an ALLPAIRS_INVALID_ARGUMENT; `pairs` may then have been written to.
ALLPAIRS_C_API allpairs_status allpairs_list_in_worlds(allpairs_search* search, const allpairs_worlds* worlds,
                                                       const uint64_t* begin, allpairs_pair* pairs);

// Moving boxes.

/// An id that no box has.
#define ALLPAIRS_NO_BOX UINT32_MAX

/// The properties of a box in a world. Two boxes that overlap are a pair if each one's mask shares a bit with the
/// other's category, they are not in the same non-zero group, and they are not both static. The margin is added to the
/// distance at which the box is a pair with another, and enlarges the box in all queries.
typedef struct allpairs_properties {
  uint32_t category;
  uint32_t mask;
  uint32_t group;
  double margin;
  bool is_static;
} allpairs_properties;

/// The defaults: every category, accepts every category, no group, no margin, not static.
static inline allpairs_properties allpairs_default_properties(void) {
  allpairs_properties properties = {UINT32_MAX, UINT32_MAX, 0, 0.0, false};
  return properties;
}

typedef struct allpairs_world_options {
  size_t struct_size;  ///< sizeof(allpairs_world_options)
  double distance;
  allpairs_order order;    ///< Of the lists of a step; ALLPAIRS_UNORDERED is an error.
  allpairs_accept accept;  ///< Its answer must not change until a box of the pair is changed or invalidated.
  void* accept_context;
  size_t threads;  ///< As in allpairs_options.
  allpairs_memory memory;
  const char* instruction_set;  ///< As in allpairs_options.
  allpairs_stop stop;           ///< Of steps and queries.
  void* stop_context;
} allpairs_world_options;

/// The pairs of a step, of ids, first < second, each list in the order of the options; valid until the next step.
typedef struct allpairs_step {
  allpairs_pairs pairs;      ///< All pairs.
  allpairs_pairs began;      ///< Pairs that did not exist in the last step.
  allpairs_pairs persisted;  ///< Pairs that also existed in the last step.
  allpairs_pairs ended;      ///< Pairs of the last step that no longer exist.
} allpairs_step;

/// Boxes that are added, moved and removed by id, their pairs step by step, and queries.
///
/// Ids:       those of boxes added to a new world are consecutive, from 0. Ids of removed boxes are reused, but only
///            after the step that reports that their pairs have ended.
/// Bad input: an id that is not in the world, or a NaN in a box, is an ALLPAIRS_INVALID_BOX; the call then has no
///            effect.
typedef struct allpairs_world allpairs_world;

ALLPAIRS_C_API allpairs_status allpairs_world_create(const allpairs_world_options* options, allpairs_world** world);
ALLPAIRS_C_API void allpairs_world_destroy(allpairs_world* world);

/// Releases the memory that neither the boxes nor the lists of the last step need; invalidates results of queries.
ALLPAIRS_C_API allpairs_status allpairs_world_shrink(allpairs_world* world);

/// Reserves memory for that many boxes in all, so that adding them allocates little.
///
/// Bad input: more than can be numbered, 2^32 - 1, are an ALLPAIRS_INVALID_ARGUMENT.
ALLPAIRS_C_API allpairs_status allpairs_world_reserve(allpairs_world* world, size_t boxes);

/// An array of ids.
typedef struct allpairs_ids {
  const uint32_t* data;
  size_t count;
} allpairs_ids;

/// Adds boxes with the same properties (null: the defaults) and writes their ids, one for each box of the set. A set
/// with margins is an ALLPAIRS_INVALID_ARGUMENT: here a margin is a property.
ALLPAIRS_C_API allpairs_status allpairs_world_add(allpairs_world* world, const allpairs_set* boxes,
                                                  const allpairs_properties* properties, uint32_t* ids);

/// The same, with properties[k] for box k of the set.
///
/// Bad input: a margin that is NaN or -infinity is an ALLPAIRS_INVALID_BOX; no box is added then.
ALLPAIRS_C_API allpairs_status allpairs_world_add_each(allpairs_world* world, const allpairs_set* boxes,
                                                       const allpairs_properties* properties, uint32_t* ids);

/// Sets the bounds of box ids[k] to those of box k of the set.
ALLPAIRS_C_API allpairs_status allpairs_world_move(allpairs_world* world, allpairs_ids ids, const allpairs_set* boxes);

/// Sets the bounds of boxes to the union of their start and their end.
ALLPAIRS_C_API allpairs_status allpairs_world_move_swept(allpairs_world* world, allpairs_ids ids,
                                                         const allpairs_set* starts, const allpairs_set* ends);

/// How boxes move: the velocity of each in rows of three, and for how long.
typedef struct allpairs_velocities {
  const double* data;
  double duration;
} allpairs_velocities;

/// Like allpairs_world_move_swept(), with ends that are start + velocity * duration, in double.
///
/// Bad input: a velocity that is not finite is an ALLPAIRS_INVALID_BOX, and so is a motion of an infinite box that
///            gives a NaN; a duration that is not finite is an ALLPAIRS_INVALID_ARGUMENT.
ALLPAIRS_C_API allpairs_status allpairs_world_move_swept_by(allpairs_world* world, allpairs_ids ids,
                                                            const allpairs_set* starts,
                                                            const allpairs_velocities* velocities);

ALLPAIRS_C_API allpairs_status allpairs_world_remove(allpairs_world* world, allpairs_ids ids);

/// Removes all boxes; the next step lists their pairs among those that ended.
ALLPAIRS_C_API allpairs_status allpairs_world_clear(allpairs_world* world);

/// The number of a box that every world has, such as the ground.
#define ALLPAIRS_EVERY_WORLD UINT32_MAX

/// What boxes are added with.
typedef struct allpairs_membership {
  const allpairs_properties* properties;  ///< Of all of them; null: the defaults.
  const uint32_t* worlds;  ///< For each the number of its world, or ALLPAIRS_EVERY_WORLD; null: all are of world 0.
} allpairs_membership;

/// Adds boxes of many worlds, such as the copies of a scene: boxes of different worlds are never pairs and are not
/// tested against each other, wherever they are; those of ALLPAIRS_EVERY_WORLD are in each. Else as
/// allpairs_world_add(), whose boxes are of world 0.
ALLPAIRS_C_API allpairs_status allpairs_world_add_to_worlds(allpairs_world* world, const allpairs_set* boxes,
                                                            const allpairs_membership* membership, uint32_t* ids);

/// Gives boxes the number of another world, one for each id: their pairs end, and others begin.
ALLPAIRS_C_API allpairs_status allpairs_world_set_worlds(allpairs_world* world, allpairs_ids ids,
                                                         const uint32_t* worlds);

/// Sets the properties of boxes, one for each id; they stay in their worlds.
ALLPAIRS_C_API allpairs_status allpairs_world_set_properties(allpairs_world* world, allpairs_ids ids,
                                                             const allpairs_properties* properties);

/// Makes the next step call `accept` again for the pairs of these boxes.
ALLPAIRS_C_API allpairs_status allpairs_world_invalidate(allpairs_world* world, allpairs_ids ids);

ALLPAIRS_C_API size_t allpairs_world_size(const allpairs_world* world);
ALLPAIRS_C_API bool allpairs_world_contains(const allpairs_world* world, uint32_t id);

/// A number above all ids, those of removed boxes included: the size of an array that is indexed by id. 0 for null.
/// allpairs_world_shrink() may lower it.
ALLPAIRS_C_API uint32_t allpairs_world_id_bound(const allpairs_world* world);

/// Writes the ids of all boxes, ascending: as many as allpairs_world_size() says.
///
/// Cost: that of a pass over all ids that there have been.
ALLPAIRS_C_API allpairs_status allpairs_world_list_ids(const allpairs_world* world, uint32_t* ids);

/// Writes the six bounds of a box.
ALLPAIRS_C_API allpairs_status allpairs_world_box(const allpairs_world* world, uint32_t id, double* bounds);

/// Writes the properties of a box, which allpairs_world_set_properties() takes.
ALLPAIRS_C_API allpairs_status allpairs_world_properties(const allpairs_world* world, uint32_t id,
                                                         allpairs_properties* properties);

/// Writes the number of a box's world; 0 if it was given none.
ALLPAIRS_C_API allpairs_status allpairs_world_number(const allpairs_world* world, uint32_t id, uint32_t* number);

/// Finds the current pairs.
ALLPAIRS_C_API allpairs_status allpairs_world_step(allpairs_world* world, allpairs_step* step);

/// Numbers of the last step of a world, and of all its steps. Set struct_size.
typedef struct allpairs_step_statistics {
  size_t struct_size;  ///< sizeof(allpairs_step_statistics)
  uint64_t box_tests;  ///< As in allpairs_overlap_statistics, and so the next two.
  uint64_t group_tests;
  uint64_t exact_tests;
  uint64_t changed;  ///< Boxes that were added, moved, removed or given other properties.
  /// Full rebuilds of a hierarchy up to the last step, by steps and queries; with world numbers, how often a world's
  /// boxes were put in order.
  uint64_t rebuilds;
  bool joined_all;  ///< Whether the step joined all boxes, instead of only the changed ones with all.
} allpairs_step_statistics;

/// Writes the statistics of the last step; all 0 before the first one. After a step that failed they mean nothing.
ALLPAIRS_C_API allpairs_status allpairs_world_statistics(const allpairs_world* world,
                                                         allpairs_step_statistics* statistics);

/// The lists of the last step for one world: the pairs of its boxes with each other and with those of every world; with
/// ALLPAIRS_EVERY_WORLD, the pairs of two boxes of every world. Valid until the next step.
ALLPAIRS_C_API allpairs_status allpairs_world_result_of(allpairs_world* world, uint32_t number, allpairs_step* step);

/// From now on queries consider the boxes of the world of that number and those of every world; with
/// ALLPAIRS_EVERY_WORLD, as at first, of all worlds. allpairs_world_find_between() is not concerned.
ALLPAIRS_C_API allpairs_status allpairs_world_restrict_queries(allpairs_world* world, uint32_t number);

/// Which boxes a query considers: those whose category shares a bit with `mask` and whose mask with `category`: none if
/// one of these is 0.
typedef struct allpairs_query_filter {
  uint32_t category;
  uint32_t mask;
  bool skip_static;
  bool skip_moving;
} allpairs_query_filter;

/// The defaults, which null stands for too: all categories and masks, static boxes and others.
static inline allpairs_query_filter allpairs_default_query_filter(void) {
  allpairs_query_filter filter = {UINT32_MAX, UINT32_MAX, false, false};
  return filter;
}

/// The boxes that overlap a box of six numbers, by ascending id; valid until the next such query. As in all queries,
/// boxes are enlarged by their margins, and the distance of the world does not count. Null filter: all categories and
/// masks. No query finds a box of category 0 or mask 0.
ALLPAIRS_C_API allpairs_status allpairs_world_find_overlapping(allpairs_world* world, const double* box,
                                                               const allpairs_query_filter* filter, allpairs_ids* ids);

/// The points origin + t * direction with 0 <= t <= length, which may be INFINITY; if it is 0, the origin alone.
typedef struct allpairs_ray {
  double origin[3];
  double direction[3];
  double length;
} allpairs_ray;

/// A box and the smallest t at which a ray hits it.
typedef struct allpairs_hit {
  uint32_t id;
  double t;
} allpairs_hit;

/// The first box that a ray hits; of several at the same t, the one with the smallest id. Without a hit, id is
/// ALLPAIRS_NO_BOX.
ALLPAIRS_C_API allpairs_status allpairs_world_find_first(allpairs_world* world, const allpairs_ray* ray,
                                                         const allpairs_query_filter* filter, allpairs_hit* hit);

/// Hits in memory of the world that returned them.
typedef struct allpairs_hits {
  const allpairs_hit* data;
  size_t count;
} allpairs_hits;

/// All boxes that a ray hits, by ascending (t, id); valid until the next call of this or of allpairs_world_sweep_all().
ALLPAIRS_C_API allpairs_status allpairs_world_find_all(allpairs_world* world, const allpairs_ray* ray,
                                                       const allpairs_query_filter* filter, allpairs_hits* hits);

/// A swept box: six numbers, moved by t * motion with 0 <= t <= length.
typedef struct allpairs_sweep {
  double box[6];
  double motion[3];
  double length;
} allpairs_sweep;

/// Like find_first and find_all, for a swept box.
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_first(allpairs_world* world, const allpairs_sweep* sweep,
                                                          const allpairs_query_filter* filter, allpairs_hit* hit);
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_all(allpairs_world* world, const allpairs_sweep* sweep,
                                                        const allpairs_query_filter* filter, allpairs_hits* hits);

/// A box and its Euclidean distance from a point or a box; 0 if the point is in it, or the two overlap.
typedef struct allpairs_neighbor {
  uint32_t id;
  double distance;
} allpairs_neighbor;

/// Neighbors in memory of the world that returned them.
typedef struct allpairs_neighbors {
  const allpairs_neighbor* data;
  size_t count;
} allpairs_neighbors;

/// A point of three numbers, and the number of nearest boxes to find.
typedef struct allpairs_nearest {
  double point[3];
  size_t count;
} allpairs_nearest;

/// The boxes nearest to a point, or all if there are fewer, by ascending (distance, id); valid until the next such
/// query.
ALLPAIRS_C_API allpairs_status allpairs_world_find_nearest(allpairs_world* world, const allpairs_nearest* nearest,
                                                           const allpairs_query_filter* filter,
                                                           allpairs_neighbors* neighbors);

// Many queries in one call: the results are those of single queries, in less time, on the threads of the world.
// Lists are valid until the next query, single or batched, with the same kind of result. An invalid query is an
// ALLPAIRS_INVALID_ARGUMENT, a sweep of a box with a NaN an ALLPAIRS_INVALID_BOX; the message gives its index. Then no
// query is answered.

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

/// Points in rows of three numbers, and the number of nearest boxes to find for each.
typedef struct allpairs_nearest_many {
  const double* points;
  size_t point_count;
  size_t count;
} allpairs_nearest_many;

/// Boxes, and the number of nearest boxes to find for each.
typedef struct allpairs_nearest_to_boxes {
  const allpairs_set* boxes;
  size_t count;
} allpairs_nearest_to_boxes;

/// The result of allpairs_world_find_overlapping() for each box of a set. A set with margins is an
/// ALLPAIRS_INVALID_ARGUMENT.
ALLPAIRS_C_API allpairs_status allpairs_world_find_overlapping_many(allpairs_world* world, const allpairs_set* boxes,
                                                                    const allpairs_query_filter* filter,
                                                                    allpairs_id_lists* lists);

/// Writes the first hit of each ray, one per ray.
ALLPAIRS_C_API allpairs_status allpairs_world_find_first_many(allpairs_world* world, allpairs_rays rays,
                                                              const allpairs_query_filter* filter, allpairs_hit* hits);
ALLPAIRS_C_API allpairs_status allpairs_world_find_all_many(allpairs_world* world, allpairs_rays rays,
                                                            const allpairs_query_filter* filter,
                                                            allpairs_hit_lists* lists);

/// Writes the first hit of each swept box, one per box.
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_first_many(allpairs_world* world, allpairs_sweeps sweeps,
                                                               const allpairs_query_filter* filter, allpairs_hit* hits);
ALLPAIRS_C_API allpairs_status allpairs_world_sweep_all_many(allpairs_world* world, allpairs_sweeps sweeps,
                                                             const allpairs_query_filter* filter,
                                                             allpairs_hit_lists* lists);

ALLPAIRS_C_API allpairs_status allpairs_world_find_nearest_many(allpairs_world* world,
                                                                const allpairs_nearest_many* nearest,
                                                                const allpairs_query_filter* filter,
                                                                allpairs_neighbor_lists* lists);

/// The boxes nearest to each box of a set, in the order of allpairs_world_find_nearest(); an empty box is near nothing.
/// A set with margins is an ALLPAIRS_INVALID_ARGUMENT.
ALLPAIRS_C_API allpairs_status allpairs_world_find_nearest_to_boxes(allpairs_world* world,
                                                                    const allpairs_nearest_to_boxes* nearest,
                                                                    const allpairs_query_filter* filter,
                                                                    allpairs_neighbor_lists* lists);

/// All pairs of a box of `world` (first) and one of `other` that overlap at the mean of the distances of the two;
/// ordered, and valid until the next such query of `world`.
ALLPAIRS_C_API allpairs_status allpairs_world_find_between(allpairs_world* world, allpairs_world* other,
                                                           allpairs_pairs* pairs);

// Deforming triangle meshes.

/// The number of vertices of a mesh, and the vertices of its triangles in rows of 3 indices.
typedef struct allpairs_mesh {
  size_t vertex_count;
  const uint32_t* triangles;
  size_t triangle_count;
} allpairs_mesh;

/// Which candidates to find, and how. All fields except struct_size are 0 by default.
typedef struct allpairs_elements_options {
  size_t struct_size;  ///< sizeof(allpairs_elements_options)
  double distance;     ///< Elements whose boxes are at most this far apart on every axis are candidates.
  bool skip_within;    ///< No two elements of one mesh.
  bool skip_between;   ///< No two elements of different meshes.
  allpairs_order order;
  size_t threads;          ///< As in allpairs_options.
  allpairs_memory memory;  ///< Of candidates and the search; meshes and the boxes of elements are allocated elsewhere.
  allpairs_stop stop;      ///< As in allpairs_options.
  void* stop_context;
} allpairs_elements_options;

/// The two kinds of element in a candidate.
typedef enum allpairs_candidates {
  ALLPAIRS_VERTEX_FACE = 0,  ///< (vertex, triangle).
  ALLPAIRS_EDGE_EDGE = 1,    ///< (edge, edge), first < second.
  ALLPAIRS_FACE_FACE = 2     ///< (triangle, triangle), first < second.
} allpairs_candidates;

/// The pairs of elements of meshes that may touch while vertices move on straight lines through a step.
///
/// Elements are numbered consecutively: those of the first mesh, then those of the second, and so on. Triangles keep
/// their order; edges are unique, ascending by their two vertices.
/// Geometry:  the box of an element bounds its vertices at start and end; boxes are compared exactly, in double. Two
///            elements that share a vertex are never candidates.
/// Bad input: positions that are not finite, and a vertex or mesh out of range, are an ALLPAIRS_INVALID_ARGUMENT.
typedef struct allpairs_elements allpairs_elements;

/// The meshes are read during the call and need not outlive it. Null options are the defaults.
ALLPAIRS_C_API allpairs_status allpairs_elements_create(const allpairs_mesh* meshes, size_t count,
                                                        const allpairs_elements_options* options,
                                                        allpairs_elements** elements);
ALLPAIRS_C_API void allpairs_elements_destroy(allpairs_elements* elements);

/// Releases the memory kept for the next search. The candidates found last stay valid.
ALLPAIRS_C_API allpairs_status allpairs_elements_shrink(allpairs_elements* elements);

/// The number of elements of each kind, in all or before a mesh.
typedef struct allpairs_element_counts {
  size_t vertices;
  size_t edges;
  size_t triangles;
} allpairs_element_counts;

/// The number of elements before those of a mesh; with the number of meshes as index, the number of all elements.
ALLPAIRS_C_API allpairs_status allpairs_elements_before(const allpairs_elements* elements, size_t mesh,
                                                        allpairs_element_counts* counts);

/// The edges as two vertices each, the smaller first; valid as long as the handle.
ALLPAIRS_C_API allpairs_status allpairs_elements_edges(const allpairs_elements* elements, allpairs_pairs* edges);

/// Sets the positions of the vertices of a mesh at the start and at the end of the step, in rows of 3, one row per
/// vertex. The arrays are read during the call. Other meshes keep their positions; until set, all vertices are at the
/// origin.
ALLPAIRS_C_API allpairs_status allpairs_elements_move_f32(allpairs_elements* elements, size_t mesh, const float* start,
                                                          const float* end);
ALLPAIRS_C_API allpairs_status allpairs_elements_move_f64(allpairs_elements* elements, size_t mesh, const double* start,
                                                          const double* end);

/// All candidates of a kind, each once; valid until the next search for the same kind or the end of the handle.
ALLPAIRS_C_API allpairs_status allpairs_elements_find(allpairs_elements* elements, allpairs_candidates kind,
                                                      allpairs_pairs* pairs);

/// Count the candidates, and pass them to a visitor in batches; both use memory independent of their number.
ALLPAIRS_C_API allpairs_status allpairs_elements_count(allpairs_elements* elements, allpairs_candidates kind,
                                                       uint64_t* count);
ALLPAIRS_C_API allpairs_status allpairs_elements_stream(allpairs_elements* elements, allpairs_candidates kind,
                                                        allpairs_visitor visitor);

#ifdef __cplusplus
}  // extern "C"
#endif

// NOLINTEND
