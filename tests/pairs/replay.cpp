// SPDX-License-Identifier: MIT
#include "tests/pairs/replay.h"

#include <stdexcept>

#include "tests/reference/impact.h"
#include "tests/reference/rotation.h"

namespace carom::pairs {
namespace {

using reference::RMat;
using reference::RVec;
const Fine kNudge("1e-16");

RVec narrow(const FineVector& v) { return {v[0], v[1], v[2]}; }
RMat narrow(const FineMatrix& m) { return {{narrow(m.column[0]), narrow(m.column[1]), narrow(m.column[2])}}; }
FineVector wide(const RVec& v) { return {v[0], v[1], v[2]}; }
FineMatrix wide(const RMat& m) { return {{wide(m.column[0]), wide(m.column[1]), wide(m.column[2])}}; }

// What follows from a body's mass and shape.
struct Model {
  std::vector<exact::Piece<Fine>> pieces;
  Fine mass;
  FineVector center, moments;
  FineMatrix axes = FineMatrix::identity();  // principal to shape
};

Model modelOf(const BodyNumbers& n) {
  Model m;
  m.pieces = exact::piecesOf(n.shape);
  if (!n.moving) return m;
  const auto solid = exact::integralsOf(n.shape);
  m.mass = n.has_density ? Fine(n.mass_or_density * solid.volume) : n.mass_or_density;
  m.center = solid.center();
  m.moments = n.moments, m.axes = n.axes;
  if (n.inertia_derived) {
    const auto found = exact::principal<Fine>(m.mass * solid.unitInertia(), Fine("1e-49"));
    m.moments = found.moments, m.axes = found.axes;
  }
  return m;
}

struct State {
  FineVector position, velocity, spin;  // of the shape's origin, of the centre of mass
  FineMatrix R;                         // shape axes to world
};

// Free flight of one body.
struct Flight {
  bool moving = false;
  Fine start = 0;
  FineVector x, v, g, center;
  FineMatrix axes, R;  // principal to shape; of a body that stands still shape to world
  std::shared_ptr<reference::FreeRotation> rotation;

  State at(const Fine& t) const {
    if (!moving) return {x, {}, {}, R};
    const Fine s = t - start;
    const RMat turned = rotation->orientationAt(s);
    const FineMatrix R_WG = wide(turned) * transpose(axes);
    return {x + s * v + (s * s / 2) * g - R_WG * center, v + s * g, wide(rotation->spinAt(turned)), R_WG};
  }
};

struct Frozen {
  FeatureId a, b;
  int side;
  FineVector near_a, near_b;
  Fine time, after;
};

struct Outcome {
  Fine time;
  exact::Touch<Fine> touch;
  State before[2], after[2];
  Model models[2];
  Flight flights[2];
};

FineVector momentum(const Model& m, const FineMatrix& R_WG, const FineVector& spin) {
  const FineMatrix R = R_WG * m.axes;
  return R * times(m.moments, transposeTimes(R, spin));
}

class Run {
 public:
  /// Models and rotations that are those of `base` are taken from it.
  Run(const PairNumbers& n, const Frozen& frozen, const Outcome* base, int changed) : n_(n), frozen_(frozen) {
    for (int i = 0; i < 2; ++i) {
      out_.models[i] = base && changed != i ? base->models[i] : modelOf(n.bodies[i]);
      out_.flights[i] = flightOf(i, base);
    }
  }

  Outcome follow(ImpactMode& mode, bool decide) {
    findImpact();
    for (int i = 0; i < 2; ++i) out_.before[i] = out_.after[i] = out_.flights[i].at(out_.time);
    strike(mode, decide);
    return std::move(out_);
  }

 private:
  Flight flightOf(int i, const Outcome* base) const {
    const BodyNumbers& b = n_.bodies[i];
    const Model& m = out_.models[i];
    Flight f;
    f.moving = b.moving, f.R = b.orientation, f.x = b.position;
    if (!b.moving) return f;
    f.axes = m.axes, f.center = m.center;
    f.x = b.position + b.orientation * m.center, f.v = b.velocity, f.g = n_.gravity;
    f.rotation = rotationFrom(m, b.orientation, momentum(m, b.orientation, b.spin));
    if (base && f.rotation->sameAs(*base->flights[i].rotation)) f.rotation = base->flights[i].rotation;
    return f;
  }

  static std::shared_ptr<reference::FreeRotation> rotationFrom(const Model& m, const FineMatrix& R_WG,
                                                               const FineVector& L) {
    return std::make_shared<reference::FreeRotation>(narrow(m.moments), narrow(R_WG * m.axes), narrow(L));
  }

  exact::Touch<Fine> touchAt(const State& a, const State& b) const {
    const auto feature = [](const Model& m, const State& s, const FeatureId& id) {
      return placed(m.pieces[static_cast<std::size_t>(id.piece)].feature(id), exact::Pose<Fine>{s.position, s.R});
    };
    const auto touch = exact::touchOf(feature(out_.models[0], a, frozen_.a), feature(out_.models[1], b, frozen_.b),
                                      frozen_.side, frozen_.near_a, frozen_.near_b);
    if (!touch) throw std::runtime_error("features that meet in no general way");
    return *touch;
  }

  FineVector armOf(int i, const State& s, const FineVector& point) const {
    return point - s.position - s.R * out_.models[i].center;
  }
  FineVector pointVelocity(int i, const State& s, const FineVector& point) const {
    return n_.bodies[i].moving ? s.velocity + cross(s.spin, armOf(i, s, point)) : FineVector();
  }

  // Newton on the gap, whose rate at a touch is n.u.
  void findImpact() {
    out_.time = frozen_.time;
    for (int round = 0; round < 60; ++round) {
      const State a = out_.flights[0].at(out_.time), b = out_.flights[1].at(out_.time);
      out_.touch = touchAt(a, b);
      const FineVector& p = out_.touch.point;
      const Fine change = -out_.touch.gap / dot(out_.touch.normal, pointVelocity(0, a, p) - pointVelocity(1, b, p));
      if (abs(change) < 1e-34) return;
      out_.time += change;
    }
    throw std::runtime_error("Newton's method does not find the time of the impact");
  }

  reference::Side sideOf(int i) const {
    reference::Side side;
    side.moving = n_.bodies[i].moving;
    if (!side.moving) return side;
    const Model& m = out_.models[i];
    const State& s = out_.before[i];
    side.inverse_mass = 1 / m.mass;
    for (int k = 0; k < 3; ++k) side.inverse_inertia[k] = 1 / m.moments[k];
    side.R = narrow(s.R * m.axes), side.arm = narrow(armOf(i, s, out_.touch.point));
    side.velocity = narrow(s.velocity), side.spin = narrow(s.spin);
    return side;
  }

  void strike(ImpactMode& mode, bool decide) {
    const auto coefficients = reference::combined(n_.materials[0], n_.materials[1]);
    const FineVector P =
        wide(reference::impulseOf(sideOf(0), sideOf(1), narrow(out_.touch.normal), coefficients, mode, decide));
    for (int i = 0; i < 2; ++i) {
      if (!n_.bodies[i].moving) continue;
      const Model& m = out_.models[i];
      const State& s = out_.before[i];
      const FineVector push = (i == 0 ? 1 : -1) * P;
      Flight f = out_.flights[i];
      f.start = out_.time, f.x = s.position + s.R * m.center, f.v = s.velocity + (1 / m.mass) * push;
      f.rotation = rotationFrom(m, s.R, momentum(m, s.R, s.spin) + cross(armOf(i, s, out_.touch.point), push));
      out_.after[i] = f.at(frozen_.after);
    }
  }

  const PairNumbers& n_;
  const Frozen& frozen_;
  Outcome out_;
};

FineVector rotationBetween(const FineMatrix& from, const FineMatrix& to) {
  FineVector sum;
  for (int j = 0; j < 3; ++j) sum = sum + cross(from.column[j], to.column[j]);
  return (Fine(1) / 2) * sum;
}

Fine componentOf(const State& s, const State& base, int c) {
  if (c < 3) return s.position[c];
  if (c < 6) return rotationBetween(base.R, s.R)[c - 3];
  return c < 9 ? s.velocity[c - 6] : s.spin[c - 9];
}

Fine valueOf(const PairRow& row, const Outcome& o, const Outcome& base) {
  using Of = PairRow::Of;
  switch (row.of) {
    case Of::time:
      return o.time;
    case Of::normal:
      return o.touch.normal[row.component];
    case Of::point:
      return o.touch.point[row.component];
    case Of::before:
      return componentOf(o.before[row.body], base.before[row.body], row.component);
    case Of::after:
      return componentOf(o.after[row.body], base.after[row.body], row.component);
  }
  throw std::logic_error("no such row");
}

}  // namespace

struct Replay::Data {
  PairNumbers numbers;
  std::vector<PairRow> rows;
  Frozen frozen;
  ImpactMode mode = ImpactMode::frictionless;
  Outcome base;
};

Replay::Replay(const Scene& scene, const FirstImpact& impact, double after) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.numbers = pairNumbers(scene);
  d.rows = rowsOf(d.numbers);
  const Candidate& c = impact.nearest;
  d.frozen = {c.a, c.b, c.side, FineVector(c.p.rounded()), FineVector(c.q.rounded()), Fine(impact.time), Fine(after)};
  d.base = Run(d.numbers, d.frozen, nullptr, -1).follow(d.mode, true);
}
Replay::~Replay() = default;

const PairNumbers& Replay::numbers() const { return data_->numbers; }
ImpactMode Replay::mode() const { return data_->mode; }
double Replay::time() const { return static_cast<double>(data_->base.time); }

std::vector<double> Replay::derivative(const PairKnob& knob) const {
  const Data& d = *data_;
  Frozen frozen = d.frozen;
  frozen.time = d.base.time;
  Outcome ends[2];
  for (int side : {0, 1}) {
    PairNumbers nudged = d.numbers;
    knob.nudge(nudged, side ? kNudge : Fine(-kNudge));
    ImpactMode mode = d.mode;
    ends[side] = Run(nudged, frozen, &d.base, knob.body).follow(mode, false);
  }
  std::vector<double> column;
  for (const PairRow& row : d.rows) {
    const Fine rise = valueOf(row, ends[1], d.base) - valueOf(row, ends[0], d.base);
    column.push_back(static_cast<double>(Fine(rise / (2 * kNudge))));
  }
  return column;
}

}  // namespace carom::pairs
