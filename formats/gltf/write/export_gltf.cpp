// SPDX-License-Identifier: MIT
#include "formats/gltf/write/export_gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

#include "adjoint/base/errors.h"
#include "formats/drawing/motion_extent.hpp"
#include "formats/gltf/axes.hpp"
#include "formats/gltf/physics_nodes.hpp"
#include "formats/gltf/read/left_document.hpp"
#include "formats/gltf/write/keys.hpp"
#include "formats/gltf/write/physics.hpp"
#include "formats/gltf/write/stage.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"

namespace carom {

using namespace formats_detail;

namespace {

using tinygltf::Value;

std::string placeOf(const Body& body) { return "body '" + body.name + "'"; }

class Writer {
 public:
  Writer(const Document& document, const Motion& motion, const GltfOptions& options)
      : document_(document),
        motion_(motion),
        scene_(*motion.scene),
        options_(options),
        extent_(motionExtent(motion)),
        buffer_(model_),
        look_(model_, buffer_, scene_, extent_.diagonal().norm()),
        physics_(scene_) {}

  tinygltf::Model make() {
    model_.asset.version = "2.0";
    model_.asset.generator = "carom";
    addSurfaces();
    addBodies();
    physics_.finish(model_);
    addAnimation();
    addStage();
    const Value playback(Value::Object{{"frames_per_second", Value(options_.frames_per_second)},
                                       {"last_frame", Value(lastFrame(motion_.end, options_.frames_per_second))}});
    tinygltf::Scene scene;
    scene.name = "carom";
    scene.nodes = roots_;
    scene.extras =
        Value(Value::Object{{"carom", documentOf(document_, scene_, surfaces_)}, {"carom_playback", playback}});
    model_.defaultScene = append(model_.scenes, scene);
    return std::move(model_);
  }

 private:
  // The surfaces that bodies collide with, as meshes that no node shows. Other programs see floats, 6e-8 of the
  // coordinates off; importGltf finds the doubles in a view of their own, which extras name.
  void addSurfaces() {
    for (Body body : scene_.bodies)
      for (const shapes::SurfaceUse& use : shapes::surfacesOf(body.shape)) {
        const Surface* surface = &use.surface;
        if (surfaces_.count(surface) > 0) continue;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.attributes["POSITION"] = buffer_.addVertices(surface->vertices, placeOf(body));
        primitive.indices = buffer_.addIndices(fansOf(*surface));
        tinygltf::Mesh mesh;
        mesh.name = body.name + " collision";
        mesh.primitives.push_back(primitive);
        const Value positions(buffer_.addDoubles(surface->vertices));
        mesh.extras = Value(Value::Object{{"carom", Value(Value::Object{{"positions", positions}})}});
        surfaces_[surface] = append(model_.meshes, mesh);
      }
  }

  static std::vector<std::uint32_t> fansOf(const Surface& surface) {
    std::vector<std::uint32_t> indices;
    for (const Surface::Face& face : surface.faces)
      for (int k = 1; k + 1 < face.count; ++k)
        for (const int i : {0, k, k + 1})
          indices.push_back(static_cast<std::uint32_t>(surface.corners[static_cast<std::size_t>(face.first + i)]));
    return indices;
  }

  // Node i is body i; then come the nodes below bodies.
  void addBodies() {
    model_.nodes.resize(static_cast<std::size_t>(bodyCount()));
    for (int body = 0; body < bodyCount(); ++body) {
      addBody(body);
      roots_.push_back(body);
    }
  }

  void addBody(int body) {
    gltf::PhysicsNode physics = physicsNodeOf(scene_, body, (*motion_.models)[body], surfaces_);
    if (kindOf(scene_.bodies[body].shape).endless) {  // drawn as a square around the motion
      const Vec3 normal = gltf::turned(physics.rotation, Vec3::UnitZ()), centre = extent_.center();
      const Vec3 was = physics.translation;
      physics.translation = centre + normal.dot(physics.translation - centre) * normal;
      physics.surface_velocity +=
          physics.surface_angular_velocity.cross(gltf::turned(physics.rotation.conjugate(), physics.translation - was));
    }
    tinygltf::Node node = nodeOf(physics);
    node.mesh = look_.body(body);
    model_.nodes[static_cast<std::size_t>(body)] = node;
  }

  /// Adds the nodes below, not the node itself.
  tinygltf::Node nodeOf(const gltf::PhysicsNode& physics) {
    tinygltf::Node node;
    node.name = physics.name;
    setPose(node, physics.translation, physics.rotation);
    const Vec3 scale = gltf::swappedSizes(physics.scale);
    if (scale != Vec3::Ones()) node.scale = {scale.x(), scale.y(), scale.z()};
    if (physics.motion || physics.collider) node.extensions["KHR_physics_rigid_bodies"] = physics_.extensionOf(physics);
    if (physics.surfaceMoves()) node.extras = surfaceExtrasOf(physics);
    for (const gltf::PhysicsNode& child : physics.children) {
      const tinygltf::Node below = nodeOf(child);
      node.children.push_back(append(model_.nodes, below));
    }
    return node;
  }

  void addStage() {
    if (options_.camera) roots_.push_back(addCamera(model_, extent_));
    if (options_.light) roots_.push_back(addSun(model_, extent_, *options_.light));
    const auto add = [&](const std::vector<int>& marks) { roots_.insert(roots_.end(), marks.begin(), marks.end()); };
    if (options_.ghosts) add(addGhosts(model_, look_, motion_, *options_.ghosts));
    if (options_.nails) add(addNails(model_, look_, document_, motion_));
  }

  void addAnimation() {
    tinygltf::Animation animation;
    animation.name = "motion";
    for (int body = 0; body < bodyCount(); ++body) {
      if (scene_.bodies[body].fixed) continue;
      if (options_.keys == GltfKeys::cubic) {
        addCubic(animation, body);
      } else {
        addLinear(animation, body);
      }
    }
    if (!animation.channels.empty()) model_.animations.push_back(animation);
  }

  // Where no time passes, the node's own pose says all.
  void addLinear(tinygltf::Animation& animation, int body) {
    const std::string place = placeOf(scene_.bodies[body]);
    const FrameKeys keys = frameKeys(motion_, body, options_.frames_per_second, options_.tolerance);
    if (keys.moves.times.size() < 2) return;
    const int times = buffer_.addTimes(keys.moves.times, place);
    addChannel(animation, body, "translation", times, buffer_.addVectors(keys.moves.values, place), "LINEAR");
    addChannel(animation, body, "rotation", times, buffer_.addQuaternions(keys.turns.values, place), "LINEAR");
  }

  void addCubic(tinygltf::Animation& animation, int body) {
    const std::string place = placeOf(scene_.bodies[body]);
    const TranslationKeys moves = cubicKeys(motion_, body);
    if (moves.times.size() < 2) return;
    addChannel(animation, body, "translation", buffer_.addTimes(moves.times, place),
               buffer_.addVectors(woven(moves), place), "CUBICSPLINE");
    const RotationKeys turns = turnKeys(motion_, body);
    addChannel(animation, body, "rotation", buffer_.addTimes(turns.times, place),
               buffer_.addQuaternions(turns.values, place), "LINEAR");
  }

  // glTF stores in-tangent, value, out-tangent of every key.
  static std::vector<Vec3> woven(const TranslationKeys& keys) {
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < keys.times.size(); ++k)
      out.insert(out.end(), {keys.in_tangents[k], keys.values[k], keys.out_tangents[k]});
    return out;
  }

  static void addChannel(tinygltf::Animation& animation, int body, const std::string& path, int input, int output,
                         const std::string& interpolation) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel channel;
    channel.sampler = append(animation.samplers, sampler);
    channel.target_node = body;
    channel.target_path = path;
    animation.channels.push_back(channel);
  }

  int bodyCount() const { return static_cast<int>(scene_.bodies.size()); }

  const Document& document_;
  const Motion& motion_;
  const Scene& scene_;
  const GltfOptions& options_;
  const Extent extent_;
  tinygltf::Model model_;
  GltfBuffer buffer_;
  GltfLook look_;
  PhysicsWriter physics_;
  SurfaceMeshes surfaces_;
  std::vector<int> roots_;  // nodes of the scene
};

void requireSense(const std::string& what, double value, double most) {
  if (!(value > 0 && value <= most))
    throw InputError(what, "found " + numberText(value) + ", expected a number above 0 and up to " + numberText(most));
}

}  // namespace

int lastFrame(double seconds, double frames_per_second) {
  // A motion that ends on a frame ends there, whatever the last digit of the product.
  const double frames = std::ceil(seconds * frames_per_second * (1 - 1e-12));
  return frames < 2e9 ? static_cast<int>(frames) : 2000000000;
}

std::string gltfText(const Document& document, const Motion& motion, const GltfOptions& options, bool binary) {
  requireSense("frames per second", options.frames_per_second, 1e5);
  requireSense("tolerance", options.tolerance, 1e6);
  if (options.light) requireSense("light", *options.light, 1e9);
  if (options.ghosts) requireSense("ghosts", *options.ghosts, 1e9);
  const tinygltf::Model model = Writer(document, motion, options).make();
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, true, binary))
    throw InputError("glTF", "the scene cannot be written");
  return std::move(out).str();
}

}  // namespace carom
