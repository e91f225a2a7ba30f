// SPDX-License-Identifier: MIT
// Bodies, features and times that are not there: collision detection says so.

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "adjoint/base/errors.h"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/gaps.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

struct Touching {
  Scene scene = makeScene({0, 0, -9.81}, 0.8, 0.3,
                          {makeBall("ball", 0.1, {0, 0, 1}), makeBox("box", {0.2, 0.3, 0.4}, {2, 0, 1}),
                           makePlane("floor", Vec3::UnitZ(), 0)});
  OdeContacts contacts{scene};
  Motion motion = simulate(scene, contacts, 0.9);
  const FeatureGeometry& geometry = dynamic_cast<const FeatureGeometry&>(*motion.geometry);
  FeaturePair pair{kPointPlane, 0, 0, 1};  // a vertex of the box on the floor
  Pose pose;
  std::vector<int> list;
  Arc& arc(int body) { return motion.world_lines[static_cast<std::size_t>(body)].arcs[0]; }
};

struct Misuse {
  const char* name;
  std::function<void(Touching&)> call;
  std::vector<std::string> words = {};
};

void contact(const Touching& t, int a, int b, const FeaturePair& f) { t.geometry.contact(a, b, f, t.pose, t.pose); }

const std::vector<Misuse>& misuses() {
  static const std::vector<Misuse> all{
      {"contact, body 3", [](Touching& t) { contact(t, 3, 2, t.pair); }, {"body 3", "from 0 to 2"}},
      {"contact, body -1", [](Touching& t) { contact(t, 1, -1, t.pair); }, {"body -1"}},
      {"contact, a pair as it is made", [](Touching& t) { contact(t, 1, 2, {}); }, {"kind -1"}},
      {"contact, kind 13", [](Touching& t) { contact(t, 1, 2, {13, 0, 0, 1}); }, {"kind 13"}},
      {"contact, vertex 8 of a box", [](Touching& t) { contact(t, 1, 2, {kPointPlane, 8, 0, 1}); }, {"feature 8"}},
      {"contact, face 1 of a plane", [](Touching& t) { contact(t, 1, 2, {kPointPlane, 0, 1, 1}); }, {"feature 1"}},
      {"contact, the rim of a box", [](Touching& t) { contact(t, 1, 2, {kRimPlane, 0, 0, 1}); }, {"there are none"}},
      {"jacobian, body 3", [](Touching& t) { t.geometry.jacobian(3, 2, t.pair, t.pose, t.pose); }, {"body 3"}},
      {"jacobianRates, two sizes of a box",
       [](Touching& t) {
         PairTangent d;
         d.size_a = Eigen::VectorXd::Ones(2);
         t.geometry.jacobianRates(1, 2, t.pair, t.pose, t.pose, std::span(&d, 1));
       },
       {"2 rates of dimensions", "expected 3"}},
      {"jacobianRates, NaN",
       [](Touching& t) {
         PairTangent d;
         d.pose[3] = kNan;
         t.geometry.jacobianRates(1, 2, t.pair, t.pose, t.pose, std::span(&d, 1));
       },
       {"nan"}},
      {"describe, kind -1", [](Touching& t) { t.geometry.describe(1, 2, {}); }, {"kind -1"}},
      {"boundingRadius, body 3", [](Touching& t) { t.geometry.boundingRadius(3); }, {"body 3"}},
      {"overlap, body -1", [](Touching& t) { t.geometry.overlap(1, -1, t.pose, t.pose); }, {"body -1"}},
      {"limits, vertex 8", [](Touching& t) { t.geometry.limits(1, 2, {kPointPlane, 8, 0, 1}, t.pose, t.pose); }, {"8"}},
      {"setPath, body 3", [](Touching& t) { t.contacts.setPath(3, t.arc(0), 0, 1); }, {"body 3"}},
      {"setPath, until infinity", [](Touching& t) { t.contacts.setPath(0, t.arc(0), 0, kInfinity); }, {"inf"}},
      {"window, body -1", [](Touching& t) { t.contacts.window(-1, 0); }, {"body -1"}},
      {"window, NaN", [](Touching& t) { t.contacts.window(0, kNan); }, {"nan"}},
      {"neighbours, body 3", [](Touching& t) { t.contacts.neighbours(3, t.list); }, {"body 3"}},
      {"firstImpact, body 3", [](Touching& t) { t.contacts.firstImpact(0, 3, t.arc(0), t.arc(1), 0, 1); }, {"body 3"}},
      {"firstImpact, NaN", [](Touching& t) { t.contacts.firstImpact(0, 2, t.arc(0), t.arc(2), kNan, 1); }, {"nan"}},
      {"touching, body 3", [](Touching& t) { t.contacts.touching(3, 1, t.arc(0), t.arc(1), 0, 0); }, {"body 3"}},
      {"touching, NaN", [](Touching& t) { t.contacts.touching(0, 1, t.arc(0), t.arc(1), 0, kNan); }, {"nan"}},
      {"a scene of a radius of NaN",
       [](Touching& t) {
         t.scene.bodies[0].shape = Sphere{kNan};
         const OdeContacts made(t.scene);
       },
       {"/bodies/0/shape/sphere/radius", "nan"}},
      {"a mesh without a surface",
       [](Touching& t) {
         t.scene.bodies[0].shape = Mesh{};
         t.contacts.begin(t.scene);
       },
       {"/bodies/0/shape/mesh"}},
      {"a hull of NaN",
       [](Touching&) {
         convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, kNan}});
       },
       {"nan"}},
  };
  return all;
}

TEST(CollisionArguments, AreChecked) {
  for (const Misuse& misuse : misuses()) {
    SCOPED_TRACE(misuse.name);
    Touching touching;
    try {
      misuse.call(touching);
      ADD_FAILURE() << "was taken";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("found"), std::string::npos) << text;
      for (const std::string& word : misuse.words) EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "threw " << error.what();
    }
  }
}

TEST(CollisionArguments, ThatMakeSenseAreTaken) {
  Touching t;
  EXPECT_EQ(t.geometry.describe(1, 2, t.pair), "vertex -x-y-z on plane");
  EXPECT_NO_THROW(contact(t, 1, 2, t.pair));
}

}  // namespace
}  // namespace carom
