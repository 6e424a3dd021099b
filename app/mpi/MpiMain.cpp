// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/mpi/DistributedOverlaps.h"
#include "allpairs/mpi/OnAllRanks.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/TargetFile.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/ParseArguments.h"
#include "cli/Text.h"
#include "cli/Warning.h"
#include "mpi/BoxShare.h"
#include "mpi/PairFile.h"

namespace {

using allpairs::app::ExitStatus;
using allpairs::app::UsageError;
using allpairs::scene::EmptyBoxes;

constexpr const char* kExamples =
    R"(Boxes are .npy arrays (n, 6), float32 or float64: minx miny minz maxx maxy maxz.
Several files are one set, numbered on from file to file; every rank must see
them. The result is the file that 'allpairs detect -o' and 'allpairs join' write.
With --with the pairs are those of a box of BOXES, first, and a box of a second
set of files, second; both sets are numbered by themselves. --with comes after
BOXES: it takes all files up to the next option.
Margins are .npy arrays (n,) of floats or integers, groups, categories and masks
of integers or bools: one number for each box, in one file or several, numbered
on.

Examples:
  mpirun allpairs-mpi join boxes.npy -o pairs.npy
  mpirun -n 64 allpairs-mpi join part*.npy --count
  mpirun -n 64 allpairs-mpi join part*.npy --with obstacles.npy -o pairs.npy
  mpirun allpairs-mpi join boxes.npy -o pairs.npy --margins margins.npy
  mpirun --map-by socket allpairs-mpi join boxes.npy -o pairs.npy --threads 16)";

struct Settings {
  allpairs::app::BoxSetArguments sets;
  std::string output;
  std::string distance;
  std::string threads = "1";
  bool count = false;
};

/// What each rank does; only rank 0 says what came out.
class Join {
 public:
  explicit Join(const Settings& settings)
      : m_settings(settings),
        m_files{allpairs::app::pathsOf(settings.sets.paths), allpairs::app::filesOf(settings.sets.values)},
        m_with{allpairs::app::pathsOf(settings.sets.with), allpairs::app::filesOf(settings.sets.withValues)} {
    MPI_Comm_rank(MPI_COMM_WORLD, &m_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &m_ranks);
  }

  void run() {
    check();
    std::optional<allpairs::parallel::TbbExecutor> executor;
    const std::size_t threads = makeExecutor(executor);
    allpairs::mpi::DistributedOptions options;
    if (!m_settings.sets.box.empty()) options.region = allpairs::app::parseRegion(m_settings.sets.box);
    if (!m_settings.distance.empty()) options.distance = allpairs::app::parseDistance(m_settings.distance);
    if (threads != 1) options.executor = &*executor;
    std::optional<allpairs::app::PairFile> output;  // before all else: a place that cannot be written is an error now
    if (!m_settings.count) output.emplace(MPI_COMM_WORLD, m_settings.output);
    std::optional<allpairs::app::BoxShare> first;
    std::optional<allpairs::app::BoxShare> second;
    allpairs::mpi::onAllRanks(MPI_COMM_WORLD, [&] {
      first.emplace(m_files, m_rank, m_ranks);
      if (!m_with.paths.empty()) second.emplace(m_with, m_rank, m_ranks);
    });
    options.first = first->bits();
    if (second) options.second = second->bits();
    allpairs::mpi::DistributedOverlaps search(MPI_COMM_WORLD, options);
    const auto boxes = [&first] { return first->view(); };
    const auto others = [&second] { return second->view(); };
    std::uint64_t pairs = 0;
    if (output) {
      const std::uint64_t most = std::max(first->allBoxes(), second ? second->allBoxes() : 0);
      pairs = output->write(second ? search.find(boxes, others) : search.find(boxes), most);
    } else {
      pairs = second ? search.count(boxes, others) : search.count(boxes);
    }
    const std::string all = second ? allpairs::app::countedBoxes(first->allBoxes(), second->allBoxes())
                                   : allpairs::app::counted(first->allBoxes(), "box", "boxes");
    const std::array<EmptyBoxes, 2> empty{emptyOfAllRanks(*first), second ? emptyOfAllRanks(*second) : EmptyBoxes()};
    allpairs::mpi::onAllRanks(MPI_COMM_WORLD, [&] {
      if (m_rank != 0) return;
      for (const std::string& text : allpairs::app::emptyTexts(m_settings.sets, empty))
        allpairs::app::warn(text, "allpairs-mpi");
      say(pairs, all);
    });
  }

 private:
  /// Each rank has threads of its own: a number that is wrong on one of them is wrong usage on all.
  std::size_t makeExecutor(std::optional<allpairs::parallel::TbbExecutor>& executor) const {
    std::size_t threads = 1;
    try {
      allpairs::mpi::onAllRanks(MPI_COMM_WORLD, [&] {
        try {
          threads = allpairs::app::parseThreads(m_settings.threads);
        } catch (const UsageError& problem) {
          throw allpairs::InvalidArgument(problem.what());  // which arrives on other ranks as what it is
        }
        executor.emplace(threads);
      });
    } catch (const allpairs::InvalidArgument& problem) {
      throw UsageError(problem.what());
    }
    return threads;
  }

  void check() const {
    const std::string& output = m_settings.output;
    if (output.empty() && !m_settings.count) throw UsageError("join takes -o FILE, or --count");
    if (!output.empty() && m_settings.count) throw UsageError("--count writes no pairs: -o has nothing to hold");
    if (output == "-") throw UsageError("-o: the ranks write a file, and not to standard output");
    allpairs::app::checkPairFileName(output);
    allpairs::mpi::onAllRanks(MPI_COMM_WORLD, [this] {
      if (m_rank == 0) allpairs::scene::checkIsNoInput(m_settings.output, allpairs::app::filesOf(m_settings.sets));
    });
  }

  /// The boxes of a set that are empty, on every rank.
  static EmptyBoxes emptyOfAllRanks(const allpairs::app::BoxShare& share) {
    EmptyBoxes empty;
    allpairs::mpi::onAllRanks(MPI_COMM_WORLD, [&] { empty = share.empty(); });
    std::uint64_t first = empty.count == 0 ? std::numeric_limits<std::uint64_t>::max() : 4 * empty.first + empty.axis;
    MPI_Allreduce(MPI_IN_PLACE, &empty.count, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
    empty.first = first / 4;
    empty.axis = static_cast<std::size_t>(first % 4);
    return empty;
  }

  void say(std::uint64_t pairs, const std::string& boxes) const {
    using allpairs::app::counted;
    fmt::print("{} among {} on {}", counted(pairs, "pair"), boxes,
               counted(static_cast<std::uint64_t>(m_ranks), "rank"));
    if (!m_settings.output.empty()) fmt::print(" -> {}", allpairs::app::printable(m_settings.output));
    fmt::print("\n");
    if (std::fflush(stdout) != 0) throw allpairs::FileError("standard output", "cannot be written");
  }

  const Settings& m_settings;
  allpairs::app::BoxFiles m_files;
  allpairs::app::BoxFiles m_with;
  int m_rank = 0;
  int m_ranks = 1;
};

/// All ranks fail, and rank 0 says why.
ExitStatus fail(ExitStatus status, const std::string& message) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) std::fprintf(stderr, "%s\n", allpairs::oneLine("allpairs-mpi: " + message).c_str());
  return status;
}

void print(const std::string& text) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) fmt::print("{}", text);
  if (std::fflush(stdout) != 0) throw allpairs::FileError("standard output", "cannot be written");
}

/// The arguments in one text, without how many threads a rank has, which need not be equal where it is said once.
std::string comparable(const std::vector<std::string>& arguments) {
  const auto isNumber = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  };
  const std::string threads = "--threads=";
  std::string text;
  bool isSaid = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool isOne = arguments[i].starts_with(threads) && isNumber(arguments[i].substr(threads.size()));
    const bool isOfTwo = arguments[i] == "--threads" && i + 1 < arguments.size() && isNumber(arguments[i + 1]);
    if (!isSaid && (isOne || isOfTwo)) {
      isSaid = true;
      if (isOfTwo) ++i;
      continue;
    }
    text += arguments[i];
    text += '\0';
  }
  return text;
}

/// Ranks that do different things would wait for each other, or count what is not there.
void checkSame(const std::vector<std::string>& arguments) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::string own = comparable(arguments);
  auto length = static_cast<unsigned long long>(own.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
  std::string first = own;
  first.resize(static_cast<std::size_t>(length));
  MPI_Bcast(first.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  int differs = first == own ? std::numeric_limits<int>::max() : rank;
  MPI_Allreduce(MPI_IN_PLACE, &differs, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (differs != std::numeric_limits<int>::max()) {
    throw UsageError("rank " + std::to_string(differs) + " has other arguments than rank 0");
  }
}

void run(int count, char** arguments) {
  CLI::App program("Finds the overlapping boxes of more boxes than one machine holds, on the ranks of MPI.",
                   "allpairs-mpi");
  program.set_version_flag("-V,--version", "allpairs-mpi " ALLPAIRS_VERSION, "Print the version and exit");
  program.require_subcommand(1);
  Settings settings;
  CLI::App* join = program.add_subcommand("join", "Find the pairs, or count them");
  join->footer(kExamples);
  allpairs::app::addBoxSets(*join, settings.sets);
  join->add_option("-o,--output", settings.output, "Write the pairs to this .npy file")->type_name("FILE");
  join->add_option("--distance", settings.distance, "Pairs up to D apart on every axis")->type_name("D");
  join->add_option("--threads", settings.threads, "Threads of each rank; 0 means all cores")->type_name("N");
  allpairs::app::addBoxValues(*join, settings.sets);
  join->add_flag("--count", settings.count, "Only count the pairs");
  join->callback([&settings] { Join(settings).run(); });
  const std::vector<std::string> given = allpairs::app::joinNumbers(count, arguments);
  checkSame(given);
  allpairs::app::parseArguments(program, given, print);
}

ExitStatus runWithStatus(int count, char** arguments) {
  try {
    run(count, arguments);
    return ExitStatus::Success;
  } catch (const UsageError& problem) {
    return fail(ExitStatus::WrongUsage, std::string(problem.what()) + " (see 'allpairs-mpi join --help')");
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::BadInput, "not enough memory for this input or its result");
  } catch (const allpairs::mpi::MpiError& problem) {  // others may wait for this rank
    fail(ExitStatus::BadInput, problem.what());
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitStatus::BadInput));
    return ExitStatus::BadInput;
  } catch (const std::exception& problem) {
    return fail(ExitStatus::BadInput, problem.what());
  }
}

}  // namespace

int main(int count, char** arguments) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing it
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&count, &arguments, MPI_THREAD_FUNNELED, &provided);
  const ExitStatus status = runWithStatus(count, arguments);
  MPI_Finalize();
  return static_cast<int>(status);
}
