#include "film/film_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "bihive/base/fnv.h"
#include "bihive/base/path_parts.h"
#include "bihive/base/place_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "film/content_hash.h"

namespace bihive::cli {
namespace {

constexpr const char* kPlan = "film.json";
constexpr const char* kDescription = "film.json.new";
constexpr int kAttempts = 20;

[[noreturn]] void fail_busy(const std::string& path) {
  fail({"another run of bihive film works on this film", path, 0, 0, "wait for its end, or name another output"});
}

[[noreturn]] void fail_in_the_way(const std::string& path) {
  fail({"is in the place where the film would be made", path, 0, 0, "remove it, or name another output"});
}

[[noreturn]] void fail_other_film(const std::string& path) {
  fail({"another run has begun another film here", path, 0, 0, "name another output"});
}

// The bytes of a film.
FilmPlan::Made made_film(const OwnFolder& folder, const std::string& name) {
  const std::optional<Descriptor> file = folder.open_file(name, O_RDONLY);
  struct stat info {};
  if (!file || fstat(file->get(), &info) != 0)
    fail_of_system("cannot be read", folder.path_of(name), file ? errno : ENOENT);
  return {info.st_size, hash_of_file(file->get(), folder.path_of(name))};
}

bool holds_pictures(const OwnFolder& folder) {
  const std::vector<std::string> names = folder.names();
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.rfind("picture-", 0) == 0 || name.rfind("segment-", 0) == 0;
  });
}

}  // namespace

FilmFolder::FilmFolder(std::string output, FilmKind kind) : output_(std::move(output)), kind_(kind) {
  const bool parts = kind_ != FilmKind::pictures;
  const std::string beside = cli::plan_path(output_);
  path_ = parts ? part_path(output_) : folder_of(beside);
  plan_name_ = parts ? kPlan : name_in_folder(beside);
  if (parts) parent_ = open_parent(folder_of(path_));

  // Open the parts of an earlier run.
  folder_ = parts ? OwnFolder::open_private(path_) : OwnFolder::open_shared(path_);
  if (!folder_) return;
  if (std::optional<std::string> text = folder_->read(plan_name_)) {
    plan_text_ = std::move(*text);
    kept_ = parse_film_plan(
        plan_text_, plan_path(),
        parts ? "remove the folder to begin anew, or name another output" : "move it away, or name another output");
    return;
  }
  if (!parts) return;
  // Remove the remains of a killed run.
  if (!all_own(*folder_)) fail_in_the_way(path_);
  folder_.reset();
}

FilmFolder::~FilmFolder() {
  try {
    if (!hidden_.empty()) remove_all();
  } catch (const Failure&) {
    // The next run removes it.
  }
}

std::string FilmFolder::plan_path() const {
  return path_ == "." ? plan_name_ : path_ + "/" + plan_name_;
}

std::uint64_t FilmFolder::plan_hash() const {
  return fnv1a(plan_text_);
}

void FilmFolder::begin(const FilmPlan& plan, bool alone) {
  alone_ = alone;
  if (!kept_) plan_text_ = film_plan_to_json(plan);
  if (!kept_) return;
  if (kind_ != FilmKind::pictures) lock();
  ready_ = true;
}

const OwnFolder& FilmFolder::folder() {
  if (ready_) return *folder_;
  if (kind_ == FilmKind::pictures) {
    make_for_sequence();
  } else {
    make_hidden();
    // Shards meet in the folder.
    if (!alone_) keep();
  }
  ready_ = true;
  return *folder_;
}

void FilmFolder::make_for_sequence() {
  if (!folder_) {
    if (mkdir(path_.c_str(), 0777) == 0)
      made_folder_ = true;
    else if (errno != EEXIST)
      fail_of_system("cannot be made", path_, errno);
    folder_ = OwnFolder::open_shared(path_);
    if (!folder_) fail_of_system("cannot be read", path_, ENOENT);
  }
  if (folder_->place_new(plan_name_, plan_text_, kOwnerWrites)) return note_file(plan_name_);
  // Another shard was first.
  const std::optional<std::string> text = folder_->read(plan_name_);
  if (alone_ || !text || *text != plan_text_) fail_other_film(plan_path());
}

void FilmFolder::remove_rests() const {
  remove_leftovers(parent_.get(), folder_of(path_));
}

// Use an unguessable name, so that a killed run leaves no FILE.part without a picture.
void FilmFolder::make_hidden() {
  remove_rests();
  HiddenFolder made = make_hidden_folder(parent_.get(), folder_of(path_), alone_ ? LOCK_EX : LOCK_SH);
  hidden_ = made.name;
  folder_ = std::move(made.folder);
  lock_ = std::move(made.lock);
  removed_when_ended_.emplace_back(hidden_, parent_.get());
  removed_when_ended_.emplace_back(kLockOfFilm, folder_->descriptor());
  folder_->set_path(path_);
  note_file(kPlan);
  folder_->write_new(kPlan, plan_text_, kOfOutputs);
}

void FilmFolder::note_file(const std::string& name) {
  made_files_.push_back(name);
  if (!hidden_.empty()) removed_when_ended_.emplace_back(name, folder_->descriptor());
}

void FilmFolder::keep() {
  for (int attempt = 0; !hidden_.empty() && attempt < kAttempts; ++attempt) {
    if (renameat(parent_.get(), hidden_.c_str(), parent_.get(), part_name().c_str()) == 0) {
      hidden_.clear();
      removed_when_ended_.clear();
      return;
    }
    if (errno != EEXIST && errno != ENOTEMPTY && errno != ENOTDIR) fail_of_system("cannot be made", path_, errno);
    std::optional<OwnFolder> other = OwnFolder::open_private(path_);
    if (!other) continue;
    if (other->has(kPlan))
      join_other(std::move(*other));
    else
      remove_rest(*other);
  }
  if (!hidden_.empty()) fail_busy(path_);
}

// A killed run has left the folder without a description.
void FilmFolder::remove_rest(const OwnFolder& rest) const {
  if (!all_own(rest)) fail_in_the_way(path_);
  const std::optional<Descriptor> lock = lock_folder(rest, LOCK_EX);
  if (!lock) fail_busy(path_);
  remove_own_files(rest);
  unlinkat(parent_.get(), part_name().c_str(), AT_REMOVEDIR);
}

// Another run has made FILE.part meanwhile.
void FilmFolder::join_other(OwnFolder other) {
  if (alone_) fail_busy(path_);
  const std::optional<std::string> text = other.read(kPlan);
  if (!text || *text != plan_text_) fail_other_film(path_);
  remove_all();
  folder_ = std::move(other);
  lock();
}

void FilmFolder::lock() {
  std::optional<Descriptor> file = lock_folder(*folder_, alone_ ? LOCK_EX : LOCK_SH);
  if (!file) fail_busy(path_);
  lock_ = std::move(*file);
  // Another run may have finished the film since.
  struct stat opened {};
  struct stat named {};
  if (fstat(folder_->descriptor(), &opened) != 0 ||
      fstatat(parent_.get(), part_name().c_str(), &named, AT_SYMLINK_NOFOLLOW) != 0 || opened.st_ino != named.st_ino ||
      opened.st_dev != named.st_dev)
    fail({"another run has just finished, and has removed its folder", path_, 0, 0, "run the same again"});
}

void FilmFolder::finish(const std::string& film) {
  // The description comes first: a run killed before the film is moved resumes, and loses nothing.
  folder_->remove(kDescription);
  FilmPlan plan = parse_film_plan(plan_text_, plan_path());
  plan.made = made_film(*folder_, film);
  folder_->write_new(kDescription, film_plan_to_json(plan), kOfOutputs);
  if (const Status status = place_file(folder_->descriptor(), kDescription, cli::plan_path(output_), output_);
      !status) {
    folder_->remove(kDescription);
    fail(status.error());
  }
  value_or_fail(place_file(folder_->descriptor(), film, output_));
  remove_all();
}

// The folder is hidden first, so that a partly removed one is not taken for a film to resume. Files not made by bihive
// stay.
void FilmFolder::remove_all() {
  if (hidden_.empty() && all_own(*folder_)) {
    const std::string name = hidden_name();
    if (renameat(parent_.get(), part_name().c_str(), parent_.get(), name.c_str()) == 0) hidden_ = name;
  }
  remove_own_files(*folder_, made_files_);
  const std::string name = hidden_.empty() ? part_name() : hidden_;
  unlinkat(parent_.get(), name.c_str(), AT_REMOVEDIR);
  hidden_.clear();
  removed_when_ended_.clear();
  folder_.reset();
  lock_ = Descriptor();
  ready_ = false;
}

void FilmFolder::leave_nothing() {
  if (!folder_) return;
  if (kind_ != FilmKind::pictures) {
    // Shards may have pictures there.
    const bool is_last = alone_ || flock(lock_.get(), LOCK_EX | LOCK_NB) == 0;
    if (!hidden_.empty() || (is_last && !holds_pictures(*folder_))) remove_all();
    return;
  }
  for (const std::string& name : made_files_) folder_->remove(name);
  if (made_folder_) rmdir(path_.c_str());
}

std::optional<FilmPlan> finished_film(const std::string& output, const FilmPlan::Asked& asked) {
  try {
    const std::optional<OwnFolder> folder = OwnFolder::open_shared(folder_of(output));
    const std::string described = plan_path(output);
    const std::optional<std::string> text = folder ? folder->read(name_in_folder(described)) : std::nullopt;
    if (!text) return std::nullopt;
    const FilmPlan plan = parse_film_plan(*text, described);
    if (!plan.made || !difference(plan.asked, asked).empty()) return std::nullopt;
    const FilmPlan::Made there = made_film(*folder, name_in_folder(output));
    return there.bytes == plan.made->bytes && there.hash == plan.made->hash ? std::optional(plan) : std::nullopt;
  } catch (const Failure&) {
    // Other files have these names, or none.
    return std::nullopt;
  }
}

}  // namespace bihive::cli
