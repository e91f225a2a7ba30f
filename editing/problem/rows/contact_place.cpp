// SPDX-License-Identifier: MIT
#include "editing/problem/rows/contact_place.hpp"

#include <array>

#include "adjoint/base/errors.h"
#include "editing/problem/rows/pose_seeds.hpp"

namespace carom::editing_detail {
namespace {

/// Of a ContactJacobian: its rows from here on are those of the point.
constexpr int kPointRow = 4;

/// A contact as it depends on the poses of its bodies; kept beyond the motion.
struct TouchedAt {
  int a = -1, b = -1;
  FeaturePair features;
  Pose pose_a, pose_b;
};

void append(std::vector<StateSeed>& all, std::vector<StateSeed> more, double share) {
  for (StateSeed& seed : more) all.push_back(std::move(seed *= share));
}

}  // namespace

std::vector<const Contact*> contactsOf(const Event& event, int body, int with) {
  std::vector<const Contact*> own;
  for (const Contact& contact : event.contacts) {
    if (!contact.counted || contact.held || (contact.a != body && contact.b != body)) continue;
    if (with < 0 || contact.a == with || contact.b == with) own.push_back(&contact);
  }
  return own;
}

Vec3 contactPlace(const Motion& motion, int event, int body, int with) {
  const std::vector<const Contact*> own = contactsOf(motion.events[static_cast<std::size_t>(event)], body, with);
  if (own.empty()) throw InputError("found an event without a reported contact of the body, expected an impact of it");
  Vec3 sum = Vec3::Zero();
  for (const Contact* contact : own) sum += contact->at.point;
  return sum / static_cast<double>(own.size());
}

RowReading readContactPlace(const QuantityPlace& place) {
  const Motion& motion = place.motion;
  const Instant at = place.at;
  const int row = kPointRow + place.component;
  const std::vector<const Contact*> own =
      contactsOf(motion.events[static_cast<std::size_t>(at.event)], place.body, place.with);
  const double share = 1 / static_cast<double>(own.size());
  RowReading out;
  out.value = contactPlace(motion, at.event, place.body, place.with)[place.component];
  std::vector<TouchedAt> touched;
  for (const Contact* c : own) {
    const Pose A = shapePoseAt(motion, c->a, at), B = shapePoseAt(motion, c->b, at);
    append(out.seeds, seedsOfPair(motion.geometry->jacobian(c->a, c->b, c->features, A, B), row, c->a, c->b, at), share);
    touched.push_back({c->a, c->b, c->features, A, B});
  }
  out.second_order = true;
  out.seed_rates = [touched, row, at, share, geometry = motion.geometry](std::span<const BodyStateRate> rates) {
    std::vector<StateSeed> of;
    for (std::size_t k = 0; k < touched.size(); ++k) {
      const TouchedAt& c = touched[k];
      const std::array<PairTangent, 1> along{tangentOfPair(rates[2 * k], rates[2 * k + 1])};
      const ContactJacobian d = geometry->jacobianRates(c.a, c.b, c.features, c.pose_a, c.pose_b, along)[0];
      append(of, seedsOfPair(d, row, c.a, c.b, at), share);
    }
    return of;
  };
  return out;
}

}  // namespace carom::editing_detail
