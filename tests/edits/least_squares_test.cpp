// SPDX-License-Identifier: MIT
// Soft constraints: closed forms of linear fits, a noisy track, standard deviations against the spread of many fits, and
// what is refused.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/session.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/edits/ball_above.h"
#include "tests/edits/document_edits.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

/// The document pub-14, its ten places soft.
Document noisyTrack() {
  Document document = editDocument("pub-14-fit-noisy-track");
  for (Constraint& constraint : document.constraints) constraint.soft = 1;
  return document;
}

TEST(LeastSquares, FitANoisyTrack) {
  const EditResult r = solveDocument(noisyTrack());
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_NEAR(r.changed[2].after, 0.72, 0.02) << r.changed[2].name;
  EXPECT_NEAR(r.changed[0].after, 1.3, 0.01) << r.changed[0].name;
  EXPECT_EQ(r.fit.rows, 20);
  EXPECT_EQ(r.fit.parameters, 4);
  ASSERT_TRUE(r.fit.deviation);
  EXPECT_NEAR(*r.fit.deviation * 0.06, 0.002, 0.001) << "2 mm of noise; the natural length is the diameter";
  for (const ChangedNumber& number : r.changed) {
    ASSERT_TRUE(number.standard_deviation) << number.name;
    EXPECT_GT(*number.standard_deviation, 0) << number.name;
  }
  EXPECT_LT(*r.changed[2].standard_deviation, 0.002);
  EXPECT_EQ(r.soft_residuals.size(), 20u);
  EXPECT_TRUE(r.residuals.empty());
  EXPECT_NEAR(r.objective, 0.5 * r.fit.sum_of_squares, 0.5 * r.objective + 0.3);
}

// The example: from a guess with other impacts, within a few deviations of what the recording was made with.
TEST(LeastSquares, FindATossedBox) {
  const EditResult r = solveDocument(readDocument(projectFile("examples/scenes/tossed-box.json")));
  ASSERT_TRUE(r.solved()) << r.message;
  ASSERT_TRUE(r.fit.deviation) << r.fit.message;
  EXPECT_LE(*r.fit.deviation, 0.01) << "1 mm of 0.16 m, and 0.01 rad";
  const double made_with[] = {1.27, 0.16, 0.86, 3.2, -4.3, 1.8, 0.55, 0.32, 0.00052, 0.00078, 0.0011};
  ASSERT_EQ(r.changed.size(), std::size(made_with));
  for (std::size_t i = 0; i < r.changed.size(); ++i) {
    const ChangedNumber& number = r.changed[i];
    ASSERT_TRUE(number.standard_deviation) << number.name;
    EXPECT_NEAR(number.after, made_with[i], 4 * *number.standard_deviation) << number.name;
    EXPECT_LE(*number.standard_deviation, 0.02 * std::abs(made_with[i])) << number.name;
  }
}

// A ball that flies: places are linear in velocity and position, so that the fit is that of the normal equations.
TEST(LeastSquares, OfAFlightIsThatOfTheNormalEquations) {
  const Scene scene = ballAbove({1, 0, 2});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.5);
  edit.vary(velocity("ball"));
  const double times[] = {0.1, 0.2, 0.3, 0.4}, noise[] = {0.01, -0.02, 0.005, 0.013};
  for (int k = 0; k < 4; ++k)
    edit.nail("ball", times[k]).position(1.2 * times[k] + noise[k], any, any).soft(k + 1.0);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const double length = 0.2, speed = std::sqrt(9.81 * length);  // natural scales of the body
  double SS = 0, Sr = 0;
  for (int k = 0; k < 4; ++k) {
    const double s = (k + 1) * times[k] * speed / length, r0 = (k + 1) * (0.2 * times[k] + noise[k]) / length;
    SS += s * s, Sr += s * r0;
  }
  const double z = Sr / (SS + 1);  // (S^2 + 1) z = S r
  EXPECT_NEAR(r.changed[0].after, 1 + z * speed, 1e-12);
  double squares = 0;
  for (int k = 0; k < 4; ++k) {
    const double e = (k + 1) * (r.changed[0].after * times[k] - 1.2 * times[k] - noise[k]) / length;
    squares += e * e;
  }
  EXPECT_NEAR(r.fit.sum_of_squares, squares, 1e-12);
  EXPECT_NEAR(r.objective, 0.5 * squares + 0.5 * z * z, 1e-12);
  ASSERT_TRUE(r.changed[0].standard_deviation) << r.fit.message;
  EXPECT_EQ(r.fit.parameters, 3);
  EXPECT_NEAR(*r.changed[0].standard_deviation, std::sqrt(squares / (4 - 3) / SS) * speed, 1e-9);
  EXPECT_FALSE(r.changed[1].standard_deviation);
  EXPECT_FALSE(r.changed[2].standard_deviation);
  EXPECT_EQ(r.fit.message, "The soft constraints do not determine velocity.y of 'ball' and velocity.z of 'ball'.");
}

TEST(LeastSquares, HardConstraintsAreMetAndTheRestIsLeast) {
  const Scene scene = ballAbove({1, 0, 2});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.5);
  edit.vary(velocity("ball"), elasticity("m"));
  edit.nail("ball", 1.2).position(1.5, any, any);
  edit.nail("ball", 1.2).position(any, any, atLeast(0.55));
  edit.nail("ball", 0.9).position(0.9, 0.1, 0.3).soft(2);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_LE(r.scaled_residual, 1e-9);
  EXPECT_NEAR(r.changed[0].after, 1.25, 1e-9) << "the hard constraint alone decides";
  // Of the neighbours that meet the hard constraints none has a smaller objective.
  for (int k = 0; k < 20; ++k) {
    Scene beside = r.scene;
    const double angle = 0.3 * k;
    beside.bodies[1].velocity += 1e-4 * Vec3(0, std::cos(angle), std::sin(angle));
    OdeContacts again(beside);
    const Motion motion = simulate(beside, again, 1.5);
    if (motion.stateAt("ball", 1.2).position.z() < 0.55) continue;
    const Vec3 off = (motion.stateAt("ball", 0.9).position - Vec3(0.9, 0.1, 0.3)) / 0.2;
    const double speed = std::sqrt(9.81 * 0.2), scale = 0.25 / 0.07 * 0.1 * 0.7;
    const Vec3 z = (beside.bodies[1].velocity - Vec3(1, 0, 2)) / speed;
    const double e = (beside.materials[0].elasticity - 0.7) / scale;
    EXPECT_GE(0.5 * (4 * off.squaredNorm() + z.squaredNorm() + e * e), r.objective - 1e-9) << k;
  }
}

TEST(LeastSquares, DerivativesOfTheObjectiveAreExact) {
  const Document document = noisyTrack();
  OdeContacts contacts(document.scene);
  const Edit edit(document.scene, contacts, document.duration, document.controls, document.constraints);
  const NlpEvaluator program = edit.evaluator();
  Eigen::VectorXd x(4);
  x << 1.25, 0.1, 0.7, 1.01;
  const NlpPoint at = program.at(x);
  ASSERT_TRUE(at.available()) << at.message();
  const Eigen::VectorXd gradient = at.gradient().entries;
  const Eigen::MatrixXd hessian = at.hessian(1, Eigen::VectorXd::Zero(0));
  for (int j = 0; j < 4; ++j) {
    const double h = 1e-6;
    const NlpPoint up = program.at(x + h * Eigen::VectorXd::Unit(4, j)), down = program.at(x - h * Eigen::VectorXd::Unit(4, j));
    expectEntries(gradient[j], (up.objective() - down.objective()) / (2 * h), 1e-7, "gradient", gradient.norm());
    expectEntries(Eigen::VectorXd(hessian.col(j)), Eigen::VectorXd((up.gradient().entries - down.gradient().entries) / (2 * h)),
                  1e-6, "Hessian", hessian.norm());
  }
}

// Over many recordings of one throw the true coefficient lies within two standard deviations as often as it should.
TEST(LeastSquares, StandardDeviationsAreThoseOfManyFits) {
  Scene hidden = ballAbove({1, 0, 0});
  hidden.materials[0].elasticity = 0.75;
  OdeContacts contacts(hidden);
  const Motion motion = simulate(hidden, contacts, 1.25);
  int within = 0, fits = 0;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    Scene start = hidden;
    start.materials[0].elasticity = random.in(0.6, 0.85);
    start.bodies[1].velocity.x() += random.in(-0.3, 0.3);
    OdeContacts of_start(start);
    Edit edit(start, of_start, 1.25);
    edit.vary(velocity("ball").only({"x", "z"}).weighted(1e-3), elasticity("m").weighted(1e-3));
    for (int k = 1; k <= 12; ++k) {
      Vec3 p = motion.stateAt("ball", 0.1 * k).position;
      for (int c : {0, 2}) {
        double sum = 0;  // nearly normal, of 2 mm
        for (int i = 0; i < 12; ++i) sum += random.in(-0.5, 0.5);
        p[c] += 0.002 * sum;
      }
      edit.nail("ball", 0.1 * k).position(p.x(), any, p.z()).soft();
    }
    const EditResult r = edit.solve({.effort = Effort::fast});
    ASSERT_TRUE(r.solved()) << r.message;
    const ChangedNumber& e = r.changed.back();
    ASSERT_TRUE(e.standard_deviation) << r.fit.message;
    const double off = (e.after - 0.75) / *e.standard_deviation;
    ++fits, within += std::abs(off) <= 2, squares += off * off;
  }
  EXPECT_GE(within, 52) << "of " << fits;
  EXPECT_GE(squares / fits, 0.6);
  EXPECT_LE(squares / fits, 1.6);
}

TEST(LeastSquares, ThatHaveNoErrorAreRefused) {
  const Scene scene = ballAbove({1, 0, 0});
  OdeContacts contacts(scene);
  const auto refused = [&](Constraint constraint, double weight) {
    constraint.soft = weight;
    Edit edit(scene, contacts, 1, {velocity("ball")}, {constraint});
    try {
      edit.solve();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  Constraint place{"ball", 0.5, {Target{"position", {1.0, any, any}}}};
  EXPECT_EQ(refused(place, 0), "/constraints/0/soft: found the weight 0, expected a number > 0");
  EXPECT_EQ(refused(place, std::nan("")), "/constraints/0/soft: found the weight nan, expected a number > 0");
  Constraint hit{"ball", 0.0, {}};
  hit.hits = Hit{"floor"};
  EXPECT_EQ(refused(hit, 1),
            "/constraints/0/soft: found a weight of a hit, expected a constraint that has an error: an impact is there or not");
}

TEST(LeastSquares, AreWrittenAndRead) {
  Document document = noisyTrack();
  document.constraints[3].soft = 0.125;
  const Document again = parseDocument(writeDocument(document), "again");
  ASSERT_EQ(again.constraints.size(), 10u);
  EXPECT_EQ(again.constraints[2].soft, 1);
  EXPECT_EQ(again.constraints[3].soft, 0.125);
  EXPECT_FALSE(parseDocument(writeDocument(editDocument("pub-14-fit-noisy-track")), "hard").constraints[0].soft);
}

TEST(LeastSquares, ASessionFitsAndDragsAgainstThem) {
  const Document document = noisyTrack();
  OdeContacts contacts(document.scene);
  EditSession session(document.scene, contacts, document.duration, document.controls, document.constraints);
  const EditResult fitted = solveDocument(document);
  const SessionUpdate met = session.meetNails();
  EXPECT_TRUE(met.reached) << met.message;
  EXPECT_NEAR(session.scene().materials[0].elasticity, fitted.changed[2].after, 1e-6);
  const NailState nail = session.nailStates()[0];
  EXPECT_TRUE(nail.soft);
  EXPECT_FALSE(nail.met);
  // A drag reaches its target; what is left free stays with the track.
  const Vec3 before = met.motion->stateAt("ball", 1.5).position;
  session.grab("ball", 1.5);
  session.dragTo({before.x() + 0.05, 0, before.z()});
  session.dragTo({before.x() + 0.1, 0, before.z()});
  const SessionUpdate end = session.release();
  EXPECT_LE(end.distance, 1e-6) << end.message;
  EXPECT_NEAR(session.scene().materials[0].elasticity, fitted.changed[2].after, 0.02);
}

}  // namespace
}  // namespace carom::test
