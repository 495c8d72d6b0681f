// HTTP/1.1 on one thread: connections, time limits, and the end of them. What is said comes from a handler.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "server/answer.h"

namespace bihive::cli {

class HttpServer {
 public:
  explicit HttpServer(std::function<Answer(const Question&)> handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Waits for connections at the first of the ports that is free (0: any), and returns which. `address` is numeric.
  /// From here on SIGINT, SIGTERM and SIGHUP (those that are not ignored) end run_until_signal(), not the program.
  /// Errors: no port is free, no permission, the address is not this machine's.
  Result<int> listen(const std::string& address, const std::vector<int>& ports);

  /// Serves until such a signal, then drops every connection at once.
  void run_until_signal();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bihive::cli
