// The server's answer to a request. Nothing here knows of sockets.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/named_file.h"
#include "server/page_files.h"

namespace bihive::cli {

/// A request as it was received; missing headers are empty.
struct Question {
  std::string method;
  std::string target;
  std::vector<std::string> hosts;  ///< every Host header
  std::string accept_encoding, if_none_match, if_range, range;
  bool has_body = false;
};

/// Bytes in memory, or a range of an open file; `size` of them from `offset` on.
struct Content {
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const OpenFile> file;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

struct Answer {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;  ///< all but Content-Length, Connection and Date
  Content content;                                           ///< Content-Length is its size
  bool send_content = true;                                  ///< false for HEAD and for answers without a body
  bool close = false;                                        ///< the connection ends with this answer
};

/// All content that can be fetched.
struct Site {
  PageFiles page;
  std::string file_url;   ///< the path of the named file's URL, not escaped: "/file/a b.pdb"; empty: there is none
  std::string file_path;  ///< its path on the disk
  /// Whether this server answers for the name or address of a Host header, in the spelling of host_name().
  std::function<bool(const std::string&)> is_own_host;
};

/// Never fails. 400: malformed; 403: a Host header of another machine, which a page of another site could send (DNS
/// rebinding); 404; 405: neither GET nor HEAD; 413: a request with a body; 416: a range outside the file.
Answer answer(const Site& site, const Question& question);

/// An answer of plain text.
Answer refusal(int status, const std::string& text);

}  // namespace bihive::cli
