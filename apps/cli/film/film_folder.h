// The folder of a film that is being made: FILE.part of a film in one file, the folder of its pictures of a sequence.
//
// It does not appear before a picture is complete. Until then FILE.part has an unguessable name; a run killed before
// that leaves no more, and the next run removes it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/path_parts.h"
#include "bihive/job/film/hidden_folder.h"
#include "bihive/job/film/own_folder.h"
#include "film/film_plan.h"
#include "film/film_sink.h"
#include "support/interrupt.h"

namespace bihive::cli {

/// All functions fail with kBadInput.
class FilmFolder {
 public:
  /// `output` is the film's, its links followed. Fails if something else has the folder's name, or if it is not to be
  /// trusted.
  FilmFolder(std::string output, FilmKind kind);
  ~FilmFolder();
  FilmFolder(const FilmFolder&) = delete;
  FilmFolder& operator=(const FilmFolder&) = delete;

  /// The description that an earlier run has left.
  const std::optional<FilmPlan>& kept() const { return kept_; }
  /// Its path: FILE.part/film.json, or run/film.json.
  std::string plan_path() const;
  /// Sets the plan of this run: the kept one, or a new one. `alone`: no other run may work on the film meanwhile; the
  /// shards of a film share it. Makes nothing.
  void begin(const FilmPlan& plan, bool alone);
  /// Hash of the description's bytes.
  std::uint64_t plan_hash() const;

  /// The folder, if it exists.
  const OwnFolder* existing() const { return folder_ ? &*folder_ : nullptr; }
  /// The folder; it is created, with the description.
  const OwnFolder& folder();
  /// Called when a picture is complete: the folder gets its final name, because the next run may continue with it.
  void keep();
  /// A file of this run, removed if no picture is completed.
  void note_file(const std::string& name);

  /// `film` in the folder is the whole film: moves it and its description, which then states its bytes, to their paths,
  /// and removes the folder.
  void finish(const std::string& film);
  /// Removes what killed runs have left beside the film. For one in one file, before it begins.
  void remove_rests() const;
  /// Leaves nothing if no picture is complete.
  void leave_nothing();

 private:
  void make_for_sequence();
  void make_hidden();
  void remove_rest(const OwnFolder& rest) const;
  void join_other(OwnFolder other);
  void lock();
  void remove_all();
  std::string part_name() const { return name_in_folder(path_); }

  std::string output_;
  FilmKind kind_;
  std::string path_;       // path of the folder
  std::string plan_name_;  // file name of the description in it
  Descriptor parent_;      // folder that holds FILE.part
  std::optional<OwnFolder> folder_;
  std::optional<FilmPlan> kept_;
  std::string plan_text_;
  bool alone_ = false, ready_ = false;
  std::string hidden_;  // the name of FILE.part before a picture is whole; empty: it has its own
  std::deque<RemovedWhenEnded> removed_when_ended_;
  bool made_folder_ = false;
  std::vector<std::string> made_files_;
  Descriptor lock_;
};

/// The description of the film that an earlier run has finished in one file at `output`, its links followed: nothing
/// unless it was asked for in the same way, and both files are this user's and have not changed since.
std::optional<FilmPlan> finished_film(const std::string& output, const FilmPlan::Asked& asked);

}  // namespace bihive::cli
