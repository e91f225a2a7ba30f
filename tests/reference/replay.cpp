// SPDX-License-Identifier: MIT
#include "tests/reference/replay.h"

#include "tests/reference/differences.h"
#include "tests/reference/knobs.h"
#include "tests/reference/world_lines.h"

namespace carom::reference {
namespace {

struct FlightTime {
  int flight;
  Real time;
};

Eigen::Quaterniond quaternionOf(const RMat& R) { return Quat(rounded(R)).normalized(); }

BodyState roundedState(const RealState& s) {
  return {s.position.rounded(), quaternionOf(s.R), s.velocity.rounded(), s.spin.rounded()};
}

/// The twelve (and the time) differences between two states, divided by the width h.
std::array<Real, 13> difference(const RealState& from, const RealState& to, const Real& dtime, const Real& h) {
  const Real f = 1 / h;
  std::array<Real, 13> out{};
  const RVec parts[] = {to.position - from.position, rotationBetween(from.R, to.R), to.velocity - from.velocity,
                        to.spin - from.spin};
  for (int p = 0; p < 4; ++p) {
    for (int c = 0; c < 3; ++c) out[3 * p + c] = f * parts[p][c];
  }
  out[kTimeComponent] = f * dtime;
  return out;
}

/// A scene that is near another one, replayed along the impacts of that.
struct Nearby {
  WorldLines lines;
  std::vector<FrozenImpact> impacts;

  Nearby(SceneNumbers numbers, const WorldLines& known, const std::vector<FrozenImpact>& known_impacts,
         ImpactTimes times)
      : lines(std::move(numbers), &known), impacts(known_impacts) {
    for (FrozenImpact& f : impacts) lines.apply(f, times, false);
  }
};

FlightTime flightTimeOf(const WorldLines& lines, const std::vector<FrozenImpact>& impacts, const Row& row) {
  if (row.event < 0) return {lines.flightAt(row.body, row.time), Real(row.time)};
  const FrozenImpact& f = impacts[row.event];
  if (row.body != f.a && row.body != f.b) throw std::invalid_argument("the body takes no part in the event");
  return {row.body == f.a ? f.flight_a : f.flight_b, f.time};
}

bool sameMoment(const Row& a, const Row& b) { return a.body == b.body && a.event == b.event && a.time == b.time; }

/// Differences of two replays, one for each row; what is read at a time is read `later` after it in both.
std::vector<Real> differences(const WorldLines& from, const std::vector<FrozenImpact>& impacts, const Nearby& to,
                              const std::vector<Row>& rows, const Real& later, const Real& h) {
  std::vector<Real> column;
  std::array<Real, 13> all{};
  const Row* last = nullptr;
  for (const Row& row : rows) {
    if (!last || !sameMoment(*last, row)) {
      FlightTime at[2] = {flightTimeOf(from, impacts, row), flightTimeOf(to.lines, to.impacts, row)};
      if (row.event < 0) at[0].time += later, at[1].time += later;
      all = difference(from.stateAt(row.body, at[0].flight, at[0].time),
                       to.lines.stateAt(row.body, at[1].flight, at[1].time), at[1].time - at[0].time, h);
      last = &row;
    }
    column.push_back(all[row.component]);
  }
  return column;
}

SceneNumbers nudged(SceneNumbers numbers, const Knob& knob, const Real& change) {
  knobKinds()[knob.kind].nudge(numbers, knob.index, knob.component, change);
  return numbers;
}

}  // namespace

struct Reference::Data {
  SceneNumbers numbers;
  WorldLines lines;
  std::vector<FrozenImpact> impacts;
  std::vector<std::string> features;

  explicit Data(const Scene& scene) : numbers(numbersOf(scene)), lines(numbers) {}
};

Reference::Reference(const Scene& scene, const Sequence& sequence) : data_(std::make_unique<Data>(scene)) {
  Data& d = *data_;
  for (const Impact& impact : sequence) {
    FrozenImpact f = d.lines.recognise(impact);
    d.lines.apply(f, ImpactTimes::follow, true);
    d.features.push_back(nameOf(d.numbers.bodies[f.a], f.features.a) + " on " +
                         nameOf(d.numbers.bodies[f.b], f.features.b));
    d.impacts.push_back(f);
  }
}
Reference::~Reference() = default;
Reference::Reference(Reference&&) noexcept = default;

int Reference::events() const { return static_cast<int>(data_->impacts.size()); }
double Reference::eventTime(int event) const { return static_cast<double>(data_->impacts[event].time); }
ImpactMode Reference::mode(int event) const { return data_->impacts[event].mode; }
const std::string& Reference::features(int event) const { return data_->features[event]; }
Vec3 Reference::impulse(int event) const { return data_->impacts[event].impulse.rounded(); }

BodyState Reference::stateAt(int body, double t) const {
  return roundedState(data_->lines.stateAt(body, data_->lines.flightAt(body, t), t));
}
BodyState Reference::stateBefore(int event, int body) const {
  const FlightTime at = flightTimeOf(data_->lines, data_->impacts, {body, event, 0, 0});
  return roundedState(data_->lines.stateAt(body, at.flight, at.time));
}

std::vector<double> Reference::derivative(const Knob& knob, const std::vector<Row>& rows, ImpactTimes times) const {
  const Data& d = *data_;
  const Nearby there(nudged(d.numbers, knob, kNudge), d.lines, d.impacts, times);
  std::vector<double> column;
  for (const Real& exact : differences(d.lines, d.impacts, there, rows, 0, kNudge))
    column.push_back(static_cast<double>(exact));
  return column;
}

std::vector<std::vector<double>> Reference::secondDerivatives(const std::vector<double>& direction, double dtime,
                                                              const std::vector<Knob>& knobs,
                                                              const std::vector<Row>& rows) const {
  const Data& d = *data_;
  std::vector<std::vector<Real>> low;
  std::vector<std::vector<double>> columns(knobs.size());
  for (const Real& h : {Real(-kAlong), kAlong}) {
    SceneNumbers moved = d.numbers;
    std::size_t n = 0;
    for (const KnobKind& kind : knobKinds())
      for (int index = 0; index < kind.count(d.numbers); ++index)
        for (int component : kind.components(d.numbers, index)) kind.nudge(moved, index, component, h * direction[n++]);
    const Nearby here(moved, d.lines, d.impacts, ImpactTimes::follow);
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      const Nearby there(nudged(moved, knobs[k], kBeside), here.lines, here.impacts, ImpactTimes::follow);
      std::vector<Real> exact = differences(here.lines, here.impacts, there, rows, h * dtime, kBeside);
      if (h < 0) low.push_back(std::move(exact));
      for (std::size_t i = 0; i < rows.size() && h > 0; ++i)
        columns[k].push_back(static_cast<double>(Real((exact[i] - low[k][i]) / (2 * h))));
    }
  }
  return columns;
}

std::vector<Knob> knobsOf(const Scene& scene) {
  const SceneNumbers numbers = numbersOf(scene);
  std::vector<Knob> knobs;
  for (std::size_t kind = 0; kind < knobKinds().size(); ++kind) {
    const KnobKind& k = knobKinds()[kind];
    for (int index = 0; index < k.count(numbers); ++index) {
      for (int component : k.components(numbers, index)) {
        knobs.push_back({static_cast<int>(kind), index, component,
                         std::string(k.name) + "[" + std::to_string(index) + "]." + std::to_string(component)});
      }
    }
  }
  return knobs;
}

double& entryOf(SceneDerivative& derivative, const Knob& knob) {
  return knobKinds()[knob.kind].entry(derivative, knob.index, knob.component);
}

std::string describe(const Row& row) {
  static const char* const names[] = {"position", "orientation", "velocity", "angular_velocity", "time"};
  std::string text = names[row.component / 3];
  if (row.component != kTimeComponent) text += std::string(".") + "xyz"[row.component % 3];
  return text + " of body " + std::to_string(row.body) +
         (row.event < 0 ? " at t=" + std::to_string(row.time) : " before event " + std::to_string(row.event));
}

std::vector<Rotation> freeRotation(const Vec3& inertia, const Quat& q, const Vec3& L, const std::vector<double>& times,
                                   bool sensitivities) {
  const RVec I(inertia), momentum(L);
  const RMat R = rotationOf(q);
  std::vector<Rotation> out;
  FreeRotation nominal(I, R, momentum);
  for (const double t : times) {
    out.push_back({rounded(nominal.orientationAt(t)), Mat3::Zero(), Mat3::Zero(), Mat3::Zero()});
  }
  if (!sensitivities) return out;
  Mat3 Rotation::*const blocks[] = {&Rotation::dtheta_dtheta, &Rotation::dtheta_dL, &Rotation::dtheta_dI};
  for (int block = 0; block < 3; ++block) {
    for (int c = 0; c < 3; ++c) {
      const RVec change = axisVector(c, kNudge);
      FreeRotation there(block == 2 ? I + change : I, block == 0 ? rotationBy(change) * R : R,
                         block == 1 ? momentum + change : momentum);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const RVec turn = rotationBetween(nominal.orientationAt(times[i]), there.orientationAt(times[i]));
        (out[i].*blocks[block]).col(c) = ((1 / kNudge) * turn).rounded();
      }
    }
  }
  return out;
}

}  // namespace carom::reference
