// SPDX-License-Identifier: MIT
// The derivative of paths of boxes that floors hold at their corners, by everything that they depend on, against
// differences of series in 50 digits: what the collocation leaves out is below what is compared.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "adjoint/constrained/constrained_sensitivity.hpp"
#include "tests/reference/differences.h"
#include "tests/reference/constrained_along.h"
#include "tests/reference/constrained_boxes.h"
#include "tests/reference/worst.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::reference::held_sensitivity {
namespace {

using adjoint_detail::PersistentContact;
using adjoint_detail::ConstrainedInputs;
using adjoint_detail::ContactMode;
using adjoint_detail::ConstrainedPath;
using test::playLasting;
using test::Random;

using Column = Eigen::Matrix<double, 12, 1>;

constexpr int kOrder = 16, kTimes = 4;
const Real kTolerance("1e-17");  // what the series leave out varies with the numbers no more than they do
constexpr double kColumn = 1e-10;
const Real kNoStart("1e-9");  // of gravity: friction has just come to its limit, and the slip has no acceleration yet

// What a path depends on.
struct Numbers {
  ConstrainedBody body;
  std::vector<ConstrainedCorner> corners;
  ConstrainedState start;
  Real time;
  RMat axes = RMat::identity();  // of the inertia, in those that the path has
};

RVec momentumOf(const ConstrainedBody& body, const ConstrainedState& s) { return s.R * times(body.inertia, transposeTimes(s.R, s.spin)); }

void giveMomentum(Numbers& n, const RVec& L) {
  RVec own = transposeTimes(n.start.R, L);
  for (int i = 0; i < 3; ++i) own[i] /= n.body.inertia[i];
  n.start.spin = n.start.R * own;
}

// A product of inertia turns the principal axes: [w]x D - D [w]x is what it adds to the diagonal D.
void addProduct(Numbers& n, int which, const Real& h) {
  const int j = (which + 1) % 3, k = (which + 2) % 3;
  const RMat turn = rotationBy(axisVector(which, h / (n.body.inertia[j] - n.body.inertia[k])));
  n.axes = n.axes * turn, n.start.R = n.start.R * turn;
  for (ConstrainedCorner& c : n.corners) c.at = transposeTimes(turn, c.at);
}

// One of the columns of ConstrainedInputs, by h; the momentum stays where it is not that.
Numbers nudged(Numbers n, const ConstrainedPath& path, const ConstrainedInputs& inputs, int column, const Real& h) {
  RVec L = momentumOf(n.body, n.start);
  const int own = column % 3;
  const ConstrainedInputs::Partner& floor = inputs.partners.at(0);
  if (column < 3) n.start.x[own] += h;
  else if (column < 6) n.start.R = rotationBy(axisVector(own, h)) * n.start.R;
  else if (column < 9) n.start.v[own] += h;
  else if (column < 12) L[own] += h;
  else if (column < ConstrainedInputs::kMass) n.body.gravity[own] += h;
  else if (column == ConstrainedInputs::kMass) n.body.mass += h;
  else if (column < ConstrainedInputs::kProducts) n.body.inertia[column - ConstrainedInputs::kInertia] += h;
  else if (column < ConstrainedInputs::kSizes) addProduct(n, column - ConstrainedInputs::kProducts, h);
  else if (column < ConstrainedInputs::kSizes + inputs.size_count) {
    const int side = column - ConstrainedInputs::kSizes;
    for (ConstrainedCorner& c : n.corners) c.at[side] += (c.at[side] > 0 ? h : Real(-h)) / 2;
  } else if (column < floor.sizes) {
    const int part = column - floor.pose;
    const RVec about(path.scene().with[0].pose.x);
    for (ConstrainedCorner& c : n.corners) {
      const Real rest = c.offset - dot(c.normal, about);
      if (part < 3) c.offset += h * c.normal[part];
      else c.normal = rotationBy(axisVector(part - 3, h)) * c.normal, c.offset = dot(c.normal, about) + rest;
    }
  } else {
    n.corners.at(static_cast<std::size_t>(column - inputs.friction)).friction += h;
  }
  giveMomentum(n, L);
  return n;
}

// What was left of speeds at the start is taken away where the corners are now, and along their normals where they slide.
void stopAgain(Numbers& n, const Numbers& known, const std::vector<Vec3>& stopped) {
  RVec L = momentumOf(n.body, n.start);
  for (std::size_t k = 0; k < stopped.size(); ++k) {
    const ConstrainedCorner &c = n.corners[k], &was = known.corners[k];
    const RVec before(stopped[k]);
    const RVec now = c.sticks || c.begins ? before : dot(was.normal, before) * c.normal;
    n.start.v = n.start.v + (1 / n.body.mass) * now - (1 / known.body.mass) * before;
    L = L + cross(n.start.R * c.at, now) - cross(known.start.R * was.at, before);
  }
  giveMomentum(n, L);
}

// The unit of a column: that much of the input moves the state by about as much as it is.
double unitOf(const ConstrainedPath& path, const ConstrainedInputs& inputs, int column) {
  const BodyModel& model = *path.scene().model;
  const double l = path.scene().length, c = path.scene().speed, inertia = model.inertia.maxCoeff();
  if (column < ConstrainedInputs::kMass) return std::array{l, 1.0, c, inertia * c / l, path.scene().gravity.norm()}[static_cast<std::size_t>(column / 3)];
  if (column == ConstrainedInputs::kMass) return model.mass;
  if (column < ConstrainedInputs::kSizes) return inertia;
  if (column < ConstrainedInputs::kSizes + inputs.size_count) return l;
  const int pose = inputs.partners.at(0).pose;
  return column >= pose && column < pose + 3 ? l : 1;
}

// What is left of the cone of friction at a corner if those that begin to slip stick, some time after the start.
Real roomAt(const Numbers& n, std::size_t k, const Real& t) {
  std::vector<ConstrainedCorner> stuck = n.corners;
  for (ConstrainedCorner& c : stuck)
    if (c.begins) c.sticks = true, c.begins = false;
  const ConstrainedSeries held(n.body, stuck, projected(n.body, stuck, n.start), 4, kTolerance);
  const RVec f = held.force(k, t);
  const Real pressing = held.pressing(k, t);
  return n.corners[k].friction * pressing - sqrt(dot(f, f) - pressing * pressing);
}

// How much later the path starts: where a slip begins with an acceleration, when it is 0 (5.4); where friction has just
// come to its limit, when it is there.
Real delayOf(const Numbers& n, const Numbers& known, const ConstrainedSeries& series) {
  Real across = 0, square = 0;
  std::size_t last = 0;
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    if (!n.corners[k].begins) continue;
    const RVec rate = known.start.R * series.slipRate(k);
    across += dot(rate, n.start.v + cross(n.start.spin, n.start.R * n.corners[k].at));
    square += dot(rate, rate);
    last = k;
  }
  if (!n.corners[last].begins) return 0;
  if (!(sqrt(square) < kNoStart * norm(n.body.gravity))) return -across / square;
  const Real now = roomAt(known, last, 0), rate = (roomAt(known, last, kNudge) - now) / kNudge;
  return (now - roomAt(n, last, 0)) / rate;
}

void moveStart(Numbers& n, const Numbers& known, const ConstrainedSeries& series) {
  const Real dt = delayOf(n, known, series);
  const ConstrainedState s0 = series.at(0), s1 = series.at(dt);
  n.time += dt;
  n.start.x = n.start.x + (s1.x - s0.x), n.start.v = n.start.v + (s1.v - s0.v), n.start.spin = n.start.spin + (s1.spin - s0.spin);
  n.start.R = s1.R * transpose(s0.R) * n.start.R;
}

std::vector<ConstrainedState> statesOf(const Numbers& n, const std::vector<double>& at) {
  ConstrainedAlong along(n.body, n.corners, n.start, n.time, kOrder, kTolerance);
  std::vector<ConstrainedState> states;
  for (const double t : at) states.push_back(along.at(t));
  return states;
}

// A start in doubles has the direction of a slow slip no better.
double directionsKnownTo(const ConstrainedPath& path) {
  const auto now = path.instantAt(path.start());
  double slowest = kInfinity;
  for (std::size_t k = 0; k < path.contacts().size(); ++k)
    if (path.contacts()[k].mode == ContactMode::slides && !path.contacts()[k].begins) slowest = std::min(slowest, now.slipAt(k).norm());
  return std::numeric_limits<double>::epsilon() * path.scene().speed / slowest;
}

struct Seen {
  int paths = 0, begin = 0, slide = 0, stick = 0, redundant = 0, unknown = 0;
  double worst = 0;
};

// Of one path, at times that grow, every so manieth column from one on: the worst error as a share of its column.
double worstOf(const ConstrainedPath& path, const Vec3& size, const std::vector<double>& at, int stride, std::size_t first,
               const std::string& which) {
  const BodyModel& model = *path.scene().model;
  const State start = path.stateAt(path.start());
  const ConstrainedBody body = bodyOf(path);
  const std::vector<ConstrainedCorner> corners = cornersOf(path, size);
  const Numbers known{body, corners, projected(body, corners, stateOf(model, start)), path.start()};
  const ConstrainedSeries series(body, corners, known.start, 3, kTolerance);
  const ConstrainedInputs inputs(path.scene(), path.contacts(), start);
  // What stops speeds is differentiated at the event; where no slip begins, that is at the time at which the path starts.
  const bool stops = path.stopsSpeeds() && std::ranges::none_of(path.contacts(), &PersistentContact::begins);
  std::vector<Eigen::MatrixXd> found;
  for (const double t : at) {
    found.push_back(constrainedSensitivity(path, inputs, t));
    if (stops) found.back() = ConstrainedInputs::chained(found.back(), constrainedStop(path, inputs));
  }
  const double l = path.scene().length, c = path.scene().speed, turning = model.inertia.maxCoeff() * c / l;
  Column unit;
  unit << Vec3::Constant(l), Vec3::Ones(), Vec3::Constant(c), Vec3::Constant(turning);
  const std::vector<ConstrainedState> before = statesOf(known, at);
  const double allowed = kColumn + directionsKnownTo(path);
  double worst = 0;
  for (int column = static_cast<int>(first % static_cast<std::size_t>(stride)); column < inputs.count; column += stride) {
    std::vector<Column> expected;
    Numbers there = nudged(known, path, inputs, column, kNudge);
    there.start = withoutGaps(there.body, there.corners, there.start);
    if (stops) stopAgain(there, known, path.stopped());
    moveStart(there, known, series);
    const std::vector<ConstrainedState> after = statesOf(there, at);
    const double input = unitOf(path, inputs, column);
    const Real over = 1 / kNudge;
    double whole = kSmallestScale;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const ConstrainedState &from = before[i], &to = after[i];
      Column d;
      d << (over * (to.x - from.x)).rounded(), (over * rotationBetween(from.R, to.R * transpose(there.axes))).rounded(),
          (over * (to.v - from.v)).rounded(), (over * (momentumOf(there.body, to) - momentumOf(known.body, from))).rounded();
      expected.push_back(input * d.cwiseQuotient(unit));
      whole = std::max(whole, expected.back().norm());
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Column here = input * found[i].col(column).cwiseQuotient(unit);
      const double error = (here - expected[i]).cwiseAbs().maxCoeff() / whole;
      if (!(error <= allowed))
        ADD_FAILURE() << which << ", column " << column << " at " << at[i] << ": " << error << " of it\n"
                      << here.transpose() << "\n" << expected[i].transpose();
      keepWorst(worst, error);
    }
  }
  test::recordShare(worst / allowed);
  return worst;
}

Seen expectPaths(const Scene& scene, double duration, std::uint64_t seed, int stride = 1) {
  const Motion m = playLasting(scene, duration);
  const Vec3 size = std::get<Box>(scene.bodies[0].shape).size;
  Random random(seed);
  Seen seen;
  for (const ConstrainedSpan& span : constrainedPathsOf(m)) {
    std::vector<double> at;
    for (int i = 0; i < kTimes; ++i) at.push_back(random.in(span.path->start(), span.until));
    std::sort(at.begin(), at.end());
    try {
      const std::string which = "seed " + std::to_string(seed) + ", path " + std::to_string(span.arc);
      keepWorst(seen.worst, worstOf(*span.path, size, at, stride, span.arc, which));
    } catch (const SlipsTogether&) {
      ++seen.unknown;
      continue;
    }
    ++seen.paths;
    seen.begin += span.any([](const PersistentContact& c) { return c.begins; });
    seen.slide += span.any([](const PersistentContact& c) { return c.mode == ContactMode::slides && !c.begins; });
    seen.stick += span.any([](const PersistentContact& c) { return c.mode == ContactMode::sticks; });
    seen.redundant += span.path->redundant();
  }
  std::printf("seed %llu: %d paths, worst %.2g of a column\n", static_cast<unsigned long long>(seed), seen.paths, seen.worst);
  return seen;
}

TEST(ConstrainedSensitivity, ACornerSticks) {
  EXPECT_GE(expectPaths(onCorner(kLeaning, 0.9, Vec3::Zero(), Vec3::Zero()), 0.15, 1).stick, 1);
}
TEST(ConstrainedSensitivity, ACornerSlides) {
  EXPECT_GE(expectPaths(onCorner(kLeaning, 0.9, {0.05, 0.1, 0}, {0.2, 0.1, 1}), 0.15, 2).slide, 1);
}
TEST(ConstrainedSensitivity, ACornerStartsToSlideFromRest) {
  EXPECT_GE(expectPaths(onCorner(kLeaning, 0.1, Vec3::Zero(), Vec3::Zero()), 0.15, 3).begin, 1);
}
TEST(ConstrainedSensitivity, AnEdgeSticks) {
  EXPECT_GE(expectPaths(onCorner(Quat(Eigen::AngleAxisd(0.7, Vec3::UnitX())), 0.4, Vec3::Zero(), Vec3::Zero()), 0.3, 4).stick, 1);
}
TEST(ConstrainedSensitivity, AFaceSlidesAndTurns) {
  EXPECT_GE(expectPaths(onCorner(Quat::Identity(), 0.4, {1, 0.3, 0}, {0, 0, 5}), 0.9, 5).redundant, 1);
}

// Whatever comes of boxes that are dropped.
TEST(ConstrainedSensitivity, RandomBoxes) {
  Seen all;
  for (int i = 1; i <= test::scaled(2); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Seen seen = expectPaths(droppedBox(seed), 1.5, seed, test::testScale() < 1.5 ? 4 : 1);
    all.paths += seen.paths, all.begin += seen.begin, all.slide += seen.slide, all.stick += seen.stick;
    all.unknown += seen.unknown, all.worst = std::max(all.worst, seen.worst);
  }
  std::printf("%d paths: %d begin to slip, %d slide, %d stick; %d unknown; worst %g of a column\n", all.paths, all.begin,
              all.slide, all.stick, all.unknown, all.worst);
  EXPECT_TRUE(all.begin > 0 && all.slide > 0 && all.stick > 0 && 20 * all.unknown < all.paths);
}

}  // namespace
}  // namespace carom::reference::held_sensitivity
