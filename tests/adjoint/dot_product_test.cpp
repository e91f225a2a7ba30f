// Equation 5.5: the tangent and the adjoint pass are each other's transpose, <J u, w> = <u, J^T w>, for every control,
// impact law, flight tier and pair of features. Errors are relative to the sums of absolute products.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adjoint/tangent.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/dot_product_scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kDot = 1e-13;

double absoluteSum(const BodyStateRate& r, const StateSeed& s) {
  return r.position.cwiseAbs().dot(s.position.cwiseAbs()) + r.orientation.cwiseAbs().dot(s.orientation.cwiseAbs()) +
         r.velocity.cwiseAbs().dot(s.velocity.cwiseAbs()) +
         r.angular_velocity.cwiseAbs().dot(s.angular_velocity.cwiseAbs()) + std::abs(r.time * s.time);
}

/// Sum of absolute products, at least `least`; returns it.
double expectTransposed(DerivativeTape& tape, const SceneTangent& direction, const std::vector<StateSeed>& seeds,
                        double least, const std::string& what) {
  const MotionTangent t = tangent(tape, direction);
  double lhs = 0, size = least;
  for (const StateSeed& seed : seeds) {
    const BodyStateRate rate = t.at(seed.body, seed.at);
    lhs += rate.dot(seed);
    size += absoluteSum(rate, seed);
  }
  const SceneGradient g = adjoint(tape, seeds);
  const double rhs = g.dot(direction);
  size = std::max(size, flatten(g).cwiseAbs().dot(flatten(direction).cwiseAbs()));
  expectEntries(lhs / size, rhs / size, kDot, what);
  return size;
}

std::vector<int> movingBodies(const Scene& s) {
  std::vector<int> list;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    if (!s.bodies[static_cast<std::size_t>(b)].fixed) list.push_back(b);
  return list;
}

/// Fields of a SceneDerivative, by control.
struct ControlRow {
  const char* name;
  std::function<void(SceneTangent& to, const SceneTangent& from)> copy;
};

std::vector<ControlRow> controls() {
  std::vector<ControlRow> rows = {
      {"gravity", [](auto& to, const auto& from) { to.gravity = from.gravity; }},
      {"tilt", [](auto& to, const auto& from) { to.tilts = from.tilts; }},
  };
  const auto body = [&](const char* name, auto member) {
    rows.push_back({name, [member](auto& to, const auto& from) {
                      for (std::size_t b = 0; b < to.bodies.size(); ++b) to.bodies[b].*member = from.bodies[b].*member;
                    }});
  };
  body("position", &BodyDerivative::position);
  body("orientation", &BodyDerivative::orientation);
  body("velocity", &BodyDerivative::velocity);
  body("angular_velocity", &BodyDerivative::angular_velocity);
  body("mass", &BodyDerivative::mass);
  body("density", &BodyDerivative::density);
  body("inertia", &BodyDerivative::inertia);
  body("size", &BodyDerivative::size);
  const auto material = [&](const char* name, auto member) {
    rows.push_back({name, [member](auto& to, const auto& from) {
                      for (std::size_t m = 0; m < to.materials.size(); ++m)
                        to.materials[m].*member = from.materials[m].*member;
                    }});
  };
  material("elasticity", &MaterialDerivative::elasticity);
  material("friction", &MaterialDerivative::friction);
  material("tangential_elasticity", &MaterialDerivative::tangential_elasticity);
  return rows;
}

class DotProduct : public ::testing::TestWithParam<DotProductScene> {};

TEST_P(DotProduct, TangentAndAdjointAreTransposed) {
  const DotProductScene& row = GetParam();
  const Scene scene = row.scene();
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = row.impacts;
  options.asked = row.asked;
  const Motion m = simulate(scene, contacts, 3, options);
  ASSERT_FALSE(m.events.empty());
  for (const char* word : row.has)  // the row is about what its name says
    EXPECT_NE(
        (m.describeEvent(0) + " " + nameOf(m.plan.bodies[0].tier) + "/" + nameOf(m.plan.bodies[0].derivative_tier))
            .find(word),
        std::string::npos)
        << word << " in " << m.describeEvent(0);
  DerivativeTape tape(m);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const SceneTangent all = randomDirection(scene, random);
    std::vector<StateSeed> at_times, at_impacts;
    for (int b : movingBodies(scene)) {
      at_times.push_back(randomSeed(b, Instant::at(random.in(0, m.end)), random));
      at_times.push_back(randomSeed(b, Instant::at(m.end), random));
      for (int n = 1; n <= 2; ++n)
        if (const auto e = m.findImpact(b, n)) at_impacts.push_back(randomSeed(b, Instant::before(*e), random));
    }
    // some derivatives are 0 (a lone body's by its mass) and cannot be held to their own size
    const double least_t = 1e-2 * expectTransposed(tape, all, at_times, 1e-12, "everything, at times");
    const double least_i = 1e-2 * expectTransposed(tape, all, at_impacts, 1e-12, "everything, at impacts");
    for (const ControlRow& control : controls()) {
      SceneTangent d(scene);
      control.copy(d, all);
      expectTransposed(tape, d, at_times, least_t, std::string(control.name) + ", at times");
      expectTransposed(tape, d, at_impacts, least_i, std::string(control.name) + ", at impacts");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, DotProduct, ::testing::ValuesIn(dotProductScenes()),
                         [](const auto& row) { return std::string(row.param.name); });

// Controls that a motion does not depend on have no derivative, in either pass; those that it does depend on have one.
TEST(DotProductRows, EveryControlMattersInSomeRow) {
  for (const ControlRow& control : controls()) {
    bool matters = false;
    for (const DotProductScene& row : dotProductScenes()) {
      const Scene scene = row.scene();
      const Motion m = play(scene, 3, row.impacts);
      Random random(5);
      const SceneTangent all = randomDirection(scene, random);
      SceneTangent d(scene);
      control.copy(d, all);
      const StateSeed seed = randomSeed(movingBodies(scene)[0], Instant::at(m.end), random);
      matters |= std::abs(adjoint(m, std::span(&seed, 1)).dot(d)) > 1e-3;
    }
    EXPECT_TRUE(matters) << control.name;
  }
}

}  // namespace
}  // namespace carom
