// SPDX-License-Identifier: MIT
// Scenes of millimetres and of kilometres: the examples with every length scaled, gravity and speeds likewise, are read
// and play the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/scene/body_model.h"
#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

void scaleShape(Shape& shape, double s) {
  const ShapeKind& kind = kindOf(shape);
  kind.setDimensions(shape, s * kind.dimensions(shape));
  if (auto* plane = std::get_if<Plane>(&shape)) plane->offset *= s;
  const auto move = [&](auto&& again, Shape& whole) -> void {
    auto* compound = std::get_if<Compound>(&whole);
    if (compound == nullptr) return;
    for (CompoundPart& part : compound->parts) {
      part.position *= s;
      again(again, part.shape);
    }
  };
  move(move, shape);
}

/// Lengths times s, masses times m.
Document scaled(const Document& document, double s, double m) {
  Document out = document;
  out.constraints.clear();  // targets would have to be scaled by their units
  out.controls.clear();
  out.scene.gravity *= s;
  for (Body& body : out.scene.bodies) {
    scaleShape(body.shape, s);
    body.position *= s;
    body.velocity *= s, body.surface_velocity *= s;
    if (body.center_of_mass) *body.center_of_mass *= s;
    if (body.mass) *body.mass *= m;
    if (body.density) *body.density *= m / (s * s * s);
    body.inertia.moments *= m * s * s;
  }
  return out;
}

Motion simulated(const Document& document) {
  OdeContacts contacts(document.scene);
  const bool large = document.scene.bodies.size() > 100;
  return simulate(document.scene, contacts, large ? 0.1 : double(document.duration));
}

/// The impacts come in the same order, and while few have come, at the same times: later ones amplify rounding.
void expectSimilar(const Motion& a, const Motion& b) {
  constexpr std::size_t kFew = 6;
  EXPECT_EQ(a.status, b.status) << b.message;
  ASSERT_GE(b.events.size(), std::min(kFew, a.events.size())) << b.message;
  for (std::size_t i = 0; i < std::min({kFew, a.events.size(), b.events.size()}); ++i) {
    EXPECT_EQ(a.describeEvent(static_cast<int>(i)), b.describeEvent(static_cast<int>(i)));
    EXPECT_FALSE(!(std::abs(a.events[i].time - b.events[i].time) <= 1e-9 * (1 + a.events[i].time)))
        << "impact " << i << " at " << a.events[i].time << " s, scaled at " << b.events[i].time << " s";
  }
}

class ScaledScenes : public testing::TestWithParam<double> {};

TEST_P(ScaledScenes, areReadAndPlayTheSame) {
  const double s = GetParam();
  for (const std::string& path : formats_test::exampleScenes()) {
    SCOPED_TRACE(path);
    const Document document = readDocument(path);
    const Motion motion = simulated(document);
    for (const double m : {1.0, s * s * s}) {  // the same masses; the same densities
      SCOPED_TRACE("masses times " + std::to_string(m));
      const Document changed = parseDocument(writeDocument(scaled(document, s, m)), path, document.folder);
      expectSimilar(motion, simulated(changed));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, ScaledScenes, testing::Values(1.0 / 256, 1e-3, 256.0, 1e3));

// What an edit writes down is read again: moments of a large body, the mass of a small dense one.
TEST(ScaledScenes, whatIsDerivedCanBeWritten) {
  for (const double s : {1e-6, 1e-3, 1e3, 1e6}) {
    SCOPED_TRACE(s);
    Document document;
    Body body;
    body.name = "block", body.density = 8000, body.shape = Box{s * Vec3(1, 2, 3)};
    document.scene.bodies = {body};
    OdeContacts contacts(document.scene);
    const Motion motion = simulate(document.scene, contacts, 0.1);
    const BodyModel model = modelOf(document.scene.bodies[0]);
    document.scene.bodies[0].density.reset();
    document.scene.bodies[0].mass = model.mass;
    document.scene.bodies[0].inertia = Inertia::fromMoments(model.inertia);
    const Document again = parseDocument(writeDocument(document), "written");
    EXPECT_EQ(*again.scene.bodies[0].mass, model.mass);
    EXPECT_EQ(again.scene.bodies[0].inertia.moments, model.inertia);
    EXPECT_EQ(motion.status, MotionStatus::complete);
  }
}

}  // namespace
}  // namespace carom
