#include "tests/reference/written_replay.h"

#include "tests/reference/impact.h"
#include "tests/reference/rotation.h"

namespace carom::reference {
namespace {

const Real kNudge("1e-16");

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
  explicit Throw(const ThrowNumbers& n)
      : n_(n), model_(modelOf(n.body)), points_(pointsOf(n.body.parts)), normal_(n.floor.orientation * n.floor.normal) {
    const RMat R = n.body.orientation * model_.principal.axes;
    const RVec L = R * times(model_.principal.moments, transposeTimes(R, n.body.spin));
    begin(0, n.body.position + n.body.orientation * model_.center, n.body.velocity, R, L);
  }

  WrittenState stateAt(const Real& t) {
    const Moment m = momentAt(t);
    return {m.x - m.R_WG * model_.center, m.v, m.spin, m.R_WG, t};
  }

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
    rotation_ = std::make_unique<FreeRotation>(model_.principal.moments, R, L);
  }

  Moment momentAt(const Real& t) {
    const Real s = t - start_;
    const RMat R = rotation_->orientationAt(s);
    return {x_ + s * v_ + (s * s / 2) * n_.body.gravity, v_ + s * n_.body.gravity, rotation_->spinAt(R), R,
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
  RealModel model_;
  std::vector<Point> points_;
  RVec normal_;
  Real start_;
  RVec x_, v_;
  std::unique_ptr<FreeRotation> rotation_;
};

RVec rotationBetween(const RMat& R_0, const RMat& R_1) {
  RVec sum;
  for (int j = 0; j < 3; ++j) sum = sum + cross(R_0.column[j], R_1.column[j]);
  return (Real(1) / 2) * sum;
}

}  // namespace

ThrowNumbers throwNumbers(const Scene& scene, int body, int floor) {
  const Body& f = scene.bodies[static_cast<std::size_t>(floor)];
  const Plane& plane = std::get<Plane>(f.shape);
  return {writtenNumbers(scene, scene.bodies[static_cast<std::size_t>(body)]),
          {unit(RVec(plane.normal)), RVec(f.position), plane.offset, rotationOf(f.orientation)}};
}

std::vector<WrittenState> replay(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts, const Real& end,
                                 bool decide) {
  std::vector<WrittenState> states;
  Throw run(numbers);
  for (const PointImpact& impact : impacts) {
    const Real t = run.timeOf(impact);
    states.push_back(run.stateAt(t));
    run.strike(impact, t, decide);
  }
  states.push_back(run.stateAt(end));
  return states;
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

std::vector<Eigen::Matrix<double, 13, 1>> replayDerivative(const ThrowNumbers& numbers,
                                                           const std::vector<PointImpact>& impacts, const Real& end,
                                                           const ThrowKnob& knob) {
  std::vector<WrittenState> ends[2];
  for (int side : {0, 1}) {
    ThrowNumbers nudged = numbers;
    knob.nudge(nudged, side ? kNudge : Real(-kNudge));
    ends[side] = replay(nudged, impacts, end, false);
  }
  std::vector<Eigen::Matrix<double, 13, 1>> out;
  const Real f = 1 / (2 * kNudge);
  for (std::size_t k = 0; k < ends[0].size(); ++k) {
    const WrittenState &lo = ends[0][k], &hi = ends[1][k];
    Eigen::Matrix<double, 13, 1> d;
    d << (f * (hi.position - lo.position)).rounded(), (f * rotationBetween(lo.R, hi.R)).rounded(),
        (f * (hi.velocity - lo.velocity)).rounded(), (f * (hi.spin - lo.spin)).rounded(),
        static_cast<double>(f * (hi.time - lo.time));
    out.push_back(d);
  }
  return out;
}

std::vector<Eigen::Matrix<double, 13, 1>> replaySecondDerivative(const ThrowNumbers& numbers,
                                                                 const std::vector<PointImpact>& impacts,
                                                                 const Real& end, const std::vector<ThrowKnob>& knobs,
                                                                 const std::vector<double>& direction,
                                                                 const ThrowKnob& knob) {
  const Real h("1e-11");
  const Real f = 1 / (4 * h * h);
  std::vector<Eigen::Matrix<Real, 13, 1>> sum;
  for (int along : {-1, 1}) {
    ThrowNumbers moved = numbers;
    for (std::size_t k = 0; k < knobs.size(); ++k) knobs[k].nudge(moved, along * h * direction[k]);
    std::vector<WrittenState> ends[2];
    for (int side : {0, 1}) {
      ThrowNumbers nudged = moved;
      knob.nudge(nudged, side ? h : Real(-h));
      ends[side] = replay(nudged, impacts, end, false);
    }
    sum.resize(ends[0].size(), Eigen::Matrix<Real, 13, 1>::Zero());
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const WrittenState &lo = ends[0][k], &hi = ends[1][k];
      const RVec parts[] = {hi.position - lo.position, rotationBetween(lo.R, hi.R), hi.velocity - lo.velocity,
                            hi.spin - lo.spin};
      for (int i = 0; i < 12; ++i) sum[k][i] += along * parts[i / 3][i % 3];
      sum[k][12] += along * (hi.time - lo.time);
    }
  }
  std::vector<Eigen::Matrix<double, 13, 1>> out;
  for (const auto& numbers_of : sum) {
    Eigen::Matrix<double, 13, 1>& d = out.emplace_back();
    for (Eigen::Index i = 0; i < 13; ++i) d[i] = static_cast<double>(f * numbers_of[i]);
  }
  return out;
}

}  // namespace carom::reference
