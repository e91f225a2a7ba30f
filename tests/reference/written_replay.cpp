// SPDX-License-Identifier: MIT
#include "tests/reference/written_replay.h"

#include "tests/reference/differences.h"
#include "tests/reference/impact.h"
#include "tests/reference/rotation.h"

namespace carom::reference {
namespace {

/// The rotations of the flights of a replay.
using Rotations = std::vector<std::shared_ptr<FreeRotation>>;

struct Point {
  RVec at;  // in the axes of the shape
  Real radius;
};

// In the order of sweptPointsOf.
std::vector<Point> pointsOf(const std::vector<PartNumbers>& parts) {
  using Kind = PartNumbers::Kind;
  std::vector<Point> points;
  for (const PartNumbers& part : parts) {
    const auto add = [&](const RVec& at, const Real& radius) {
      points.push_back({part.position + part.orientation * at, radius});
    };
    if (part.kind == Kind::ball) add(RVec(), part.size[0]);
    if (part.kind == Kind::capsule)
      for (int sign : {-1, 1}) add(axisVector(2, sign * part.size[1] / 2), part.size[0]);
    if (part.kind == Kind::hull)
      for (const Vec3& v : part.surface->vertices) add(part.size[0] * RVec(v), 0);
    for (int v = 0; part.kind == Kind::box && v < 8; ++v) {
      RVec corner;
      for (int i = 0; i < 3; ++i) corner[i] = (v >> i & 1 ? 1 : -1) * part.size[static_cast<std::size_t>(i)] / 2;
      add(corner, 0);
    }
  }
  return points;
}

class Throw {
 public:
  /// Rotations that are equal to `known` ones are shared with them, since their series are the dear part.
  Throw(const ThrowNumbers& n, const Rotations& known)
      : n_(n),
        known_(known),
        model_(modelOf(n.body)),
        points_(pointsOf(n.body.parts)),
        normal_(n.floor.orientation * n.floor.normal) {
    const RMat R = n.body.orientation * model_.principal.axes;
    const RVec L = R * times(model_.principal.moments, transposeTimes(R, n.body.spin));
    begin(0, n.body.position + n.body.orientation * model_.center, n.body.velocity, R, L);
  }

  WrittenState stateAt(const Real& t) {
    const Moment m = momentAt(t);
    return {m.x - m.R_WG * model_.center, m.v, m.spin, m.R_WG, t};
  }
  const Rotations& rotations() const { return rotations_; }

  // Newton on the gap, whose rate is n.u.
  Real timeOf(const PointImpact& impact) {
    Real t = impact.time;
    for (int i = 0; i < 60; ++i) {
      const Moment m = momentAt(t);
      const Side side = sideOf(m, armOf(m, impact.point));
      const Real gap = dot(normal_, m.x + side.arm - n_.floor.position) - n_.floor.offset;
      const Real change = -gap / dot(normal_, side.pointVelocity());
      t += change;
      if (abs(change) < 1e-30) return t;
    }
    throw std::runtime_error("Newton's method does not find the time of an impact");
  }

  void strike(const PointImpact& impact, const Real& t, bool decide) {
    const Moment m = momentAt(t);
    const Side side = sideOf(m, armOf(m, impact.point));
    if (!(dot(normal_, side.pointVelocity()) < 0)) throw std::runtime_error("the point does not approach");
    ImpactMode mode = impact.mode;
    const Coefficients c{n_.body.elasticity, n_.body.friction, n_.body.tangential_elasticity};
    const RVec P = impulseOf(side, Side(), normal_, c, mode, decide);
    if (mode != impact.mode) throw std::runtime_error("the mode of an impact is another one");
    const RVec L = side.R * times(model_.principal.moments, transposeTimes(side.R, side.spin));
    begin(t, m.x, m.v + side.inverse_mass * P, side.R, L + cross(side.arm, P));
  }

 private:
  struct Moment {
    RVec x, v, spin;
    RMat R, R_WG;
  };

  void begin(const Real& t, const RVec& x, const RVec& v, const RMat& R, const RVec& L) {
    start_ = t, x_ = x, v_ = v;
    auto rotation = std::make_shared<FreeRotation>(model_.principal.moments, R, L);
    const std::size_t k = rotations_.size();
    if (k < known_.size() && known_[k]->sameAs(*rotation)) rotation = known_[k];
    rotations_.push_back(rotation);
  }

  Moment momentAt(const Real& t) {
    const Real s = t - start_;
    FreeRotation& rotation = *rotations_.back();
    const RMat R = rotation.orientationAt(s);
    return {x_ + s * v_ + (s * s / 2) * n_.body.gravity, v_ + s * n_.body.gravity, rotation.spinAt(R), R,
            R * transpose(model_.principal.axes)};
  }

  // from the centre of mass to the place of contact
  RVec armOf(const Moment& m, int point) const {
    const Point& p = points_.at(static_cast<std::size_t>(point));
    return m.R_WG * (p.at - model_.center) - p.radius * normal_;
  }

  Side sideOf(const Moment& m, const RVec& arm) const {
    Side side;
    side.moving = true;
    side.inverse_mass = 1 / model_.mass;
    for (int i = 0; i < 3; ++i) side.inverse_inertia[i] = 1 / model_.principal.moments[i];
    side.R = m.R, side.arm = arm, side.velocity = m.v, side.spin = m.spin;
    return side;
  }

  const ThrowNumbers& n_;
  const Rotations& known_;
  RealModel model_;
  std::vector<Point> points_;
  RVec normal_;
  Real start_;
  RVec x_, v_;
  Rotations rotations_;
};

struct Followed {
  std::vector<WrittenState> states;
  Rotations rotations;
};

Followed replayNear(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts, const Real& end, bool decide,
                    const Rotations& known) {
  Followed out;
  Throw run(numbers, known);
  for (const PointImpact& impact : impacts) {
    const Real t = run.timeOf(impact);
    out.states.push_back(run.stateAt(t));
    run.strike(impact, t, decide);
  }
  out.states.push_back(run.stateAt(end));
  out.rotations = run.rotations();
  return out;
}

/// A throw followed, to take differences from.
struct Base {
  ThrowNumbers numbers;
  std::vector<PointImpact> impacts;  ///< at the exact times
  Real end;
  Followed followed;

  Base(const ThrowNumbers& n, const std::vector<PointImpact>& near, const Real& at_end, const Rotations& known)
      : numbers(n), impacts(near), end(at_end), followed(replayNear(n, near, at_end, false, known)) {
    for (std::size_t k = 0; k < impacts.size(); ++k) impacts[k].time = followed.states[k].time;
  }

  /// The changes of the 13 numbers of every state by a nudge of h.
  std::vector<std::array<Real, 13>> changes(const ThrowKnob& knob, const Real& h) const {
    ThrowNumbers nudged = numbers;
    knob.nudge(nudged, h);
    const std::vector<WrittenState> ends = replayNear(nudged, impacts, end, false, followed.rotations).states;
    std::vector<std::array<Real, 13>> out;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const WrittenState &from = followed.states[k], &to = ends[k];
      const RVec parts[] = {to.position - from.position, rotationBetween(from.R, to.R), to.velocity - from.velocity,
                            to.spin - from.spin};
      std::array<Real, 13>& d = out.emplace_back();
      for (int i = 0; i < 12; ++i) d[static_cast<std::size_t>(i)] = parts[i / 3][i % 3];
      d[12] = to.time - from.time;
    }
    return out;
  }
};

}  // namespace

ThrowNumbers throwNumbers(const Scene& scene, int body, int floor) {
  const Body& f = scene.bodies[static_cast<std::size_t>(floor)];
  const Plane& plane = std::get<Plane>(f.shape);
  return {writtenNumbers(scene, scene.bodies[static_cast<std::size_t>(body)]),
          {unit(RVec(plane.normal)), RVec(f.position), plane.offset, rotationOf(f.orientation)}};
}

std::vector<WrittenState> replay(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts, const Real& end,
                                 bool decide) {
  return replayNear(numbers, impacts, end, decide, {}).states;
}

std::vector<ThrowKnob> throwKnobs(const ThrowNumbers& numbers, int body, int floor) {
  using N = ThrowNumbers;
  using D = SceneDerivative;
  const auto b = static_cast<std::size_t>(body), f = static_cast<std::size_t>(floor);
  std::vector<ThrowKnob> knobs;
  const auto vector = [&](const std::string& name, auto nudge, auto entry) {
    for (int i = 0; i < 3; ++i)
      knobs.push_back({name + "." + std::to_string(i), [nudge, i](N& n, const Real& h) { nudge(n, axisVector(i, h)); },
                       [entry, i](D& d) -> double& { return entry(d)[i]; }});
  };
  const auto scalar = [&](const std::string& name, auto nudge, auto entry) { knobs.push_back({name, nudge, entry}); };
  vector(
      "gravity", [](N& n, const RVec& h) { n.body.gravity = n.body.gravity + h; },
      [](D& d) -> Vec3& { return d.gravity; });
  vector(
      "position", [](N& n, const RVec& h) { n.body.position = n.body.position + h; },
      [b](D& d) -> Vec3& { return d.bodies[b].position; });
  vector(
      "orientation", [](N& n, const RVec& h) { n.body.orientation = rotationBy(h) * n.body.orientation; },
      [b](D& d) -> Vec3& { return d.bodies[b].orientation; });
  vector(
      "velocity", [](N& n, const RVec& h) { n.body.velocity = n.body.velocity + h; },
      [b](D& d) -> Vec3& { return d.bodies[b].velocity; });
  vector(
      "angular_velocity", [](N& n, const RVec& h) { n.body.spin = n.body.spin + h; },
      [b](D& d) -> Vec3& { return d.bodies[b].angular_velocity; });
  vector(
      "floor position", [](N& n, const RVec& h) { n.floor.position = n.floor.position + h; },
      [f](D& d) -> Vec3& { return d.bodies[f].position; });
  vector(
      "floor orientation", [](N& n, const RVec& h) { n.floor.orientation = rotationBy(h) * n.floor.orientation; },
      [f](D& d) -> Vec3& { return d.bodies[f].orientation; });
  if (!numbers.body.inertia_derived)
    vector(
        "inertia", [](N& n, const RVec& h) { n.body.moments = n.body.moments + h; },
        [b](D& d) -> Vec3& { return d.bodies[b].inertia; });
  const bool density = numbers.body.has_density;
  scalar(
      density ? "density" : "mass", [](N& n, const Real& h) { n.body.mass_or_density += h; },
      [b, density](D& d) -> double& { return density ? d.bodies[b].density : d.bodies[b].mass; });
  scalar(
      "elasticity", [](N& n, const Real& h) { n.body.elasticity += h; },
      [](D& d) -> double& { return d.materials[0].elasticity; });
  scalar(
      "friction", [](N& n, const Real& h) { n.body.friction += h; },
      [](D& d) -> double& { return d.materials[0].friction; });
  scalar(
      "tangential_elasticity", [](N& n, const Real& h) { n.body.tangential_elasticity += h; },
      [](D& d) -> double& { return d.materials[0].tangential_elasticity; });
  Eigen::Index dimension = 0;
  for (std::size_t p = 0; p < numbers.body.parts.size(); ++p)
    for (std::size_t i = 0; i < numbers.body.parts[p].size.size(); ++i, ++dimension)
      scalar(
          "size " + std::to_string(p) + "." + std::to_string(i),
          [p, i](N& n, const Real& h) { n.body.parts[p].size[i] += h; },
          [b, dimension](D& d) -> double& { return d.bodies[b].size[dimension]; });
  return knobs;
}

ThrowKnob inertiaOfMass() {
  return {"inertia of mass",
          [](ThrowNumbers& n, const Real& h) { n.body.inertia_factor += h / n.body.mass_or_density; },
          [](SceneDerivative&) -> double& { throw std::logic_error("no number of a scene"); }};
}

std::vector<MomentRates> replayDerivatives(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts,
                                           const Real& end, const std::vector<ThrowKnob>& knobs) {
  const Base base(numbers, impacts, end, {});
  std::vector<MomentRates> columns;
  for (const ThrowKnob& knob : knobs) {
    MomentRates& column = columns.emplace_back();
    for (const auto& change : base.changes(knob, kNudge)) {
      Eigen::Matrix<double, 13, 1>& d = column.emplace_back();
      for (std::size_t i = 0; i < 13; ++i)
        d[static_cast<Eigen::Index>(i)] = static_cast<double>(Real(change[i] / kNudge));
    }
  }
  return columns;
}

std::vector<MomentRates> replaySecondDerivatives(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts,
                                                 const Real& end, const std::vector<ThrowKnob>& knobs,
                                                 const std::vector<double>& direction,
                                                 const std::vector<ThrowKnob>& columns_of) {
  const Base base(numbers, impacts, end, {});
  std::vector<std::vector<std::array<Real, 13>>> low;
  std::vector<MomentRates> columns(columns_of.size());
  for (const Real& h : {Real(-kAlong), kAlong}) {
    ThrowNumbers moved = numbers;
    for (std::size_t k = 0; k < knobs.size(); ++k) knobs[k].nudge(moved, h * direction[k]);
    const Base here(moved, base.impacts, end, base.followed.rotations);
    for (std::size_t c = 0; c < columns_of.size(); ++c) {
      auto changes = here.changes(columns_of[c], kBeside);
      if (h < 0) low.push_back(std::move(changes));
      for (std::size_t k = 0; k < changes.size() && h > 0; ++k) {
        Eigen::Matrix<double, 13, 1>& d = columns[c].emplace_back();
        for (std::size_t i = 0; i < 13; ++i)
          d[static_cast<Eigen::Index>(i)] =
              static_cast<double>(Real((changes[k][i] - low[c][k][i]) / (2 * kBeside * h)));
      }
    }
  }
  return columns;
}

}  // namespace carom::reference
