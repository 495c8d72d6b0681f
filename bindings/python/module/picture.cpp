#include "picture.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/image/exr.h"
#include "bihive/image/png.h"
#include "bihive/image/tiff.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/figure.h"
#include "bihive/job/messages.h"
#include "bihive/job/methods_text.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/render_on_gpu.h"
#include "bihive/job/report_text.h"
#include "bihive/job/scene_request.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/render/finished_pixels.h"
#include "bihive/render/layers.h"
#include "bihive/render/memory.h"
#include "bihive/scene/looks.h"
#include "errors.h"
#include "spheres.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// A scene with its tracer, which refers to it: neither is moved.
struct Drawing {
  Input input;
  RenderSettings settings;
  std::optional<Tracer> tracer;
};

// The data of layers.
struct Light {
  std::shared_ptr<const Drawing> drawing;
  Film film;
};

// All except `light` is immutable, so that threads may read it without Python's lock. `light` is read and written under
// the lock alone: code without the lock keeps its own pointer.
struct Picture {
  std::shared_ptr<const Light> light;  // null: it was released, or the picture was unpickled
  PngPixels pixels;
  PngText text;
  std::vector<std::pair<std::string, std::string>> exr_text;  // the same in UTF-8, without the record
  std::optional<PictureRecord> record;
  double dots_per_inch = 0;
  std::string report;  // JSON
  std::string methods;
  std::vector<std::string> warnings;
  std::optional<FixedByFilm> fixed;  // for pictures like it; unset: it was unpickled
};

Input input_of(const Spheres& spheres, const PictureRequest& options, const Style& style) {
  refuse_settings_of_files(options.input);
  if (options.picture.has("trail"))
    fail_setting("trail", " needs the frames before, and these spheres are in memory", "give the path of their file");
  if (spheres.file.spheres.empty()) fail({"there are no spheres to draw", "", 0, 0, "a picture needs at least one"});
  SphereFile file = spheres.file;
  if (!options.input.reading.options().periodic && file.spheres.cell()) file.spheres.cell()->periodic = {};
  if (options.input.reading.has("replicate")) {
    if (!file.spheres.cell()) fail_setting("replicate", " needs a periodic cell", "give Spheres a cell");
    value_of(file.spheres.replicate(file.spheres.cell()->vectors, options.input.reading.options().replicate));
  }
  return scene_of_spheres(std::move(file), spheres.name, &style);
}

// A style that is not in a file is passed as its text.
Style style_of(const PictureRequest& options, const std::string& style_text) {
  if (style_text.empty()) return choose_style(options.style);
  return value_of(parse_style(style_text, "style"));
}

nlohmann::ordered_json rays_json(const RenderCounts& rays) {
  return {{"primary", rays.primary},
          {"shadow", rays.shadow},
          {"reflected", rays.reflected},
          {"transmitted", rays.transmitted},
          {"ambient", rays.ambient}};
}

// The film by the engine, and its report.
Rendered draw(const Drawing& drawing, RenderEngine engine, Work& work) {
  const Tracer& tracer = *drawing.tracer;
  const auto progress = [&work](double done) { work.done.store(done, std::memory_order_relaxed); };
  if (!is_gpu(engine)) return value_of(render(drawing.input.scene, tracer, drawing.settings, progress, &work.cancel));
  GpuPicture picture = render_on_gpu(drawing.input.scene, tracer.tree(), drawing.settings, [&](double done) {
    progress(done);
    if (work.cancel.cancelled()) fail(cancelled_error());
  });
  Rendered rendered;
  rendered.film = std::move(picture.film);
  rendered.rays.primary = picture.primary;
  rendered.render_ms = picture.render_ms;
  return rendered;
}

std::shared_ptr<Picture> make_picture(const SharedSpheres& spheres, PictureRequest options,
                                      const std::string& style_text, const Picture* like, Work& work) {
  auto picture = std::make_shared<Picture>();
  const CollectedWarnings collected(picture->warnings);

  // Load the scene, and apply the options to it.
  if (like != nullptr && !like->fixed)
    fail_usage("camera: a picture that was unpickled has none", "render it again, or give eye and look_at");
  if (like != nullptr) options.fixed = like->fixed;
  const RenderEngine engine = choose_engine(options);
  Style style = style_of(options, style_text);
  if (options.fixed) fix_range(style, options.fixed->range_of_style);
  auto drawing = std::make_shared<Drawing>();
  const bool asked_for = !options.style.name.empty() || !style_text.empty();
  drawing->input = spheres != nullptr ? input_of(*spheres, options, style)
                                      : load_input(options.input, LooksOfFile::keep, &style, asked_for);
  drawing->settings = prepare_picture(options, engine, drawing->input);
  const Scene& scene = drawing->input.scene;
  const RenderSettings& settings = drawing->settings;
  const Tile drawn = drawn_pixels(settings);
  check_memory_of(engine, drawing->input, options, settings);
  value_of(check_picture_memory(drawn.width(), drawn.height()));

  // Build and draw.
  drawing->tracer = value_of(
      Tracer::build(scene, structure_of(engine), tree_for(options, engine, scene, settings), settings.threads));
  Rendered rendered = draw(*drawing, engine, work);
  picture->pixels = finished_pixels(rendered.film, scene, settings, static_cast<int>(options.bits.value_or(8)));

  // Keep its facts.
  const nlohmann::ordered_json described = settings_json(options, settings, scene, {});
  for (const auto& [name, value] : text_of(options, scene, described)) {
    picture->text.emplace_back(name, latin1(value));
    picture->exr_text.emplace_back(name, value);
  }
  // Spheres, styles and cameras in memory are in no file from which the picture could be drawn again.
  PictureRecord record;
  if (spheres == nullptr && style_text.empty() && like == nullptr) {
    record = record_of(options, sha256_of(picture->pixels));
    picture->text.emplace_back(kLateKeyword, to_text(record));
    picture->record = record;
  }
  record.version = version();
  record.commit = commit();
  picture->methods = methods_text(options, described, scene, record);
  nlohmann::ordered_json report;
  report["scene"] = scene.name;
  report["spheres"] = scene.spheres.size();
  report["settings"] = described;
  report["rays"] = rays_json(rendered.rays);
  report["build_ms"] = drawing->tracer->build_ms();
  report["render_ms"] = rendered.render_ms;
  picture->report = as_text(report, -1);
  picture->dots_per_inch = options.dots_per_inch;
  FixedByFilm fixed{scene.camera, range_of_style(drawing->input, options.looks),
                    ranges_of_looks(drawing->input, options.looks)};
  give_extent(fixed.range_of_style);
  for (ColourRange& range : fixed.ranges_of_looks) give_extent(range);
  picture->fixed = std::move(fixed);
  picture->light = std::make_shared<const Light>(Light{std::move(drawing), std::move(rendered.film)});
  return picture;
}

// An array of a look, with a value for each sphere: the number of the --select, the option, the values, and whether
// colours are light. The words have an option in its position, whose action the array replaces.
using ArrayOfLook = std::tuple<std::size_t, std::string, Array<double>, bool>;

std::vector<Vec3d> vectors_from(const Array<double>& rows) {
  std::vector<Vec3d> vectors;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) vectors.push_back({rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)});
  return vectors;
}

void take_array(LookOptions& options, const ArrayOfLook& array) {
  const auto& [number, name, values, are_light] = array;

  // Find the look, and its words.
  std::size_t look = 0, word = 0;
  for (std::size_t left = number + 1; left > 0; ++look)
    if (options.of_look.at(look) == "select" && --left == 0) break;
  const std::string select = option_of_setting("select") + " ";
  for (std::size_t left = number + 1; left > 0; ++word)
    if (options.words.at(word).starts_with(select) && --left == 0) break;

  // The action takes the position of the first one of its kind.
  const auto put = [&actions = options.looks[look].actions, &words = options.words, word](
                       const auto& is_replaced, const std::string& option, const char* said, LookAction action) {
    *std::find_if(actions.begin(), actions.end(), is_replaced) = std::move(action);
    for (std::size_t at = word; at < words.size(); ++at)
      if (words[at].starts_with(option + " ")) {
        words[at] = said;
        break;
      }
  };
  if (name == "colour")
    put([](const LookAction& one) { return std::holds_alternative<SetColour>(one); }, "--colour", "--colour (array)",
        SetColours{vectors_from(values), are_light});
  else if (name == "opacity")
    put([](const LookAction& one) { return std::holds_alternative<SetOpacity>(one); }, "--opacity", "--opacity (array)",
        SetOpacities{vector_from<double>(values)});
  else
    put([](const LookAction& one) { return std::holds_alternative<ScaleRadius>(one); }, "--radius-scale",
        "radius (array)", SetRadii{vector_from<double>(values)});
}

std::shared_ptr<Picture> render_picture(const std::shared_ptr<Spheres>& spheres, const std::vector<std::string>& words,
                                        const std::vector<ArrayOfLook>& arrays, const std::string& style_text,
                                        const Picture* like, const py::object& progress) {
  PictureRequest options = request_of(words);
  for (const ArrayOfLook& array : arrays) take_array(options.looks, array);
  if (spheres == nullptr && like == nullptr) take_saved_request(options);
  std::shared_ptr<Picture> picture;
  wait_for([&](Work& work) { picture = make_picture(spheres, options, style_text, like, work); }, progress);
  return picture;
}

std::shared_ptr<Picture> draw_again(const std::string& path, const std::string& input,
                                    const std::vector<std::string>& words, const py::object& progress) {
  const std::vector<GivenSetting> changes = request_of(words).given;
  std::shared_ptr<Picture> picture;
  wait_for(
      [&](Work& work) {
        picture = make_picture(nullptr, request_again(read_figure(path), path, input, changes), "", nullptr, work);
      },
      progress);
  return picture;
}

// With layers the numbers that an OpenEXR file has.
FigurePixels pixels_of_figure(Picture& picture, const std::vector<std::string>& names, Work& work) {
  if (names.empty()) return {std::move(picture.pixels)};
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  const std::vector<Layer> layers = value_of(layers_from_text(text));
  const Drawing& drawing = *picture.light->drawing;
  value_of(check_layers(drawing.input.scene, layers));
  ExrForm form{drawing.settings.width_px, drawing.settings.height_px, drawn_pixels(drawing.settings), {}, {}, 0};
  form.channels =
      draw_layers(drawing.input.scene, *drawing.tracer, drawing.settings, layers, picture.light->film, &work.cancel);
  std::sort(form.channels.begin(), form.channels.end(),
            [](const Channel& a, const Channel& b) { return a.name < b.name; });
  return {{}, std::move(form)};
}

// The verdict as a sentence and as JSON.
std::pair<std::string, std::string> verify(const std::string& path, const std::string& input,
                                           const std::string& difference, const py::object& progress) {
  Verdict verdict;
  wait_for(
      [&](Work& work) {
        verdict = verify_figure(path, input, difference, [&](const PictureRequest& request, const auto& layers) {
          return pixels_of_figure(*make_picture(nullptr, request, "", nullptr, work), layers, work);
        });
      },
      progress);
  return {sentence_of(verdict), as_text(json_of(verdict), -1)};
}

py::array pixels_of(const py::object& self) {
  const auto& pixels = self.cast<const Picture&>().pixels;
  const py::dtype type(pixels.bits == 8 ? "u1" : ">u2");
  py::array made(type, {pixels.height, pixels.width, pixels.channels}, {}, pixels.bytes.data(), self);
  made.attr("setflags")(py::arg("write") = false);
  return made;
}

// The scene and film of a picture. Fails, naming `what` was asked for, if they were released.
std::shared_ptr<const Light> light_of(const Picture& picture, const std::string& what) {
  if (picture.light != nullptr) return picture.light;
  fail_usage(what + ": this picture has its pixels alone, because it was unpickled or detached", "render it again");
}

// The camera of a picture, for positions counted from the corner of what was drawn.
struct PictureCamera {
  std::shared_ptr<const Light> light;
  const SphereSet& spheres;
  Camera camera;  // local
  int width, height;
  double left, top;

  static PictureCamera of(const Picture& picture, const std::string& what) {
    std::shared_ptr<const Light> light = light_of(picture, what);
    const RenderSettings& settings = light->drawing->settings;
    if (settings.stereo.form != StereoForm::none)
      fail_usage(what + ": a stereo picture has two cameras", "render one view");
    const Scene& scene = light->drawing->input.scene;
    const Tile drawn = drawn_pixels(settings);
    return {std::move(light),   scene.spheres,    local_camera(scene), settings.width_px,
            settings.height_px, double(drawn.x0), double(drawn.y0)};
  }
};

// Origins and directions, (n, 3) each, of the rays through these positions; and the direction of view.
py::tuple camera_rays(const Picture& picture, const Array<double>& x, const Array<double>& y) {
  const PictureCamera camera = PictureCamera::of(picture, "rays");
  const PixelRays rays(camera.camera, camera.width, camera.height);
  const py::ssize_t count = x.size();
  Array<double> origin({count, py::ssize_t{3}}), direction({count, py::ssize_t{3}});
  const double *const at_x = x.data(), *const at_y = y.data();
  double *to_origin = origin.mutable_data(), *to_direction = direction.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    for (py::ssize_t i = 0; i < count; ++i) {
      const Ray ray = rays.at(at_x[i] + camera.left, at_y[i] + camera.top);
      const Vec3d from = camera.spheres.in_world(to_double(ray.origin)), along = to_double(ray.direction);
      for (int axis = 0; axis < 3; ++axis) *to_origin++ = from[axis], *to_direction++ = along[axis];
    }
  }
  const Vec3d forward = rays.forward();
  return py::make_tuple(origin, direction, py::make_tuple(forward.x, forward.y, forward.z));
}

// Of points (n, 3): x, y and the distance along the view, (n, 3). NaN for x and y of what lies behind an eye.
Array<double> camera_places(const Picture& picture, const Array<double>& points) {
  const PictureCamera camera = PictureCamera::of(picture, "project");
  const PixelPlaces places(camera.camera, camera.width, camera.height);
  const py::ssize_t count = points.shape(0);
  Array<double> made({count, py::ssize_t{3}});
  const double* from = points.data();
  double* to = made.mutable_data();
  const py::gil_scoped_release unlocked;
  const bool has_eye = camera.camera.projection == Projection::perspective;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (py::ssize_t i = 0; i < count; ++i, from += 3) {
    const Vec3d seen = places.from_eye(camera.spheres.to_local({from[0], from[1], from[2]}));
    const bool is_behind = has_eye && !(seen.z > 0);
    *to++ = is_behind ? nan : places.x_px(seen) - camera.left;
    *to++ = is_behind ? nan : places.y_px(seen) - camera.top;
    *to++ = seen.z;
  }
  return made;
}

// `name` is known to layers_from_text(), and is one layer. Ids are 64-bit, -1 for nothing and -2 for the plane.
py::object layer_of(const Picture& picture, const std::string& name) {
  const std::shared_ptr<const Light> light = light_of(picture, "layer");
  const Drawing& drawing = *light->drawing;
  const Result<std::vector<Layer>> known = layers_from_text(name);
  if (!known) fail_usage("name: " + known.error().message, known.error().hint);
  const std::vector<Layer>& layers = *known;
  if (layers.size() != 1) fail_usage("name: expected one layer, found \"" + name + "\"");
  std::vector<Channel> channels;
  wait_for(
      [&](Work& work) {
        value_of(check_layers(drawing.input.scene, layers));
        channels =
            draw_layers(drawing.input.scene, *drawing.tracer, drawing.settings, layers, light->film, &work.cancel);
      },
      py::none());
  const py::ssize_t width = picture.pixels.width, height = picture.pixels.height;
  if (channels.size() == 1 && channels.front().of_ids) {
    std::vector<std::int64_t> ids;
    ids.reserve(channels.front().ids.size());
    for (const std::uint32_t id : channels.front().ids)
      ids.push_back(id == kIdOfNothing ? kNothing : id == kIdOfPlane ? kPlane : std::int64_t{id});
    return array_from<std::int64_t>(std::move(ids), {height, width});
  }
  if (channels.size() == 1) return array_from<float>(std::move(channels.front().numbers), {height, width});
  const std::size_t count = channels.size();
  std::vector<float> mixed(static_cast<std::size_t>(width * height) * count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < channels[k].numbers.size(); ++i) mixed[i * count + k] = channels[k].numbers[i];
  return array_from<float>(std::move(mixed), {height, width, static_cast<py::ssize_t>(count)});
}

// `names` are layers between commas, known to layers_from_text(). The file holds the numbers that layer() gives.
void save_exr(const Picture& picture, const std::string& path, const std::string& names, bool metadata) {
  const std::shared_ptr<const Light> light = picture.light;
  if (light == nullptr)
    fail_usage("path: OpenEXR needs the light, and this picture has its pixels alone (unpickled or detached)",
               "render it again, or save a PNG");
  if (!can_write_exr())
    fail_environment(
        {"this build of bihive has no OpenEXR", path, 0, 0, "install libopenexr-dev and build again, or save a PNG"});
  const Drawing& drawing = *light->drawing;
  const Result<std::vector<Layer>> known = layers_from_text(names);
  if (!known) fail_usage("layers: " + known.error().message, known.error().hint);
  const std::vector<Layer>& layers = *known;
  if (const Status status = check_layers(drawing.input.scene, layers); !status)
    fail_usage("layers: " + status.error().message, status.error().hint);
  wait_for(
      [&](Work& work) {
        const RenderSettings& settings = drawing.settings;
        ExrForm form{settings.width_px,
                     settings.height_px,
                     drawn_pixels(settings),
                     draw_layers(drawing.input.scene, *drawing.tracer, settings, layers, light->film, &work.cancel),
                     metadata ? picture.exr_text : decltype(picture.exr_text){},
                     picture.dots_per_inch};
        if (metadata && picture.record) {
          PictureRecord record = *picture.record;
          ChannelsHash hash;
          hash.add(form.channels, form.pixels.width());
          record.pixels_sha256 = hash.digits();
          for (const Layer& layer : layers) record.layers.push_back(name_of_layer(layer));
          form.text.emplace_back(kLateKeyword, to_text(record));
        }
        value_of(write_exr(path, form));
      },
      py::none());
}

void save_tiff(const Picture& picture, const std::string& path, bool metadata) {
  const PngPixels& pixels = picture.pixels;
  TiffForm form{pixels.width, pixels.height, pixels.channels, pixels.bits, picture.dots_per_inch, "", ""};
  for (const auto& [name, value] : picture.exr_text) {
    if (!metadata) break;
    if (name == "Software") form.software = value;
    if (name == "Settings") form.description = value;
  }
  if (metadata && picture.record) form.description = to_text_with_settings(*picture.record, form.description);
  if (!can_write_tiff())
    fail_environment(
        {"this build of bihive has no TIFF", path, 0, 0, "install libtiff-dev and build again, or save a PNG"});
  value_of(write_tiff(path, form, pixels));
}

std::string png_bytes(const Picture& picture, bool metadata = true) {
  return value_of(encode_png(picture.pixels, metadata ? picture.text : PngText{}, picture.dots_per_inch));
}

py::tuple state_of(const Picture& picture) {
  const PngPixels& pixels = picture.pixels;
  const py::bytes bytes(reinterpret_cast<const char*>(pixels.bytes.data()), pixels.bytes.size());
  py::list text;
  for (const auto& [name, value] : picture.text) text.append(py::make_tuple(py::bytes(name), py::bytes(value)));
  return py::make_tuple(pixels.width, pixels.height, pixels.channels, pixels.bits, bytes, text, picture.dots_per_inch,
                        picture.report, picture.methods, pixels.is_srgb);
}

std::shared_ptr<Picture> from_state(const py::tuple& state) {
  auto picture = std::make_shared<Picture>();
  PngPixels& pixels = picture->pixels;
  pixels.width = state[0].cast<int>();
  pixels.height = state[1].cast<int>();
  pixels.channels = state[2].cast<int>();
  pixels.bits = state[3].cast<int>();
  const auto bytes = state[4].cast<std::string>();
  pixels.bytes.assign(bytes.begin(), bytes.end());
  if (pixels.bytes.size() != pixels.row_bytes() * static_cast<std::size_t>(pixels.height))
    fail({"a pickled picture is damaged", "", 0, 0, "render it again"});
  for (const py::handle one : state[5].cast<py::list>()) {
    const auto pair = one.cast<py::tuple>();
    picture->text.emplace_back(pair[0].cast<std::string>(), pair[1].cast<std::string>());
  }
  picture->dots_per_inch = state[6].cast<double>();
  picture->report = state[7].cast<std::string>();
  picture->methods = state[8].cast<std::string>();
  pixels.is_srgb = state[9].cast<bool>();
  return picture;
}

}  // namespace

void bind_pictures(py::module_& module) {
  py::class_<Picture, std::shared_ptr<Picture>>(module, "Picture")
      .def_property_readonly("pixels", pixels_of)
      .def_property_readonly("report", [](const Picture& p) { return p.report; })
      .def_property_readonly("methods", [](const Picture& p) { return p.methods; })
      .def_property_readonly("warnings", [](const Picture& p) { return safe_texts(p.warnings); })
      .def_property_readonly("has_scene", [](const Picture& p) { return p.light != nullptr; })
      .def_property_readonly("hash", [](const Picture& p) { return picture_hash(p.pixels); })
      .def("layer", layer_of)
      .def("camera_rays", camera_rays)
      .def("camera_places", camera_places)
      .def("png", [](const Picture& p) { return py::bytes(png_bytes(p)); })
      .def("save",
           [](const Picture& p, const std::string& path, bool metadata) {
             const py::gil_scoped_release unlocked;
             value_of(write_file(path, png_bytes(p, metadata)));
           })
      .def("save_tiff", save_tiff)
      .def("save_exr", save_exr)
      .def("detach", [](Picture& p) { p.light.reset(); })
      .def(py::pickle(&state_of, &from_state));
  module.def("render", render_picture);
  module.def("again", draw_again);
  module.def("verify", verify);
}

}  // namespace bihive::python
