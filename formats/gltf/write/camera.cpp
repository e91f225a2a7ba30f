// SPDX-License-Identifier: MIT
// Camera and light of exported glTF.
#include <tiny_gltf.h>

#include <cmath>
#include <numbers>

#include "formats/gltf/write/stage.hpp"

namespace carom::formats_detail {

namespace {

using tinygltf::Value;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHeightAngle = 35 * kDegree;  // of the picture, from top to bottom
constexpr double kAspect = 16.0 / 9;
constexpr double kTurn = 20 * kDegree, kRise = 14 * kDegree;
constexpr double kRoom = 1.08;

/// Axes of a camera in the columns: to the right, up and back. From the front (-y), or from the right (+x) where the
/// motion is longer in y.
Mat3 viewAxes(const Extent& extent, double turn, double rise) {
  const Vec3 size = extent.sizes();
  const double front = size.y() > size.x() ? 0.5 * std::numbers::pi : 0;
  const double azimuth = front + turn;
  const Vec3 back(std::cos(rise) * std::sin(azimuth), -std::cos(rise) * std::cos(azimuth), std::sin(rise));
  const Vec3 right(std::cos(azimuth), std::sin(azimuth), 0);
  Mat3 axes;
  axes << right, back.cross(right), back;
  return axes;
}

/// glTF's cameras and lights look along -z of their node, whose y is up. Our axes have its y as z: what is right, up,
/// back there are x, z and -y of a node here.
tinygltf::Node lookingNode(const std::string& name, const Vec3& x, const Mat3& right_up_back) {
  Mat3 axes;
  axes << right_up_back.col(0), -right_up_back.col(2), right_up_back.col(1);
  tinygltf::Node node;
  node.name = name;
  setPose(node, x, Quat(axes));
  return node;
}

/// How far behind the centre every corner is in the picture.
double distanceFor(const Extent& extent, const Mat3& axes) {
  const double tan_up = std::tan(0.5 * kHeightAngle) / kRoom, tan_side = tan_up * kAspect;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = axes.transpose() * (extent.corner(static_cast<Extent::CornerType>(corner)) - extent.center());
    distance = std::max({distance, p.z() + std::abs(p.x()) / tan_side, p.z() + std::abs(p.y()) / tan_up});
  }
  return distance;
}

}  // namespace

int addCamera(tinygltf::Model& model, const Extent& extent) {
  const Mat3 axes = viewAxes(extent, kTurn, kRise);
  const double radius = 0.5 * extent.diagonal().norm(), distance = distanceFor(extent, axes);
  tinygltf::Camera camera;
  camera.name = "camera";
  camera.type = "perspective";
  camera.perspective.yfov = kHeightAngle;
  camera.perspective.aspectRatio = kAspect;
  camera.perspective.znear = 0.01 * distance;
  camera.perspective.zfar = distance + 100 * radius;  // floors go on behind the motion
  tinygltf::Node node = lookingNode("camera", extent.center() + distance * axes.col(2), axes);
  node.camera = append(model.cameras, camera);
  return append(model.nodes, node);
}

int addSun(tinygltf::Model& model, const Extent& extent, double lux) {
  const Mat3 axes = viewAxes(extent, -25 * kDegree, 55 * kDegree);
  tinygltf::Light light;
  light.name = "sun";
  light.type = "directional";
  light.color = {1, 1, 1};
  light.intensity = lux;
  tinygltf::Node node = lookingNode("sun", extent.center() + extent.diagonal().norm() * axes.col(2), axes);
  node.extensions["KHR_lights_punctual"] = Value(Value::Object{{"light", Value(append(model.lights, light))}});
  return append(model.nodes, node);
}

}  // namespace carom::formats_detail
