// SPDX-License-Identifier: MIT
#include "adjoint/scene/scene.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"

namespace carom {

using namespace adjoint_detail;

Inertia Inertia::fromMoments(const Vec3& moments) {
  Inertia inertia;
  inertia.source = Source::moments;
  inertia.moments = moments;
  return inertia;
}

Inertia Inertia::fromMatrix(const Mat3& matrix) {
  checkEntries("Inertia::fromMatrix", "an entry of", matrix);
  constexpr double kSymmetryRounding = 1e-12;
  if (!((matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= kSymmetryRounding * matrix.cwiseAbs().maxCoeff()))
    throw InputError("Inertia::fromMatrix", "found a matrix that is not symmetric, expected a symmetric one");
  Inertia inertia;
  inertia.source = Source::matrix;
  if (matrix.isDiagonal(0)) {  // already principal: keep the order that was written
    inertia.moments = matrix.diagonal();
    return inertia;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(0.5 * (matrix + matrix.transpose()));
  inertia.moments = solver.eigenvalues();
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  inertia.axes = Quat(axes).normalized();
  inertia.axes.coeffs().array() += 0.0;  // no negative zeros: a file in other axes does not keep them
  return inertia;
}

Mat3 Inertia::matrix() const {
  const Mat3 R = axes.toRotationMatrix();
  return R * moments.asDiagonal() * R.transpose();
}

namespace {

template <class Items>
int indexByName(const Items& items, const std::string& name, const char* what) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  std::string known;
  for (const auto& item : items) known += (known.empty() ? "'" : ", '") + item.name + "'";
  throw InputError(std::string("found no ") + what + " '" + name + "', expected one of " +
                   (known.empty() ? "none: the scene has none" : known));
}

}  // namespace

int bodyIndex(const Scene& scene, const std::string& name) { return indexByName(scene.bodies, name, "body"); }
int materialIndex(const Scene& scene, const std::string& name) {
  return indexByName(scene.materials, name, "material");
}
int materialIndexOf(const Scene& scene, int body) {
  const std::string& name = scene.bodies[checkedIndex("materialIndexOf", "body", body, scene.bodies.size())].material;
  return name.empty() ? -1 : materialIndex(scene, name);
}

const Material& materialOf(const Scene& scene, const Body& body) {
  static const Material plain;
  if (body.material.empty()) return plain;
  return scene.materials[static_cast<std::size_t>(materialIndex(scene, body.material))];
}

namespace {

bool share(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& name) { return std::find(b.begin(), b.end(), name) != b.end(); });
}

bool lets(const CollisionFilter& filter, const CollisionFilter& other) {
  if (!filter.collide_with.empty() && !share(filter.collide_with, other.systems)) return false;
  return !share(filter.not_collide_with, other.systems);
}

}  // namespace

bool mayCollide(const Body& a, const Body& b) {
  if (a.immovable() && b.immovable()) return false;
  return lets(a.collision_filter, b.collision_filter) && lets(b.collision_filter, a.collision_filter);
}

template <>
double SceneDerivativeOf<double>::dot(const SceneDerivativeOf& o) const {
  checkCount("SceneDerivative::dot", "materials", o.materials.size(), materials.size());
  checkCount("SceneDerivative::dot", "bodies", o.bodies.size(), bodies.size());
  checkCount("SceneDerivative::dot", "tilts", o.tilts.size(), tilts.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    checkCount("SceneDerivative::dot", "dimensions", static_cast<std::size_t>(o.bodies[i].size.size()),
               static_cast<std::size_t>(bodies[i].size.size()));
  double sum = gravity.dot(o.gravity);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MaterialDerivative &m = materials[i], &n = o.materials[i];
    sum += m.elasticity * n.elasticity + m.friction * n.friction + m.tangential_elasticity * n.tangential_elasticity;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyDerivative &b = bodies[i], &c = o.bodies[i];
    sum += b.position.dot(c.position) + b.orientation.dot(c.orientation) + b.velocity.dot(c.velocity) +
           b.angular_velocity.dot(c.angular_velocity) + b.mass * c.mass + b.density * c.density +
           b.inertia.dot(c.inertia) + b.size.dot(c.size) + b.surface_velocity.dot(c.surface_velocity) +
           b.surface_angular_velocity.dot(c.surface_angular_velocity);
  }
  for (std::size_t i = 0; i < tilts.size(); ++i) sum += tilts[i].dot(o.tilts[i]);
  return sum;
}

}  // namespace carom
