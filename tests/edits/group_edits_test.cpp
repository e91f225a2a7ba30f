// SPDX-License-Identifier: MIT
// Edits of bodies that move on each other.
#include <gtest/gtest.h>

#include "tests/edits/document_edits.h"
#include "tests/support/compare.h"

namespace carom::test {
namespace {

// Box 1 kg on a plank of 4 kg on ice: as one at V = v/5 from t = 4 v/(5 mu g) on, the plank at 1 + V (1 - t/2): 0.5 m/s and 1.27 m ask
// for 2.5 m/s and t = 0.92 s.
TEST(GroupEdits, ABoxBringsAPlankToItsMark) {
  const EditResult r = solveDocument(editDocument("box-on-plank"));
  ASSERT_TRUE(r.solved()) << r.message;
  expectEntries(r.scene.bodies[2].velocity, Vec3(2.5, 0, 0), 1e-9, "velocity");
  expectEntries(r.scene.materials[r.scene.materials[0].name == "rough" ? 0 : 1].friction, 2.5 * 4 / (5 * 0.92 * 9.81), 1e-9, "friction");
  EXPECT_LE(r.certificate.energy_drift, 1e-12);
  ASSERT_TRUE(r.certificate.deepest_penetration);
  EXPECT_LE(*r.certificate.deepest_penetration, 1e-12);
  EXPECT_TRUE(r.certificate.reliability.reliable) << r.certificate.reliability.message;
}

}  // namespace
}  // namespace carom::test
