#include "bihive/job/rigid_motion.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "bihive/math/symmetric_eigen.h"

namespace bihive {

Vec3d mean_of(const std::vector<Vec3d>& points) {
  // About the first one, so that points far from 0 keep their digits.
  Vec3d sum;
  for (const Vec3d point : points) sum = sum + (point - points.front());
  return points.front() + sum / static_cast<double>(points.size());
}

RigidMotion superposition(const std::vector<Vec3d>& moving, const std::vector<Vec3d>& still) {
  const Vec3d from = mean_of(moving), to = mean_of(still);
  double s[3][3] = {};
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Vec3d a = moving[i] - from, b = still[i] - to;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) s[row][column] += a[row] * b[column];
  }
  // Horn's matrix: its eigenvector of the greatest eigenvalue is the quaternion of the rotation.
  const double xx = s[0][0], yy = s[1][1], zz = s[2][2];
  const double x = s[1][2] - s[2][1], y = s[2][0] - s[0][2], z = s[0][1] - s[1][0];
  const double xy = s[0][1] + s[1][0], zx = s[2][0] + s[0][2], yz = s[1][2] + s[2][1];
  const Eigensystem<4> system = eigensystem_of<4>(
      {{{xx + yy + zz, x, y, z}, {x, xx - yy - zz, xy, zx}, {y, xy, yy - xx - zz, yz}, {z, zx, yz, zz - xx - yy}}});
  const auto [w, i, j, k] = system.vectors[0];
  RigidMotion motion;
  motion.rows = {Vec3d{w * w + i * i - j * j - k * k, 2 * (i * j - w * k), 2 * (i * k + w * j)},
                 Vec3d{2 * (i * j + w * k), w * w - i * i + j * j - k * k, 2 * (j * k - w * i)},
                 Vec3d{2 * (i * k - w * j), 2 * (j * k + w * i), w * w - i * i - j * j + k * k}};
  motion.shift = to - motion.turned(from);
  return motion;
}

Status move_spheres(SphereSet& spheres, const RigidMotion& motion) {
  std::vector<double> x, y, z, r;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d local = spheres.to_local(motion(spheres.centre(id)));
    x.push_back(local.x);
    y.push_back(local.y);
    z.push_back(local.z);
    r.push_back(spheres.radius(id));
  }
  Result<SphereSet> moved = SphereSet::from_local(x, y, z, r, spheres.origin());
  if (!moved) return moved.error();
  if (spheres.cell()) {
    Cell cell = *spheres.cell();
    cell.origin = motion(cell.origin);
    for (Vec3d& vector : cell.vectors) vector = motion.turned(vector);
    moved->cell() = cell;
  }
  moved->attributes() = std::move(spheres.attributes());
  spheres = std::move(*moved);
  return Done{};
}

}  // namespace bihive
