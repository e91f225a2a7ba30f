#include <algorithm>
#include <cmath>
#include <sstream>

#include "adjoint/simulator.h"

// The outcomes that end a motion before its duration, each a status and a sentence.

namespace carom {

// An impulse along a tilted normal may fail to part the bodies: there is no motion after it.
bool Simulator::separates(const Draft& d) {
  for (const Contact& c : d.event.contacts) {
    if (c.tilt_a < 0 && c.tilt_b < 0) continue;
    Vec3 u = Vec3::Zero();
    const auto add = [&](int body, double sign) {
      const Participant* p = d.event.find(body);
      if (!p) return;
      const Kinematics k = d.arcs[static_cast<std::size_t>(p - d.event.participants.data())].kinematicsAt(d.event.time);
      u += sign * (k.v + k.w.cross(c.at.point - k.x));
    };
    add(c.a, 1);
    add(c.b, -1);
    if (c.at.normal.dot(u) >= 0 && c.impulse.dot(c.impulse_normal) > 0) continue;
    std::ostringstream text;
    text << "the tilted normal at the impact of '" << scene_.bodies[static_cast<std::size_t>(c.a)].name << "' and '"
         << scene_.bodies[static_cast<std::size_t>(c.b)].name << "' at t = " << d.event.time
         << " s does not part the bodies";
    finish(MotionStatus::unresolved_impact, d.event.time, text.str());
    return false;
  }
  return true;
}

// True when the impacts of a pair pile up in finite time, or every impact does; sets status and message.
bool Simulator::accumulates(const Draft& d) {
  for (const Contact& c : d.event.contacts) {
    auto low = std::find_if(low_bounces_.begin(), low_bounces_.end(),
                            [&](const LowBounces& l) { return l.a == c.a && l.b == c.b; });
    const auto next = std::find_if(d.predictions.begin(), d.predictions.end(),
                                   [&](const Prediction& p) { return p.a == c.a && p.b == c.b; });
    const double leaving = std::abs(c.pair.elasticity * c.approach);
    const bool is_low = next != d.predictions.end() && 0.25 * leaving * (next->time - d.event.time) < kLowestBounce;
    if (!is_low) {
      if (low != low_bounces_.end()) low->count = 0;
      continue;
    }
    if (low == low_bounces_.end()) low = low_bounces_.insert(low_bounces_.end(), {c.a, c.b, 0});
    if (!(next->features == c.features) && ++low->count < kRattles) continue;
    // gaps shrink by e each, so the rest of the cascade takes gap / (1 - e)
    const double gap = next->time - d.event.time, e = c.pair.elasticity;
    std::ostringstream text;
    text.precision(10);
    text << "'" << scene_.bodies[static_cast<std::size_t>(c.a)].name << "' and '"
         << scene_.bodies[static_cast<std::size_t>(c.b)].name
         << "' stay in contact from t = " << d.event.time + (e < 1 ? gap / (1 - e) : gap) << " s on, at ("
         << c.at.point.x() << ", " << c.at.point.y() << ", " << c.at.point.z() << "), after "
         << motion_.events.size() + 1 << " impacts; lasting contact is not modelled, so the motion ends there";
    finish(MotionStatus::cascade, d.event.time, text.str());
    return true;
  }
  const auto& events = motion_.events;
  if (events.size() < kStallEvents || d.event.time - events[events.size() - kStallEvents].time >= kStall) return false;
  std::ostringstream text;
  text << "impacts accumulate at t = " << d.event.time << " s, at (" << d.event.contacts[0].at.point.transpose()
       << "): " << kStallEvents << " within " << kStall << " s; the motion ends there";
  finish(MotionStatus::cascade, d.event.time, text.str());
  return true;
}

}  // namespace carom
