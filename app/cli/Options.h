// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class Option;
}  // namespace CLI

namespace allpairs::app {

class SpooledInputs;

/// What the inputs may touch: the files that they name, and memory.
struct ReadLimits {
  bool allowOutside = false;
  std::string maxMemory;    ///< As written; empty for the default.
  std::string inputFormat;  ///< What standard input and pipes hold, as an extension; empty: as their names say.
};

/// Which inputs to read, and how: what every command that reads has in common.
struct InputSettings {
  std::vector<std::string> paths;
  std::vector<std::string> searchRoots;
  bool partial = false;
  bool recursive = false;
  bool betweenInputs = false;  ///< Two models of one input are no pair.
  std::string sofa{};          ///< As which SOFA to read, "24.06"; empty for the default.
  ReadLimits limits{};
  std::vector<std::filesystem::path> outputs{};  ///< Files that are written, which may be none that is read.
  const SpooledInputs* spooled = nullptr;        ///< Knows what paths that are temporary files stand for.
};

/// Declares --allow-outside, --max-memory SIZE and --input-format EXT.
void addReadLimits(CLI::App& command, ReadLimits& limits);

/// Declares these, INPUT..., --partial and --data, which every command that reads has.
void addInputs(CLI::App& command, InputSettings& settings);

/// Declares --between-inputs.
void addBetweenInputs(CLI::App& command, InputSettings& settings);

/// Declares an option whose value is one of a few words.
CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices);

/// Declares --distance D, whose value parseDistance() takes.
CLI::Option* addDistance(CLI::App& command, std::string& distance, const std::string& description);

/// Declares --threads N, whose value parseThreads() takes.
CLI::Option* addThreads(CLI::App& command, std::string& threads);

/// Lets an option that counts something take whole numbers only, those like 1e6 too.
void takeCount(CLI::Option& option);

/// Lets an option take whole numbers in this range only.
void takeNumber(CLI::Option& option, std::uint64_t least, std::uint64_t most);

/// Declares --strategy WORD, whose value strategyOf() takes.
void addStrategy(CLI::App& command, std::string& strategy);

/// Declares --format WORD, one of these.
void addFormat(CLI::App& command, std::string& format, const std::vector<std::string>& formats);

/// The format that was chosen; else the one that the name of the output ends in, if it is one of these; else the first.
///
/// Bad input: a name that ends in something else than ".txt" throws UsageError.
[[nodiscard]] std::string formatOf(const std::string& format, const std::string& output,
                                   const std::vector<std::string>& formats);

/// Declares -o FILE; `path` stays empty where it isn't given, or is "-".
CLI::Option* addOutput(CLI::App& command, std::string& path);

/// The file of such a path, as Output takes it: none for standard output.
[[nodiscard]] std::optional<std::filesystem::path> targetOf(const std::string& path);

}  // namespace allpairs::app
