#include "bihive/image/font_file.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bihive/base/write_file.h"

namespace bihive {
namespace {

constexpr double kMostEms = 16;
constexpr FT_Int32 kUnscaled = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;

using Contour = std::vector<OutlinePoint>;

OutlinePoint between(const OutlinePoint& from, const OutlinePoint& to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), true};
}

struct Cubic {
  OutlinePoint a, b, c, d;
};

// The begin of a curve; the rest stays (de Casteljau).
Cubic cut_off(Cubic& curve, double share) {
  const OutlinePoint ab = between(curve.a, curve.b, share), bc = between(curve.b, curve.c, share);
  const OutlinePoint cd = between(curve.c, curve.d, share);
  const OutlinePoint abc = between(ab, bc, share), bcd = between(bc, cd, share), middle = between(abc, bcd, share);
  const Cubic begin{curve.a, ab, abc, middle};
  curve = {middle, bcd, cd, curve.d};
  return begin;
}

// A cubic curve as quadratic ones, without its first point.
void add_cubic(Cubic curve, Contour& contour) {
  constexpr int kParts = 4;
  for (int part = 0; part < kParts; ++part) {
    const Cubic piece = part + 1 < kParts ? cut_off(curve, 1.0 / (kParts - part)) : curve;
    contour.push_back({(3 * (piece.b.x + piece.c.x) - (piece.a.x + piece.d.x)) / 4,
                       (3 * (piece.b.y + piece.c.y) - (piece.a.y + piece.d.y)) / 4, false});
    contour.push_back(piece.d);
  }
}

// Points `first` to `last` of an outline, in ems. Nothing: curves of a kind that FreeType does not make.
std::optional<Contour> contour_of(const FT_Outline& outline, int first, int last, double unit) {
  const int count = last - first + 1;
  const auto tag = [&](int i) { return FT_CURVE_TAG(outline.tags[first + i % count]); };
  const auto point = [&](int i) {
    const FT_Vector& at = outline.points[first + i % count];
    return OutlinePoint{static_cast<double>(at.x) / unit, static_cast<double>(at.y) / unit, tag(i) == FT_CURVE_TAG_ON};
  };
  Contour contour;
  for (int i = 0; i < count; ++i) {
    if (tag(i) != FT_CURVE_TAG_CUBIC) {
      contour.push_back(point(i));
      continue;
    }
    // Two control points between points on the curve; after the last ones comes the first point.
    if (i == 0 || tag(i - 1) != FT_CURVE_TAG_ON || tag(i + 1) != FT_CURVE_TAG_CUBIC || tag(i + 2) != FT_CURVE_TAG_ON)
      return std::nullopt;
    add_cubic({point(i - 1), point(i), point(i + 1), point(i + 2)}, contour);
    if (i + 2 >= count) contour.pop_back();
    i += 2;
  }
  return contour;
}

class FreeTypeFont final : public Font {
 public:
  FreeTypeFont() = default;
  FreeTypeFont(const FreeTypeFont&) = delete;
  FreeTypeFont& operator=(const FreeTypeFont&) = delete;
  ~FreeTypeFont() override {
    if (face_ != nullptr) FT_Done_Face(face_);
    if (library_ != nullptr) FT_Done_FreeType(library_);
  }

  // Error: the message alone.
  Status open(std::string bytes) {
    bytes_ = std::move(bytes);
    if (FT_Init_FreeType(&library_) != 0) return Error{"FreeType cannot be used", "", 0, 0, ""};
    if (FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(bytes_.data()),
                           static_cast<FT_Long>(bytes_.size()), 0, &face_) != 0)
      return Error{"is no font that FreeType can read", "", 0, 0, "name a .ttf, .otf or .pfb file"};
    if (!FT_IS_SCALABLE(face_) || face_->units_per_EM == 0)
      return Error{"is a font of pixels, and letters are drawn from outlines", "", 0, 0, "name a .ttf or .otf file"};
    if (FT_Select_Charmap(face_, FT_ENCODING_UNICODE) != 0)
      return Error{"is a font of symbols: it does not say which Unicode characters it has", "", 0, 0, ""};
    return Done{};
  }

  const Glyph* glyph(char32_t character) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [known, is_new] = glyphs_.try_emplace(character);
    if (is_new) known->second = read(character);
    return known->second ? &*known->second : nullptr;
  }

  double kerning(char32_t left, char32_t right) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    FT_Vector added{0, 0};
    if (!FT_HAS_KERNING(face_) || FT_Get_Kerning(face_, FT_Get_Char_Index(face_, left), FT_Get_Char_Index(face_, right),
                                                 FT_KERNING_UNSCALED, &added) != 0)
      return 0;
    return static_cast<double>(added.x) / face_->units_per_EM;
  }

 private:
  std::optional<Glyph> read(char32_t character) const {
    const FT_UInt index = character == 0 ? 0 : FT_Get_Char_Index(face_, character);
    if (index == 0 || FT_Load_Glyph(face_, index, kUnscaled) != 0) return std::nullopt;
    const double unit = face_->units_per_EM;
    // A damaged glyph that reaches far beyond its line counts as lacking: it would take the memory of a huge picture.
    const auto is_far = [unit](FT_Pos length) { return std::abs(static_cast<double>(length)) > kMostEms * unit; };
    const FT_Outline& outline = face_->glyph->outline;
    if (is_far(face_->glyph->advance.x)) return std::nullopt;
    for (int i = 0; i < outline.n_points; ++i)
      if (is_far(outline.points[i].x) || is_far(outline.points[i].y)) return std::nullopt;
    Glyph glyph{static_cast<double>(face_->glyph->advance.x) / unit, {}};
    int first = 0;
    for (int k = 0; k < outline.n_contours; ++k) {
      const int last = outline.contours[k];
      std::optional<Contour> contour = last < first ? Contour() : contour_of(outline, first, last, unit);
      if (!contour) return std::nullopt;
      glyph.contours.push_back(std::move(*contour));
      first = last + 1;
    }
    return glyph;
  }

  std::string bytes_;  // FreeType reads from them
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  mutable std::mutex mutex_;
  mutable std::unordered_map<char32_t, std::optional<Glyph>> glyphs_;
};

}  // namespace

Result<std::shared_ptr<const Font>> read_font(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  auto font = std::make_shared<FreeTypeFont>();
  if (Status status = font->open(std::move(*bytes)); !status) {
    Error error = status.error();
    error.file = path;
    return error;
  }
  return std::shared_ptr<const Font>(std::move(font));
}

}  // namespace bihive
