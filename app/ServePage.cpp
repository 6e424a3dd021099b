// SPDX-License-Identifier: MIT
#include "ServePage.h"

#include <httplib.h>
#include <sys/socket.h>

#include "allpairs/Error.h"

namespace allpairs::app {
namespace {

constexpr const char* kHost = "127.0.0.1";

bool isLocal(const std::string& host) {
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kHost || name == "localhost";
}

/// A port that another program serves is refused; the library would share it.
void refuseSharedPorts(int socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

void setUp(httplib::Server& server, const std::string& page) {
  server.set_socket_options(refuseSharedPorts);
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (isLocal(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get("/", [&page](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(page, "text/html; charset=utf-8");
  });
}

}  // namespace

void servePage(const std::string& page, int port, const std::function<void(const std::string&)>& ready) {
  httplib::Server server;
  setUp(server, page);
  const int bound = port == 0 ? server.bind_to_any_port(kHost) : server.bind_to_port(kHost, port) ? port : -1;
  if (bound <= 0) throw Error("cannot listen at " + std::string(kHost) + " on port " + std::to_string(port));
  ready("http://" + std::string(kHost) + ':' + std::to_string(bound) + '/');
  if (!server.listen_after_bind()) throw Error("the server at port " + std::to_string(bound) + " ended");
}

}  // namespace allpairs::app
