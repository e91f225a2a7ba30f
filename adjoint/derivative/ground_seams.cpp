// SPDX-License-Identifier: MIT
#include "adjoint/derivative/ground_seams.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_distance.hpp"

namespace carom::adjoint_detail {
namespace {

// Normals this alike, and points this near to one plane (as a share of the size of positions), are those of one face; what is
// this near touches.
constexpr double kOneFace = 1e-9;

}  // namespace

std::vector<int> flushBodiesOf(const Motion& motion, const Event& event) {
  std::vector<int> out;
  if (event.contacts.size() < 2) return out;
  const auto isFixed = [&](int body) { return motion.world_lines[static_cast<std::size_t>(body)].arcs.front().stays(); };
  const auto* distance = dynamic_cast<const BodyDistance*>(motion.geometry.get());
  const auto poseOf = [&](int body) {
    const Kinematics k = motion.world_lines[static_cast<std::size_t>(body)].arcs.front().kinematicsAt(0);
    return Pose{k.x, k.R};
  };
  for (std::size_t i = 0; i < event.contacts.size(); ++i)
    for (std::size_t j = i + 1; j < event.contacts.size(); ++j) {
      const Contact &c = event.contacts[i], &d = event.contacts[j];
      if (isFixed(c.a) == isFixed(c.b) || isFixed(d.a) == isFixed(d.b)) continue;
      const int one = isFixed(c.a) ? c.a : c.b, other = isFixed(d.a) ? d.a : d.b;
      if (one == other || (isFixed(c.a) ? c.b : c.a) != (isFixed(d.a) ? d.b : d.a)) continue;
      const Vec3 n = isFixed(c.a) ? c.at.normal : Vec3(-c.at.normal), m = isFixed(d.a) ? d.at.normal : Vec3(-d.at.normal);
      const Participant* moved = event.find(isFixed(c.a) ? c.b : c.a);
      const double arm = moved ? (c.at.point - moved->before.x).norm() : 0;
      const double room = kOneFace * (arm + c.at.point.norm());
      if ((n - m).norm() > kOneFace || std::abs(n.dot(c.at.point - d.at.point)) > room) continue;
      const int first = std::min(one, other), second = std::max(one, other);
      if (distance && distance->nearest(first, second, poseOf(first), poseOf(second)).gap > room) continue;
      out.insert(out.end(), {one, other});
    }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace carom::adjoint_detail
