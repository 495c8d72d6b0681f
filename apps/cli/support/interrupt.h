// Ctrl-C (and SIGTERM, SIGHUP): the program ends with 128 + the signal's number, and no file is left half.
//
// Outside of the two kinds of sections below, nothing that matters is going on, and a signal ends the program at once.
#pragma once

#include "bihive/base/cancel.h"

namespace bihive::cli {

/// Installs the handlers; a signal that is ignored already (nohup, a shell's background job) stays so. A file size
/// limit becomes an ordinary error of writing.
void handle_signals();

/// While one of these lives, the first signal sets token(), so that long work stops by itself; another, a moment
/// later, ends the program at once.
class CancellableSection {
 public:
  CancellableSection();
  ~CancellableSection();
  CancellableSection(const CancellableSection&) = delete;
  CancellableSection& operator=(const CancellableSection&) = delete;

  static const CancelToken& token();
  /// Ends the program if a signal has set the token.
  static void leave_if_cancelled();
};

/// While one of these lives, files are being written: signals are forgotten, for the work is done. Afterwards the first
/// one is forgotten too (only a stuck output can still take time; a second one ends it). So exit code 130 after one
/// Ctrl-C means that there is no file.
class WritingSection {
 public:
  WritingSection();
  ~WritingSection();
  WritingSection(const WritingSection&) = delete;
  WritingSection& operator=(const WritingSection&) = delete;
};

}  // namespace bihive::cli
