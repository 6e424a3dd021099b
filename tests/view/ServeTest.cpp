// SPDX-License-Identifier: MIT
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

namespace fs = std::filesystem;

const std::string kBoxes = ALLPAIRS_SOURCE_DIR "/examples/boxes.csv";

/// The program while it serves a page.
class Served {
 public:
  explicit Served(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {ALLPAIRS_PROGRAM, "view", kBoxes, "--serve"});
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::runtime_error("cannot make a pipe");
    m_child = ::fork();
    if (m_child == 0) run(words, ends);
    ::close(ends[1]);
    m_out = ::fdopen(ends[0], "r");
    std::array<char, 200> line{};
    if (std::fgets(line.data(), line.size(), m_out) != nullptr) m_line = line.data();
  }

  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  Served(Served&&) = delete;
  Served& operator=(Served&&) = delete;

  ~Served() {
    if (m_child > 0) end(SIGKILL);
    std::fclose(m_out);
  }

  [[nodiscard]] const std::string& line() const { return m_line; }
  [[nodiscard]] int port() const { return std::stoi(m_line.substr(m_line.rfind(':') + 1)); }

  /// Sends a signal, and gives that with which the program ended.
  int end(int signal) {
    ::kill(m_child, signal);
    int status = 0;
    ::waitpid(m_child, &status, 0);
    m_child = -1;
    return WIFSIGNALED(status) ? WTERMSIG(status) : -1;
  }

 private:
  [[noreturn]] static void run(std::vector<std::string>& words, const std::array<int, 2>& ends) {
    // Left alone it would keep the outputs of the test open, for whose end ctest waits.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }

  pid_t m_child = -1;
  std::FILE* m_out = nullptr;
  std::string m_line;
};

/// The answer to a request, for which a busy machine may take long.
httplib::Response answer(const Served& served, const std::string& path, const httplib::Headers& headers = {}) {
  httplib::Client client("127.0.0.1", served.port());
  client.set_read_timeout(std::chrono::minutes(5));
  const httplib::Result result = client.Get(path, headers);
  if (!result) throw std::runtime_error(path + ": " + httplib::to_string(result.error()));
  return *result;
}

TEST(Serve, GivesThePageAtTheAddressThatItPrintsAndNothingElse) {
  const Served served;
  EXPECT_TRUE(served.line().starts_with("http://127.0.0.1:")) << served.line();
  EXPECT_TRUE(served.line().ends_with("/ (end with Ctrl+C)\n")) << served.line();
  const httplib::Response page = answer(served, "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_NE(page.body.find("id=\"allpairs-scene\""), std::string::npos);
  EXPECT_TRUE(page.body.ends_with("</html>\n") || page.body.ends_with("</html>")) << page.body.size();
  EXPECT_EQ(answer(served, "/etc/passwd").status, 404);
}

TEST(Serve, EndsWhereItsAddressCannotBeWritten) {
  expectFailure(runProgram({"view", kBoxes, "--serve"}, StandardOutput::FullDevice), 3,
                "standard output: cannot be written");
}

TEST(Serve, RefusesOtherNamesForThisMachine) {
  const Served served;
  const std::string port = std::to_string(served.port());
  EXPECT_EQ(answer(served, "/", {{"Host", "localhost:" + port}}).status, 200);
  EXPECT_EQ(answer(served, "/", {{"Host", "evil.example:" + port}}).status, 403);
}

TEST(Serve, IsForThisMachineAlone) {
  const Served served;
  std::FILE* table = std::fopen("/proc/net/tcp", "r");
  if (table == nullptr) GTEST_SKIP() << "the system does not show its sockets";
  std::array<char, 300> line{};
  std::array<char, 10> port{};
  static_cast<void>(std::snprintf(port.data(), port.size(), ":%04X ", static_cast<unsigned>(served.port())));
  std::vector<std::string> addresses;
  while (std::fgets(line.data(), line.size(), table) != nullptr) {
    const std::string text = line.data();
    const std::size_t place = text.find(port.data());
    const bool listens = text.find(" 0A ") != std::string::npos;
    if (listens && place != std::string::npos && place < 20) addresses.push_back(text.substr(place - 8, 8));
  }
  std::fclose(table);
  EXPECT_EQ(addresses, std::vector<std::string>{"0100007F"});
}

/// A connection that says what it is told to, and no more.
class RawConnection {
 public:
  explicit RawConnection(int port) : m_socket(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(m_socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
      throw std::runtime_error("cannot connect");
    }
  }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;
  RawConnection(RawConnection&&) = delete;
  RawConnection& operator=(RawConnection&&) = delete;
  ~RawConnection() { ::close(m_socket); }

  /// Returns false once the other end is closed.
  bool send(std::string_view text) const {
    return ::send(m_socket, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }

  /// All that comes until the other end closes; a connection that is broken off gives less.
  [[nodiscard]] std::string receiveAll() const {
    std::string received;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 1; count > 0;) {
      count = ::recv(m_socket, bytes.data(), bytes.size(), 0);
      if (count > 0) received.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return received;
  }

  /// Whether the other end closes within that time, whatever it sends before.
  [[nodiscard]] bool isClosedWithin(std::chrono::milliseconds time) const {
    std::array<char, 4096> bytes{};
    pollfd poll{m_socket, POLLIN, 0};
    while (::poll(&poll, 1, static_cast<int>(time.count())) > 0) {
      if (::recv(m_socket, bytes.data(), bytes.size(), 0) <= 0) return true;
    }
    return false;
  }

 private:
  int m_socket;
};

/// Many connections, each of which goes on sending a byte of a request that never ends.
class SlowClients {
 public:
  SlowClients(int port, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      m_connections.push_back(std::make_unique<RawConnection>(port));
      m_connections.back()->send("GET / HTTP/1.1\r\nX-Slow: ");
    }
    m_thread = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        for (const auto& connection : m_connections) connection->send("x");
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
      }
    });
  }

  [[nodiscard]] std::size_t countOpen() const {
    return static_cast<std::size_t>(std::ranges::count_if(m_connections, [](const auto& connection) {
      return !connection->isClosedWithin(std::chrono::milliseconds(0));
    }));
  }

 private:
  std::vector<std::unique_ptr<RawConnection>> m_connections;
  std::jthread m_thread;
};

TEST(Serve, AnswersWhileThreeHundredSlowConnectionsAreOpen) {
  const Served served;
  const SlowClients slow(served.port(), 300);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(answer(served, "/").status, 200);
  EXPECT_LE(slow.countOpen(), 64U);
}

TEST(Serve, ClosesAConnectionWhoseRequestDoesNotCome) {
  const Served served;
  const RawConnection silent(served.port());
  EXPECT_TRUE(silent.isClosedWithin(std::chrono::minutes(5)));
}

TEST(Serve, ClosesAConnectionThatSendsMoreThanARequest) {
  const Served served;
  const RawConnection chatty(served.port());
  chatty.send("GET / HTTP/1.1\r\n");
  const std::string header = "X-More: " + std::string(1000, 'x') + "\r\n";
  int sent = 0;
  while (sent < 100'000 && chatty.send(header)) ++sent;
  EXPECT_LT(sent, 100'000);
}

TEST(Serve, GivesTheWholePageThoughMoreStandsBehindTheRequest) {
  const Served served;
  const std::string page = answer(served, "/").body;
  const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (const std::string& more : {std::string(), request, std::string(3000, 'x')}) {
    const RawConnection client(served.port());
    client.send(request + more);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // The answer fills what the system holds of it.
    EXPECT_TRUE(client.receiveAll().ends_with(page)) << more.size() << " bytes more";
  }
}

TEST(Serve, AnswersARequestForManyRangesWithThePage) {
  const Served served;
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 1000; ++i) ranges += ",0-";
  const httplib::Response page = answer(served, "/", {{"Range", ranges}});
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, answer(served, "/").body);
}

TEST(Serve, EndsWithCtrlC) {
  Served served;
  EXPECT_EQ(served.end(SIGINT), SIGINT);
}

TEST(Serve, RefusesAPortThatAnotherProgramServes) {
  const Served served;
  const std::string port = std::to_string(served.port());
  expectFailure(runProgram({"view", kBoxes, "--serve", "--port", port}), 3,
                "cannot listen at 127.0.0.1 on port " + port);
}

/// A folder with an xdg-open that notes what it is asked for, and which signals it ignores, and ends with `status`.
std::string fakeOpener(const TempFolder& folder, int status) {
  const fs::path path = folder.write("xdg-open", R"(#!/bin/sh
printf '%s\n' "$@" > "${0%/*}/asked"
sed -n 's/SigIgn:[[:space:]]*//p' "/proc/$$/status" > "${0%/*}/ignored"
exit )" + std::to_string(status) + '\n');
  fs::permissions(path, fs::perms::owner_all);
  return folder.path();
}

ProgramRun runWithPath(const std::string& path, const std::string& words) {
  return runScript("PATH='" + path + "' TMPDIR='" + path + "' \"$0\" view '" + kBoxes + "' " + words);
}

TEST(Open, AsksTheDesktopForTheFileThatWasWritten) {
  const TempFolder folder;
  const std::string path = fakeOpener(folder, 0) + ":/usr/bin:/bin";
  const std::string page = folder.path() / "a page.html";
  const ProgramRun run = runWithPath(path, "-o '" + page + "' --open");
  expectSuccess(run);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(readBytes(folder.path() / "asked"), page + "\n");
  EXPECT_TRUE(fs::exists(page));
  const std::uint64_t ignored = std::stoull(readBytes(folder.path() / "ignored"), nullptr, 16);
  for (const int signal : {SIGPIPE, SIGXFSZ}) EXPECT_EQ(ignored >> (signal - 1) & 1U, 0U) << signal;
}

TEST(Open, WithoutANameWritesAFileOfItsOwnThatOnlyTheUserMayRead) {
  const TempFolder folder;
  fakeOpener(folder, 0);
  const ProgramRun run = runScript("PATH='" + folder.path().string() + ":/usr/bin:/bin' TMPDIR='" +
                                   folder.path().string() + "' \"$0\" view '" + kBoxes + "' --open");
  expectSuccess(run);
  std::string asked = readBytes(folder.path() / "asked");
  asked.pop_back();
  EXPECT_TRUE(asked.ends_with(".html")) << asked;
  EXPECT_EQ(fs::path(asked).parent_path(), folder.path());
  EXPECT_NE(readBytes(asked).find("allpairs-scene"), std::string::npos);
  EXPECT_EQ(fs::status(asked).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Open, SaysWhatToDoWhereNothingOpensIt) {
  const TempFolder folder;
  const std::string page = folder.path() / "page.html";
  const ProgramRun none = runWithPath(folder.path(), "-o '" + page + "' --open");
  expectFailure(none, 3, "there is no xdg-open here: open " + page + " in a browser yourself");
  EXPECT_TRUE(fs::exists(page)) << "the page is there all the same";
  const ProgramRun fails = runWithPath(fakeOpener(folder, 3) + ":/usr/bin:/bin", "-o '" + page + "' --open");
  expectFailure(fails, 3, "xdg-open found no way to open it: open " + page + " in a browser yourself");
}

TEST(Open, LeavesNoFileOfItsOwnThatIsNotWhole) {
  const TempFolder folder;
  const ProgramRun run =
      runScript("ulimit -f 16; TMPDIR='" + folder.path().string() + "' \"$0\" view '" + kBoxes + "' --open");
  expectFailure(run, 3, "cannot be written");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Open, AndServeWriteNoPageToStandardOutput) {
  for (const std::string option : {"--open", "--serve"}) {
    const ProgramRun run = runScript("timeout 30 \"$0\" view '" + kBoxes + "' -o - " + option);
    expectFailure(run, 2, "-o -: a page for a browser is not written to standard output");
  }
}

TEST(Open, TakesNothingFromTheStatusOfAReport) {
  const TempFolder folder;
  const std::string report = folder.path() / "report";
  const std::string words = "PATH='" + folder.path().string() + "' \"$0\" report '" + kBoxes + "' -o '" + report + "' ";
  const ProgramRun found = runScript(words + "--fail-on pair --open");
  EXPECT_EQ(found.status, 4) << found.err;
  const std::string advice = "there is no xdg-open here: open " + report + "/index.html in a browser yourself\n";
  EXPECT_EQ(found.err, "allpairs: " + advice + "allpairs: --fail-on: found 2 rows\n");
  EXPECT_EQ(runScript(words + "--open").status, 3);
}

/// Serves and opens, with PATH as given, until the file `sign` is there and says something.
ProgramRun serveAndOpen(const std::string& path, const std::string& sign) {
  return runScript("PATH='" + path + "' \"$0\" view '" + kBoxes + "' --serve --open & child=$!; n=0\n" +
                   "while [ ! -s '" + sign + "' ] && [ $n -lt 600 ]; do n=$((n + 1)); sleep 0.1; done\n" +
                   "kill $child; wait");
}

TEST(Open, AsksForTheAddressThatIsServed) {
  const TempFolder folder;
  const std::string asked = folder.path() / "asked";
  const ProgramRun run = serveAndOpen(fakeOpener(folder, 0) + ":/usr/bin:/bin", asked);
  EXPECT_EQ(readBytes(asked), run.out.substr(0, run.out.find(' ')) + "\n");
}

TEST(Open, ServesOnWhereNothingOpensIt) {
  const TempFolder folder;
  const std::string err = folder.path() / "err";
  const ProgramRun run =
      runScript("PATH='" + folder.path().string() + "' \"$0\" view '" + kBoxes + "' --serve --open 2> '" + err +
                "' & child=$!; n=0\n" + "while [ ! -s '" + err +
                "' ] && [ $n -lt 600 ]; do n=$((n + 1)); sleep 0.1; done\n" + "kill $child && wait $child; echo $?");
  EXPECT_TRUE(run.out.starts_with("http://127.0.0.1:")) << run.out;
  EXPECT_TRUE(run.out.ends_with("\n143\n")) << "it was there until it was ended: " << run.out;
  EXPECT_NE(readBytes(err).find("there is no xdg-open here: open http://127.0.0.1:"), std::string::npos);
}

}  // namespace
}  // namespace allpairs::test
