// SPDX-License-Identifier: MIT
// Boxes in files, joined in next to no memory: the bytes are those of the double loop, at once, and after the join was
// ended at some step, its files damaged, and it went on.
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../Choices.h"
#include "../SceneFile.h"
#include "../Sides.h"
#include "allpairs/join/Join.h"
#include "allpairs/scene/FileError.h"
#include "join/JoinCase.h"

namespace allpairs::fuzz {
namespace {

namespace fs = std::filesystem;

/// What ends a join at a step.
struct Ended : std::runtime_error {
  Ended() : std::runtime_error("ended") {}
};

/// Boxes as a file of float32 or of float64 has them.
std::vector<Box> readFileOf(Choices& choices, test::JoinCase& with) {
  constexpr std::size_t kMost = 150;
  std::vector<Box> boxes;
  if (choices.byte() % 8 != 0) boxes = choices.boxes(kMost);
  const bool isFloat32 = choices.flag();
  if (isFloat32)
    std::transform(boxes.begin(), boxes.end(), boxes.begin(), [](const Box& box) { return asFloat32(box); });
  with.add(boxes, {.descr = isFloat32 ? "<f4" : "<f8", .fortran = choices.flag()});
  return boxes;
}

/// Little of everything, so that cells are cut, searched in parts, and pairs divided. More of what there is much of: with
/// one pair in each of a hundred thousand runs, all of them read for each row, an input took minutes.
join::Budget readBudget(Choices& choices, std::size_t boxes, std::size_t pairs) {
  join::Budget budget = test::tinyBudget();
  budget.cellBoxes = 4 + choices.below(120) + boxes / 16;
  budget.bufferPairs = 1 + choices.below(100) + pairs / 100;
  budget.sampleBoxes = 1 + choices.below(200);
  budget.mergeBytes = 2'000 + 64 * choices.below(1000);
  return budget;
}

/// Changes a byte of one of the join's files, cuts the file, or removes it.
void damage(Choices& choices, const fs::path& work) {
  constexpr std::array kFiles{"boxes", "pairs", "manifest"};
  const fs::path file = work / kFiles[choices.below(kFiles.size())];
  const std::size_t where = choices.below(1 << 16);
  const std::uint8_t way = choices.byte();
  if (!fs::exists(file)) return;
  if (way % 8 == 0) {
    fs::remove(file);
  } else if (way % 8 == 1) {
    fs::resize_file(file, std::min<std::uintmax_t>(where, fs::file_size(file)));
  } else if (where < fs::file_size(file)) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(where));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(where));
    stream.put(static_cast<char>(byte ^ (1 + way / 8)));
  }
}

void endAndGoOn(Choices& choices, test::JoinCase& with, join::JoinOptions options, const join::Budget& budget,
                const std::string& expected) {
  const std::size_t last = choices.below(40);
  join::JoinOptions ending = options;
  ending.progress = [last, step = std::size_t{0}](const join::JoinProgress&) mutable {
    if (step++ == last) throw Ended();
  };
  try {
    require(with.run(ending, budget) == expected, "a join that was not ended gives all pairs");
    return;
  } catch (const Ended&) {
  }
  const bool isDamaged = choices.flag();
  if (isDamaged) damage(choices, options.work);
  options.resume = true;
  try {
    require(with.run(options, budget) == expected, "a join that goes on gives all pairs");
  } catch (const FileError& error) {
    examine(error);
    require(isDamaged, "only a damaged join is refused");
  }
}

/// Two sets, or one, near a region or anywhere.
void joinTwo(Choices& choices) {
  constexpr std::size_t kMost = 60;
  test::JoinCase with;
  Side first, second;
  first.boxes = readFileOf(choices, with);
  const bool areTwo = choices.flag();
  if (areTwo) {
    second.boxes = choices.boxes(kMost);
    with.addSecond(second.boxes, {.descr = "<f8", .fortran = choices.flag()});
  }
  OverlapOptions asked{.distance = choices.distance()};
  const Box region = choices.box();
  if (choices.flag() && !isNothing(region)) asked.region = region;
  with.distance = asked.distance;
  with.region = asked.region;
  const std::string expected = test::bytesOfPairs(Oracle{asked, first, areTwo ? second : first}.pairs());
  const std::size_t pairs = test::pairsOfNpy(expected).size();
  const join::Budget budget = readBudget(choices, first.boxes.size() + second.boxes.size(), pairs);
  require(with.run(with.options(), budget) == expected,
          "a join of two sets, near a region, gives the double loop's pairs");
  require(with.count(with.options(), budget) == pairs, "and counts as many");
}

void runJoins(Bytes bytes) {
  Choices choices(bytes);
  test::JoinCase with;
  std::vector<Box> boxes;
  for (std::size_t files = 1 + choices.below(3); files > 0; --files) {
    const std::vector<Box> part = readFileOf(choices, with);
    boxes.insert(boxes.end(), part.begin(), part.end());
  }
  join::JoinOptions options = with.options();
  options.distance = choices.distance();
  const std::string expected = test::expectedBytes(boxes, options.distance);
  const std::size_t pairs = test::pairsOfNpy(expected).size();
  const join::Budget budget = readBudget(choices, boxes.size(), pairs);
  require(with.run(options, budget) == expected, "a join gives the pairs of the double loop");
  require(with.count(options, budget) == pairs, "and counts as many");
  endAndGoOn(choices, with, options, budget, expected);
  if (!choices.done()) joinTwo(choices);
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(joins, allpairs::fuzz::runJoins)
