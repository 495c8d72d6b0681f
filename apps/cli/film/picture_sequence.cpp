// A film as PNG files: the requested sequence, or the pictures of a shard.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <utility>

#include "bihive/base/fnv.h"
#include "bihive/base/path_parts.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/system_failure.h"
#include "bihive/job/messages.h"
#include "commands/draw_picture.h"
#include "film/content_hash.h"
#include "film/film_folder.h"
#include "film/film_sink.h"
#include "film/picture_index.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

class PictureSequence final : public FilmSink {
 public:
  PictureSequence(FilmFolder& film, SequenceForm form)
      : film_(film), form_(std::move(form)), whole_(form_.wanted.step()) {
    prefix_ = form_.store ? "" : name_in_folder(plan_path(form_.output));
    if (!form_.store) prefix_.resize(prefix_.size() - std::string("film.json").size());
    index_name_ = index_name(prefix_, form_.shard.index, form_.shard.count);
    if (film_.existing() == nullptr) return;
    read_indices(*film_.existing());
    find_pictures(*film_.existing());
    // Somebody has removed the film's description alone.
    if (!whole_.empty()) film_.folder();
  }

  bool has(std::int64_t number) const override { return number <= last_added_ || whole_.contains(number); }

  void add(const FilmPicture& picture) override {
    const std::string bytes = value_or_fail(encode_png(picture.pixels, picture.text, form_.dots_per_inch));
    const OwnFolder& folder = film_.folder();
    add_bytes(folder, picture.number, bytes);
    last_added_ = picture.number;
    film_.keep();
  }

  void pause() override {}

  // One index for the whole sequence.
  void finish() override {
    if (form_.store) return;
    const OwnFolder& folder = film_.folder();
    for_each_repeated([&](std::int64_t number, std::int64_t first) { repeat(folder, number, first); });
    if (!warn_of_earlier(folder)) indices_.insert(indices_.end(), earlier_indices_.begin(), earlier_indices_.end());
    indices_.erase(std::remove(indices_.begin(), indices_.end(), index_name_), indices_.end());
    if (indices_.empty()) return;
    if (!index_) open_index(folder);
    std::string lines;
    for (const IndexEntry& entry : own_)
      if (whole_.contains(entry.number)) lines += index_line(entry);
    append(lines);
    for (const std::string& name : indices_) folder.remove(name);
  }

 private:
  std::string name_of(std::int64_t number) const {
    return name_in_folder(form_.store ? shard_picture_path(form_.output, number) : picture_path(form_.output, number));
  }

  [[noreturn]] static void refuse(const std::string& path) {
    fail({"exists already, and was not written by bihive film", path, 0, 0, "move it away, or name another output"});
  }

  // Those of other shards too.
  void read_indices(const OwnFolder& folder) {
    for (const std::string& name : folder.names()) {
      if (!is_index_name(prefix_, name)) continue;
      const std::optional<std::string> text = folder.read(name);
      if (!text) continue;
      const auto found = read_index(*text, film_.plan_hash());
      if (!found && name == index_name_) refuse(folder.path_of(name));
      if (!found) continue;
      (found->own.empty() ? earlier_indices_ : indices_).push_back(name);
      own_.insert(own_.end(), found->own.begin(), found->own.end());
      earlier_.insert(earlier_.end(), found->earlier.begin(), found->earlier.end());
    }
    for (std::vector<IndexEntry>* const entries : {&own_, &earlier_})
      std::sort(entries->begin(), entries->end(),
                [](const IndexEntry& a, const IndexEntry& b) { return a.number < b.number; });
  }

  // An existing picture belongs to the film, or to an earlier one whose description is gone; others are refused.
  void find_pictures(const OwnFolder& folder) {
    for (const std::int64_t number : form_.wanted)
      if (is_whole(folder, number)) whole_.add(number);
    for_each_repeated([&](std::int64_t number, std::int64_t) { is_whole(folder, number); });
  }

  // False: there is none, or that of an earlier film.
  bool is_whole(const OwnFolder& folder, std::int64_t number) const {
    const std::string name = name_of(number);
    if (!folder.has(name)) return false;
    const std::optional<IndexEntry> there = existing_picture(folder, number);
    if (there && contains(own_, *there)) return true;
    if (!there || !contains(earlier_, *there)) refuse(folder.path_of(name));
    return false;
  }

  // Calls visit(position, first position of the same picture).
  template <class Visit>
  void for_each_repeated(const Visit& visit) const {
    if (form_.store) return;
    for (std::int64_t number = 0; number < form_.order.positions(form_.pictures); ++number)
      if (const std::int64_t first = form_.order.first_position(number, form_.pictures); first != number)
        visit(number, first);
  }

  // A copy of a picture that is shown again.
  void repeat(const OwnFolder& folder, std::int64_t number, std::int64_t first) {
    if (CancellableSection::token().cancelled()) throw Interrupted{};
    if (is_whole(folder, number)) return;
    const std::string path = folder.path_of(name_of(first));
    const std::optional<Descriptor> file = folder.open_picture(name_of(first));
    if (!file) fail({"has vanished while the film was made", path, 0, 0, "run the same again"});
    add_bytes(folder, number, value_or_fail(read_descriptor(file->get(), path)));
  }

  // The index gets the picture before it exists, so a kill leaves no unknown picture.
  void add_bytes(const OwnFolder& folder, std::int64_t number, const std::string& bytes) {
    if (!index_) open_index(folder);
    const IndexEntry entry{number, bytes.size(), fnv1a(bytes)};
    if (!contains(own_, entry)) append(index_line(entry));
    place(folder, number, bytes);
  }

  // As the index would list it; nothing if it is not a file of this user.
  std::optional<IndexEntry> existing_picture(const OwnFolder& folder, std::int64_t number) const {
    const std::string name = name_of(number);
    const std::optional<Descriptor> file = folder.open_picture(name);
    struct stat info {};
    if (!file || fstat(file->get(), &info) != 0) return std::nullopt;
    return IndexEntry{number, static_cast<std::uint64_t>(info.st_size),
                      hash_of_file(file->get(), folder.path_of(name))};
  }

  // A picture may have several entries, if runs were killed before it existed.
  static bool contains(const std::vector<IndexEntry>& entries, const IndexEntry& picture) {
    auto entry = std::lower_bound(entries.begin(), entries.end(), picture.number,
                                  [](const IndexEntry& a, std::int64_t b) { return a.number < b; });
    for (; entry != entries.end() && entry->number == picture.number; ++entry)
      if (*entry == picture) return true;
    return false;
  }

  // A picture of an earlier film makes way.
  void place(const OwnFolder& folder, std::int64_t number, const std::string& bytes) const {
    const std::string name = name_of(number);
    if (folder.place_new(name, bytes, kOfOutputs)) return;
    const std::optional<IndexEntry> there = existing_picture(folder, number);
    if (!there || !contains(earlier_, *there)) refuse(folder.path_of(name));
    folder.remove(name);
    if (!folder.place_new(name, bytes, kOfOutputs)) refuse(folder.path_of(name));
  }

  // Pictures of an earlier film whose numbers this one does not have stay. Whether there are any.
  bool warn_of_earlier(const OwnFolder& folder) const {
    std::int64_t first = -1, last = -1, count = 0;
    for (const IndexEntry& entry : earlier_) {
      if (entry.number == last || entry.number < form_.order.positions(form_.pictures)) continue;
      if (existing_picture(folder, entry.number) != entry) continue;
      last = entry.number;
      if (count++ == 0) first = last;
    }
    if (count == 0) return false;
    const std::string more =
        count == 1 ? "" : fmt::format(", as {} {} more here", count == 2 ? "is" : "are", count - 1);
    warn(folder.path_of(name_of(first)) + ": is of an earlier film" + more + "; remove what you do not need");
    return true;
  }

  // The lock ends with the program.
  void open_index(const OwnFolder& folder) {
    if (folder.write_new(index_name_, "", kOwnerWrites)) film_.note_file(index_name_);
    index_ = folder.open_file(index_name_, O_RDWR | O_APPEND);
    const std::string path = folder.path_of(index_name_);
    if (!index_) fail_of_system("cannot be written", path, ENOENT);
    if (flock(index_->get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail({"another run of bihive film works on this film", path, 0, 0, "wait for its end, or name another output"});
    const std::string text = value_or_fail(read_descriptor(index_->get(), path));
    const std::optional<PictureIndex> index = read_index(text, film_.plan_hash());
    if (!index) refuse(path);
    if (ftruncate(index_->get(), static_cast<off_t>(whole_lines(text))) != 0)
      fail_of_system("cannot be written", path, errno);
    if (!index->ends_with_own) append(index_head(film_.plan_hash()));
  }

  void append(const std::string& lines) {
    int code = write_whole(index_->get(), lines);
    if (code == 0) code = flush_to_disk(index_->get());
    if (code != 0) fail_of_system("writing failed", index_name_, code);
  }

  FilmFolder& film_;
  SequenceForm form_;
  std::string prefix_, index_name_;
  std::vector<std::string> indices_, earlier_indices_;  // the latter know other films alone
  std::vector<IndexEntry> own_, earlier_;               // by rising number; of this film, and of others
  PictureNumbers whole_;
  std::int64_t last_added_ = -1;
  std::optional<Descriptor> index_;
};

}  // namespace

std::unique_ptr<FilmSink> open_sequence(FilmFolder& film, SequenceForm form) {
  return std::make_unique<PictureSequence>(film, std::move(form));
}

}  // namespace bihive::cli
