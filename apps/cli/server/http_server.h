// HTTP/1.1 on one thread: connections, time limits, and their end. A handler makes the answers.
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

  /// Listens at the first free port of `ports` (0: any), and returns it. `address` is numeric. From here on SIGINT,
  /// SIGTERM and SIGHUP (unless they are ignored) end run_until_signal(), not the program. Errors: no port is free, no
  /// permission, the address is not this machine's.
  Result<int> listen(const std::string& address, const std::vector<int>& ports);

  /// Serves until such a signal, then drops every connection at once.
  void run_until_signal();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bihive::cli
