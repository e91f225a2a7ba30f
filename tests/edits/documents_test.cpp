// SPDX-License-Identifier: MIT
// Documents that an edit, or the reading of their files, once failed at: what each is right about, by its kind.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/edits/document_edits.h"

namespace carom::test {
namespace {

Motion played(const Document& document) {
  OdeContacts contacts(document.scene);
  return simulate(document.scene, contacts, document.duration);
}

/// Edits with a motion that meets them: `hidden` documents are such motions.
class SolvableDocument : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Each, SolvableDocument, testing::Values("p3-3-2", "z2-3-0", "z3-3-1"));

TEST_P(SolvableDocument, IsMetByItsHiddenMotionAndSolved) {
  const Document hidden = editDocument(std::string(GetParam()) + ".hidden");
  const EditResult already = solveDocument(hidden);
  EXPECT_EQ(already.status, EditStatus::solved) << already.message;
  EXPECT_EQ(already.iterations, 0);
  const EditResult r = solveDocument(editDocument(GetParam()), {.effort = Effort::fast});
  EXPECT_TRUE(r.solved()) << r.message;
  EXPECT_LE(r.scaled_residual, 1e-9);
}

// The work of one answer: after the constraints are first met no more than its own local solve and a projection.
TEST_P(SolvableDocument, FastEndsWithTheFirstAnswer) {
  const Document document = editDocument(GetParam());
  int first = -1;
  EditOptions options{.effort = Effort::fast, .threads = 1};
  options.progress = [&](const EditProgress& at) {
    if (first < 0 && at.violation <= 1e-9) first = at.iteration;
    return true;
  };
  const EditResult fast = solveDocument(document, options);
  ASSERT_TRUE(fast.solved()) << fast.message;
  EXPECT_LE(fast.iterations - std::max(first, 0), 60);
}

TEST(EditDocuments, ABlockThatSlidesOnAnInclineIsStopped) {
  const double before = cpuSeconds();
  const EditResult r = solveDocument(editDocument("block-on-incline-slow"), {.effort = Effort::fast});
  RecordProperty("cpu_seconds", std::to_string(cpuSeconds() - before));
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_LE(r.iterations, 20) << "the search went on after the first answer";
}

TEST(EditDocuments, ARegionThatEndsBesideAStretchIsJudged) {
  const EditResult r = solveDocument(editDocument("region-end-ulp"), {.effort = Effort::fast});
  EXPECT_TRUE(r.status == EditStatus::not_converged || r.solved()) << r.message;
  EXPECT_NE(r.status, EditStatus::infeasible) << "nothing proves that";
}

TEST(EditDocuments, AThrowIntoAMovingBasketIsNotCalledOutOfReach) {
  const Document document = editDocument("pub-08-throw-into-moving-basket");
  for (const int seed : {0, 1}) {
    const EditResult r = solveDocument(document, {.seed = seed});
    EXPECT_NE(r.status, EditStatus::infeasible) << r.message;
    EXPECT_EQ(r.message.find("out of reach"), std::string::npos) << r.message;
    if (seed == 1) EXPECT_TRUE(r.solved()) << r.message;
  }
}

// The hit that it asks for grazes at the smallest change: it goes inside by a margin that is told.
TEST(EditDocuments, AGrazingAnswerGoesInside) {
  const EditResult r = solveDocument(editDocument("words-before-last-constraint"));
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_NE(r.message.find("natural scales from the smallest change that was found: the answer lies 0.0001 inside."), std::string::npos)
      << r.message;
  EXPECT_GE(r.certificate.signature_radius, 5e-5);
  EXPECT_LE(r.objective, 1.01 * 0.0025037178);
  for (const SequenceChange& change : r.sequence_changes) EXPECT_EQ(change.sentence.find("last constraint"), std::string::npos) << change.sentence;
}

TEST(EditDocuments, ABallWithoutRollingResistanceRollsOn) {  // pub-13: there is no word for rolling resistance
  const Motion motion = played(editDocument("pub-13-ball-with-rolling-resistance"));
  ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
  EXPECT_NEAR(motion.stateAt("ball", 20.0).velocity.x(), 1, 1e-12);
  EXPECT_NEAR(motion.stateAt("ball", 20.0).position.x(), 20, 1e-9);
}

TEST(EditDocuments, MeshesOfOthersAreTaken) {  // pub-15: an edge of four triangles; pub-16: a hull with a concave polygon
  EXPECT_EQ(played(editDocument("pub-15-mesh-edge-of-four-triangles")).status, MotionStatus::complete);
  const Document prism = editDocument("pub-16-hull-from-file-with-concave-polygon");
  EXPECT_EQ(played(prism).status, MotionStatus::complete);
}

}  // namespace
}  // namespace carom::test
