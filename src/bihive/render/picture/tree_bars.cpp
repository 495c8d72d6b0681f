// The second part of the tree's drawing: a bar for every node, by depth.

#include <algorithm>
#include <vector>

#include "bihive/bih/child_boxes.h"
#include "bihive/bih/statistics.h"
#include "bihive/render/picture/tree_colours.h"
#include "bihive/render/tree_picture.h"

namespace bihive {
namespace {

namespace colours = tree_colours;

// An inner node's bar is dimmer than a leaf of its depth.
constexpr double kInnerShade = 0.45;
constexpr double kCutShade = 0.40;
// Rows are at most this share of the part, so that a tree of one leaf is a bar and not a wall.
constexpr std::int64_t kFewestRows = 8;
// Bars of at least this size have a dark edge of one pixel.
constexpr double kEdgedPx = 5;

// A node to draw: its box along the axes, and the bar's place.
struct Job {
  std::int64_t node;
  std::int64_t depth;
  std::int64_t first_sphere;
  Aabb box;
};

class Bars {
 public:
  Bars(Canvas& canvas, const CanvasArea& area, const Tree& tree)
      : canvas_(canvas),
        area_(area),
        tree_(tree),
        deepest_(tree_statistics(tree).depth.max),
        row_px_(area.height() / static_cast<double>(std::max(deepest_, kFewestRows))) {
    count_spheres();
  }

  void draw() {
    canvas_.add_rectangle(area_, colours::kPaper);

    // A set without spheres has one leaf, which fills its row.
    const std::int64_t all = std::max<std::int64_t>(1, static_cast<std::int64_t>(tree_.sphere_ids.size()));
    sphere_px_ = area_.width() / static_cast<double>(all);
    if (tree_.sphere_ids.empty()) spheres_of_[0] = 1;

    std::vector<Job> waiting{{0, 1, 0, tree_.aabb}};
    while (!waiting.empty()) {
      const Job job = waiting.back();
      waiting.pop_back();
      const Node& node = tree_.nodes[static_cast<std::size_t>(job.node)];
      draw_bar(job, node);
      if (node.is_leaf()) continue;
      const std::int64_t left_spheres = spheres_of_[static_cast<std::size_t>(node.first)];
      const ChildBoxes boxes = child_boxes(node, job.box);
      waiting.push_back({node.first, job.depth + 1, job.first_sphere, boxes.first});
      if (node.kind == NodeKind::split)
        waiting.push_back({node.right_child(), job.depth + 1, job.first_sphere + left_spheres, boxes.second});
    }
  }

 private:
  // The number of spheres below each node. Parents have smaller numbers than their children, so add up in reverse.
  void count_spheres() {
    std::vector<std::int64_t> order{0};
    order.reserve(tree_.nodes.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Node& node = tree_.nodes[static_cast<std::size_t>(order[i])];
      if (node.is_leaf()) continue;
      order.push_back(node.first);
      if (node.kind == NodeKind::split) order.push_back(node.right_child());
    }
    spheres_of_.resize(tree_.nodes.size());
    for (auto position = order.rbegin(); position != order.rend(); ++position) {
      const auto i = static_cast<std::size_t>(*position);
      const Node& node = tree_.nodes[i];
      spheres_of_[i] = node.is_leaf() ? node.sphere_count : spheres_of_[static_cast<std::size_t>(node.first)];
      if (node.kind == NodeKind::split) spheres_of_[i] += spheres_of_[static_cast<std::size_t>(node.right_child())];
    }
  }

  void draw_bar(const Job& job, const Node& node) {
    // Place the bar, and leave a dark edge if there is room.
    CanvasArea bar;
    bar.x0 = area_.x0 + static_cast<double>(job.first_sphere) * sphere_px_;
    bar.x1 = bar.x0 + static_cast<double>(spheres_of_[static_cast<std::size_t>(job.node)]) * sphere_px_;
    bar.y0 = area_.y0 + static_cast<double>(job.depth - 1) * row_px_;
    bar.y1 = bar.y0 + row_px_;
    if (bar.width() >= kEdgedPx) bar.x1 -= 1;
    if (row_px_ >= kEdgedPx) bar.y1 -= 1;

    const Vec3d colour = colours::of_depth(job.depth, deepest_);
    if (node.is_leaf()) {
      const bool forced = node.sphere_count > tree_.parameters.max_prims && job.depth < tree_.parameters.max_depth;
      return add(bar, forced ? colours::kForced : colour);
    }

    // Run along the box: from its lower side over the two planes to its upper side.
    const int axis = node.split_axis;
    const double lo = double(job.box.lo[axis]);
    const double length = double(job.box.hi[axis]) - lo;
    const auto share = [&](float plane) {
      return length > 0 ? std::clamp((double(plane) - lo) / length, 0.0, 1.0) : 0.5;
    };
    const double left = share(node.left_clip);
    const double right = share(node.right_clip);
    const Vec3d inner = colour * kInnerShade;
    switch (node.kind) {
      case NodeKind::split: {
        const double a = std::min(left, right);
        const double b = std::max(left, right);
        const bool gap = node.left_clip < node.right_clip;
        return draw_parts(bar, a, b, inner, gap ? colours::kGap : colours::kOverlap, inner);
      }
      case NodeKind::clip:
        return draw_parts(bar, left, right, colours::kClip, colours::kClip * kCutShade, colours::kClip);
      case NodeKind::one_left:
        return draw_parts(bar, left, 1, colours::kEmpty * kCutShade, colours::kEmpty, {});
      case NodeKind::one_right:
        return draw_parts(bar, 0, right, {}, colours::kEmpty, colours::kEmpty * kCutShade);
      case NodeKind::leaf:
        break;
    }
  }

  // Bars never overlap, so the sum of colour and background is the colour itself.
  void add(const CanvasArea& area, Vec3d colour) { canvas_.add_rectangle(area, colour - colours::kPaper); }

  // A bar in three colours; they change at the shares a <= b of its width.
  void draw_parts(const CanvasArea& bar, double a, double b, Vec3d first, Vec3d second, Vec3d third) {
    const double xa = bar.x0 + a * bar.width();
    const double xb = bar.x0 + b * bar.width();
    add({bar.x0, bar.y0, xa, bar.y1}, first);
    add({xa, bar.y0, xb, bar.y1}, second);
    add({xb, bar.y0, bar.x1, bar.y1}, third);
  }

  Canvas& canvas_;
  CanvasArea area_;
  const Tree& tree_;
  std::int64_t deepest_;
  double row_px_;
  double sphere_px_ = 0;
  std::vector<std::int64_t> spheres_of_;
};

}  // namespace

void draw_tree_bars(Canvas& canvas, const CanvasArea& area, const Tree& tree) {
  Bars(canvas, area, tree).draw();
}

}  // namespace bihive
