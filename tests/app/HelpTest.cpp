// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Every option and command that a help text names at the beginning of a line.
std::set<std::string> optionsOf(const std::string& help) {
  std::set<std::string> options;
  const std::regex line(R"(\n  (-[^ ]*|[a-z]+)(?= ))");
  for (auto match = std::sregex_iterator(help.begin(), help.end(), line); match != std::sregex_iterator(); ++match) {
    std::istringstream words(std::regex_replace((*match)[1].str(), std::regex(","), " "));
    for (std::string word; words >> word;) options.insert(word);
  }
  options.erase("allpairs");  // an example
  options.erase("a");         // "a folder", in the list of inputs
  return options;
}

class Help : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Help, HasExamplesAndEveryOptionIsInTheManualAndInTheCompletion) {
  std::vector<std::string> words = GetParam();
  words.emplace_back("--help");
  const ProgramRun run = runProgram(words);
  expectSuccess(run);
  EXPECT_NE(run.out.find("Examples:\n  allpairs "), std::string::npos);
  std::string manual = readBytes(ALLPAIRS_SOURCE_DIR "/docs/man/allpairs.1");
  manual = std::regex_replace(manual, std::regex(R"(\\-)"), "-");
  const std::string completion = readBytes(ALLPAIRS_SOURCE_DIR "/completions/allpairs.bash");
  const std::set<std::string> options = optionsOf(run.out);
  EXPECT_TRUE(options.contains("--help"));
  for (const std::string& option : options) {
    const std::regex whole("(^|[^a-z-])" + option + "($|[^a-z-])");
    EXPECT_TRUE(std::regex_search(manual, whole)) << option << " is missing in the manual page";
    EXPECT_TRUE(std::regex_search(completion, whole)) << option << " is missing in the completion";
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         testing::Values(std::vector<std::string>{}, std::vector<std::string>{"detect"},
                                         std::vector<std::string>{"info"}, std::vector<std::string>{"track"},
                                         std::vector<std::string>{"elements"}, std::vector<std::string>{"generate"},
                                         std::vector<std::string>{"bench"}, std::vector<std::string>{"view"},
                                         std::vector<std::string>{"report"}, std::vector<std::string>{"join"},
                                         std::vector<std::string>{"plan"}, std::vector<std::string>{"completion"}));

TEST(HelpOfDetect, NamesAllThatTheManualDescribes) {
  const std::set<std::string> options = optionsOf(runProgram({"detect", "--help"}).out);
  for (const char* option : {"--distance", "--box", "--strategy", "--threads", "--verify", "--format", "-o", "--output",
                             "--partial", "--data", "-h", "--help"}) {
    EXPECT_TRUE(options.contains(option)) << option;
  }
}

TEST(HelpOfDetect, ShowsThatWhyTakesTwoModels) {
  EXPECT_NE(runProgram({"detect", "--help"}).out.find("\n  --why A B  "), std::string::npos);
}

/// The numbers in a part of a text: what the pattern's group holds wherever it matches behind `begin` and before `end`.
std::set<int> statusesIn(const std::string& text, const std::string& begin, const std::string& end,
                         const std::string& pattern) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const std::string part = text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
  const std::regex lines(pattern), number("[0-9]+");
  std::set<int> statuses;
  for (auto line = std::sregex_iterator(part.begin(), part.end(), lines); line != std::sregex_iterator(); ++line) {
    const std::string numbers = (*line)[1].str();
    for (auto each = std::sregex_iterator(numbers.begin(), numbers.end(), number); each != std::sregex_iterator();
         ++each)
      statuses.insert(std::stoi(each->str()));
  }
  return statuses;
}

TEST(Help, HasEveryExitStatusAndSoHasTheManual) {
  const std::string described = readBytes(ALLPAIRS_SOURCE_DIR "/docs/command.md");
  const std::set<int> statuses = statusesIn(described, "\n## Exit status", "\n## ", R"(\n\| ([0-9, ]+) \|)");
  EXPECT_TRUE(statuses.contains(kWrongUsage));
  const std::string manual = readBytes(ALLPAIRS_SOURCE_DIR "/docs/man/allpairs.1");
  EXPECT_EQ(statusesIn(manual, "\n.SH EXIT STATUS", "\n.SH ", R"(\n\.TP\n\.BR? ([0-9", ]+)(?=\n))"), statuses);
  EXPECT_EQ(statusesIn(runProgram({"--help"}).out, "Exit status:", "\n\n", R"([ \n]([0-9]+)(?=[ ,]))"), statuses);
}

TEST(Help, OfACommandIsItsOwn) {
  for (const char* command : {"detect", "generate", "bench"}) {
    const ProgramRun run = runProgram({"help", command});
    expectSuccess(run);
    EXPECT_EQ(run.out, runProgram({command, "--help"}).out);
    EXPECT_NE(run.out.find(std::string("\nUsage: allpairs ") + command + " [OPTIONS] "), std::string::npos) << run.out;
  }
  EXPECT_EQ(runProgram({"help"}).out, runProgram({"--help"}).out);
  expectFailure(runProgram({"help", "find"}), kWrongUsage, "unknown command 'find'");
  expectFailure(runProgram({"help", "detect", "join"}), kWrongUsage, "one argument too many: 'join'");
}

TEST(Help, IsWhatAProgramWithoutArgumentsPrints) {
  const ProgramRun run = runProgram({});
  EXPECT_EQ(run.status, kWrongUsage);
  EXPECT_EQ(run.out, runProgram({"--help"}).out);
  EXPECT_EQ(run.err, "allpairs: no command given (see 'allpairs --help')\n");
}

TEST(MistypedWords, GetASuggestionWhereTheyResembleOne) {
  const auto expectUsage = [](const std::vector<std::string>& words, const std::string& message) {
    expectFailure(runProgram(words), kWrongUsage, message);
  };
  expectUsage({"detect", "--distnce", "1", "a.npy"}, "unknown option '--distnce' - did you mean --distance? (see");
  expectUsage({"detect", "--margn", "1", "a.npy"}, "unknown option '--margn' - did you mean --distance? (see");
  expectUsage({"detect", "a.npy", "--margin", "1"}, "unknown option '--margin' - did you mean --distance? (see");
  expectUsage({"detect", "a.npy", "--margin=-1"}, "unknown option '--margin' - did you mean --distance? (see");
  for (const char* command : {"join", "plan"})
    expectUsage({command, "a.npy", "--margin", "m.npy"},
                "unknown option '--margin' - did you mean --distance or --margins? (see");
  expectUsage({"bench", "uniform", "--margin", "1"}, "unknown option '--margin' (see");
  expectUsage({"detect", "--dist", "1", "a.npy"}, "unknown option '--dist' - did you mean --distance? (see");
  expectUsage({"detect", "a.npy", "--treads=2"}, "unknown option '--treads' - did you mean --threads? (see");
  expectUsage({"track", "a.npy", "--verfy"}, "unknown option '--verfy' - did you mean --verify? (see");
  expectUsage({"detect", "a.npy", "--picture"}, "unknown option '--picture' (see");
  expectUsage({"detect", "a.npy", "-x"}, "unknown option '-x' (see");
  expectUsage({"detect", "a.npy", "--" + std::string(5000, 'x')}, "unknown option '--xxx");
  expectUsage({"detect", "a.npy", "--verify=often"}, "--verify takes no value (see");
  expectUsage({"--verify", "detect", "a.npy"}, "the option '--verify' comes behind 'detect' (see");
  expectUsage({"bench", "uniform", "--seed", "99999999999999999999"},
              "--seed: '99999999999999999999' is too large (see");
  expectUsage({"generate", "uniform", "-n", "-1"}, "-n, --boxes: '-1' is not a whole number from 0 on (see");
  for (const std::string value : {"-1", "1.5", "1e999", "many"}) {
    expectUsage({"report", "a.obj", "-o", "b", "--pictures", value},
                "--pictures: '" + value + "' is not a whole number from 0 on (see");
    expectUsage({"bench", "uniform", "--repetitions", value},
                "--repetitions: '" + value + "' is not a whole number from 0 on (see");
  }
  for (const std::string value : {"-1", "0", "1.5", "0x10", "1000001", "99999999999999999999", "many"}) {
    expectUsage({"plan", "a.npy", "--ranks", value},
                "--ranks: '" + value + "' is not a whole number from 1 to 1000000 (see");
  }
  expectUsage({"view", "a.obj", "--serve", "--port", "65536"}, "--port: '65536' is not a whole number from 0 to 65535");
  expectUsage({"report", "a.obj", "-o", "b", "--metres-per-unit", "foot"}, "--metres-per-unit: 'foot' is not a number");
  expectUsage({"detct", "a.npy"}, "unknown command 'detct' - did you mean detect? (see");
  expectUsage({"find"}, "unknown command 'find' (see");
  expectUsage({"--distance", "1"}, "a command comes first, not '--distance=1' (see");
  expectUsage({"generate", "uniform", "city"}, "one argument too many: 'city'");
}

/// As where a script's variable has no value: it must not be as if the option was not given.
TEST(EmptyValues, AreRefused) {
  const auto expectRefused = [](std::vector<std::string> words, const std::string& option) {
    words.insert(words.end(), {option, ""});
    expectFailure(runProgram(words), kWrongUsage, option + ": the value is empty (see");
  };
  expectFailure(runProgram({"detect", "a.npy", ""}), kWrongUsage, "INPUT: the value is empty (see");
  expectFailure(runProgram({"join", "", "--count"}), kWrongUsage, "BOXES: the value is empty (see");
  expectFailure(runProgram({"track", ""}), kWrongUsage, "FRAMES: the value is empty (see");
  for (const char* option : {"--max-memory", "--data", "--sofa", "--threads", "--min-depth", "--format", "--why"})
    expectRefused({"detect", "a.npy"}, option);
  for (const char* option : {"--memory", "--work", "--with", "--margins"})
    expectRefused({"join", "a.npy", "--count"}, option);
  for (const char* option : {"--work", "--ranks"}) expectRefused({"plan", "a.npy"}, option);
  for (const char* option : {"--since", "--fail-on", "--up"}) expectRefused({"report", "a.obj", "-o", "b"}, option);
}

TEST(Version, IsOneLine) {
  EXPECT_EQ(runProgram({"-V"}).out, runProgram({"--version"}).out);
  const ProgramRun run = runProgram({"--version"});
  expectSuccess(run);
  EXPECT_TRUE(std::regex_match(run.out, std::regex("allpairs [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << run.out;
}

}  // namespace
}  // namespace allpairs::test
