// SPDX-License-Identifier: MIT
// Numbers that cannot be computed with: a status and a sentence, wherever it happens.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/impact/complementarity.hpp"
#include "adjoint/impact/impact.hpp"
#include "ode_bridge/gaps.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
const Vec3 kDown(0, 0, -9.81);

void expectEnded(const Motion& m, const std::vector<std::string>& words) {
  EXPECT_EQ(m.status, MotionStatus::not_computable) << m.message;
  EXPECT_STREQ(nameOf(m.status), "not_computable");
  EXPECT_TRUE(m.end >= 0 && m.end <= m.duration) << m.end;
  for (const std::string& word : words) EXPECT_NE(m.message.find(word), std::string::npos) << word << ": " << m.message;
  for (std::size_t b = 0; b < m.world_lines.size(); ++b)
    EXPECT_TRUE(m.stateAt(static_cast<int>(b), m.end).position.allFinite());
}

TEST(NotComputable, BodiesThatTurnTooFastToBeFollowed) {
  Scene s = makeScene(kDown, 0.5, 0.5, {makeBox("box", {0.1, 0.2, 0.3}, {0, 0, 1}), makePlane("floor", Vec3::UnitZ(), 0)});
  s.bodies[0].angular_velocity = {1e9, 1e6, 0};
  expectEnded(play(s, 1), {"'box' and 'floor'", "more than 1000000 steps"});
}

TEST(NotComputable, ASpinOfWhichNoDigitIsLeft) {
  Scene s = makeScene(kDown, 0.5, 0, {makeBox("box", {0.1, 0.2, 0.3}, {0, 0, 1})});
  s.bodies[0].angular_velocity = {1e9, 1e6, 1e3};
  EXPECT_EQ(play(s, 1e3).status, MotionStatus::complete);
  expectEnded(play(s, 1e7), {"'box'", "no digit of its orientation"});
}

// A source whose answers are no numbers, or features without a contact.
class Spoilt final : public ContactSource {
 public:
  explicit Spoilt(double time) : time_(time) {}
  explicit Spoilt(const FeaturePair& features) : features_(features) {}
  void begin(const Scene& scene) override { inner_.begin(scene); }
  void setPath(int body, const Arc& arc, double from, double until) override { inner_.setPath(body, arc, from, until); }
  void neighbours(int body, std::vector<int>& out) override { inner_.neighbours(body, out); }
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override {
    auto impact = inner_.firstImpact(a, b, arc_a, arc_b, from, until);
    if (impact && time_) impact->time = *time_;
    if (impact && features_) impact->features = *features_;
    return impact;
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return inner_.geometry(); }

 private:
  std::optional<double> time_;
  std::optional<FeaturePair> features_;
  OdeContacts inner_{Scene{}};
};

// A rim that lies flat on a face has no lowest point.
TEST(NotComputable, AContactWithoutAPoint) {
  Body high = makeBox("high", {1, 1, 1}, {0, 0, 2});
  high.shape = Cylinder{0.5, 1};
  const Scene s = makeScene(kDown, 0.5, 0.5, {fixedBody(makeBox("low", {2, 2, 1}, {0, 0, 0.5})), high});
  const int top = 5, rim = 0;
  Spoilt contacts(FeaturePair{kPlaneRim, top, rim, 1});
  expectEnded(simulate(s, contacts, 1), {"'low' and 'high'", "t = 0.319275 s", "face +z on rim -z", "no point or no normal"});
}

TEST(NotComputable, ATimeThatIsNoNumber) {
  const Scene s = makeScene(kDown, 0.5, 0, {makeBall("ball", 0.1, {0, 0, 1}), makePlane("floor", Vec3::UnitZ(), 0)});
  for (double time : {kNan, kInfinity, -kInfinity}) {
    Spoilt contacts(time);
    expectEnded(simulate(s, contacts, 1), {"'ball' and 'floor'", "beyond the range of doubles"});
  }
}

TEST(NotComputable, AnImpulseThatIsNoNumber) {
  Scene s = makeScene(kDown, 0.5, 0.3, {makeBall("ball", 0.1, {0, 0, 1}), makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion m = play(s, 0.5);
  ASSERT_EQ(m.events.size(), 1u);
  std::vector<State> after;
  for (double inverse : {kInfinity, kNan}) {
    std::vector<BodyModel> models = *m.models;
    models[0].inverse_mass = inverse;
    Event event = m.events[0];
    EXPECT_THROW(solveImpact(event, models, after), NotComputable) << inverse;
    event.contacts.push_back(event.contacts[0]);
    EXPECT_THROW(solveImpact(event, models, after), NotComputable) << inverse << ", two contacts";
  }
  Event event = m.events[0];
  event.contacts[0].at.point.x() = kNan;
  EXPECT_THROW(solveImpact(event, *m.models, after), NotComputable);
  EXPECT_NO_THROW(solveImpact(event = m.events[0], *m.models, after));
}

TEST(NotComputable, SystemsOfContacts) {
  const Eigen::MatrixXd empty(0, 0);
  const Eigen::VectorXd none(0);
  const LeastNormSolve nothing(empty, none);
  EXPECT_EQ(nothing.y.size(), 0);
  EXPECT_EQ(nothing.tangent(empty, none).size(), 0);
  EXPECT_TRUE(activeContacts(empty, none).empty());
  const Eigen::Matrix2d zero = Eigen::Matrix2d::Zero();
  expectEntries(LeastNormSolve(zero, Eigen::Vector2d(1, 2)).y, Eigen::Vector2d::Zero(), 0, "a mass without end");
  EXPECT_TRUE(activeContacts(Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 2)).empty()) << "all of them part";
  for (double bad : {kNan, kInfinity, -kInfinity}) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
    Eigen::Vector2d b(-1, -2);
    b[1] = bad;
    EXPECT_THROW(LeastNormSolve(A, b), NotComputable);
    EXPECT_THROW(activeContacts(A, b), NotComputable);
    b[1] = -2, A(0, 1) = A(1, 0) = bad;
    EXPECT_THROW(LeastNormSolve(A, b), NotComputable);
    EXPECT_THROW(activeContacts(A, b), NotComputable);
  }
}

// Spins whose twentieth powers leave the range of doubles when squared turn like any other, on another scale of time.
TEST(NotComputable, IsNoMatterOfTheUnitOfTime) {
  const Vec3 D(1, 2, 3.5), L(0.3, -0.5, 0.8);
  const auto orientation = [&](double scale) {
    TriaxialRotation rotation;
    rotation.begin(D, Quat::Identity(), scale * L);
    rotation.extendTo(40 / scale);
    return rotation.orientationAt(40 / scale).coeffs().eval();
  };
  const auto ordinary = orientation(1);
  for (double scale : {0x1p-30, 0x1p-24, 0x1p24, 0x1p30, 0x1p40})
    expectEntries(orientation(scale), ordinary, 1e-13, "at " + std::to_string(scale));
}

TEST(NotComputable, ARotationThatTakesTooManySeries) {
  TriaxialRotation rotation;
  rotation.begin({1, 1e3, 1e3 * (1 + 1e-13)}, Quat(1, 0.1, 0.2, 0.3).normalized(), {1e6, 2e6, 3e6});
  try {
    rotation.extendTo(1e9);
  } catch (const NotComputable& error) {
    EXPECT_NE(std::string(error.what()).find("100000 series"), std::string::npos);
    EXPECT_TRUE(rotation.availableUntil() > 0 && rotation.availableUntil() < 1e9);
    EXPECT_NO_THROW(rotation.orientationAt(rotation.availableUntil()));
  }
}

}  // namespace
}  // namespace carom
