// SPDX-License-Identifier: MIT
#include "adjoint/simulate/flat_disc.hpp"

#include "adjoint/simulate/contact_acceleration.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr std::size_t kMarksOfRim = 4;

Vec3 outwards(const FlatDisc& disc, const Vec3& point, const Vec3& normal) {
  const Vec3 out = point - disc.center;
  return out - normal.dot(out) * normal;
}

}  // namespace

std::optional<FlatDisc> FlatDisc::of(const Motion& motion, const std::vector<const Contact*>& contacts) {
  if (contacts.size() != kMarksOfRim) return std::nullopt;
  const auto first = rimOf(motion, *contacts[0]);
  if (!first) return std::nullopt;
  FlatDisc disc;
  disc.radius = first->radius;
  for (const Contact* c : contacts) {
    const auto rim = rimOf(motion, *c);
    if (!rim || c->features == rim->features || !(rim->features == first->features) || c->a != contacts[0]->a || c->b != contacts[0]->b)
      return std::nullopt;
    disc.center += c->at.point / static_cast<double>(kMarksOfRim);
  }
  return disc;
}

double FlatDisc::roomAround(const Vec3& point, const Vec3& normal) const { return radius - outwards(*this, point, normal).norm(); }

Vec3 FlatDisc::borderAt(const Vec3& point, const Vec3& normal) const {
  return center + radius * outwards(*this, point, normal).normalized();
}

}  // namespace carom::adjoint_detail
