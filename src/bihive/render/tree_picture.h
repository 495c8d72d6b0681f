// A drawing of the tree itself: the boxes of its nodes as the camera sees them, and all its nodes by depth.
//
// The picture has two parts with a black band between them: side by side where it is wider than high, else one above
// the other.
//
// Boxes (left, above): the spheres as a dim grey relief (plane and materials left out), and over them every node's box,
// cut from the tree's box by the planes above it. Lines are coloured by depth, from white at the root over blue to
// violet at the deepest leaf. Gaps between children are green slabs, overlaps red ones, what a one-sided node cuts off
// is magenta; what a clip node keeps has a yellow outline, a leaf is faintly filled.
//   A large tree stays readable because every level of depth gets the same ink: where a level's lines add up to more
// than kLineInk pixels of line per pixel of the part, or its slabs to more than kFillInk, all of that level fades in
// proportion. Below the level at which the lines would be fainter than kFaintest nothing is drawn, nor inside a box
// whose longer side is shorter than kSmallestPx. All of that depends on tree, camera and size alone.
//
// Nodes by depth (right, below): x is the share of the spheres, in the order of the leaves; each row is one level, the
// root on top; a node is a bar above its spheres, a leaf a filled one. Along an inner node's bar runs its box along the
// split axis: the children's parts in the dimmed colour of the depth, the gap green, the overlap red, in proportion;
// a clip node is yellow, bright where it cuts off; a one-sided node is magenta, bright where its empty leaf is; a leaf
// that holds more than max_prims because no split made progress is orange. Bars finer than a pixel are averaged
// exactly: nothing is left out.
#pragma once

#include "bihive/image/canvas.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/framing.h"

namespace bihive {

constexpr double kLineInk = 0.08;
constexpr double kFillInk = 0.12;
constexpr double kFaintest = 1.0 / 32;
constexpr double kSmallestPx = 2;

/// Where the two parts lie, in whole pixels. A picture of a single pixel a side has no second part.
struct TreePictureLayout {
  CanvasArea boxes, bars;
};
TreePictureLayout tree_picture_layout(int width_px, int height_px);

/// What render() makes for View::tree. Of the settings only the size and the threads matter. The tracer must have a
/// tree. frame_tree() gives a camera.
Result<Rendered> render_tree_picture(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                     const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr);

/// A camera that shows the whole box around the set in the first part of a picture of this size.
Camera frame_tree(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px);

/// The boxes, blended over what the canvas holds.
void draw_tree_boxes(Canvas& canvas, const CanvasArea& area, const Tree& tree, double world_from_stored,
                     const Camera& camera);
/// The nodes by depth; the area must be black.
void draw_tree_bars(Canvas& canvas, const CanvasArea& area, const Tree& tree);

}  // namespace bihive
