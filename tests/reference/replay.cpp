#include "tests/reference/replay.h"

#include "tests/reference/knobs.h"
#include "tests/reference/world_lines.h"

namespace carom::reference {
namespace {

/// Half the width of the central differences. Their error is its square, 1e-32, times a third derivative; that of the
/// arithmetic 1e-40 (the series) divided by it.
const Real kNudge("1e-16");

struct Instant {
  int flight;
  Real time;
};

Eigen::Quaterniond quaternionOf(const RMat& R) { return Quat(rounded(R)).normalized(); }

BodyState roundedState(const RealState& s) {
  return {s.position.rounded(), quaternionOf(s.R), s.velocity.rounded(), s.spin.rounded()};
}

/// Vector of the small rotation that takes R_0 to R_1.
RVec rotationBetween(const RMat& R_0, const RMat& R_1) {
  RVec sum;
  for (int j = 0; j < 3; ++j) sum = sum + cross(R_0.column[j], R_1.column[j]);
  return (Real(1) / 2) * sum;
}

/// The twelve (and the time) differences between two states, divided by the width 2 h.
std::array<Real, 13> realDifference(const RealState& lo, const RealState& hi, const Real& dtime, const Real& h) {
  const Real f = 1 / (2 * h);
  std::array<Real, 13> out{};
  const RVec parts[] = {hi.position - lo.position, rotationBetween(lo.R, hi.R), hi.velocity - lo.velocity,
                        hi.spin - lo.spin};
  for (int p = 0; p < 4; ++p) {
    for (int c = 0; c < 3; ++c) out[3 * p + c] = f * parts[p][c];
  }
  out[kTimeComponent] = f * dtime;
  return out;
}

std::array<double, 13> difference(const RealState& lo, const RealState& hi, const Real& dtime) {
  const std::array<Real, 13> exact = realDifference(lo, hi, dtime, kNudge);
  std::array<double, 13> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<double>(exact[i]);
  return out;
}

/// The same for second differences, which divide the error of the arithmetic twice.
const Real kSecondNudge("1e-11");

}  // namespace

struct Reference::Data {
  SceneNumbers numbers;
  WorldLines lines;
  std::vector<FrozenImpact> impacts;
  std::vector<std::string> features;

  explicit Data(const Scene& scene) : numbers(numbersOf(scene)), lines(numbers) {}

  Instant instantOf(const std::vector<FrozenImpact>& at, const Row& row) const {
    if (row.event < 0) return {lines.flightAt(row.body, row.time), Real(row.time)};
    const FrozenImpact& f = at[row.event];
    if (row.body != f.a && row.body != f.b) throw std::invalid_argument("the body takes no part in the event");
    return {row.body == f.a ? f.flight_a : f.flight_b, f.time};
  }
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
  const Instant at = data_->instantOf(data_->impacts, {body, event, 0, 0});
  return roundedState(data_->lines.stateAt(body, at.flight, at.time));
}

std::vector<double> Reference::derivative(const Knob& knob, const std::vector<Row>& rows, ImpactTimes times) const {
  const Data& d = *data_;
  std::vector<FrozenImpact> impacts[2] = {d.impacts, d.impacts};
  std::vector<WorldLines> lines;
  for (int side : {0, 1}) {
    SceneNumbers numbers = d.numbers;
    knobKinds()[knob.kind].nudge(numbers, knob.index, knob.component, side == 0 ? -kNudge : kNudge);
    lines.emplace_back(std::move(numbers), &d.lines);
    for (FrozenImpact& f : impacts[side]) lines[side].apply(f, times, false);
  }
  std::vector<double> column;
  std::array<double, 13> all{};
  const Row* last = nullptr;
  for (const Row& row : rows) {
    if (!last || last->body != row.body || last->event != row.event || last->time != row.time) {
      RealState s[2];
      for (int side : {0, 1}) {
        const Instant at = d.instantOf(impacts[side], row);
        s[side] = lines[side].stateAt(row.body, at.flight, at.time);
      }
      all = difference(s[0], s[1], row.event < 0 ? Real(0) : impacts[1][row.event].time - impacts[0][row.event].time);
      last = &row;
    }
    column.push_back(all[row.component]);
  }
  return column;
}

std::vector<double> Reference::secondDerivative(const std::vector<double>& direction, double dtime, const Knob& knob,
                                                const std::vector<Row>& rows) const {
  const Data& d = *data_;
  const Real& h = kSecondNudge;
  std::vector<std::array<Real, 13>> sides[2];
  for (int along : {-1, 1}) {
    SceneNumbers moved = d.numbers;
    std::size_t k = 0;
    for (const KnobKind& kind : knobKinds())
      for (int index = 0; index < kind.count(d.numbers); ++index)
        for (int component : kind.components(d.numbers, index))
          kind.nudge(moved, index, component, along * h * direction[k++]);
    std::vector<FrozenImpact> impacts[2] = {d.impacts, d.impacts};
    std::vector<WorldLines> lines;
    for (int side : {0, 1}) {
      SceneNumbers numbers = moved;
      knobKinds()[knob.kind].nudge(numbers, knob.index, knob.component, side == 0 ? -h : h);
      lines.emplace_back(std::move(numbers), &d.lines);
      for (FrozenImpact& f : impacts[side]) lines[side].apply(f, ImpactTimes::follow, false);
    }
    for (const Row& row : rows) {
      RealState s[2];
      for (int side : {0, 1}) {
        Instant at = d.instantOf(impacts[side], row);
        if (row.event < 0) at.time += along * h * dtime;
        s[side] = lines[side].stateAt(row.body, at.flight, at.time);
      }
      const Real later = row.event < 0 ? Real(0) : impacts[1][row.event].time - impacts[0][row.event].time;
      sides[along > 0].push_back(realDifference(s[0], s[1], later, h));
    }
  }
  std::vector<double> column;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto c = static_cast<std::size_t>(rows[i].component);
    column.push_back(static_cast<double>((sides[1][i][c] - sides[0][i][c]) / (2 * h)));
  }
  return column;
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
      std::vector<FreeRotation> ends;
      for (const Real& nudge : {Real(-kNudge), kNudge}) {
        const RVec change = axisVector(c, nudge);
        ends.emplace_back(block == 2 ? I + change : I, block == 0 ? rotationBy(change) * R : R,
                          block == 1 ? momentum + change : momentum);
      }
      for (std::size_t i = 0; i < times.size(); ++i) {
        const RVec turn = rotationBetween(ends[0].orientationAt(times[i]), ends[1].orientationAt(times[i]));
        (out[i].*blocks[block]).col(c) = ((1 / (2 * kNudge)) * turn).rounded();
      }
    }
  }
  return out;
}

}  // namespace carom::reference
