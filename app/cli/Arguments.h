// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/scene/BoxValues.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class Option;
}  // namespace CLI

namespace allpairs::app {

/// The arguments as the parser needs them: an option that takes numbers is joined with its value, which may begin with
/// a minus and would otherwise be taken for an option. What follows "--" is marked where it looks like one.
[[nodiscard]] std::vector<std::string> joinNumbers(int count, const char* const* arguments);

/// An argument without that mark.
[[nodiscard]] std::string asGiven(const std::string& argument);

/// Whether it takes all files that follow it.
[[nodiscard]] bool isOfFiles(const CLI::Option& option);

/// What an option may be called, since nothing says by which name it was given: "-n, --boxes".
[[nodiscard]] std::string namesOf(const CLI::Option& option);

/// The number that follows --distance.
///
/// Bad input: anything but a number, NaN and -infinity throw UsageError.
[[nodiscard]] double parseDistance(const std::string& text);

/// The number that follows an option: a length from 0 on.
///
/// Bad input: anything but a finite number that is not negative throws UsageError.
[[nodiscard]] double parseLength(const char* option, const std::string& text);

/// The number that follows --threads.
///
/// Bad input: throws UsageError.
[[nodiscard]] std::size_t parseThreads(const std::string& text);

/// The bytes that follow an option such as --max-memory: a whole number above 0, with K, M, G or T behind it for powers
/// of 1024.
///
/// Bad input: throws UsageError.
[[nodiscard]] std::uint64_t parseMemory(const std::string& option, const std::string& text);

/// Files of what each box of a set has beside its bounds.
struct ValueArguments {
  std::vector<std::string> margins;
  std::vector<std::string> groups;
  std::vector<std::string> categories;
  std::vector<std::string> masks;
};

/// The files of one or two sets of boxes.
struct BoxSetArguments {
  std::vector<std::string> paths;
  std::vector<std::string> with;  ///< The second set.
  ValueArguments values;
  ValueArguments withValues;
  std::string box;  ///< As written; empty for no region.
};

/// Declares BOXES... and --with FILE....
///
/// Bad input: BOXES after --with, or after another option that takes all files that follow it, throw UsageError when
///            the command is parsed.
void addBoxSets(CLI::App& command, BoxSetArguments& arguments);

/// What a message says of the place of BOXES where one of the options that were given takes all files that follow it:
/// "come before --with, which takes all files that follow it"; else nothing.
[[nodiscard]] std::string placeOfBoxes(const CLI::App& command);

/// Declares --box, and --margins, --groups, --categories and --masks, which take files, and the same of the second set:
/// --with-margins and so on.
void addBoxValues(CLI::App& command, BoxSetArguments& arguments);

[[nodiscard]] std::vector<std::filesystem::path> pathsOf(const std::vector<std::string>& names);
[[nodiscard]] scene::BoxValueFiles filesOf(const ValueArguments& arguments);

/// All files that are named.
[[nodiscard]] std::vector<std::filesystem::path> filesOf(const BoxSetArguments& arguments);

/// Checks the name of a file that a join writes: it ends in ".npy", in letters of any case, or has no ending.
///
/// Bad input: another one throws UsageError.
void checkPairFileName(const std::string& output);

/// The region that follows --box: x0,y0,z0,x1,y1,z1 with min < max on every axis.
///
/// Bad input: throws UsageError.
[[nodiscard]] Box parseRegion(const std::string& text);

}  // namespace allpairs::app
