// The leavings of a run for the next one: the film's description, and the folder FILE.part of a film in one file.
#pragma once

#include <optional>
#include <string>

#include "film/film_plan.h"
#include "film/film_sink.h"

namespace bihive::cli {

class FilmFolder {
 public:
  /// `output` is the film's. With `parts` there is a folder FILE.part, which holds the description until the film is
  /// whole. Fails with kBadInput if something else is in its place, or if another run works on the film.
  FilmFolder(std::string output, bool parts);
  ~FilmFolder();
  FilmFolder(const FilmFolder&) = delete;
  FilmFolder& operator=(const FilmFolder&) = delete;

  /// The description that an earlier run has left.
  const std::optional<FilmPlan>& kept() const { return kept_; }
  /// Takes the place for this run: makes the folders and writes the description. `alone`: no other run may work on the
  /// film meanwhile; the shards of a film share it.
  void take(const FilmPlan& plan, bool alone);
  /// The film is whole: its description takes its place beside it, and the folder goes away.
  void finish(const FilmPlan& plan);
  /// Leaves nothing behind if no picture is whole.
  void leave_nothing();

 private:
  void lock(bool alone);

  std::string output_, folder_, plan_;
  bool parts_;
  std::optional<FilmPlan> kept_;
  bool made_plan_ = false;
  std::string made_folder_;  // of a sequence; empty: it was there
  int lock_ = -1;
};

}  // namespace bihive::cli
