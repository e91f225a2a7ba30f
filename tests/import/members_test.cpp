// SPDX-License-Identifier: MIT
// What every member means: samples of this folder and small changes of them, against values worked out by hand.
#include <gtest/gtest.h>

#include "adjoint/motion/plan.h"
#include "adjoint/scene/body_model.h"
#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"
#include "tests/import/gltf_files.h"
#include "tests/support/compare.h"

namespace carom::import_tests {
namespace {

using nlohmann::json;
using test::expectEntries;

template <class Kind>
const Kind& shapeIn(const Imported& imported, const std::string& name) {
  return std::get<Kind>(bodyIn(imported, name).shape);
}

Mat3 turnOf(const Body& body) { return body.orientation.toRotationMatrix(); }

/// glTF's axes in ours: x to x, y to z, z to -y.
Mat3 zUp() { return (Mat3() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished(); }
/// A turn in a file's axes, of axes that are turned along: the same turn of ours.
Mat3 zUp(const Mat3& turn) { return zUp() * turn * zUp().transpose(); }

constexpr double kTight = 1e-15;

TEST(Members, EveryKindOfShape) {
  const Imported sample = importGltf(samplePath("shapes.gltf"));
  EXPECT_EQ(sample.document.scene.bodies.size(), 13u);
  EXPECT_EQ(shapeIn<Box>(sample, "Box").size, Vec3(0.5, 0.3, 0.8));
  EXPECT_EQ(shapeIn<Capsule>(sample, "Capsule").radius, 0.2);
  EXPECT_EQ(shapeIn<Capsule>(sample, "Capsule").height, 0.5);
  EXPECT_EQ(shapeIn<Cylinder>(sample, "Cylinder").height, 0.7);
  EXPECT_EQ(shapeIn<Sphere>(sample, "Ball").radius, 0.8 * 0.25);
  EXPECT_EQ(shapeIn<Hull>(sample, "Cone").surface->vertices.size(), 96u);
  EXPECT_TRUE(shapeIn<Hull>(sample, "Tapered capsule").surface->closed);
  EXPECT_EQ(shapeIn<Hull>(sample, "Hull").surface->vertices.size(), 10u);
  EXPECT_EQ(shapeIn<Mesh>(sample, "Bracket").surface->vertices.size(), 12u);
  EXPECT_TRUE(shapeIn<Mesh>(sample, "Bracket").surface->closed);
  EXPECT_FALSE(shapeIn<Mesh>(sample, "Bowl").surface->closed);
  EXPECT_EQ(shapeIn<Mesh>(sample, "Ground").surface->faces.size(), 32u);
  EXPECT_EQ(shapeIn<Mesh>(sample, "Shelf").surface->faces.size(), 2u);
  EXPECT_EQ(shapeIn<Plane>(sample, "Below everything").offset, 0);
  EXPECT_EQ(shapeIn<Compound>(sample, "Car").parts.size(), 5u);
}

// Its axes are those of a cone: from the base to the apex, the centre of mass a quarter of the height above the base.
TEST(Members, ACylinderThatNarrowsToAPointIsACone) {
  struct Case {
    double bottom, top, scale_y, apex;  // apex: which way it points, in our z
  };
  for (const auto& [bottom, top, scale_y, apex] :
       {Case{0.3, 0, 1, 1}, Case{0, 0.3, 1, -1}, Case{0.3, 0, -1, -1}, Case{0, 0.3, -1, 1}}) {
    SCOPED_TRACE(testing::Message() << "radii " << bottom << " and " << top << ", scale " << scale_y);
    json file = plainDocument();
    shapesOf(file)[1] = {{"type", "cylinder"},
                         {"cylinder", {{"height", 0.4}, {"radiusBottom", bottom}, {"radiusTop", top}}}};
    file["nodes"][1]["scale"] = {1, scale_y, 1};
    ballMotion(file) = {{"mass", 2}, {"linearVelocity", {1, 2, 3}}, {"angularVelocity", {0, 5, 1}}};
    const Imported imported = importJson(file);
    EXPECT_TRUE(imported.report.warnings.empty()) << listOf(imported.report);
    const Body& body = bodyIn(imported, "ball");
    EXPECT_EQ(shapeIn<Cone>(imported, "ball").radius, 0.3);
    EXPECT_EQ(shapeIn<Cone>(imported, "ball").height, 0.4);
    EXPECT_EQ(body.position, Vec3(0, 0, 2));
    expectEntries(Vec3(turnOf(body).col(2)), Vec3(0, 0, apex), kTight, "from base to apex");
    expectEntries(Vec3(turnOf(body) * modelOf(body).center), Vec3(0, 0, -0.1 * apex), kTight, "centre of mass");
    expectEntries(body.velocity, Vec3(1, -3, 2), kTight, "velocity");
    expectEntries(body.angular_velocity, Vec3(0, -1, 5), kTight, "spin");
  }
}

TEST(Members, YUpBecomesZUp) {
  const Imported sample = importGltf(samplePath("shapes.gltf"));
  const Body& box = bodyIn(sample, "Box");
  EXPECT_EQ(box.position, Vec3(-3, -1, 2));
  expectEntries(turnOf(box), Mat3(Mat3::Identity()), kTight, "box");
  expectEntries(turnOf(bodyIn(sample, "Capsule")), Mat3(Mat3::Identity()), kTight, "capsule");
  EXPECT_EQ(bodyIn(sample, "Capsule").angular_velocity, Vec3(0, 0, 3));
  const Body& cylinder = bodyIn(sample, "Cylinder");  // a quarter turn about z: its axis lies along -x
  expectEntries(Vec3(turnOf(cylinder).col(2)), Vec3(-1, 0, 0), kTight, "axis");
  expectEntries(cylinder.velocity, Vec3(-1, 0, 0), kTight, "velocity along the node's y");
  const Body& plane = bodyIn(sample, "Below everything");
  EXPECT_EQ(plane.position, Vec3(0, 0, -2));
  expectEntries(turnOf(plane), Mat3(Mat3::Identity()), kTight, "plane");
  EXPECT_EQ(sample.document.scene.gravity, Vec3(0, 0, -9.8));
}

TEST(Members, NodesBelowAMotionAreParts) {
  const Imported sample = importGltf(samplePath("shapes.gltf"));
  const Body& car = bodyIn(sample, "Car");
  const auto& parts = std::get<Compound>(car.shape).parts;
  EXPECT_EQ(car.mass, 3);
  expectEntries(parts[2].position, Vec3(0.3, 0.25, 0), kTight, "third wheel");
  // The wheel's axis is turned from y to z, which is across here.
  expectEntries(Vec3(parts[2].orientation.toRotationMatrix().col(2)), Vec3(0, -1, 0), kTight, "third wheel");
  EXPECT_EQ(std::get<Cylinder>(parts[2].shape).radius, 0.12);
  EXPECT_EQ(std::get<Hull>(parts[4].shape).surface->vertices.size(), 10u);
  EXPECT_NEAR(modelOf(car).center.z(), 0.11, 0.02) << "the roof is above the wheels";
}

TEST(Members, MassCentreAndInertia) {
  const Imported sample = importGltf(samplePath("shapes.gltf"));
  const Body& bracket = bodyIn(sample, "Bracket");
  EXPECT_EQ(bracket.mass, 1.5);
  EXPECT_EQ(*bracket.center_of_mass, Vec3(0.25, 0, 0.25));
  // Principal axes turned by twice atan(0.6 / 0.8) about z.
  const double c = 0.28, s = 0.96;
  Mat3 expected;
  expected << c * c * 0.05 + s * s * 0.06, c * s * (0.05 - 0.06), 0, c * s * (0.05 - 0.06), s * s * 0.05 + c * c * 0.06,
      0, 0, 0, 0.07;
  expectEntries(bracket.inertia.matrix(), zUp(expected), 1e-15, "inertia");
  const Body& box = bodyIn(sample, "Box");
  EXPECT_EQ(box.inertia.source, Inertia::Source::derived);
  EXPECT_FALSE(box.center_of_mass.has_value());
}

// The nearest moments that a body can have: (I1 - d, I2 + d, I3 + d), d = (I1 - I2 - I3)/3.
TEST(Members, ImpossibleMomentsAreMended) {
  for (int largest = 0; largest < 3; ++largest) {
    Vec3 written(0.1, 0.1, 0.1), expected(1.0 / 6, 1.0 / 6, 1.0 / 6);
    written[largest] = 0.4, expected[largest] = 1.0 / 3;
    json file = plainDocument();
    ballMotion(file)["inertiaDiagonal"] = {written.x(), written.y(), written.z()};
    const Imported imported = importJson(file);
    EXPECT_EQ(imported.report.warnings.size(), 1u) << listOf(imported.report);
    const Vec3 moments = bodyIn(imported, "ball").inertia.moments;
    const Vec3 ours = largest == 1 ? Vec3(expected.x(), expected.z(), expected.y()) : largest == 2 ? Vec3(expected.x(), expected.z(), expected.y()) : expected;
    expectEntries(moments, ours, 1e-15, "moments");
    EXPECT_NO_THROW(validate(imported.document.scene));
  }
  json file = plainDocument();  // what is possible stays as it is
  ballMotion(file)["inertiaDiagonal"] = {0.2, 0.1, 0.1};
  EXPECT_TRUE(importJson(file).report.warnings.empty());
}

TEST(Members, KinematicGravityFactorAndFilter) {
  json file = plainDocument();
  ballMotion(file)["gravityFactor"] = 0.5;
  file["extensions"]["KHR_physics_rigid_bodies"]["collisionFilters"] = {
      {{"collisionSystems", {"a", "b"}}, {"notCollideWithSystems", {"c"}}}, {{"collideWithSystems", {"a"}}}};
  physicsOf(file, 1)["collider"]["collisionFilter"] = 0;
  physicsOf(file, 0)["collider"]["collisionFilter"] = 1;
  const Imported falling = importJson(file);
  EXPECT_TRUE(falling.report.warnings.empty()) << listOf(falling.report);
  EXPECT_EQ(bodyIn(falling, "ball").gravity_factor, 0.5);
  EXPECT_EQ(bodyIn(falling, "ball").collision_filter, (CollisionFilter{{"a", "b"}, {}, {"c"}}));
  EXPECT_EQ(bodyIn(falling, "floor").collision_filter, (CollisionFilter{{}, {"a"}, {}}));

  ballMotion(file)["isKinematic"] = true;
  ballMotion(file)["linearVelocity"] = {1, 2, 3};
  const Imported moving = importJson(file);
  EXPECT_TRUE(moving.report.warnings.empty()) << listOf(moving.report);
  EXPECT_TRUE(bodyIn(moving, "ball").kinematic);
  EXPECT_FALSE(bodyIn(moving, "ball").fixed);
  EXPECT_FALSE(bodyIn(moving, "ball").mass.has_value());
  EXPECT_EQ(bodyIn(moving, "ball").velocity, Vec3(1, -3, 2));

  ballMotion(file).erase("linearVelocity");  // at rest: fixed
  const Imported still = importJson(file);
  EXPECT_TRUE(still.report.warnings.empty()) << listOf(still.report);
  EXPECT_TRUE(bodyIn(still, "ball").fixed);
}

TEST(Members, JointsAndTriggersAreListed) {
  json file = plainDocument();
  physicsOf(file, 1)["joint"] = {{"connectedNode", 0}};
  file["nodes"].push_back(json::object());
  physicsOf(file, 2)["trigger"] = {{"geometry", {{"shape", 1}}}};
  file["scenes"][0]["nodes"].push_back(2);
  const Imported imported = importJson(file);
  EXPECT_EQ(imported.report.joints, std::vector<std::string>{"ball"});
  EXPECT_EQ(imported.report.triggers, std::vector<std::string>{"node-2"});
}

TEST(Members, WithoutAMassItIsThatOfWater) {
  json file = plainDocument();
  physicsOf(file, 1)["motion"] = json::object();
  const Imported imported = importJson(file);
  const Body& ball = bodyIn(imported, "ball");
  EXPECT_EQ(ball.density, 1000);
  EXPECT_FALSE(ball.mass.has_value());
  EXPECT_TRUE(hasWarning(imported.report, {"node 'ball' (/nodes/1)", "no mass", "1000 kg/m^3"}));
}

TEST(Members, VelocitiesAreInTheAxesOfTheNode) {
  json file = plainDocument();
  file["nodes"][1]["rotation"] = {0, 0, 0.6, 0.8};
  file["nodes"][1]["scale"] = {3, 3, 3};
  physicsOf(file, 1)["motion"]["linearVelocity"] = {1, 2, 3};
  physicsOf(file, 1)["motion"]["angularVelocity"] = {0, 5, 0};
  const Imported imported = importJson(file);
  Mat3 turn;
  turn << 0.28, -0.96, 0, 0.96, 0.28, 0, 0, 0, 1;
  expectEntries(bodyIn(imported, "ball").velocity, zUp() * turn * Vec3(1, 2, 3), 1e-15, "velocity");
  expectEntries(bodyIn(imported, "ball").angular_velocity, zUp() * turn * Vec3(0, 5, 0), 1e-15, "spin");
  EXPECT_NEAR(shapeIn<Sphere>(imported, "ball").radius, 0.3, 1e-16);
}

TEST(Members, MaterialsWithTheirRules) {
  const Imported sample = importGltf(samplePath("materials.gltf"));
  const auto& materials = sample.document.scene.materials;
  ASSERT_EQ(materials.size(), 4u);
  EXPECT_EQ(materials[0].name, "ice");
  EXPECT_EQ(materials[0].friction, 0.02);
  EXPECT_EQ(materials[0].elasticity, 0.1);
  EXPECT_EQ(materials[0].combine_friction, Combine::minimum);
  EXPECT_EQ(materials[0].combine_elasticity, Combine::average);
  EXPECT_EQ(materials[1].name, "material-1");
  EXPECT_EQ(materials[1].combine_elasticity, Combine::maximum);
  EXPECT_EQ(materials[2].combine_friction, Combine::multiply);
  EXPECT_EQ(materials[3].name, "felt-2") << "two materials of one name";
  EXPECT_EQ(materials[3].friction, 0.6) << "the extension's default";
  EXPECT_EQ(materials[3].elasticity, 0) << "the extension's default";
  EXPECT_EQ(bodyIn(sample, "Plain").material, "");
  EXPECT_EQ(bodyIn(sample, "Heavy ball").material, "felt");
  EXPECT_EQ(sample.document.scene.gravity, Vec3(0, 0, -9.81)) << "no gravity in the file";
}

// All pairs of rules in a file, and in the document that is made of it: the earlier one holds, as the extension's text says.
TEST(Members, TheEarlierOfTwoRulesHolds) {
  const std::vector<std::string> words = {"average", "minimum", "maximum", "multiply"};
  const double values[] = {0.5 * (0.3 + 0.7), 0.3, 0.7, 0.3 * 0.7};
  json file = plainDocument();
  json& materials = file["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"];
  materials = json::array();
  for (const double value : {0.3, 0.7})
    for (const std::string& word : words)
      materials.push_back({{"name", word + (value < 0.5 ? " low" : " high")},
                           {"staticFriction", value},
                           {"dynamicFriction", value},
                           {"restitution", value},
                           {"frictionCombine", word},
                           {"restitutionCombine", word}});
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      physicsOf(file, 0)["collider"]["physicsMaterial"] = i;
      physicsOf(file, 1)["collider"]["physicsMaterial"] = 4 + j;
      const Document imported = importJson(file).document;
      for (const Document& document : {imported, parseDocument(writeDocument(imported), "written")}) {
        const Scene& scene = document.scene;
        const Material &a = materialOf(scene, scene.bodies[0]), &b = materialOf(scene, scene.bodies[1]);
        EXPECT_EQ(combine(a, b).friction, values[std::min(i, j)]) << words[i] << " with " << words[j];
        EXPECT_EQ(combine(b, a).elasticity, values[std::min(i, j)]) << words[i] << " with " << words[j];
      }
    }
}

TEST(Members, ScaleGoesIntoTheShape) {
  const Imported sample = importGltf(samplePath("materials.gltf"));
  EXPECT_EQ(shapeIn<Box>(sample, "Slope").size, Vec3(6, 6, 0.3));
  EXPECT_EQ(shapeIn<Sphere>(sample, "Heavy ball").radius, 0.9 * 0.125);
  expectEntries(shapeIn<Box>(sample, "Soap").size, Vec3(0.21, 0.14, 0.070000004), 1e-15, "soap");

  const Imported shapes = importGltf(samplePath("shapes.gltf"));
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const Vec3& v : shapeIn<Mesh>(shapes, "Ground").surface->vertices)
    low = low.cwiseMin(v), high = high.cwiseMax(v);
  expectEntries(Vec3(high - low), Vec3(4 * 1.8, 3 * 1.4, (high - low).z()), 1e-6, "ground");
}

TEST(Members, ScaleAboveABodyStretchesItsPartsAndItsCentre) {
  json file = plainDocument();
  file["extensions"]["KHR_implicit_shapes"]["shapes"].push_back({{"type", "box"}, {"box", {{"size", {1, 1, 1}}}}});
  physicsOf(file, 1).erase("collider");
  physicsOf(file, 1)["motion"]["centerOfMass"] = {0.1, 0.2, 0.3};
  file["nodes"][1]["children"] = {2};
  file["nodes"].push_back({{"name", "part"}, {"translation", {1, 1, 1}}});
  physicsOf(file, 2)["collider"] = {{"geometry", {{"shape", 2}}}};
  file["nodes"].push_back({{"name", "stretched"}, {"scale", {1, 2, 3}}, {"children", {1}}});
  file["scenes"][0]["nodes"] = {0, 3};
  const Imported imported = importJson(file);
  const Body& body = bodyIn(imported, "ball");
  const auto& parts = std::get<Compound>(body.shape).parts;
  EXPECT_EQ(body.position, Vec3(0, 0, 4));
  EXPECT_EQ(parts[0].position, Vec3(1, -3, 2));
  EXPECT_EQ(std::get<Box>(parts[0].shape).size, Vec3(1, 3, 2));
  expectEntries(*body.center_of_mass, Vec3(0.1, -0.9, 0.4), 1e-15, "centre of mass");
}

TEST(Members, NegativeScaleMirrorsMeshesAndSizesOthers) {
  json file = jsonOf(samplePath("shapes.gltf"));
  file["buffers"][0]["uri"] = samplePath("shapes.bin");
  std::size_t bracket = 0;
  while (file["nodes"][bracket]["name"] != "Bracket") ++bracket;
  file["nodes"][bracket]["scale"] = {-1, 1, 1};
  file["nodes"][0]["scale"] = {-1, -2, 3};
  writeTemporary("shapes.bin", contentOf(samplePath("shapes.bin")));
  file["buffers"][0]["uri"] = "shapes.bin";
  const Imported imported = importJson(file);
  EXPECT_EQ(shapeIn<Box>(imported, "Box").size, Vec3(0.5, 0.3 * 3, 1.6));
  const Surface& surface = *shapeIn<Mesh>(imported, "Bracket").surface;
  EXPECT_TRUE(surface.closed);
  EXPECT_NEAR(surface.volume, 0.06, 1e-7) << "inside out it would be refused";  // (0.12 + 0.08) * 0.3
  EXPECT_LT(surface.center.x(), 0);
  EXPECT_EQ(*bodyIn(imported, "Bracket").center_of_mass, Vec3(-0.25, 0, 0.25));
}

TEST(Members, AMirroredPlaneFacesTheOtherWay) {
  json file = plainDocument();
  file["nodes"][0]["scale"] = {1, -1, 1};
  file["nodes"][1]["translation"] = {0, -2, 0};
  const Imported imported = importJson(file);
  const Body& floor = bodyIn(imported, "floor");
  expectEntries(Vec3(floor.orientation * shapeIn<Plane>(imported, "floor").normal), Vec3(0, 0, -1), kTight, "normal");
}

TEST(Members, AMatrixIsATransform) {
  json file = plainDocument();
  json& node = file["nodes"][1];
  node.erase("translation");
  // Columns: a turn by 90 degrees about z with scale 2, then (3, 4, 5).
  node["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 3, 4, 5, 1};
  physicsOf(file, 1)["motion"]["linearVelocity"] = {1, 0, 0};
  const Imported imported = importJson(file);
  const Body& ball = bodyIn(imported, "ball");
  EXPECT_EQ(ball.position, Vec3(3, -5, 4));
  EXPECT_NEAR(shapeIn<Sphere>(imported, "ball").radius, 0.2, 1e-16);
  expectEntries(ball.velocity, Vec3(0, 0, 1), 1e-15, "velocity");
}

TEST(Members, ShapesAndMeshesMayBeUsedAgain) {
  json file = plainDocument();
  for (int i = 2; i < 5; ++i) {
    file["nodes"].push_back(file["nodes"][1]);
    file["nodes"].back()["translation"] = {i, 2, 0};
    file["scenes"][0]["nodes"].push_back(i);
  }
  const Imported imported = importJson(file);
  ASSERT_EQ(imported.document.scene.bodies.size(), 5u);
  EXPECT_EQ(bodyIn(imported, "ball-4").position, Vec3(4, 0, 2));

  const Imported shapes = importGltf(samplePath("shapes.gltf"));
  EXPECT_NE(shapeIn<Hull>(shapes, "Hull").surface, nullptr);
  json twice = jsonOf(samplePath("older.gltf"));
  twice["nodes"].push_back(twice["nodes"][1]);
  twice["nodes"].back()["translation"] = {3, 1, 0};
  twice["scenes"][0]["nodes"].push_back(3);
  const Imported pair = importJson(twice);
  EXPECT_EQ(shapeIn<Hull>(pair, "Tetrahedron").surface, shapeIn<Hull>(pair, "Tetrahedron-2").surface);
}

TEST(Members, AMotionBelowAMotionIsABodyOfItsOwn) {
  json file = plainDocument();
  file["nodes"].push_back(file["nodes"][1]);
  file["nodes"][2]["name"] = "second";
  file["nodes"][2]["translation"] = {1, 0, 0};
  file["nodes"][1]["children"] = {2};
  const Imported imported = importJson(file);
  EXPECT_TRUE(std::holds_alternative<Sphere>(bodyIn(imported, "ball").shape));
  EXPECT_EQ(bodyIn(imported, "second").position, Vec3(1, 0, 2));
}

TEST(Members, TheOlderForm) {
  const Imported imported = importGltf(samplePath("older.gltf"));
  EXPECT_TRUE(imported.report.warnings.empty()) << listOf(imported.report);
  EXPECT_EQ(shapeIn<Box>(imported, "Floor").size, Vec3(4, 4, 0.2));
  EXPECT_EQ(shapeIn<Hull>(imported, "Tetrahedron").surface->vertices.size(), 4u);
  EXPECT_NEAR(shapeIn<Hull>(imported, "Tetrahedron").surface->volume, 0.4 * 0.5 * 0.3 / 6, 1e-9);
  EXPECT_EQ(shapeIn<Sphere>(imported, "Ball").radius, 0.2);
  EXPECT_EQ(bodyIn(imported, "Floor").material, "material-0");
}

TEST(Members, BinaryFilesAreReadAlike) {
  const std::string path =
      writeTemporary("shapes.glb", binaryOf(jsonOf(samplePath("shapes.gltf")), contentOf(samplePath("shapes.bin"))));
  const Imported binary = importGltf(path), text = importGltf(samplePath("shapes.gltf"));
  EXPECT_EQ(binary.report.warnings, text.report.warnings);
  ASSERT_EQ(binary.document.scene.bodies.size(), text.document.scene.bodies.size());
  EXPECT_EQ(shapeIn<Mesh>(binary, "Bowl").surface->vertices, shapeIn<Mesh>(text, "Bowl").surface->vertices);
}

TEST(Members, NamesAreMadeFitForADocument) {
  json file = plainDocument();
  std::string name;
  for (int i = 0; i < 150; ++i) name += "\xC3\xA9";  // two bytes each
  file["nodes"][0]["name"] = name;
  file["nodes"][1].erase("name");
  file["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"][0]["name"] = name;
  const Imported imported = importJson(file);
  EXPECT_EQ(imported.document.scene.bodies[0].name, name.substr(0, 180));
  EXPECT_EQ(imported.document.scene.bodies[1].name, "node-1");
  EXPECT_EQ(imported.document.scene.materials[0].name, name.substr(0, 180));
  EXPECT_TRUE(saveWithMeshes(temporaryPath("scene.json"), imported.document).empty());
}

}  // namespace
}  // namespace carom::import_tests
