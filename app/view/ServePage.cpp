// SPDX-License-Identifier: MIT
#include "view/ServePage.h"

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "allpairs/Error.h"

namespace allpairs::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kHost = "127.0.0.1";

/// A browser opens six connections to a server at most; one more than this closes the oldest.
constexpr std::size_t kMaxConnections = 64;

/// How many may wait to be accepted. The library's own bound, 5, makes a client wait for a second where many come at
/// once.
constexpr int kMaxWaiting = 128;

/// A whole request: its line, its headers and what follows. Browsers send less than 2 KiB, in one piece.
constexpr std::size_t kMaxRequestBytes = 16384;
constexpr std::chrono::seconds kMaxRequestTime(5);

/// How long a client may take nothing of the answer.
constexpr std::chrono::seconds kMaxWriteStall(30);

/// The accepted connections. Each has its own thread, so that a slow one does not block others.
class Connections {
 public:
  /// Makes a connection one of at most kMaxConnections; where there are as many, the oldest is shut down.
  void admit() {
    std::unique_lock lock(m_mutex);
    const auto hasRoom = [this] { return m_admitted < kMaxConnections; };
    while (!hasRoom()) {
      shutOldest();
      m_left.wait_for(lock, std::chrono::milliseconds(10), hasRoom);
    }
    ++m_admitted;
  }

  void leave() {
    const std::lock_guard lock(m_mutex);
    --m_admitted;
    m_left.notify_one();
  }

  void open(int socket) {
    const std::lock_guard lock(m_mutex);
    m_sockets.push_back(socket);
  }

  void close(int socket) {
    const std::lock_guard lock(m_mutex);
    std::erase(m_sockets, socket);
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
  }

 private:
  /// Ends what its thread waits for; the thread closes it.
  void shutOldest() {
    if (m_sockets.empty()) return;
    ::shutdown(m_sockets.front(), SHUT_RDWR);
    m_sockets.erase(m_sockets.begin());
  }

  std::mutex m_mutex;
  std::condition_variable m_left;
  std::size_t m_admitted = 0;
  std::vector<int> m_sockets;  ///< Oldest first, without those that were shut down.
};

/// The threads of the connections.
class ConnectionThreads final : public httplib::ThreadPool {
 public:
  explicit ConnectionThreads(Connections& connections) : ThreadPool(kMaxConnections), m_connections(connections) {}

  void enqueue(std::function<void()> serve) override {
    m_connections.admit();
    ThreadPool::enqueue([this, serve = std::move(serve)] {
      serve();
      m_connections.leave();
    });
  }

 private:
  Connections& m_connections;
};

/// One request and its answer on a socket; reads no more bytes and for no longer than a request may take.
class RequestStream final : public httplib::Stream {
 public:
  explicit RequestStream(int socket) : m_socket(socket) {}

  [[nodiscard]] bool is_readable() const override {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(m_end - Clock::now());
    pollfd poll{m_socket, POLLIN, 0};
    return m_bytesLeft > 0 && left.count() > 0 && ::poll(&poll, 1, static_cast<int>(left.count())) > 0;
  }

  [[nodiscard]] bool is_writable() const override { return true; }

  ssize_t read(char* bytes, std::size_t size) override {
    if (!is_readable()) return -1;
    const ssize_t count = ::recv(m_socket, bytes, std::min(size, m_bytesLeft), 0);
    if (count > 0) m_bytesLeft -= static_cast<std::size_t>(count);
    return count;
  }

  ssize_t write(const char* bytes, std::size_t size) override { return ::send(m_socket, bytes, size, MSG_NOSIGNAL); }

  /// Ends the answer, and waits until the client has it: to close a socket with bytes that nobody has read, as behind
  /// the request, takes back what the client has not.
  void awaitEnd() {
    ::shutdown(m_socket, SHUT_WR);
    m_bytesLeft = kMaxRequestBytes;
    m_end = Clock::now() + kMaxRequestTime;
    std::array<char, 1024> bytes{};
    while (read(bytes.data(), bytes.size()) > 0) {
    }
  }

  void get_remote_ip_and_port(std::string& address, int& port) const override { get_local_ip_and_port(address, port); }

  void get_local_ip_and_port(std::string& address, int& port) const override {
    address = kHost;
    port = 0;  // no one asks
  }

  [[nodiscard]] int socket() const override { return m_socket; }

 private:
  int m_socket;
  std::size_t m_bytesLeft = kMaxRequestBytes;
  Clock::time_point m_end = Clock::now() + kMaxRequestTime;
};

bool isLocal(const std::string& host) {
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kHost || name == "localhost";
}

/// A port that another program serves is refused; the library would share it.
void refuseSharedPorts(int socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

/// One answer a connection, written from the one copy of the page.
class PageServer final : public httplib::Server {
 public:
  explicit PageServer(const std::string& page) {
    new_task_queue = [this] { return std::make_unique<ConnectionThreads>(m_connections).release(); };
    set_socket_options(refuseSharedPorts);
    set_write_timeout(kMaxWriteStall);
    set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
      if (isLocal(request.get_header_value("Host"))) return HandlerResponse::Unhandled;
      response.status = 403;
      return HandlerResponse::Handled;
    });
    Get("/", [&page](const httplib::Request&, httplib::Response& response) { answer(page, response); });
  }

  /// Listens at the port, or at any where it is 0; returns it, or -1.
  int bind(int port) {
    const int bound = port == 0 ? bind_to_any_port(kHost) : bind_to_port(kHost, port) ? port : -1;
    if (bound > 0) ::listen(svr_sock_, kMaxWaiting);
    return bound;
  }

 private:
  static void answer(const std::string& page, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content_provider(page.size(), "text/html; charset=utf-8",
                                  [&page](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return sink.write(page.data() + offset, length);
                                  });
  }

  bool process_and_close_socket(int socket) override {
    m_connections.open(socket);
    RequestStream stream(socket);
    bool isClosed = false;
    // The library would put an answer to many ranges together in memory.
    const bool isAnswered =
        process_request(stream, true, isClosed, [](httplib::Request& request) { request.ranges.clear(); });
    stream.awaitEnd();
    m_connections.close(socket);
    return isAnswered;
  }

  Connections m_connections;
};

}  // namespace

void servePage(const std::string& page, int port, const std::function<void(const std::string&)>& ready) {
  PageServer server(page);
  const int bound = server.bind(port);
  if (bound <= 0) throw Error("cannot listen at " + std::string(kHost) + " on port " + std::to_string(port));
  ready("http://" + std::string(kHost) + ':' + std::to_string(bound) + '/');
  if (!server.listen_after_bind()) throw Error("the server at port " + std::to_string(bound) + " ended");
}

}  // namespace allpairs::app
