// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "adjoint/base/errors.h"
#include "formats/export/export_motion.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {
namespace {

tinygltf::Model load(const std::string& path) {
  tinygltf::Model model;
  std::string error, warning;
  tinygltf::TinyGLTF reader;
  const bool ok = path.ends_with(".glb") ? reader.LoadBinaryFromFile(&model, &error, &warning, path)
                                         : reader.LoadASCIIFromFile(&model, &error, &warning, path);
  EXPECT_TRUE(ok) << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

tinygltf::Model exported(const std::string& name, const GltfOptions& options = {}) {
  const std::string path = temporaryPath(name);
  exportMotion(path, handDocument(), handMotion(), {options});
  return load(path);
}

std::vector<double> floatsOf(const tinygltf::Model& model, int accessor) {
  const auto& a = model.accessors.at(accessor);
  const auto& view = model.bufferViews.at(a.bufferView);
  const std::size_t count = a.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(a.type));
  std::vector<float> out(count);
  std::memcpy(out.data(), model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset, count * sizeof(float));
  return {out.begin(), out.end()};
}

struct Track {
  std::vector<double> times, values;
  std::string interpolation;
};

Track trackOf(const tinygltf::Model& model, const std::string& body, const std::string& path) {
  for (const auto& channel : model.animations.at(0).channels)
    if (model.nodes.at(channel.target_node).name == body && channel.target_path == path) {
      const auto& sampler = model.animations[0].samplers.at(channel.sampler);
      return {floatsOf(model, sampler.input), floatsOf(model, sampler.output), sampler.interpolation};
    }
  ADD_FAILURE() << body << " " << path;
  return {};
}

std::size_t intervalOf(const Track& track, double t) {
  const auto next = std::upper_bound(track.times.begin(), track.times.end(), t);
  const auto k = static_cast<std::size_t>(next - track.times.begin());
  return std::clamp<std::size_t>(k, 1, track.times.size() - 1) - 1;
}

// In our axes: glTF's y is our z, its z our -y.
Vec3 vectorAt(const Track& track, std::size_t index) {
  const double* v = &track.values[3 * index];
  return {v[0], -v[2], v[1]};
}

// As a player of glTF 2.0 evaluates it (specification, appendix C).
Vec3 translationAt(const Track& track, double t) {
  const std::size_t k = intervalOf(track, t);
  const double d = track.times[k + 1] - track.times[k], s = (t - track.times[k]) / d;
  if (track.interpolation == "LINEAR") return (1 - s) * vectorAt(track, k) + s * vectorAt(track, k + 1);
  return (2 * s * s * s - 3 * s * s + 1) * vectorAt(track, 3 * k + 1) +
         d * (s * s * s - 2 * s * s + s) * vectorAt(track, 3 * k + 2) +
         (-2 * s * s * s + 3 * s * s) * vectorAt(track, 3 * k + 4) +
         d * (s * s * s - s * s) * vectorAt(track, 3 * k + 3);
}

Quat quaternionAt(const Track& track, std::size_t k) {
  const double* q = &track.values[4 * k];
  return {q[3], q[0], -q[2], q[1]};
}

const std::vector<std::string> kMoving = {"book", "ball <1>", "top"};
constexpr int kSamples = 997;

class Keys : public testing::TestWithParam<GltfOptions> {
 protected:
  bool isCubic() const { return GetParam().keys == GltfKeys::cubic; }
};

TEST_P(Keys, TranslationFollowsTheMotion) {
  const Motion motion = handMotion();
  const tinygltf::Model model = exported("m.glb", GetParam());
  double worst = 0;
  for (const std::string& name : kMoving) {
    const Track track = trackOf(model, name, "translation");
    EXPECT_EQ(track.interpolation, isCubic() ? "CUBICSPLINE" : "LINEAR");
    for (int i = 0; i <= kSamples; ++i) {
      const double t = motion.end * i / kSamples;
      const double error = (translationAt(track, t) - motion.stateAt(name, t).position).norm();
      EXPECT_TRUE(error <= (isCubic() ? 0 : GetParam().tolerance) + 5e-7) << name << " at " << t << ": " << error;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst_mm", std::to_string(1e3 * worst));  // seen with --gtest_output=xml
}

// Turned evenly between keys, as glTF says, and blended and normalized, as Blender does.
TEST_P(Keys, RotationFollowsTheMotion) {
  const Motion motion = handMotion();
  const tinygltf::Model model = exported("m.glb", GetParam());
  for (const std::string& name : kMoving) {
    const Track track = trackOf(model, name, "rotation");
    for (int i = 0; i <= kSamples; ++i) {
      const double t = motion.end * i / kSamples;
      const std::size_t k = intervalOf(track, t);
      const double s = (t - track.times[k]) / (track.times[k + 1] - track.times[k]);
      const Quat a = quaternionAt(track, k), b = quaternionAt(track, k + 1);
      const Quat blended((1 - s) * a.coeffs() + s * b.coeffs());
      for (const Quat& q : {a.slerp(s, b).normalized(), blended.normalized()}) {
        const double error = q.angularDistance(motion.stateAt(name, t).orientation);
        EXPECT_TRUE(error <= 1e-3) << name << " at " << t << ": " << error;
      }
    }
    for (std::size_t k = 0; k + 1 < track.times.size(); ++k) {
      EXPECT_LT(track.times[k], track.times[k + 1]);
      EXPECT_GT(quaternionAt(track, k).dot(quaternionAt(track, k + 1)), 0) << "hemisphere at key " << k;
    }
  }
}

TEST_P(Keys, EveryImpactHasAKeyInBothTracks) {
  const Motion motion = handMotion();
  const tinygltf::Model model = exported("m.glb", GetParam());
  for (const Event& event : motion.events)
    for (const Participant& p : event.participants)
      for (const std::string path : {"translation", "rotation"}) {
        const Track track = trackOf(model, motion.scene->bodies[p.body].name, path);
        EXPECT_TRUE(std::count(track.times.begin(), track.times.end(), static_cast<float>(event.time)) == 1)
            << path << " at " << event.time;
        EXPECT_EQ(track.times.front(), 0);
        EXPECT_EQ(track.times.back(), static_cast<float>(motion.end));
      }
}

TEST_P(Keys, EveryFrameHasAKeyInBothTracks) {
  if (isCubic()) GTEST_SKIP() << "cubic keys are at impacts only";
  const Motion motion = handMotion();
  const tinygltf::Model model = exported("m.glb", GetParam());
  const double fps = GetParam().frames_per_second;
  for (const std::string& name : kMoving)
    for (const std::string path : {"translation", "rotation"}) {
      const Track track = trackOf(model, name, path);
      for (int frame = 0; frame / fps <= motion.end; ++frame)
        EXPECT_TRUE(std::count_if(track.times.begin(), track.times.end(), [&](double t) {
                      return std::abs(t - frame / fps) <= 1e-7;
                    }) == 1)
            << name << " " << path << " frame " << frame;
    }
}

std::string nameOf(const testing::TestParamInfo<GltfOptions>& info) {
  if (info.param.keys == GltfKeys::cubic) return "cubic";
  return "linear_" + std::to_string(std::lround(info.param.frames_per_second)) + "_within_" +
         std::to_string(std::lround(1e6 * info.param.tolerance)) + "_um";
}

INSTANTIATE_TEST_SUITE_P(ExportGltf, Keys,
                         testing::Values(GltfOptions{GltfKeys::cubic}, GltfOptions{GltfKeys::linear, 24},
                                         GltfOptions{GltfKeys::linear, 25}, GltfOptions{GltfKeys::linear, 60, 1e-5},
                                         GltfOptions{GltfKeys::linear, 24, 1}),
                         nameOf);

TEST(ExportGltf, CubicKeysAreStartImpactsAndEnd) {
  const tinygltf::Model model = exported("m.glb", {GltfKeys::cubic});
  EXPECT_EQ(trackOf(model, "book", "translation").times.size(), 4u);
  EXPECT_EQ(trackOf(model, "ball <1>", "translation").times.size(), 3u);
  EXPECT_EQ(trackOf(model, "top", "translation").times.size(), 2u);
}

TEST(ExportGltf, SmallBodiesHaveMoreKeysAndStraightFlightsHaveTwo) {
  Document document = handDocument();
  document.controls.clear(), document.constraints.clear();
  document.scene.bodies.resize(3);
  document.scene.bodies[2].shape = Sphere{0.001};
  document.scene.bodies[2].angular_velocity.setZero();
  const Motion motion = handMotion(document.scene, 1, {});
  const std::string path = temporaryPath("m.glb");
  exportMotion(path, document, motion);
  const tinygltf::Model small = load(path);
  const Track track = trackOf(small, "book", "translation");
  for (int i = 0; i <= kSamples; ++i) {
    const double t = motion.end * i / kSamples;
    EXPECT_TRUE((translationAt(track, t) - motion.stateAt("book", t).position).norm() <= 0.005 * 0.001 + 5e-7) << t;
  }
  document.scene.gravity.setZero();
  exportMotion(path, document, handMotion(document.scene, 1, {}));
  EXPECT_EQ(trackOf(load(path), "book", "translation").times.size(), 2u);
}

TEST(ExportGltf, PlaybackSaysFrames) {
  const tinygltf::Model model = exported("m.glb", {GltfKeys::linear, 30});
  const auto& playback = model.scenes.at(0).extras.Get("carom_playback");
  EXPECT_EQ(playback.Get("frames_per_second").GetNumberAsDouble(), 30);
  EXPECT_EQ(playback.Get("last_frame").GetNumberAsInt(), 36);  // 1.2 s
  EXPECT_EQ(lastFrame(1.2, 24), 29);
  EXPECT_EQ(lastFrame(0.1 * 3, 10), 3) << "0.30000000000000004 s end on a frame";
  EXPECT_EQ(lastFrame(0, 24), 0);
}

TEST(ExportGltf, TextAndBinaryHoldTheSame) {
  const tinygltf::Model binary = exported("m.glb"), text = exported("m.gltf");
  EXPECT_EQ(binary.buffers.at(0).data, text.buffers.at(0).data);
  EXPECT_EQ(binary.nodes, text.nodes);
  EXPECT_EQ(binary.extensions, text.extensions);
}

// A program that turns y up into z up, axes of nodes included, has bodies as they are here; no node stands above them.
TEST(ExportGltf, YIsUpForPlacesAndAxes) {
  const tinygltf::Model model = exported("m.glb");
  const Scene scene = handDocument().scene;
  EXPECT_EQ(model.scenes.at(0).nodes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(model.nodes.size(), 5u);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    const auto& x = model.nodes.at(i).translation;
    const auto& q = model.nodes.at(i).rotation;
    EXPECT_EQ(Vec3(x[0], -x[2], x[1]), scene.bodies[i].position);
    EXPECT_EQ(Quat(q[3], q[0], -q[2], q[1]).coeffs(), scene.bodies[i].orientation.coeffs());
    EXPECT_EQ(model.nodes.at(i).name, scene.bodies[i].name);
  }
  const auto& book = model.accessors.at(model.meshes.at(static_cast<std::size_t>(model.nodes.at(2).mesh))
                                            .primitives.at(0)
                                            .attributes.at("POSITION"));
  EXPECT_EQ(book.maxValues, (std::vector<double>{0.15f, 0.025f, 0.1f}));  // 0.3, 0.2, 0.05 m, its z along y
}

TEST(ExportGltf, MeshesFaceOutwards) {
  const tinygltf::Model model = exported("m.glb");
  EXPECT_EQ(model.meshes.size(), 5u);
  for (const auto& mesh : model.meshes)
    for (const auto& primitive : mesh.primitives) {
      const auto x = floatsOf(model, primitive.attributes.at("POSITION"));
      const auto n = floatsOf(model, primitive.attributes.at("NORMAL"));
      ASSERT_EQ(x.size(), n.size());
      const auto& a = model.accessors.at(primitive.indices);
      const auto* index = reinterpret_cast<const std::uint32_t*>(model.buffers.at(0).data.data() +
                                                                 model.bufferViews.at(a.bufferView).byteOffset);
      for (std::size_t i = 0; i < a.count; i += 3) {
        const auto at = [&](const std::vector<double>& v, std::size_t k) { return Vec3(&v[3 * index[i + k]]); };
        const Vec3 face = (at(x, 1) - at(x, 0)).cross(at(x, 2) - at(x, 0));
        for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(face.normalized().dot(at(n, k)), 0.9) << mesh.name << " " << i;
      }
    }
}

const tinygltf::Value& rigidBody(const tinygltf::Node& node) { return node.extensions.at("KHR_physics_rigid_bodies"); }

double number(const tinygltf::Value& value) { return value.GetNumberAsDouble(); }

const tinygltf::Node& nodeOf(const tinygltf::Model& model, const std::string& name) {
  return *std::find_if(model.nodes.begin(), model.nodes.end(), [&](const auto& node) { return node.name == name; });
}

Vec3 inFile(const Vec3& v) { return {v.x(), v.z(), -v.y()}; }

TEST(ExportGltf, PhysicsIsWrittenButNotRequired) {
  const Motion motion = handMotion();
  const tinygltf::Model model = exported("m.glb");
  EXPECT_TRUE(model.extensionsRequired.empty());
  for (const char* name : {"KHR_physics_rigid_bodies", "KHR_implicit_shapes", "OMI_physics_gravity"})
    EXPECT_EQ(std::count(model.extensionsUsed.begin(), model.extensionsUsed.end(), name), 1) << name;

  const int book = bodyIndex(*motion.scene, "book");
  const Body& body = motion.scene->bodies[book];
  const auto& moves = rigidBody(nodeOf(model, "book")).Get("motion");
  EXPECT_EQ(number(moves.Get("mass")), 0.7);
  for (int i = 0; i < 3; ++i) {
    const int axis = i == 0 ? 0 : 3 - i;
    EXPECT_EQ(number(moves.Get("inertiaDiagonal").Get(i)), (*motion.models)[book].inertia[axis]);
    EXPECT_NEAR(number(moves.Get("linearVelocity").Get(i)), inFile(body.orientation.conjugate() * body.velocity)[i],
                1e-14);
    EXPECT_NEAR(number(moves.Get("angularVelocity").Get(i)),
                inFile(body.orientation.conjugate() * body.angular_velocity)[i], 1e-14);
  }
  const auto& collider = rigidBody(nodeOf(model, "book")).Get("collider");
  const auto& shapes = model.extensions.at("KHR_implicit_shapes").Get("shapes");
  const auto& shape = shapes.Get(collider.Get("geometry").Get("shape").GetNumberAsInt());
  EXPECT_EQ(shape.Get("type").Get<std::string>(), "box");
  EXPECT_EQ(number(shape.Get("box").Get("size").Get(0)), 0.3);
  const auto& materials = model.extensions.at("KHR_physics_rigid_bodies").Get("physicsMaterials");
  const auto& felt = materials.Get(collider.Get("physicsMaterial").GetNumberAsInt());
  EXPECT_EQ(number(felt.Get("restitution")), 0.45);
  EXPECT_EQ(number(felt.Get("staticFriction")), 0.6);
  EXPECT_EQ(felt.Get("frictionCombine").Get<std::string>(), "multiply");
  EXPECT_FALSE(rigidBody(nodeOf(model, "wall")).Has("motion"));
  EXPECT_TRUE(rigidBody(nodeOf(model, "floor")).Has("collider"));
  EXPECT_EQ(number(model.extensions.at("OMI_physics_gravity").Get("direction").Get(1)), -1);
}

TEST(ExportGltf, TheEditTravelsInExtras) {
  const std::string path = temporaryPath("m.gltf");
  exportMotion(path, handDocument(), handMotion());
  const tinygltf::Model model = load(path);
  const auto& edit = model.scenes.at(0).extras.Get("carom");
  EXPECT_EQ(edit.Get("controls").ArrayLen(), 2u);
  EXPECT_EQ(edit.Get("controls").Get(1).Get("vary").Get<std::string>(), "elasticity");
  EXPECT_EQ(edit.Get("constraints").ArrayLen(), 2u);
  EXPECT_EQ(number(edit.Get("constraints").Get(0).Get("at")), 1.1);
  std::string text = contentOf(path);  // free components are null
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); }), text.end());
  EXPECT_NE(text.find("\"position\":[0.9,null,null]"), std::string::npos);
}

TEST(ExportGltf, OddMotionsAreWritten) {
  Document document = handDocument();
  document.constraints.clear(), document.controls.clear();
  const std::string path = temporaryPath("m.glb");
  exportMotion(path, document, handMotion(document.scene, 0, {}));  // no time passes
  EXPECT_TRUE(load(path).animations.empty());
  // Two impacts that a float cannot tell apart.
  exportMotion(
      path, document,
      handMotion(document.scene, 1, {{0.5, 2, 0, {1, 0, 1}, {1, 2, 3}}, {0.5 + 1e-9, 2, 0, {0, 0, 2}, {3, 2, 1}}}),
      {{GltfKeys::cubic}});
  const Track track = trackOf(load(path), "book", "translation");
  ASSERT_EQ(track.times.size(), 3u);
  EXPECT_EQ(vectorAt(track, 5), Vec3(0, 0, 2));  // the last one counts
  document.scene.gravity.setZero();
  document.scene.bodies.resize(2);
  exportMotion(path, document, handMotion(document.scene, 1, {}));  // nothing moves
  EXPECT_EQ(load(path).meshes.size(), 2u);
}

TEST(ExportGltf, NumbersThatDoNotFitAreRefused) {
  Document document = handDocument();
  document.scene.bodies[2].angular_velocity = {1e7, 2e7, 3e7};
  const auto write = [&] { exportMotion(temporaryPath("m.glb"), document, handMotion(document.scene, 10, {})); };
  document.scene.bodies[2].shape = Sphere{0.1};
  EXPECT_THROW(write(), InputError);  // more rotation keys than anybody wants
  document.scene.bodies[2].angular_velocity.setZero();
  document.scene.bodies[2].position.x() = 1e39;
  EXPECT_THROW(write(), InputError);  // beyond floats
  const auto refuses = [](const GltfOptions& options) {
    EXPECT_THROW(exportMotion(temporaryPath("m.glb"), handDocument(), handMotion(), {options}), InputError);
  };
  for (const double bad : {0.0, -24.0, std::nan(""), 1e300}) {
    GltfOptions frames, tolerance, light, ghosts;
    frames.frames_per_second = bad, tolerance.tolerance = bad, light.light = bad, ghosts.ghosts = bad;
    for (const GltfOptions& options : {frames, tolerance, light, ghosts}) refuses(options);
  }
  GltfOptions many;
  many.ghosts = 1e-9;
  refuses(many);
}

}  // namespace
}  // namespace carom::export_tests
