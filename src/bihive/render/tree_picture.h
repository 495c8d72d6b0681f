// A drawing of the tree itself: the boxes of its nodes as the camera sees them, and all its nodes by depth.
//
// The picture has two parts with a black band between them: side by side if it is wider than high, else one above the
// other.
//
// Boxes (left, above): the spheres are a dim grey relief, without plane and materials. Over them is every node's box,
// cut from the tree's box by the planes above it. Lines are coloured by depth, from white at the root over blue to
// violet at the deepest leaf. Gaps between children are green slabs, overlaps red ones. The part that a one-sided node
// cuts off is magenta. The part that a clip node keeps has a yellow outline. A leaf is faintly filled.
//
// A large tree stays readable because every level of depth gets the same ink. If a level's lines add up to more than
// kLineInk pixels of line per pixel of the part, or its slabs to more than kFillInk, the whole level fades in
// proportion. Nothing is drawn below the level at which the lines would be fainter than kFaintest, nor inside a box
// whose longer side is shorter than kSmallestPx. All of that depends on tree, camera and size alone.
//
// Nodes by depth (right, below): x is the share of the spheres, in the order of the leaves. Each row is one level, the
// root on top. A node is a bar above its spheres; a leaf is a filled bar. An inner node's bar shows its box along the
// split axis, in proportion: the children's parts in the dimmed colour of the depth, the gap green, the overlap red. A
// clip node is yellow, and bright where it cuts off; a one-sided node is magenta, and bright where its empty leaf is. A
// leaf is orange if it holds more than max_prims spheres because no split made progress. Bars finer than a pixel are
// averaged exactly: nothing is left out.
#pragma once

#include "bihive/image/canvas.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/framing.h"

namespace bihive {

constexpr double kLineInk = 0.08;
constexpr double kFillInk = 0.12;
constexpr double kFaintest = 1.0 / 32;
constexpr double kSmallestPx = 2;

/// The places of the two parts, in whole pixels. A picture with a side of one pixel has no second part.
struct TreePictureLayout {
  CanvasArea boxes, bars;
};
TreePictureLayout tree_picture_layout(int width_px, int height_px);

/// The picture of render() for View::tree. Only the size, the crop and the threads of the settings matter. The tracer
/// must have a tree. frame_tree() gives a camera.
Result<Rendered> render_tree_picture(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                     const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr);

/// A camera that shows the whole box around the set in the first part of a picture of this size.
Camera frame_tree(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px);
Camera frame_tree(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px);

/// Draws the boxes, blended over the canvas's content.
void draw_tree_boxes(Canvas& canvas, const CanvasArea& area, const Tree& tree, double world_from_stored,
                     const Camera& camera);
/// Draws the nodes by depth; the area must be black.
void draw_tree_bars(Canvas& canvas, const CanvasArea& area, const Tree& tree);

}  // namespace bihive
