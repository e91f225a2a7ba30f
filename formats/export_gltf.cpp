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
      : document_(document),
        motion_(motion),
        scene_(*motion.scene),
        options_(options),
        buffer_(model_),
        physics_(scene_) {}

  tinygltf::Model make() {
    const Extent extent = motionExtent(motion_);
    centre_ = extent.center();
    plane_half_width_ = extent.diagonal().norm();
    model_.asset.version = "2.0";
    model_.asset.generator = "carom";
    addSurfaces();
    addBodies();
    physics_.finish(model_);
    addAnimation();
    tinygltf::Scene scene;
    scene.name = "carom";
    scene.nodes = {0};
    scene.extras = Value(Value::Object{{"carom", documentOf(document_, scene_, surfaces_)}});
    model_.defaultScene = append(model_.scenes, scene);
    return std::move(model_);
  }

 private:
  // The surfaces that bodies collide with, as meshes that no node shows. Other programs see floats, 6e-8 of the
  // coordinates off; importGltf finds the doubles in a view of their own, which extras name.
  void addSurfaces() {
    for (const Body& body : scene_.bodies)
      for (const Surface* surface : surfacesOf(body.shape)) {
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

  // Node 0 turns z-up into glTF's y-up; node i + 1 is body i; then come the nodes below bodies.
  void addBodies() {
    tinygltf::Node root;
    root.name = "z-up";
    root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    for (int body = 0; body < bodyCount(); ++body) root.children.push_back(body + 1);
    model_.nodes.resize(static_cast<std::size_t>(1 + bodyCount()));
    model_.nodes[0] = root;
    for (int body = 0; body < bodyCount(); ++body) addBody(body);
  }

  void addBody(int body) {
    const Body& b = scene_.bodies[body];
    gltf::PhysicsNode physics = physicsNodeOf(scene_, body, (*motion_.models)[body], surfaces_);
    const Plane* plane = std::get_if<Plane>(&b.shape);
    if (plane != nullptr) {                                                    // drawn as a square around the motion
      const Vec3 centre = b.orientation.conjugate() * (centre_ - b.position);  // in the body's axes
      physics.children[0].translation = centre + (plane->offset - plane->normal.dot(centre)) * plane->normal;
    }
    tinygltf::Node node = nodeOf(physics);
    const int mesh = addMesh(body);
    if (plane == nullptr) {
      node.mesh = mesh;
    } else {
      model_.nodes[static_cast<std::size_t>(node.children[0])].mesh = mesh;
    }
    model_.nodes[static_cast<std::size_t>(1 + body)] = node;
  }

  /// Adds the nodes below, not the node itself.
  tinygltf::Node nodeOf(const gltf::PhysicsNode& physics) {
    tinygltf::Node node;
    node.name = physics.name;
    setPose(node, physics.translation, physics.rotation);
    if (physics.scale != Vec3::Ones()) node.scale = {physics.scale.x(), physics.scale.y(), physics.scale.z()};
    if (physics.motion || physics.collider) node.extensions["KHR_physics_rigid_bodies"] = physics_.extensionOf(physics);
    for (const gltf::PhysicsNode& child : physics.children) {
      const tinygltf::Node below = nodeOf(child);
      node.children.push_back(append(model_.nodes, below));
    }
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
  PhysicsWriter physics_;
  SurfaceMeshes surfaces_;
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
