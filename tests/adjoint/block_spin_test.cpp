// SPDX-License-Identifier: MIT
// What a little spin makes of a block that slides without turning (11.28): against the same contacts held by collocation,
// whose corners' friction turns, and against differences of motions that spin.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adjoint/derivative/arc_pass.hpp"
#include "adjoint/constrained/constrained_linearization.hpp"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/path_arc.hpp"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/transposed.h"

namespace carom::block_spin {
namespace {

using namespace test;
using namespace adjoint_detail;

struct Slide {
  Scene scene;
  Motion motion;
  int body = 0;
  const Arc& arc() const { return motion.world_lines[static_cast<std::size_t>(body)].arcs[1]; }
  double until() const {
    const auto& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
    return arcs.size() > 2 ? arcs[2].start() : motion.end;
  }
};

// Level, straight down or up a slope, or round a bend; low enough not to tip. Some are partly beyond the border of a table, so
// that edges cross; some have a centre of mass and moments of their own.
Slide randomSlide(Random& random) {
  const int way = random.below(4);
  const double friction = random.in(0.1, 0.6), degrees = way == 0 ? 0 : random.in(2, 40);
  Body block = makeBox("block", {random.in(0.2, 0.5), random.in(0.2, 0.5), random.in(0.02, 0.1)}, {0, 0, 0});
  block.position.z() = 0.5 * std::get<Box>(block.shape).size.z();
  const double angle = way == 1 ? std::numbers::pi * random.below(2) : random.in(0, 2 * std::numbers::pi);
  block.velocity = random.in(0.5, 2) * Vec3(std::cos(angle), std::sin(angle), 0);
  block.orientation = Quat(Eigen::AngleAxisd(random.in(0, 6), Vec3::UnitZ()));
  const bool beyond = random.below(3) == 0, first = random.below(2) == 0;
  Body floor = beyond ? fixedBody(makeBox("floor", {10, 10, 1}, {0, 0, -0.5})) : makePlane("floor", Vec3::UnitZ(), 0);
  if (beyond) floor.position.x() = random.in(-0.03, 0.03) - 5 + 0.02, block.velocity.x() *= 0.05, block.velocity *= 0.3;
  Slide out;
  out.body = first ? 0 : 1;
  out.scene = first ? makeScene(downSlope(degrees), 0, friction, {block, floor})
                    : makeScene(downSlope(degrees), 0, friction, {floor, block});
  out.motion = playLasting(out.scene, 0.6);
  return out;
}

PathArc constrainedInstead(const Slide& slide) {
  const Motion& m = slide.motion;
  std::vector<Contact> lasting;
  for (const Contact& c : m.events[0].contacts) {
    if (!c.lasts) continue;
    lasting.push_back(c);
    lasting.back().pair = combine(m.scene->materials[0], m.scene->materials[0]);
  }
  const std::vector<const Contact*> closed = pointersTo(lasting);
  const State& start = slide.arc().startState();
  const ContactChoice candidates = constrainedPathOf(m, slide.body, start, closed, std::vector<PersistentContact>(closed.size()), slide.arc().start());
  const ConstrainedModes modes = chooseModes(candidates.scene, candidates.modes.contacts, start, {}, 1e-9);
  std::vector<const Contact*> holding;  // without corners that would have to pull
  for (const std::size_t k : modes.held) holding.push_back(closed[k]);
  return makePathArc(m, constrainedPathOf(m, slide.body, start, holding, modes.contacts, slide.arc().start()), slide.arc().start());
}

constexpr double kSame = 1e-10;
// A spin ends as a power of the slip, which may be a small one; collocation leaves off at 1e-8 of the speed.
constexpr double kSameAtEnd = 2e-8;

TEST(BlockSpin, IsThatOfCornersThatAreConstrained) {
  int compared = 0, at_end = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    const Slide slide = randomSlide(random);
    ASSERT_GE(slide.motion.world_lines[static_cast<std::size_t>(slide.body)].arcs.size(), 2u);
    const Arc& arc = slide.arc();
    if (!arc.closedForm() || arc.closedForm()->form != PathForm::glide_block || arc.closedForm()->inputs.begins) continue;
    PathArc held = constrainedInstead(slide);
    const auto& path = *held.arc.trajectory().constrained();
    const double until = slide.until();
    held.arc.extendTo(until < slide.motion.end ? until + 1e-3 : until);
    StateDerivative start;
    start.L = Vec3(random.in(-1, 1), random.in(-1, 1), 1);
    const SceneTangent still(slide.scene);
    const BodyModelDerivative same;
    for (const double share : {0.1, 0.5, 0.9, 1.0}) {
      const double t = std::min(share * until, held.arc.knownUntil());
      if (share == 1 && !(path.ending() && std::abs(path.ending()->time - until) < 1e-11)) continue;
      SCOPED_TRACE("share " + std::to_string(share));
      const ConstrainedColumns columns(slide.motion, path);
      const StateDerivative expected =
          asState(constrainedSensitivity(path, columns.inputs(), t) * columns.tangent(start, still, same));
      DerivativeTape tape(slide.motion);
      const double own = share == 1 ? until : t;
      const StateDerivative found =
          arcTangent(arc, own, tape.arcUntil(slide.body, 1, own), start, still, same);
      const bool stops = share == 1 && arc.closedForm()->elapsedAt(until) == arc.closedForm()->slip_end;
      const double size = asVector(expected).norm(), allowed = stops ? kSameAtEnd : kSame;
      expectEntries(found.theta, expected.theta, allowed, "turn", size);
      expectEntries(found.x, expected.x, allowed, "place", size);
      if (!stops) {
        expectEntries(found.v, expected.v, allowed, "velocity", size);
        expectEntries(found.L, expected.L, allowed, "momentum", size);
      } else {  // the last of a slip is known exactly: it only comes earlier or later, along its direction
        EXPECT_EQ(found.L, Vec3::Zero());
        const PathInputs<double>& in = arc.closedForm()->inputs;
        EXPECT_LE(found.v.cross(alongFace(in.normal, in.gravity)).norm(), 1e-14 * size);
      }
      ++compared, at_end += stops;
    }
    if (::testing::Test::HasFailure()) return;
  }
  RecordProperty("compared", compared);
  RecordProperty("at_end", at_end);
  EXPECT_GT(compared, 100);
  EXPECT_GT(at_end, 5);
}

// On past the end of the slide, to rest; seen from tangent and adjoint.
TEST(BlockSpin, IsTheLimitOfDifferences) {
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    Body block = makeBox("block", {random.in(0.2, 0.5), random.in(0.2, 0.5), random.in(0.02, 0.2)}, {0, 0, 0});
    block.position.z() = 0.5 * std::get<Box>(block.shape).size.z();
    block.velocity = {random.in(0.5, 1), random.in(-1, 1), 0};
    const double degrees = seed % 2 == 0 ? 0 : random.in(2, 10);
    const Scene scene = makeScene(downSlope(degrees), 0, random.in(0.3, 0.6), {block, makePlane("floor", Vec3::UnitZ(), 0)});
    const Motion m = playLasting(scene, 1.5);
    ASSERT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest) << m.message;
    const double h = 1e-4;
    SceneTangent spins(scene);
    spins.bodies[0].angular_velocity.z() = 1;
    const auto spinning = [&](double spin) { return playLasting(moved(scene, spins, spin), 1.5).stateAt(0, 1.5); };
    const BodyState above = spinning(h), below = spinning(-h);
    DerivativeTape tape(m);
    const BodyStateRate found = tangent(tape, spins).at(0, Instant::at(1.5));
    EXPECT_GT(std::abs(found.orientation.z()), 0.01);
    const Vec3 turn = 2 * (above.orientation * below.orientation.conjugate()).vec() / (2 * h);
    expectEntries(found.orientation, turn, 1e-5, "turn");
    expectEntries(found.position, Vec3((above.position - below.position) / (2 * h)), 1e-5, "place");
    expectTransposed(m, static_cast<std::uint64_t>(seed));
  }
}

}  // namespace
}  // namespace carom::block_spin
