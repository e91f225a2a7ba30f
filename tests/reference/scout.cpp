// SPDX-License-Identifier: MIT
#include <limits>

#include "tests/reference/world_lines.h"

// A dense search for the impact sequence in double, on the flights of the replay. It is slow and simple on purpose: no
// bound, no motion of features, only the separation of two placed shapes.

namespace carom::reference {
namespace {

constexpr double kStep = 2e-3;    ///< s, between samples
constexpr int kRefinements = 64;  ///< samples in a step, to find the end of an earlier touch
constexpr double kApart = 1e-9;   ///< m, the gap after which a pair can touch anew

struct Solid {
  BodyNumbers::Kind kind;
  Vec3 x, half;  ///< half edges; radius first for a sphere
  Mat3 R;
  Vec3 normal;
  double offset;

  Vec3 support(const Vec3& direction) const {
    const Vec3 local = R.transpose() * direction;
    return x + R * Vec3(std::copysign(half[0], local[0]), std::copysign(half[1], local[1]),
                        std::copysign(half[2], local[2]));
  }
};

struct Separation {
  double gap = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ(), point = Vec3::Zero();
};

Separation sphereOnBox(const Solid& s, const Solid& box) {
  const Vec3 local = box.R.transpose() * (s.x - box.x);
  const Vec3 nearest = box.x + box.R * local.cwiseMax(-box.half).cwiseMin(box.half);
  const double distance = (s.x - nearest).norm();
  return {distance - s.half[0], (s.x - nearest) / distance, nearest};
}

/// Separating axes. The axis of the largest gap is the contact normal at the instant of touching.
Separation boxOnBox(const Solid& a, const Solid& b) {
  Separation best;
  for (int i = 0; i < 3; ++i) {
    for (const double sign : {-1., 1.}) {
      const Vec3 n = sign * b.R.col(i), m = sign * a.R.col(i);
      const Vec3 p = a.support(-n), q = b.support(-m);
      const double gap_b = n.dot(p - b.x) - b.half[i], gap_a = m.dot(q - a.x) - a.half[i];
      if (gap_b > best.gap) best = {gap_b, n, p};
      if (gap_a > best.gap) best = {gap_a, -m, q};
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 d = a.R.col(i), e = b.R.col(j), w = d.cross(e);
      if (w.norm() < 1e-9) continue;
      for (const double sign : {-1., 1.}) {
        const Vec3 n = sign * w.normalized();
        const Vec3 p = a.support(-n), q = b.support(n);
        if (!(n.dot(p - q) > best.gap)) continue;
        const double t = (p - q).cross(d).dot(w) / -w.squaredNorm();
        best = {n.dot(p - q), n, q + t * e};
      }
    }
  }
  return best;
}

Separation separationOf(const Solid& a, const Solid& b) {
  using Kind = BodyNumbers::Kind;
  if (a.kind > b.kind) {
    const Separation s = separationOf(b, a);
    return {s.gap, -s.normal, s.point};
  }
  if (b.kind == Kind::plane) {
    const Vec3 n = b.R * b.normal;
    const Vec3 p = a.kind == Kind::sphere ? Vec3(a.x - a.half[0] * n) : a.support(-n);
    return {n.dot(p - b.x) - b.offset, n, p};
  }
  if (b.kind == Kind::sphere) {
    const double distance = (a.x - b.x).norm();
    const Vec3 n = (a.x - b.x) / distance;
    return {distance - a.half[0] - b.half[0], n, b.x + b.half[0] * n};
  }
  return a.kind == Kind::sphere ? sphereOnBox(a, b) : boxOnBox(a, b);
}

class Scout {
 public:
  explicit Scout(const Scene& scene) : lines_(numbersOf(scene)) {}

  Sequence run(double duration) {
    Sequence found;
    double now = 0;
    while (now < duration) {
      const double next = std::min(now + kStep, duration);
      const std::optional<Impact> impact = firstImpact(now, next);
      if (!impact) {
        now = next;
        continue;
      }
      FrozenImpact f = lines_.recognise(*impact);
      lines_.apply(f, ImpactTimes::follow, true);
      found.push_back(*impact);
      now = static_cast<double>(f.time);
      if (found.size() > 200) throw std::runtime_error("too many impacts for a scout");
    }
    return found;
  }

 private:
  Solid solidAt(int body, double t) const {
    const Placed placed = lines_.placedAt(body, t);
    const BodyNumbers& n = *placed.body;
    const double scale = n.kind == BodyNumbers::Kind::box ? 0.5 : 1;
    return {n.kind,
            placed.x.rounded(),
            scale * n.size.rounded(),
            rounded(placed.R),
            n.plane_normal.rounded(),
            static_cast<double>(n.plane_offset)};
  }
  Separation separation(int a, int b, double t) const { return separationOf(solidAt(a, t), solidAt(b, t)); }

  std::optional<Impact> firstImpact(double now, double next) const {
    std::vector<Solid> solids;
    for (int i = 0; i < lines_.bodies(); ++i) solids.push_back(solidAt(i, next));
    std::optional<Impact> first;
    for (int a = 0; a < lines_.bodies(); ++a) {
      for (int b = a + 1; b < lines_.bodies(); ++b) {
        if (!lines_.numbers().bodies[a].moving && !lines_.numbers().bodies[b].moving) continue;
        if (separationOf(solids[a], solids[b]).gap >= 0) continue;
        const Impact impact = bisect(a, b, now, next);
        if (!first || impact.time < first->time) first = impact;
      }
    }
    return first;
  }

  Impact bisect(int a, int b, double now, double next) const {
    double lo = now, hi = next;
    bool apart = separation(a, b, lo).gap > kApart;
    for (int i = kRefinements - 1; i > 0 && !apart; --i) {
      lo = next - (next - now) * i / kRefinements;
      apart = separation(a, b, lo).gap > kApart;
    }
    if (!apart) throw std::runtime_error("two impacts of a pair come too soon after one another for the scout");
    for (int i = 0; i < 50; ++i) {
      const double mid = (lo + hi) / 2;
      (separation(a, b, mid).gap >= 0 ? lo : hi) = mid;
    }
    const Separation s = separation(a, b, lo);
    return {lo, a, b, s.point, s.normal};
  }

  WorldLines lines_;
};

}  // namespace

Sequence scout(const Scene& scene, double duration) { return Scout(scene).run(duration); }

}  // namespace carom::reference
