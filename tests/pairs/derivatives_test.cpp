// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/pairs/compare_impact.h"
#include "tests/pairs/replay.h"
#include "tests/support/throws.h"

// Derivatives of the first impact (time, normal, point, states before and after it) by every number of the scene,
// against a replay in 50-digit arithmetic: a few throws of every kind of shape at every other, as many kinds of
// features as meet in the first throws.

namespace carom::pairs {

using namespace adjoint_detail;

namespace {

constexpr double kTolerance = 1e-9;       // of the column's scale
constexpr double kSmallestScale = 1e-2;   // of a column, so that columns of zeros can be compared
constexpr double kLeastStickSlip = 1e-6;  // nearer to the border of stick and slide the branch is a matter of rounding
constexpr int kLooked = 40, kFewest = 2, kMost = 4;  // throws of each ordered pair

/// The program's motion through one impact and a little beyond.
struct Played {
  Motion motion;
  double after = 0;
};

/// Nothing when the bodies meet again within a tenth of a millisecond.
std::optional<Played> play(const Scene& scene, double impact) {
  for (const double longer : {1e-2, 1e-3, 1e-4}) {
    OdeContacts contacts(scene);
    Motion motion = simulate(scene, contacts, impact + longer);
    if (motion.events.size() == 1 && motion.status == MotionStatus::complete)
      return Played{std::move(motion), impact + longer};
  }
  return {};
}

/// The program's d(rows) along a direction, by the tangent pass, the contact's own Jacobian joined to it by hand.
class Rates {
 public:
  Rates(const Motion& motion, DerivativeTape& tape, double after)
      : motion_(motion), tape_(tape), after_(after), contact_(motion.events[0].contacts[0]) {
    jacobian_ =
        motion.geometry->jacobian(contact_.a, contact_.b, contact_.features, poseOf(contact_.a), poseOf(contact_.b));
  }

  void along(const SceneTangent& direction) {
    pass_ = tangent(tape_, direction);
    Eigen::Matrix<double, 12, 1> poses;
    poses << poseRate(contact_.a, direction), poseRate(contact_.b, direction);
    contact_rate_ = jacobian_.pose * poses + jacobian_.size_a * sizeOf(direction, contact_.a) +
                    jacobian_.size_b * sizeOf(direction, contact_.b);
    if (contact_.a == 1) contact_rate_.segment<3>(1) *= -1;
  }
  double gap() const { return contact_rate_[0]; }
  double operator()(const PairRow& row) const {
    using Of = PairRow::Of;
    if (row.of == Of::time) return pass_.eventTime(0);
    if (row.of == Of::normal) return contact_rate_[1 + row.component];
    if (row.of == Of::point) return contact_rate_[4 + row.component];
    const StateSeed seed = seedOf(row);
    return pass_.at(seed.body, seed.at).dot(seed);
  }
  StateSeed seedOf(const PairRow& row) const {
    StateSeed seed;
    seed.body = row.of == PairRow::Of::time ? motion_.events[0].participants[0].body : row.body;
    seed.at = row.of == PairRow::Of::after ? Instant::at(after_) : Instant::before(0);
    Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
    (row.of == PairRow::Of::time ? seed.time : (*parts[row.component / 3])[row.component % 3]) = 1;
    return seed;
  }

 private:
  const Body& bodyOf(int i) const { return motion_.scene->bodies[static_cast<std::size_t>(i)]; }
  static Eigen::VectorXd sizeOf(const SceneTangent& d, int i) { return d.bodies[static_cast<std::size_t>(i)].size; }

  carom::Pose poseOf(int i) const {
    const Body& body = bodyOf(i);
    if (body.fixed) return {body.position, body.orientation.toRotationMatrix()};
    const State& s = motion_.events[0].find(i)->before;
    return {s.x, (*motion_.models)[static_cast<std::size_t>(i)].shapeToWorld(s.q.toRotationMatrix())};
  }
  /// d(x, theta), x the centre of mass, at the impact.
  Eigen::Matrix<double, 6, 1> poseRate(int i, const SceneTangent& direction) const {
    Eigen::Matrix<double, 6, 1> rate;
    const Body& body = bodyOf(i);
    if (body.fixed) {
      const BodyDerivative& d = direction.bodies[static_cast<std::size_t>(i)];
      rate << d.position, d.orientation;
      return rate;
    }
    const BodyStateRate r = pass_.at(i, Instant::before(0));
    const Mat3 R = poseOf(i).R;
    rate << r.position + r.orientation.cross(R * centerOfMass(body)) +
                R * (centerOfMassRates(body) * sizeOf(direction, i)),
        r.orientation;
    return rate;
  }

  const Motion& motion_;
  DerivativeTape& tape_;
  double after_;
  const Contact& contact_;
  ContactJacobian jacobian_;
  MotionTangent pass_;
  Eigen::Matrix<double, 7, 1> contact_rate_;
};

struct Worst {
  double error = 0;
  std::string where;
  void look(double found, double expected, double scale, const std::string& what) {
    const double error_here = std::abs(found - expected) / scale;
    if (error_here <= error || std::isnan(error)) return;
    error = error_here;
    where = what + " = " + std::to_string(found) + ", expected " + std::to_string(expected) + ", column's scale " +
            std::to_string(scale);
  }
};

/// Largest error of tangent and adjoint pass; the worst entry in words.
Worst compare(const Scene& scene, const Played& played, const Replay& replay) {
  DerivativeTape tape(played.motion);
  Rates rates(played.motion, tape, played.after);
  const std::vector<PairRow> rows = rowsOf(replay.numbers());
  std::vector<SceneGradient> gradients(rows.size());
  const auto by_adjoint = [](const PairRow& row) {
    return row.of != PairRow::Of::normal && row.of != PairRow::Of::point;
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (by_adjoint(rows[i])) gradients[i] = adjoint(tape, std::vector{rates.seedOf(rows[i])});
  Worst worst;
  for (const PairKnob& knob : knobsOf(replay.numbers())) {
    const std::vector<double> expected = replay.derivative(knob);
    double scale = kSmallestScale;
    for (const double e : expected) scale = std::max(scale, std::abs(e));
    SceneTangent direction(scene);
    knob.entry(direction) = 1;
    rates.along(direction);
    worst.look(rates.gap(), 0, scale, "tangent pass: d(gap)/d(" + knob.name + ")");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string what = "d(" + rows[i].name() + ")/d(" + knob.name + ")";
      worst.look(rates(rows[i]), expected[i], scale, "tangent pass: " + what);
      if (by_adjoint(rows[i])) worst.look(knob.entry(gradients[i]), expected[i], scale, "adjoint pass: " + what);
    }
  }
  return worst;
}

class Derivatives : public testing::TestWithParam<test::ShapePair> {
 protected:
  test::Throw throwOf(std::uint64_t seed) const { return test::randomThrow(*GetParam().a, *GetParam().b, seed); }
  /// False when the throw is not fit for a comparison.
  bool examine(std::uint64_t seed, const FirstImpact& impact, double& worst) {
    const test::Throw thrown = throwOf(seed);
    std::string wrong;
    try {
      const auto played = play(thrown.scene, static_cast<double>(impact.time));
      if (!played || played->motion.events[0].margins.stick_slip < kLeastStickSlip) return false;
      const Event& event = played->motion.events[0];
      const Replay replay(thrown.scene, impact, played->after);
      EXPECT_EQ(event.mode, replay.mode()) << "seed " << seed;
      const Worst found = compare(thrown.scene, *played, replay);
      if (!(found.error <= worst)) worst = found.error;
      if (!(found.error <= kTolerance)) wrong = "off by " + std::to_string(found.error * 1e9) + "e-9: " + found.where;
    } catch (const std::exception& error) {
      wrong = error.what();
    }
    EXPECT_EQ(wrong, "") << impact.features << ", seed " << seed << " (CAROM_TEST_SEED=" << seed << "):\n"
                         << test::describe(thrown);
    return true;
  }
};

TEST_P(Derivatives, agreeWithReplay) {
  const test::ShapeMaker &a = *GetParam().a, &b = *GetParam().b;
  const char* only = std::getenv("CAROM_TEST_SEED");
  const std::uint64_t first = only ? std::strtoull(only, nullptr, 10) : 1;
  std::set<std::string> met;
  std::string names;
  int throws = 0;
  double worst = 0;
  for (std::uint64_t seed = first; seed < first + (only ? 1 : kLooked) && throws < kMost; ++seed) {
    const test::Throw thrown = throwOf(seed);
    const auto impact = Encounter(thrown.scene).firstImpact(thrown.duration);
    if (!impact || !impact->doubt.empty()) continue;
    const std::string kinds = withoutNumbers(impact->features);
    if (met.count(kinds) && (throws >= kFewest)) continue;
    if (!examine(seed, *impact, worst)) continue;
    ++throws;
    if (met.insert(kinds).second) names += (names.empty() ? "" : ", ") + kinds;
  }
  std::printf("%s on %s: %d throws (%s), worst %.2g of the column\n", a.name, b.name, throws, names.c_str(), worst);
  EXPECT_GE(throws, only ? 1 : kFewest);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Derivatives, testing::ValuesIn(test::pairsThatMeet()),
                         [](const auto& row) { return row.param.name(); });

}  // namespace
}  // namespace carom::pairs
