// SPDX-License-Identifier: MIT
// The library as a plug-in: loaded, used and unloaded, again and again, and where there is no memory.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "allpairs.h"
#include "support/FailingAllocation.h"
#include "support/ProcessMemory.h"
#include "support/Sanitizers.h"

namespace {

/// The functions that the tests use.
struct Library {
  Library() : handle(dlopen(ALLPAIRS_C_LIBRARY, RTLD_NOW | RTLD_LOCAL)) {
    if (handle == nullptr) return;
    load(makeSet, "allpairs_set_create_f64");
    load(destroySet, "allpairs_set_destroy");
    load(makeSearch, "allpairs_search_create");
    load(destroySearch, "allpairs_search_destroy");
    load(find, "allpairs_find");
    load(message, "allpairs_error_message");
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() {
    if (handle != nullptr) dlclose(handle);
  }

  template <class Function>
  void load(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(dlsym(handle, name));
  }

  /// Finds the pairs of all boxes, which is none, one or all; returns the first status that is not OK.
  [[nodiscard]] allpairs_status search(const std::vector<double>& rows, std::size_t& pairs,
                                       const allpairs_options* options = nullptr) const {
    allpairs_set* set = nullptr;
    allpairs_search* made = nullptr;
    allpairs_pairs found{};
    allpairs_status status = makeSet(rows.data(), rows.size() / 6, &set);
    if (status == ALLPAIRS_OK) status = makeSearch(options, &made);
    if (status == ALLPAIRS_OK) status = find(made, set, &found);
    pairs = found.count;
    destroySearch(made);
    destroySet(set);
    return status;
  }

  void* handle = nullptr;
  decltype(allpairs_set_create_f64)* makeSet = nullptr;
  decltype(allpairs_set_destroy)* destroySet = nullptr;
  decltype(allpairs_search_create)* makeSearch = nullptr;
  decltype(allpairs_search_destroy)* destroySearch = nullptr;
  decltype(allpairs_find)* find = nullptr;
  decltype(allpairs_error_message)* message = nullptr;
};

std::vector<double> unitBoxes(std::size_t count) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < 6 * count; ++i) rows.push_back(i % 6 < 3 ? 0.0 : 1.0);
  return rows;
}

/// Loads the library, has it succeed and fail, and unloads it.
void useOnce() {
  const Library library;
  ASSERT_NE(library.handle, nullptr) << dlerror();
  std::size_t pairs = 0;
  ASSERT_EQ(library.search(unitBoxes(300), pairs), ALLPAIRS_OK);
  ASSERT_EQ(pairs, 300U * 299U / 2U);
  ASSERT_EQ(library.makeSearch(nullptr, nullptr), ALLPAIRS_INVALID_ARGUMENT);
  ASSERT_STREQ(library.message(), "search is null");
}

bool isLoaded() {
  void* handle = dlopen(ALLPAIRS_C_LIBRARY, RTLD_NOW | RTLD_NOLOAD);
  if (handle != nullptr) dlclose(handle);
  return handle != nullptr;
}

/// How much the process holds after a thousand cycles beyond what it held after a few.
template <class Cycle>
double growthOverCycles(const Cycle& cycle) {
  for (int i = 0; i < 20; ++i) cycle();
  const double before = allpairs::test::residentMegabytes();
  for (int i = 0; i < 1000; ++i) cycle();
  return allpairs::test::residentMegabytes() - before;
}

/// A page for each cycle would be 4.
constexpr double kSlack = 3;

TEST(Loaded, IsUnloadedWhenItIsClosed) {
  if (allpairs::test::kIsSanitized) GTEST_SKIP() << "a sanitizer keeps libraries";
  useOnce();
  EXPECT_FALSE(isLoaded());
}

TEST(Loaded, AThousandTimesItLeavesNothing) {
  if (allpairs::test::kIsSanitized) GTEST_SKIP() << "a sanitizer holds freed memory";
  EXPECT_LT(growthOverCycles(useOnce), kSlack);
}

TEST(Loaded, AThousandTimesInAThreadItLeavesNothing) {
  if (allpairs::test::kIsSanitized) GTEST_SKIP() << "a sanitizer holds freed memory";
  EXPECT_LT(growthOverCycles([] { std::thread(useOnce).join(); }), kSlack);
}

/// Boxes in a row, each of which touches the next: enough of them that each thread gets some.
std::vector<double> rowOfBoxes(std::size_t count) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    rows.insert(rows.end(), {x, 0, 0, x + 1, 1, 1});
  }
  return rows;
}

TEST(Loaded, IsUnloadedWhileThreadsOfASearchComeToAnEnd) {
  if (allpairs::test::kIsSanitized) GTEST_SKIP() << "LeakSanitizer reads what threads keep for libraries that are gone";
  const std::vector<double> rows = rowOfBoxes(30000);
  allpairs_options options = allpairs_default_options();
  options.threads = 3;
  for (int cycle = 0; cycle < 50; ++cycle) {
    const Library library;
    ASSERT_NE(library.handle, nullptr) << dlerror();
    std::size_t pairs = 0;
    ASSERT_EQ(library.search(rows, pairs, &options), ALLPAIRS_OK);
    ASSERT_EQ(pairs, rows.size() / 6 - 1);
  }
}

TEST(Loaded, TheFirstUseInAThreadThatIsOutOfMemoryIsAStatus) {
  if (allpairs::test::kIsThreadSanitized) GTEST_SKIP() << "ThreadSanitizer ends where a suppressed library is unloaded";
  const Library library;
  ASSERT_NE(library.handle, nullptr) << dlerror();
  const std::vector<double> rows = unitBoxes(200);
  std::thread(useOnce).join();  // What the C library keeps of a thread for the next one.
  const auto scene = [&](allpairs::test::Fault& fault) {
    std::thread([&] {
      allpairs_status status = ALLPAIRS_INTERNAL;
      std::size_t pairs = 0;
      static_cast<void>(fault.during([&] { status = library.search(rows, pairs); }));
      if (status == ALLPAIRS_OK) {
        EXPECT_EQ(pairs, 200U * 199U / 2U);
      } else {
        EXPECT_EQ(status, ALLPAIRS_OUT_OF_MEMORY);
        EXPECT_STRNE(library.message(), "");
      }
    }).join();
  };
  allpairs::test::failEachAllocation(scene);
}

}  // namespace
