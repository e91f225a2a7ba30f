// SPDX-License-Identifier: MIT
#include "tests/random/checks.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "adjoint/flight/trajectory.hpp"

namespace carom::brute {
namespace {

constexpr Real kOverlap = 1e-9L;  // m
constexpr Real kBeside = 1e-7L;   // s
constexpr Real kEnergy = 1e-12L;  // relative

std::string number(Real value) {
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

class StateCheck {
 public:
  StateCheck(const Motion& motion, Findings& findings) : motion_(motion), findings_(findings) {
    for (const Body& b : motion.scene->bodies) solids_.push_back(solidOf(b.shape));
  }

  void at(double t) {
    const int n = static_cast<int>(solids_.size());
    std::vector<Placement> places;
    for (int i = 0; i < n; ++i) {
      const BodyState s = motion_.stateAt(i, t);
      if (!s.position.allFinite() || !s.orientation.coeffs().allFinite() || !s.velocity.allFinite() ||
          !s.angular_velocity.allFinite())
        findings_.fail("body " + std::to_string(i) + " has a state that is not finite at t = " + number(t));
      places.push_back({widen(s.position), s.orientation.cast<Real>().normalized().toRotationMatrix()});
    }
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) overlap(a, b, places, t);
  }

 private:
  void overlap(int a, int b, const std::vector<Placement>& places, double t) {
    const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
    const auto& bodies = motion_.scene->bodies;
    if (bodies[ia].fixed && bodies[ib].fixed) return;
    const Real depth = -separation(solids_[ia], places[ia], solids_[ib], places[ib]).value;
    findings_.worst_overlap = std::max(findings_.worst_overlap, depth);
    if (!(depth <= kOverlap))
      findings_.fail("bodies " + std::to_string(a) + " and " + std::to_string(b) + " overlap by " + number(depth) +
                     " m at t = " + number(t));
  }

  const Motion& motion_;
  Findings& findings_;
  std::vector<Solid> solids_;
};

bool finite(const Event& event) {
  bool ok =
      std::isfinite(event.time) && std::isfinite(event.margins.grazing) && std::isfinite(event.margins.stick_slip);
  for (const carom::Contact& c : event.contacts)
    ok = ok && std::isfinite(c.at.gap) && c.at.normal.allFinite() && c.at.point.allFinite() && c.impulse.allFinite() &&
         c.impulse_normal.allFinite() && std::isfinite(c.approach);
  for (const Participant& p : event.participants)
    ok = ok && p.before.x.allFinite() && p.before.q.coeffs().allFinite() && p.before.v.allFinite() &&
         p.before.L.allFinite();
  return ok;
}

// Kinetic energy of a body in long double.
Real kinetic(const MassProperties& m, const State& s) {
  const Matrix R = s.q.cast<Real>().normalized().toRotationMatrix();
  const Vector L = widen(s.L);
  return m.mass * widen(s.v).squaredNorm() / 2 + L.dot(inverseInertia(m, R) * L) / 2;
}

}  // namespace

void checkStates(const Motion& motion, int samples, Findings& findings) {
  StateCheck check(motion, findings);
  const auto within = [&](double t) { return std::clamp(t, 0.0, motion.end); };
  for (int i = 0; i <= samples; ++i) check.at(within(motion.end * i / samples));
  for (std::size_t k = 0; k < motion.events.size(); ++k) {
    const Event& event = motion.events[k];
    if (!finite(event)) findings.fail("event " + std::to_string(k) + " holds a number that is not finite");
    for (double t : {event.time - double(kBeside), event.time, event.time + double(kBeside)}) check.at(within(t));
  }
}

void checkEnergy(const Motion& motion, Findings& findings) {
  std::vector<MassProperties> masses;
  for (const Body& b : motion.scene->bodies) masses.push_back(massOf(b));
  const Vector g = widen(motion.scene->gravity);
  for (std::size_t k = 0; k < motion.events.size(); ++k) {
    Real before = 0, after = 0;
    for (const Participant& p : motion.events[k].participants) {
      const auto body = static_cast<std::size_t>(p.body);
      const Arc& arc = motion.world_lines[body].arcs[static_cast<std::size_t>(p.arc)];
      const Real kinetic_before = kinetic(masses[body], p.before);
      before += kinetic_before;
      after += kinetic(masses[body], motion.world_lines[body].arcs[static_cast<std::size_t>(p.next())].startState());
      // along the arc that ends here: kinetic energy gained = work of gravity, less what friction takes
      const Real start = kinetic(masses[body], arc.startState());
      const Real work = masses[body].mass * g.dot(widen(p.before.x) - widen(arc.startState().x));
      const Real scale = kinetic_before + start + masses[body].mass * g.norm() * widen(p.before.x).norm();
      const Real gain = (kinetic_before - start - work) / std::max(scale, Real(1e-30L));
      if (arc.trajectory().group()) continue;  // what others of the group have lost
      const Real drift = arc.kind() == ArcKind::flight ? std::abs(gain) : gain;
      findings.worst_flight = std::max(findings.worst_flight, drift);
      if (!(drift <= kEnergy))
        findings.fail("energy of body " + std::to_string(p.body) + " drifts by " + number(drift) +
                      " of itself on the way to event " + std::to_string(k));
    }
    // a slip that ends leaves nothing, and a body that touches at rest has nothing before either
    const Real growth = after == before ? Real(0) : (after - before) / before;
    findings.worst_energy = std::max(findings.worst_energy, growth);
    if (!(growth <= kEnergy))
      findings.fail("energy grows by " + number(growth) + " of itself over event " + std::to_string(k));
  }
}

void Findings::add(const Findings& o) {
  failures.insert(failures.end(), o.failures.begin(), o.failures.end());
  events += o.events, single += o.single, joint += o.joint, undecided += o.undecided, tied += o.tied;
  for (const auto& [kind, count] : o.kinds) kinds[kind] += count;
  worst_time = std::max(worst_time, o.worst_time);
  worst_flight = std::max(worst_flight, o.worst_flight);
  worst_velocity = std::max(worst_velocity, o.worst_velocity);
  worst_overlap = std::max(worst_overlap, o.worst_overlap);
  worst_energy = std::max(worst_energy, o.worst_energy);
  worst_gap = std::max(worst_gap, o.worst_gap);
}

std::string Findings::summary() const {
  std::ostringstream out;
  out << events << " events (" << single << " single, " << joint << " joint), " << undecided << " undecided, " << tied
      << " tied; worst: time " << std::setprecision(3) << worst_time << " s, flight " << worst_flight << ", velocity "
      << worst_velocity << ", overlap " << worst_overlap << " m, gap at impact " << worst_gap << " m, energy growth "
      << worst_energy << "\ncontacts:";
  for (const auto& [kind, count] : kinds) out << " " << kind << " " << count << ",";
  return out.str();
}

}  // namespace carom::brute
