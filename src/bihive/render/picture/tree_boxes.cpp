// The first part of the tree's drawing: the nodes' boxes as the camera sees them.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bihive/bih/child_boxes.h"
#include "bihive/bih/statistics.h"
#include "bihive/render/picture/tree_colours.h"
#include "bihive/render/tree_picture.h"

namespace bihive {
namespace {

namespace colours = tree_colours;

constexpr double kLinePx = 1.25;
constexpr double kMostSlabOpacity = 0.14;
constexpr double kMostLeafOpacity = 0.14;
// Nothing is drawn that is nearer to the eye than this share of the set's extent.
constexpr double kNearest = 1e-6;

// A box to draw: its corners as seen from the eye. Bit i of a corner's number is set at the upper end of axis i.
struct SeenBox {
  std::array<Vec3d, 8> corner;
  std::array<bool, 6> faces_eye;  // lower and upper side of x, y, z
};

// The visible part of a face, after the part behind the eye is cut off.
struct Polygon {
  std::array<CanvasPoint, 5> points;
  int count = 0;
};

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (int i = 0; i < polygon.count; ++i) {
    const CanvasPoint a = polygon.points[static_cast<std::size_t>(i)];
    const CanvasPoint b = polygon.points[static_cast<std::size_t>(i + 1 < polygon.count ? i + 1 : 0)];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

class Boxes {
 public:
  Boxes(Canvas& canvas, const CanvasArea& area, const Tree& tree, double world_from_stored, const Camera& camera)
      : canvas_(canvas),
        area_(area),
        tree_(tree),
        unit_(world_from_stored),
        eye_(camera.eye),
        parallel_(camera.projection == Projection::orthographic),
        view_(camera.look_at - camera.eye),
        places_(camera, static_cast<int>(area.width()), static_cast<int>(area.height())),
        deepest_(tree_statistics(tree).depth.max) {
    const Vec3d extent = (to_double(tree.aabb.hi) - to_double(tree.aabb.lo)) * unit_;
    nearest_ = kNearest * std::max({extent.x, extent.y, extent.z});
  }

  void draw() {
    if (tree_.aabb.empty() || !(nearest_ > 0)) return;
    canvas_.clip_to(static_cast<int>(area_.x0), static_cast<int>(area_.y0), static_cast<int>(area_.x1),
                    static_cast<int>(area_.y1));
    const double pixels = area_.width() * area_.height();
    std::vector<Level> levels;
    std::vector<Item> items{{0, tree_.aabb}};
    while (!items.empty()) {
      // Divide the ink among the level's boxes.
      Level level;
      level.colour = colours::of_depth(static_cast<std::int64_t>(levels.size()) + 1, deepest_);
      Ink ink;
      for (const Item& item : items) measure(item, ink);
      level.line_opacity = std::min(1.0, kLineInk * pixels / ink.lines);
      level.slab_opacity = std::min(kMostSlabOpacity, kFillInk * pixels / ink.slabs);
      level.leaf_opacity = std::min(kMostLeafOpacity, kFillInk * pixels / ink.leaves);
      if (level.line_opacity < kFaintest) break;

      // Go on to the children of these boxes.
      std::vector<Item> next;
      for (const Item& item : items) add_children(item, next);
      level.items = std::move(items);
      levels.push_back(std::move(level));
      items = std::move(next);
    }

    // Draw the deepest level first, so that the boxes at the top of the tree stay clear; draw lines over slabs.
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
      for (const Item& item : level->items) draw_fills(item, *level);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
      for (const Item& item : level->items) draw_lines(item, *level);
    canvas_.clip_to(0, 0, canvas_.width(), canvas_.height());
  }

 private:
  struct Item {
    std::int64_t node;
    Aabb box;
  };
  struct Level {
    std::vector<Item> items;
    Vec3d colour;
    double line_opacity = 1, slab_opacity = 1, leaf_opacity = 1;
  };
  struct Ink {
    double lines = 0, slabs = 0, leaves = 0;
  };

  const Node& node_of(const Item& item) const { return tree_.nodes[static_cast<std::size_t>(item.node)]; }

  // The inside of a node: the slab between its children, or the part that a one-sided node cuts off.
  struct Slab {
    bool exists = false;
    Aabb box;
    Vec3d colour;
  };
  static Slab slab_of(const Node& node, const Aabb& box) {
    Slab slab{false, box, colours::kGap};
    const int axis = node.split_axis;
    if (node.kind == NodeKind::split) {
      const bool gap = node.left_clip < node.right_clip;
      slab.box.lo[axis] = std::max(box.lo[axis], gap ? node.left_clip : node.right_clip);
      slab.box.hi[axis] = std::min(box.hi[axis], gap ? node.right_clip : node.left_clip);
      slab.colour = gap ? colours::kGap : colours::kOverlap;
    } else if (node.kind == NodeKind::one_left) {
      slab.box.lo[axis] = std::max(box.lo[axis], node.left_clip);
      slab.colour = colours::kEmpty;
    } else if (node.kind == NodeKind::one_right) {
      slab.box.hi[axis] = std::min(box.hi[axis], node.right_clip);
      slab.colour = colours::kEmpty;
    } else {
      return slab;
    }
    slab.exists = slab.box.lo[axis] < slab.box.hi[axis];
    return slab;
  }

  SeenBox see(const Aabb& box) const {
    SeenBox seen;
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3d stored{double((i & 1) != 0 ? box.hi.x : box.lo.x), double((i & 2) != 0 ? box.hi.y : box.lo.y),
                         double((i & 4) != 0 ? box.hi.z : box.lo.z)};
      seen.corner[i] = places_.from_eye(stored * unit_);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int i = static_cast<int>(axis);
      seen.faces_eye[2 * axis] = parallel_ ? view_[i] > 0 : eye_[i] < double(box.lo[i]) * unit_;
      seen.faces_eye[2 * axis + 1] = parallel_ ? view_[i] < 0 : eye_[i] > double(box.hi[i]) * unit_;
    }
    return seen;
  }

  CanvasPoint place(Vec3d from_eye) const {
    return {area_.x0 + places_.x_px(from_eye), area_.y0 + places_.y_px(from_eye)};
  }

  // The point of the line from a to b at the nearest drawn distance.
  Vec3d cut(Vec3d a, Vec3d b) const {
    Vec3d point = a + (b - a) * ((nearest_ - a.z) / (b.z - a.z));
    point.z = nearest_;
    return point;
  }

  // Calls use(polygon) for each side that faces the eye. Together these sides tile the box's silhouette.
  template <class Use>
  void for_each_face(const SeenBox& seen, const Use& use) const {
    for (std::size_t face = 0; face < 6; ++face) {
      if (!seen.faces_eye[face]) continue;
      const std::size_t axis = face / 2;
      const std::size_t base = (face & 1) << axis;
      const std::size_t u = std::size_t{1} << (axis + 1) % 3;
      const std::size_t v = std::size_t{1} << (axis + 2) % 3;
      const std::array<std::size_t, 4> around{base, base | u, base | u | v, base | v};
      Polygon polygon;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d a = seen.corner[around[i]];
        const Vec3d b = seen.corner[around[(i + 1) % 4]];
        const auto add = [&](Vec3d point) { polygon.points[static_cast<std::size_t>(polygon.count++)] = place(point); };
        if (a.z >= nearest_) add(a);
        if ((a.z >= nearest_) != (b.z >= nearest_)) add(cut(a, b));
      }
      if (polygon.count >= 3) use(polygon);
    }
  }

  // Calls use(a, b) for each of the twelve edges, cut to the part before the eye.
  template <class Use>
  void for_each_edge(const SeenBox& seen, const Use& use) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < 8; ++i) {
        if ((i >> axis & 1) != 0) continue;
        Vec3d a = seen.corner[i];
        Vec3d b = seen.corner[i | std::size_t{1} << axis];
        if (a.z < nearest_ && b.z < nearest_) continue;
        if (a.z < nearest_) a = cut(a, b);
        if (b.z < nearest_) b = cut(b, a);
        use(place(a), place(b));
      }
  }

  // Long lines count only as far as they lie inside the part; its diagonal is a rough limit.
  double line_px(CanvasPoint a, CanvasPoint b) const {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    return std::min(std::sqrt(dx * dx + dy * dy), area_.width() + area_.height());
  }

  double silhouette_px(const SeenBox& seen) const {
    double area = 0;
    for_each_face(seen, [&](const Polygon& polygon) { area += area_of(polygon); });
    return std::min(area, area_.width() * area_.height());
  }

  void measure(const Item& item, Ink& ink) const {
    const Node& node = node_of(item);
    const SeenBox seen = see(item.box);
    for_each_edge(seen, [&](CanvasPoint a, CanvasPoint b) { ink.lines += line_px(a, b); });
    if (node.is_leaf()) ink.leaves += silhouette_px(seen);
    if (node.kind == NodeKind::clip)
      for_each_edge(see(child_boxes(node, item.box).first),
                    [&](CanvasPoint a, CanvasPoint b) { ink.lines += line_px(a, b); });
    if (const Slab slab = slab_of(node, item.box); slab.exists) ink.slabs += silhouette_px(see(slab.box));
  }

  void draw_fills(const Item& item, const Level& level) {
    const Node& node = node_of(item);
    const auto fill = [&](const Aabb& box, Vec3d colour, double opacity) {
      for_each_face(see(box), [&](const Polygon& polygon) {
        canvas_.blend_polygon(polygon.points.data(), polygon.count, colour, opacity);
      });
    };
    if (node.is_leaf()) fill(item.box, level.colour, level.leaf_opacity);
    if (const Slab slab = slab_of(node, item.box); slab.exists) fill(slab.box, slab.colour, level.slab_opacity);
  }

  void draw_lines(const Item& item, const Level& level) {
    const Node& node = node_of(item);
    const auto outline = [&](const Aabb& box, Vec3d colour) {
      for_each_edge(see(box), [&](CanvasPoint a, CanvasPoint b) {
        canvas_.blend_line(a, b, kLinePx, colour, level.line_opacity);
      });
    };
    outline(item.box, level.colour);
    if (node.kind == NodeKind::clip) outline(child_boxes(node, item.box).first, colours::kClip);
  }

  // The children are left out if the node's box is too small or outside of the picture.
  void add_children(const Item& item, std::vector<Item>& next) const {
    const Node& node = node_of(item);
    if (node.is_leaf()) return;
    CanvasArea seen_in{INFINITY, INFINITY, -INFINITY, -INFINITY};
    for_each_edge(see(item.box), [&](CanvasPoint a, CanvasPoint b) {
      seen_in.x0 = std::min({seen_in.x0, a.x, b.x});
      seen_in.x1 = std::max({seen_in.x1, a.x, b.x});
      seen_in.y0 = std::min({seen_in.y0, a.y, b.y});
      seen_in.y1 = std::max({seen_in.y1, a.y, b.y});
    });
    if (std::max(seen_in.width(), seen_in.height()) < kSmallestPx || !(seen_in.width() >= 0)) return;
    if (seen_in.x1 < area_.x0 || seen_in.x0 > area_.x1 || seen_in.y1 < area_.y0 || seen_in.y0 > area_.y1) return;
    const ChildBoxes boxes = child_boxes(node, item.box);
    next.push_back({node.first, boxes.first});
    if (node.kind == NodeKind::split) next.push_back({node.right_child(), boxes.second});
  }

  Canvas& canvas_;
  CanvasArea area_;
  const Tree& tree_;
  double unit_;
  Vec3d eye_;
  bool parallel_;  // rays along view_, not from the eye
  Vec3d view_;
  PixelPlaces places_;
  std::int64_t deepest_;
  double nearest_ = 0;
};

}  // namespace

void draw_tree_boxes(Canvas& canvas, const CanvasArea& area, const Tree& tree, double world_from_stored,
                     const Camera& camera) {
  if (area.width() >= 1 && area.height() >= 1) Boxes(canvas, area, tree, world_from_stored, camera).draw();
}

}  // namespace bihive
