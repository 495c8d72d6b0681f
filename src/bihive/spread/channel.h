// Questions and answers between the ranks of one program.
#pragma once

#include <utility>
#include <vector>

#include "bihive/spread/bytes.h"

namespace bihive {

/// Thrown by ask() when no answer will come because the program stops.
struct ChannelClosed {};

/// Asynchronous messages between drawing ranks; collective calls are in spread/communicator.h.
class RankChannel {
 public:
  virtual ~RankChannel() = default;
  virtual int rank() const = 0;  ///< this one
  virtual int ranks() const = 0;

  struct Question {
    int rank;  ///< the recipient, not this one
    Bytes bytes;
  };
  /// Sends all questions, and waits for all answers, in the order of the questions. Any number of threads may ask at a
  /// time.
  virtual std::vector<Bytes> ask(std::vector<Question> questions) = 0;
};

}  // namespace bihive
