#include "film_file.h"

#include <fcntl.h>
#include <pybind11/stl.h>
#include <sys/file.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "bihive/base/path_parts.h"
#include "bihive/base/place_file.h"
#include "bihive/job/film/hidden_folder.h"
#include "errors.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// A hidden folder beside the film, in which ffmpeg writes.
class FilmFile {
 public:
  explicit FilmFile(const std::string& output)
      : output_(value_of(path_behind_links(output))), around_(folder_of(output_)), parent_(open_parent(around_)) {
    remove_leftovers(parent_.get(), around_);
    hidden_.emplace(make_hidden_folder(parent_.get(), around_, LOCK_EX));
  }
  ~FilmFile() {
    try {
      leave();
    } catch (const Failure&) {
      // The next film removes it.
    }
  }
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  // The folder's descriptor; a program that inherits it finds the folder even if it is renamed.
  int descriptor() const { return hidden_ ? hidden_->folder.descriptor() : -1; }

  bool has(const std::string& name) const { return hidden_ && hidden_->folder.has(name); }

  // The file `name` in the folder replaces the film.
  void place(const std::string& name) { value_of(place_file(descriptor(), name, output_)); }

  void leave() {
    if (!hidden_) return;
    remove_own_files(hidden_->folder);
    unlinkat(parent_.get(), hidden_->name.c_str(), AT_REMOVEDIR);
    hidden_.reset();
  }

 private:
  std::string output_, around_;
  Descriptor parent_;
  std::optional<HiddenFolder> hidden_;
};

}  // namespace

void bind_film_files(py::module_& module) {
  py::class_<FilmFile>(module, "FilmFile")
      .def(py::init<const std::string&>())
      .def("descriptor", &FilmFile::descriptor)
      .def("has", &FilmFile::has)
      .def("place", &FilmFile::place)
      .def("leave", &FilmFile::leave);
}

}  // namespace bihive::python
