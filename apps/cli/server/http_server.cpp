// The only file that spends many seconds on compiling Boost.Beast.
#include "server/http_server.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <csignal>
#include <ctime>
#include <limits>
#include <optional>
#include <utility>

#include "bihive/base/setting_name.h"
#include "server/crowd.h"

namespace bihive::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
using Tcp = asio::ip::tcp;

// A client that neither sends nor takes anything for this time is dropped.
constexpr std::chrono::seconds kPatience{30};
// The server reads and drops the rest of a refused request, up to this time and this many bytes. Otherwise the system
// could drop the answer.
constexpr std::chrono::seconds kPatienceAtTheEnd{2};
constexpr std::size_t kMostDiscarded = 1 << 20;
// Bytes of an answer that must be taken within the patience above, held in memory per connection.
constexpr std::size_t kChunkBytes = 64 * 1024;
// Socket buffer size. By default, Linux takes megabytes for each slow reader, until all of them suffer.
constexpr int kSentBytes = 128 * 1024;
constexpr std::uint32_t kMostHeaderBytes = 16 * 1024;
constexpr std::size_t kMostConnections = 1000;
constexpr std::size_t kFewestConnections = 8;
constexpr std::size_t kOtherDescriptors = 40;    // of the program
constexpr std::chrono::milliseconds kRest{200};  // when the system has no descriptor or memory for a connection

std::string text_of(beast::string_view text) {
  return {text.data(), text.size()};
}

// The time in the form of HTTP: "Sun, 06 Nov 1994 08:49:37 GMT". The program never leaves the locale "C".
std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &parts)};
}

Question question_from(const http::request_parser<http::empty_body>& parser) {
  const auto& request = parser.get();
  Question question;
  question.method = text_of(request.method_string());
  question.target = text_of(request.target());
  const auto hosts = request.equal_range(http::field::host);
  for (auto host = hosts.first; host != hosts.second; ++host) question.hosts.push_back(text_of(host->value()));
  question.accept_encoding = text_of(request[http::field::accept_encoding]);
  question.if_none_match = text_of(request[http::field::if_none_match]);
  question.if_range = text_of(request[http::field::if_range]);
  question.range = text_of(request[http::field::range]);
  question.has_body = !parser.is_done();
  return question;
}

// The number of connections for which there are descriptors; each may have FILE open too. Raises the limit if possible.
std::size_t room_for_connections() {
  constexpr rlim_t kWanted = 2 * kMostConnections + kOtherDescriptors;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return kFewestConnections;
  if (limit.rlim_cur < kWanted) {
    const rlimit raised{std::min(kWanted, limit.rlim_max), limit.rlim_max};
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  const std::size_t descriptors = std::min(kWanted, limit.rlim_cur);
  return std::max(kFewestConnections, (std::max(descriptors, kOtherDescriptors) - kOtherDescriptors) / 2);
}

// One connection: reads a request, sends the answer, and repeats. It lives as long as an operation is pending.
class Connection : public std::enable_shared_from_this<Connection>, public Crowd::Member {
 public:
  Connection(Tcp::socket socket, const std::function<Answer(const Question&)>& handler, Crowd& crowd)
      : stream_(std::move(socket)), handler_(handler), crowd_(crowd) {
    error_code ignored;
    stream_.socket().set_option(Tcp::no_delay(true), ignored);
    stream_.socket().set_option(Tcp::socket::send_buffer_size(kSentBytes), ignored);
  }
  ~Connection() override { crowd_.leave(*this); }

  /// Its pending operation fails.
  void drop() override { stream_.close(); }

  void read(Crowd::Group group = Crowd::kResting) {
    crowd_.move(*this, group);
    answer_ = {};
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    // The answer refuses bodies, not the parser.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    // The time limit of the whole head, however slowly it comes.
    stream_.expires_after(kPatience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code code, std::size_t) { self->on_read(code); });
  }

 private:
  void on_read(error_code code) {
    if (!stream_.socket().is_open()) return;  // it was dropped
    crowd_.move(*this, Crowd::kAnswered);
    if (!code) {
      answer_ = handler_(question_from(*parser_));
      if (!parser_->keep_alive()) answer_.close = true;
    } else if (code == http::error::header_limit) {
      answer_ = refusal(431, "the request is too long");
      answer_.close = true;
    } else if (code != http::error::end_of_stream && code != http::error::partial_message &&
               code.category() == http::make_error_code(http::error::end_of_stream).category()) {
      answer_ = refusal(400, "this is no HTTP request");
      answer_.close = true;
    } else {
      return;  // the client has gone
    }
    // An answer to HEAD never has a body (RFC 9110, 9.3.2), an error neither.
    if (parser_->get().method() == http::verb::head || starts_with_head()) answer_.send_content = false;
    write_head();
  }

  // A first line that the parser refuses stays in the buffer; what it asks for shows there.
  bool starts_with_head() const {
    const beast::string_view bytes(static_cast<const char*>(buffer_.data().data()), buffer_.size());
    return bytes.substr(0, 5) == "HEAD ";
  }

  void write_head() {
    head_ = {};
    head_.result(static_cast<unsigned>(answer_.status));
    head_.version(parser_->get().version() == 10 ? 10 : 11);
    head_.set(http::field::date, http_date());
    for (const auto& [name, value] : answer_.headers) head_.set(name, value);
    if (answer_.status != 304) head_.content_length(answer_.content.size);
    head_.keep_alive(!answer_.close);
    serializer_.emplace(head_);
    sent_ = 0;
    stream_.expires_after(kPatience);
    http::async_write_header(stream_, *serializer_, [self = shared_from_this()](error_code code, std::size_t) {
      // For a message without a body of its own, Beast reports the end as an error.
      if (!self->stream_.socket().is_open()) return;
      if (!code || code == http::error::end_of_stream) self->write_more();
    });
  }

  void write_more() {
    const Content& content = answer_.content;
    if (!answer_.send_content || sent_ == content.size) return answer_.close ? end() : read();
    std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(kChunkBytes, content.size - sent_));
    const char* bytes = nullptr;
    if (content.file) {
      chunk_.resize(kChunkBytes);
      count = content.file->read(content.offset + sent_, chunk_.data(), count);
      if (count == 0) return;  // the file has become shorter: the promised bytes are missing
      bytes = chunk_.data();
    } else {
      bytes = content.bytes->data() + content.offset + sent_;
    }
    stream_.expires_after(kPatience);
    asio::async_write(stream_, asio::buffer(bytes, count),
                      [self = shared_from_this()](error_code code, std::size_t written) {
                        if (code || !self->stream_.socket().is_open()) return;
                        self->sent_ += written;
                        self->crowd_.move(*self, Crowd::kAnswered);
                        self->write_more();
                      });
  }

  void end() {
    crowd_.move(*this, Crowd::kSilent);
    error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kPatienceAtTheEnd);
    discard(0);
  }

  void discard(std::size_t discarded) {
    if (discarded > kMostDiscarded) return;
    chunk_.resize(kChunkBytes);
    stream_.async_read_some(asio::buffer(chunk_),
                            [self = shared_from_this(), discarded](error_code code, std::size_t count) {
                              if (!code) self->discard(discarded + count);
                            });
  }

  beast::tcp_stream stream_;
  const std::function<Answer(const Question&)>& handler_;
  Crowd& crowd_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Answer answer_;
  http::response<http::empty_body> head_;
  std::optional<http::response_serializer<http::empty_body>> serializer_;
  std::vector<char> chunk_;
  std::uint64_t sent_ = 0;
};

Error cannot_listen(const std::string& address, int port, const error_code& code) {
  return {"cannot serve at " + address + ", port " + std::to_string(port) + ": " + code.message(), "", 0, 0,
          code == asio::error::address_in_use ? setting_name("port") + " 0 takes any that is free" : ""};
}

}  // namespace

struct HttpServer::State {
  explicit State(std::function<Answer(const Question&)> said) : handler(std::move(said)) {}

  // Makes these signals end run(), not the program. Ignored signals stay ignored (nohup).
  void take_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction now {};
      sigaction(signal, nullptr, &now);
      if (now.sa_handler != SIG_IGN) signals.add(signal);
    }
    signals.async_wait([this](error_code, int) { context.stop(); });
  }

  void accept() {
    acceptor.async_accept([this](error_code code, Tcp::socket socket) {
      if (code == asio::error::operation_aborted) return;
      if (!code) {
        std::make_shared<Connection>(std::move(socket), handler, crowd)->read(Crowd::kSilent);
        while (crowd.size() > most_connections) crowd.drop_one();
      } else if (code == asio::error::no_descriptors ? !crowd.drop_one() : code != asio::error::connection_aborted) {
        return rest();
      }
      accept();
    });
  }

  void rest() {
    pause.expires_after(kRest);
    pause.async_wait([this](error_code code) {
      if (code) return;
      crowd.drop_one();
      accept();
    });
  }

  std::function<Answer(const Question&)> handler;
  Crowd crowd;
  std::size_t most_connections = kFewestConnections;
  // Declared last, so that it is destroyed first: it ends pending connections, which leave the crowd above.
  asio::io_context context{1};
  asio::signal_set signals{context};
  Tcp::acceptor acceptor{context};
  asio::steady_timer pause{context};
};

HttpServer::HttpServer(std::function<Answer(const Question&)> handler)
    : state_(std::make_unique<State>(std::move(handler))) {}
HttpServer::~HttpServer() = default;

Result<int> HttpServer::listen(const std::string& address, const std::vector<int>& ports) {
  error_code code;
  const auto ip = asio::ip::make_address(address, code);
  if (code) return cannot_listen(address, 0, code);
  state_->take_signals();
  int last = 0;
  for (const int port : ports) {
    last = port;
    const Tcp::endpoint place(ip, static_cast<unsigned short>(port));
    Tcp::acceptor& acceptor = state_->acceptor;
    acceptor.close(code);
    acceptor.open(place.protocol(), code);
    if (!code) acceptor.set_option(Tcp::acceptor::reuse_address(true), code);
    if (!code && ip.is_v6() && ip.is_unspecified()) acceptor.set_option(asio::ip::v6_only(false), code);
    if (!code) acceptor.bind(place, code);
    if (!code) acceptor.listen(asio::socket_base::max_listen_connections, code);
    if (!code) return int{acceptor.local_endpoint().port()};
    if (code != asio::error::address_in_use) break;
  }
  return cannot_listen(address, last, code);
}

void HttpServer::run_until_signal() {
  state_->most_connections = room_for_connections();
  state_->accept();
  state_->context.run();
}

}  // namespace bihive::cli
