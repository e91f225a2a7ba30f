#include "formats/export_gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

#include "adjoint/errors.h"
#include "formats/detail/gltf_buffer.hpp"
#include "formats/detail/gltf_keys.hpp"
#include "formats/detail/gltf_mesh.hpp"
#include "formats/detail/gltf_physics.hpp"
#include "formats/motion_extent.h"
#include "formats/palette.h"
#include "formats/write_file.h"

namespace carom {
namespace {

using tinygltf::Value;

std::string placeOf(const Body& body) { return "body '" + body.name + "'"; }

template <class Item>
int append(std::vector<Item>& items, Item item) {
  items.push_back(std::move(item));
  return static_cast<int>(items.size()) - 1;
}

void setPose(tinygltf::Node& node, const Vec3& x, const Quat& q) {
  node.translation = {x.x(), x.y(), x.z()};
  node.rotation = {q.x(), q.y(), q.z(), q.w()};
}

int addMaterial(tinygltf::Model& model, const std::string& name, const Colour& colour, bool fixed, bool flat) {
  tinygltf::Material material;
  material.name = name;
  const auto [r, g, b] = colour.linear();
  material.pbrMetallicRoughness.baseColorFactor = {r, g, b, 1};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = fixed ? 0.9 : 0.45;
  material.doubleSided = flat;
  return append(model.materials, material);
}

class Writer {
 public:
  Writer(const Document& document, const Motion& motion, const GltfOptions& options)
      : document_(document), motion_(motion), scene_(*motion.scene), options_(options), buffer_(model_) {}

  tinygltf::Model make() {
    const Extent extent = motionExtent(motion_);
    centre_ = extent.center();
    plane_half_width_ = extent.diagonal().norm();
    model_.asset.version = "2.0";
    model_.asset.generator = "carom";
    addPhysics(model_, scene_);
    addBodies();
    addAnimation();
    tinygltf::Scene scene;
    scene.name = "carom";
    scene.nodes = {0};
    scene.extras = Value(Value::Object{{"carom", editOf(document_, scene_)}});
    model_.defaultScene = append(model_.scenes, scene);
    return std::move(model_);
  }

 private:
  // Node 0 turns z-up into glTF's y-up; node i + 1 is body i.
  void addBodies() {
    tinygltf::Node root;
    root.name = "z-up";
    root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    for (int body = 0; body < bodyCount(); ++body) root.children.push_back(body + 1);
    model_.nodes.push_back(root);
    std::vector<tinygltf::Node> surfaces;
    for (int body = 0; body < bodyCount(); ++body) addBody(body, surfaces);
    model_.nodes.insert(model_.nodes.end(), surfaces.begin(), surfaces.end());
  }

  void addBody(int body, std::vector<tinygltf::Node>& surfaces) {
    const Body& b = scene_.bodies[body];
    tinygltf::Node node;
    node.name = b.name;
    setPose(node, b.position, b.orientation);
    Value::Object physics;
    if (!b.fixed) physics["motion"] = motionOf(b, (*motion_.models)[body]);
    if (const Plane* plane = std::get_if<Plane>(&b.shape)) {
      // glTF's plane faces +y through the origin of its node, so ours needs a node of its own.
      node.children.push_back(1 + bodyCount() + static_cast<int>(surfaces.size()));
      surfaces.push_back(planeNode(body, *plane));
    } else {
      node.mesh = addMesh(body);
      physics["collider"] = colliderOf(scene_, body);
    }
    if (!physics.empty()) node.extensions["KHR_physics_rigid_bodies"] = Value(physics);
    model_.nodes.push_back(node);
  }

  tinygltf::Node planeNode(int body, const Plane& plane) {
    const Body& b = scene_.bodies[body];
    const Vec3 centre = b.orientation.conjugate() * (centre_ - b.position);  // of the motion, in the body's axes
    tinygltf::Node node;
    node.name = b.name + " surface";
    setPose(node, centre + (plane.offset - plane.normal.dot(centre)) * plane.normal,
            Quat::FromTwoVectors(Vec3::UnitY(), plane.normal));
    node.mesh = addMesh(body);
    node.extensions["KHR_physics_rigid_bodies"] = Value(Value::Object{{"collider", colliderOf(scene_, body)}});
    return node;
  }

  int addMesh(int body) {
    const Body& b = scene_.bodies[body];
    const TriangleMesh triangles = meshOf(b.shape, plane_half_width_);
    const Colour colour = bodyColour(scene_, body);
    const bool flat = std::holds_alternative<Plane>(b.shape);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = buffer_.addVertices(triangles.positions, placeOf(b));
    primitive.attributes["NORMAL"] = buffer_.addVertices(triangles.normals, placeOf(b));
    primitive.indices = buffer_.addIndices(triangles.triangles);
    primitive.material = addMaterial(model_, b.name, colour, b.fixed, flat);
    tinygltf::Mesh mesh;
    mesh.name = b.name;
    mesh.primitives.push_back(primitive);
    if (!triangles.accent.empty()) {
      primitive.indices = buffer_.addIndices(triangles.accent);
      primitive.material = addMaterial(model_, b.name + " accent", colour.mixedWith({1, 1, 1}, 0.55), b.fixed, flat);
      mesh.primitives.push_back(primitive);
    }
    return append(model_.meshes, mesh);
  }

  void addAnimation() {
    tinygltf::Animation animation;
    animation.name = "motion";
    for (int body = 0; body < bodyCount(); ++body)
      if (!scene_.bodies[body].fixed) addChannels(animation, body);
    if (!animation.channels.empty()) model_.animations.push_back(animation);
  }

  void addChannels(tinygltf::Animation& animation, int body) {
    const std::string place = placeOf(scene_.bodies[body]);
    const bool web = options_.profile == GltfProfile::web;
    const TranslationKeys moves =
        web ? splineKeys(motion_, body) : frameKeys(motion_, body, options_.frames_per_second);
    if (moves.times.size() < 2) return;  // no time passes: the node's own pose says all
    addChannel(animation, body, "translation", buffer_.addTimes(moves.times, place),
               buffer_.addVectors(web ? woven(moves) : moves.values, place), web ? "CUBICSPLINE" : "LINEAR");
    const RotationKeys turns = rotationKeys(motion_, body, web ? 0 : options_.frames_per_second);
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
    channel.target_node = body + 1;
    channel.target_path = path;
    animation.channels.push_back(channel);
  }

  int bodyCount() const { return static_cast<int>(scene_.bodies.size()); }

  const Document& document_;
  const Motion& motion_;
  const Scene& scene_;
  const GltfOptions& options_;
  tinygltf::Model model_;
  GltfBuffer buffer_;
  Vec3 centre_ = Vec3::Zero();
  double plane_half_width_ = 1;
};

bool isBinary(const std::string& path) {
  std::string end = path.size() < 4 ? "" : path.substr(path.size() - 4);
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end == ".glb";
}

}  // namespace

void exportGltf(const std::string& path, const Document& document, const Motion& motion, const GltfOptions& options) {
  const double fps = options.frames_per_second;
  if (!(fps > 0 && fps <= 1e5))
    throw InputError("frames per second", "found " + std::to_string(fps) + ", expected a number up to 100000");
  const tinygltf::Model model = Writer(document, motion, options).make();
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, true, isBinary(path)))
    throw InputError(path, "cannot write the scene as glTF");
  writeFile(path, std::move(out).str());
}

}  // namespace carom
