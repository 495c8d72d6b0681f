#include "bihive/io/frames/frame_index.h"

namespace bihive {

FrameNotes::FrameNotes(FrameIndex* made, const TextScanner& scanner)
    : made_(made), begin_(scanner.place()), lines_before_(scanner.line_number()) {
  // A byte order mark belongs to the first frame.
  if (lines_before_ == 0) begin_ = 0;
}

void FrameNotes::end_frame(const TextScanner& scanner) {
  const std::int64_t end = scanner.place();
  if (made_ != nullptr) made_->frames.push_back({begin_, end, lines_before_});
  begin_ = end;
  lines_before_ = scanner.line_number();
  if (made_ != nullptr) made_->lines = lines_before_;
}

}  // namespace bihive
