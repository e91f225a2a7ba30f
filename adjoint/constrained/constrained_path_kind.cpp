// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/constrained/constrained_path.hpp"

namespace carom::adjoint_detail {
namespace {

// A body that turns otherwise than its support by less than this share of the unit of speed goes with it.
constexpr double kGoesWith = 1e-9;

}  // namespace

// Whether the body goes as its support does, which moves: all of one rigid body.
bool ConstrainedPath::goesWithSupport(const ConstrainedInstant& now) const {
  if (contacts_.empty() || slides() || !scene_.isDriven()) return false;
  const SupportInstant<double> support = scene_.with[0].at(start_);
  Vec3 spin = support.w;
  const Vec3& n = now.contacts[0].n;
  if (support.has_belt) spin += n.dot(Vec3(support.R * support.surface_angular_velocity)) * n;
  return (now.body.omega - spin).norm() * scene_.length <= kGoesWith * scene_.speed;
}

bool ConstrainedPath::slides() const {
  return std::ranges::any_of(contacts_, [](const PersistentContact& c) { return c.mode == ContactMode::slides; });
}

ArcKind ConstrainedPath::kind() const {
  if (slides()) return ArcKind::slide;
  if (rides_) return ArcKind::ride;
  return rolls_ ? ArcKind::roll : ArcKind::pivot;
}

}  // namespace carom::adjoint_detail
