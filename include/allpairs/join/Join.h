// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Executor.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Span.h"
#include "allpairs/StopFlag.h"
#include "allpairs/scene/BoxValues.h"
#include "allpairs/scene/EmptyBoxes.h"

namespace allpairs::join {

/// The least memory that a join can be given, 64 MiB; each thread after the first is used where there are 32 MiB more.
inline constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 20;
inline constexpr std::uint64_t kMemoryPerThread = std::uint64_t{32} << 20;

/// How far a join is: `done` of `total` boxes, cells or pairs in one of its steps.
struct JoinProgress {
  std::string_view step;
  std::uint64_t done = 0;
  std::uint64_t total = 0;
};

struct JoinOptions {
  /// As OverlapOptions::distance.
  double distance = 0.0;

  /// The memory in bytes that the process may have in the end, of which a join leaves 32 MiB to what it does not
  /// allocate itself. 0 means half of the machine's.
  std::uint64_t memory = 0;

  /// The folder of the join's own files, which is created in one that is there. It stays after a failure, for `resume`,
  /// and goes otherwise.
  std::filesystem::path work{};

  /// Goes on with what is in the work folder; starts from the beginning if there is nothing.
  bool resume = false;

  /// Searches several cells at once, each with its share of the memory, as far as that suffices; null means one after
  /// the other. Not owned.
  Executor* executor = nullptr;

  /// If given, a join throws Stopped soon after this is set; it can be resumed. Not owned.
  const StopFlag* stop = nullptr;

  /// Called now and then, by one thread at a time; may be empty.
  std::function<void(const JoinProgress&)> progress{};

  /// Called when the sink has received all bytes, and before the work folder is removed: puts the result in its place,
  /// so that a join which is killed then can still be resumed. May be empty.
  std::function<void()> commit{};

  /// Files of a second set: the pairs are those of a box of the inputs and a box of these, and both sets are numbered
  /// by themselves. None means pairs within the inputs.
  std::vector<std::filesystem::path> second{};

  /// As OverlapOptions::region: boxes outside it are left out.
  std::optional<Box> region{};

  /// Files of what each box of the inputs has, and each of the second set: a margin, as BoxView::setMargins() takes
  /// them, a group, categories and a mask, as in FilterBits.
  scene::BoxValueFiles values{};
  scene::BoxValueFiles secondValues{};

  /// The file that the sink writes, if it writes one: its disk is asked for room too. One that is the work folder, or
  /// lies in it, throws FileError before anything is read.
  std::filesystem::path output{};
};

/// What a join did, or is expected to do.
struct JoinSummary {
  std::uint64_t boxes = 0;      ///< Of both sets, where there are two.
  std::uint64_t pairs = 0;      ///< Estimated from a sample in a plan.
  std::uint64_t cells = 0;      ///< The parts of space that are searched one by one.
  std::uint64_t copies = 0;     ///< Boxes that are written to more than one cell, counted once for each cell but one.
  std::uint64_t wideBoxes = 0;  ///< Boxes in too many cells: kept apart, and searched with each cell.
  std::uint64_t boxBytes = 0;   ///< Written to the work folder, and read again.
  std::uint64_t pairBytes = 0;  ///< Likewise; and as many once more for the result.
  std::uint64_t resumedCells = 0;            ///< Cells whose pairs were found before, of a join that was resumed.
  std::uint64_t secondBoxes = 0;             ///< How many of the boxes are those of the second set.
  std::array<scene::EmptyBoxes, 2> empty{};  ///< Of each set, in no pair.
  /// In a plan, what copies of pairs take in the work folder besides while they are put in order, at most at once; 0
  /// where they fit in memory.
  std::uint64_t scratchBytes = 0;
};

/// Receives the bytes of a result, in order.
using ResultSink = FunctionRef<void(std::string_view)>;

/// Finds the overlapping pairs of boxes that do not fit in memory, and writes a .npy array of shape (m, 2) to the sink:
/// uint32, of more than 2^32 boxes in a set uint64, ordered by (first, second). These are the bytes that a search in
/// memory gives.
///
/// Inputs:    .npy files of shape (n, 6), numbered as one set in the order given; see scene::BoxRows. Of two sets,
///            options.second has the files of the other.
/// Bad input: a file that is none, or a box with a NaN, throws FileError, which names it; so does a work folder that is
///            full, in use, or another join's; so does a file of margins, groups, categories or masks that
///            scene::BoxValues refuses. Too little memory, a distance or a region that is none, or values of a second
///            set that there is not, throw InvalidArgument.
///            What was complete stays in the work folder.
/// Cost:      the inputs are read twice, and up to three times more where cells have to be cut again; options.memory;
///            on disk 32 bytes per box and copy (56 in float64), 8 more with margins and 8 for each two of groups,
///            categories and masks, and 8 per pair (16 of more than 2^32 boxes in a set); as many per pair for the
///            result, on the disk of options.output; and where boxes have more pairs than memory holds, about as much
///            again as these pairs take while they are put in order, or twice, or of very many boxes in little memory
///            three times (docs/scale.md; planFiles() says how much). Where a disk is estimated to be too small it
///            throws before it writes.
/// Resume:    what is complete is in a manifest, which is replaced atomically, with checksums of the files; a file that
///            was damaged is made again, and a manifest that was throws FileError. So do inputs of another size or time
///            of change than before. The result's bytes are the same.
JoinSummary joinFiles(Span<const std::filesystem::path> inputs, ResultSink sink, const JoinOptions& options);

/// The same into a file, which appears when it is complete, beside which it is written; options.commit and
/// options.output are not used. Killed meanwhile it leaves a file of that name, a number and ".part", which a join that
/// is resumed removes. The default work folder is `output` with ".work" behind it. Where `output` is a link its target
/// is replaced; permissions stay. One that is there and is no file, is one of the inputs, is the work folder or lies in
/// it, or cannot be written throws FileError before anything is read. The result is on the disk before it gets its
/// name, and has it before the work folder goes.
JoinSummary joinFiles(Span<const std::filesystem::path> inputs, const std::filesystem::path& output,
                      const JoinOptions& options = {});

/// Counts the pairs: no pairs are written, so that only the boxes take room on the disk.
JoinSummary countFiles(Span<const std::filesystem::path> inputs, const JoinOptions& options);

/// What a search of the same boxes by as many ranks of MPI would send (see allpairs/mpi/DistributedOverlaps.h).
struct RanksPlan {
  std::uint64_t boxes = 0;
  std::uint64_t pairs = 0;  ///< Estimated from a sample.
  std::uint64_t cells = 0;
  std::uint64_t copies = 0;
  std::uint64_t wideBoxes = 0;  ///< Sent to all ranks: in too many cells, or where no cut divides too many.
  std::uint64_t boxBytes = 0;   ///< Sent between ranks, by all of them together, where boxes lie in no order of space.
  std::uint64_t pairBytes = 0;  ///< Likewise.
  std::uint64_t secondBoxes = 0;             ///< How many of the boxes are those of the second set.
  std::array<scene::EmptyBoxes, 2> empty{};  ///< Of each set, in no pair.
};

/// Cuts space for `ranks` ranks, and counts. Reads the inputs as planFiles() does; one rank sends nothing.
///
/// Bad input: as joinFiles(); no ranks throw InvalidArgument.
[[nodiscard]] RanksPlan planRanks(Span<const std::filesystem::path> inputs, std::size_t ranks,
                                  const JoinOptions& options);

/// What joinFiles() would do: all but the pairs is exact. Reads the inputs once, or more where cells have to
/// be cut again, and writes nothing.
[[nodiscard]] JoinSummary planFiles(Span<const std::filesystem::path> inputs, const JoinOptions& options);

}  // namespace allpairs::join
