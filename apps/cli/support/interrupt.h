// Ctrl-C (and SIGTERM, SIGHUP, SIGXCPU): the program ends with 128 + the signal's number, and leaves no partial file.
//
// Outside of cancellable and writing sections the program does nothing that must be finished, so a signal ends it at
// once.
#pragma once

#include <cstddef>
#include <string>

#include "bihive/base/cancel.h"

namespace bihive::cli {

/// Installs the handlers. A signal that is ignored already (nohup, a shell's background job) stays ignored. A file size
/// limit becomes an ordinary error of writing.
void handle_signals();

/// While it exists, the first signal sets token(), so that long work stops by itself. Another signal, a moment later,
/// ends the program at once.
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

/// While it exists, files are being written. Signals are dropped, because the work is done. The first signal afterwards
/// is dropped too (only blocked output can still take time; a second signal ends it). So exit code 130 after one Ctrl-C
/// means that there is no file.
class WritingSection {
 public:
  WritingSection();
  ~WritingSection();
  WritingSection(const WritingSection&) = delete;
  WritingSection& operator=(const WritingSection&) = delete;
};

/// While it exists, a signal ends the program at once, even in a cancellable section: the program may wait for the
/// reader of a pipe, and check no token.
class StreamSection {
 public:
  /// `active`: false makes it do nothing.
  explicit StreamSection(bool active = true);
  ~StreamSection();
  StreamSection(const StreamSection&) = delete;
  StreamSection& operator=(const StreamSection&) = delete;

 private:
  int before_;
  bool active_;
};

/// While it exists, a signal that ends the program first removes this file or empty folder, the latest one before the
/// others; an empty path means none. `folder`: an open folder that the path is relative to; -1: the current one. At
/// most eight exist at a time.
class RemovedWhenEnded {
 public:
  explicit RemovedWhenEnded(const std::string& path, int folder = -1);
  ~RemovedWhenEnded();
  RemovedWhenEnded(const RemovedWhenEnded&) = delete;
  RemovedWhenEnded& operator=(const RemovedWhenEnded&) = delete;

 private:
  char* place_ = nullptr;
};

/// While it exists, a signal that ends this program also ends a process group: programs that this one has started. At
/// most two exist at a time.
class KilledWhenEnded {
 public:
  explicit KilledWhenEnded(int group);
  ~KilledWhenEnded();
  KilledWhenEnded(const KilledWhenEnded&) = delete;
  KilledWhenEnded& operator=(const KilledWhenEnded&) = delete;

 private:
  std::size_t at_;
};

/// Removes the files and ends the groups of all existing objects. For handlers: it only calls unlinkat() and kill().
void remove_unfinished();

}  // namespace bihive::cli
