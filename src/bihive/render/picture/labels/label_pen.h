// Where and with which colours labels are drawn, and their parts. Lengths are in ems: the size of the letters.
#pragma once

#include <string>

#include "bihive/image/font.h"
#include "bihive/image/overlay.h"
#include "bihive/scene/scene.h"

namespace bihive {

class LabelPen {
 public:
  /// `part`: the pixels of the whole picture, of this size, that `pixels` holds. `paper`: what is behind the picture.
  /// `font`: as in glyph_of().
  LabelPen(PngPixels& pixels, const Tile& part, int width_px, int height_px, double em_px, Vec3d paper,
           const Font* font = nullptr);
  /// Draws nothing, but widens `covered` by what it would draw. An area that nothing covers has x0 above x1.
  LabelPen(CanvasArea& covered, int width_px, int height_px, double em_px, const Font* font = nullptr);

  double width() const { return width_px_; }
  double height() const { return height_px_; }
  double em() const { return em_px_; }
  /// The free border of the picture.
  double margin() const { return em_px_; }
  /// The thickness of lines: whole pixels, at least one.
  double line() const;

  /// In one colour, without a seam.
  void fill(const Shape& shape, Vec3d colour);
  /// In the colour of letters, or another one, with a seam around it.
  void draw(const Shape& shape) { draw(shape, ink_); }
  void draw(const Shape& shape, Vec3d colour);
  /// One line of text from `start` on. `size`: in ems.
  void write(const std::string& text, CanvasPoint start, double size);
  /// The width of one line of text, in the unit of `size`.
  double width_of(const std::string& text, double size) const { return text_width(text, size, font_); }
  /// The same with a smaller or larger em, for a part that has less room.
  LabelPen with_em(double em_px) const;

 private:
  void cover(const Shape& shape, double border);

  PngPixels* pixels_ = nullptr;
  CanvasArea* covered_ = nullptr;  ///< one of both is there
  Tile part_{0, 0, 0, 0};
  int width_px_, height_px_;
  double em_px_;
  const Font* font_;
  Vec3d paper_, ink_;
};

/// The size of letters in pixels for a picture of this size; dots_per_inch 0: unknown.
double em_of_picture(int width_px, int height_px, double dots_per_inch);

}  // namespace bihive
