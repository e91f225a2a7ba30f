// SPDX-License-Identifier: MIT
#include "editing/report/motion_checks.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/group/group_path.hpp"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/motion/body_geometry.h"

namespace carom::editing_detail {
namespace {

/// Pairs of bodies that are looked at for overlaps; where there would be more, only every so many-th flight is.
constexpr std::size_t kMostPairs = 2'000'000;

double kineticEnergy(const BodyModel& model, const State& s) {
  if (model.kinematic) return 0;  // of a body without mass
  const Vec3 L_B = s.q.conjugate() * s.L;
  return 0.5 * (model.mass * s.v.squaredNorm() + L_B.dot(model.inverse_inertia.cwiseProduct(L_B)));
}

double endOf(const Motion& motion, const WorldLine& line, std::size_t k) {
  return k < line.events.size() ? motion.events[static_cast<std::size_t>(line.events[k])].time : motion.end;
}

// The largest energy that comes or goes at samples + 1 times, as a share of what there is; where it `slides`, that comes.
// energy_at(t): {kinetic, potential less the work of supports}.
template <class EnergyAt>
double driftBy(const EnergyAt& energy_at, double start, double end, int samples, bool slides) {
  const auto [kinetic, height] = energy_at(start);
  double drift = 0, most = kinetic, work = 0;
  for (int i = 1; i <= samples + 1; ++i) {
    const auto [now, potential] = energy_at(i > samples ? end : start + (end - start) * i / (samples + 1));
    const double gained = potential - height;
    drift = std::max(drift, slides ? now - kinetic + gained : std::abs(now - kinetic + gained));
    most = std::max(most, now);
    work = std::max(work, std::abs(gained));
  }
  return most + work > 0 ? drift / (most + work) : 0;
}

double driftOf(const Arc& arc, const Vec3& of_scene, double end, int samples) {
  const BodyModel& model = arc.model();
  const Vec3 gravity = model.gravity_factor * of_scene;
  const ConstrainedPath* constrained = arc.trajectory().constrained();
  const auto energy_at = [&](double t) {
    const State s = t > arc.start() ? arc.stateAt(t) : arc.startState();
    return std::pair(kineticEnergy(model, s), -model.mass * gravity.dot(s.x) - (constrained && t > arc.start() ? constrained->supportWork(t) : 0));
  };
  return driftBy(energy_at, arc.start(), end, samples, arc.kind() == ArcKind::slide);
}

// Of all bodies that move on each other; none is told where supports do work.
double driftOf(const GroupPath& path, double end, int samples) {
  if (std::ranges::any_of(path.scene().with, &Support::drives)) return 0;
  const auto energy_at = [&](double t) {
    std::pair<double, double> sum{0, 0};
    for (std::size_t m = 0; m < path.scene().members.size(); ++m) {
      const GroupMember& of = path.scene().members[m];
      const State s = path.stateAt(m, t);
      sum.first += kineticEnergy(*of.model, s), sum.second -= of.model->mass * of.gravity.dot(s.x);
    }
    return sum;
  };
  const bool slides = std::ranges::any_of(path.contacts(), &GroupContact::turns);
  return driftBy(energy_at, path.start(), end, samples, slides);
}

/// Fractions of a flight at which overlaps are looked for: its middle, and ever nearer to both ends, where bodies are
/// near each other; the ends are impacts and come last.
std::vector<double> towardsEnds(int samples) {
  std::vector<double> fractions{0, 1, 0.5};
  double nearness = 0.25;
  for (int i = 1; i < samples; i += 2, nearness /= 2) fractions.insert(fractions.end(), {nearness, 1 - nearness});
  return fractions;
}

class Overlaps {
 public:
  Overlaps(const Motion& motion, const BodyGeometry& bodies) : motion_(motion), bodies_(bodies) {}

  void lookAt(int body, const Arc& arc, double t) {
    const Pose own = poseOf(arc, t);
    const int n = static_cast<int>(motion_.world_lines.size());
    for (int other = 0; other < n; ++other) {
      if (other == body || !meets(body, other, t)) continue;
      const Arc& its =
          motion_.world_lines[static_cast<std::size_t>(other)].arcs[static_cast<std::size_t>(motion_.arcAt(other, t))];
      // far apart, mostly; a half space has no bound
      const double apart = bodies_.boundingRadius(body) + bodies_.boundingRadius(other);
      if ((own.x - its.positionAt(t)).squaredNorm() > apart * apart) continue;
      deepest_ = std::max(deepest_, bodies_.overlap(body, other, own, poseOf(its, t)));
    }
  }
  double deepest() const { return deepest_; }

 private:
  // Bodies that do not collide may overlap, as may those that did at the start until they part.
  bool meets(int body, int other, double t) const {
    const auto& bodies = motion_.scene->bodies;
    if (!mayCollide(bodies[static_cast<std::size_t>(body)], bodies[static_cast<std::size_t>(other)])) return false;
    return std::none_of(motion_.overlaps.begin(), motion_.overlaps.end(), [&](const StartOverlap& o) {
      return o.a == std::min(body, other) && o.b == std::max(body, other) && !(o.parted && *o.parted <= t);
    });
  }
  static Pose poseOf(const Arc& arc, double t) {
    const Kinematics k = arc.kinematicsAt(t);
    return {k.x, k.R};
  }

  const Motion& motion_;
  const BodyGeometry& bodies_;
  double deepest_ = 0;
};

}  // namespace

double energyDrift(const Motion& motion, int samples) {
  double worst = 0;
  for (const WorldLine& line : motion.world_lines) {
    for (std::size_t k = 0; k < line.arcs.size(); ++k) {
      const double end = endOf(motion, line, k);
      const Arc& arc = line.arcs[k];
      if (!arc.moving() || !(end > arc.start())) continue;
      if (const GroupPath* group = arc.trajectory().group()) worst = std::max(worst, arc.slot() == 0 ? driftOf(*group, end, samples) : 0);
      else worst = std::max(worst, driftOf(arc, motion.scene->gravity, end, samples));
    }
  }
  return worst;
}

namespace {

// By kinematic bodies and moving surfaces, whose velocities stay as they are: that of their surface times the impulse on the
// other body.
double workDone(const Motion& motion, const Event& event) {
  double work = 0;
  for (const Contact& c : event.contacts) work -= c.surface_velocity.dot(c.impulse);
  for (const Participant& p : event.participants) {
    const BodyModel& model = (*motion.models)[static_cast<std::size_t>(p.body)];
    if (!model.kinematic) continue;
    for (const Contact& c : event.contacts) {
      if (c.a != p.body && c.b != p.body) continue;
      const Vec3 surface = p.before.v + p.before.L.cross(c.at.point - p.before.x);
      work += (c.a == p.body ? -1.0 : 1.0) * surface.dot(c.impulse);
    }
  }
  return work;
}

}  // namespace

double energyGain(const Motion& motion) {
  double worst = 0;
  for (const Event& event : motion.events) {
    double before = 0, after = 0;
    for (const Participant& p : event.participants) {
      const WorldLine& line = motion.world_lines[static_cast<std::size_t>(p.body)];
      const BodyModel& model = (*motion.models)[static_cast<std::size_t>(p.body)];
      before += kineticEnergy(model, p.before);
      after += kineticEnergy(model, line.arcs[static_cast<std::size_t>(p.next())].startState());
    }
    after -= workDone(motion, event);
    if (before > 0) worst = std::max(worst, after / before - 1);
  }
  return worst;
}

std::optional<double> deepestPenetration(const Motion& motion, int samples, const std::function<void()>& between) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion.geometry.get());
  if (!bodies) return std::nullopt;
  Overlaps overlaps(motion, *bodies);
  const std::vector<double> fractions = towardsEnds(samples);
  std::size_t flights = 0, flight = 0;
  for (const WorldLine& line : motion.world_lines) flights += line.arcs.size();
  const std::size_t pairs = flights * fractions.size() * motion.world_lines.size();
  const std::size_t stride = 1 + pairs / kMostPairs;
  for (int b = 0; b < static_cast<int>(motion.world_lines.size()); ++b) {
    const WorldLine& line = motion.world_lines[static_cast<std::size_t>(b)];
    for (std::size_t k = 0; k < line.arcs.size(); ++k) {
      const Arc& arc = line.arcs[k];
      const double end = endOf(motion, line, k);
      if (!arc.moving() || flight++ % stride != 0) continue;
      between();
      for (const double fraction : fractions)
        overlaps.lookAt(b, arc, std::min(end, arc.start() + fraction * (end - arc.start())));
    }
  }
  return overlaps.deepest();
}

}  // namespace carom::editing_detail
