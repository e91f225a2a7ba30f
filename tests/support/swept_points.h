// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/motion/contact_source.h"
#include "adjoint/scene/scene.h"

namespace carom::test {

/// A point of a shape with a ball of some radius about it, and its change with the shape's dimensions. What a ball, a
/// box, a capsule or a hull touches a plane with is one of these.
struct SweptPoint {
  Vec3 point = Vec3::Zero();  ///< in the shape's axes
  double radius = 0;
  Eigen::Matrix3Xd dpoint;     ///< 3 x dimensions
  Eigen::RowVectorXd dradius;  ///< 1 x dimensions
};

/// Of spheres, boxes (corner v has + on axis k where bit k of v is set), capsules (lower end first), hulls, and of
/// compounds all those of the parts, in order. Cylinders and meshes have none.
std::vector<SweptPoint> sweptPointsOf(const Shape& shape);

/// Collision of bodies made of swept points with fixed planes, by dense sampling: slow, and good enough for a test that
/// is about what comes after. Moving bodies pass through one another.
class SweptPointContacts final : public ContactSource {
 public:
  explicit SweptPointContacts(const Scene& scene) { begin(scene); }

  void begin(const Scene& scene) override;
  void setPath(int, const Arc&, double, double) override {}
  void neighbours(int body, std::vector<int>& out) override;
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override;
  std::shared_ptr<const ContactGeometry> geometry() const override { return geometry_; }

 private:
  std::vector<bool> plane_;
  std::vector<std::size_t> points_;
  std::shared_ptr<const ContactGeometry> geometry_;
};

}  // namespace carom::test
