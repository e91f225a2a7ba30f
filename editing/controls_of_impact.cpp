// Control of one impact: the tilt (alpha, beta) of the collision normal at the body's n-th impact. Tilts stay within
// the cone alpha^2 + beta^2 <= max^2 (see validity_rows.h).

#include "editing/control_families.h"

namespace carom {
namespace {

std::vector<std::string> tiltComponents(const Scene&, const ControlOwner&) { return {"alpha", "beta"}; }
Vec3 getTilt(const Scene& scene, const ControlOwner& o) {
  const Vec2& value = scene.tilts[o.tilt].value;
  return {value.x(), value.y(), 0};
}
void setTilt(const Vec3& values, const Scene&, const ControlOwner& o, Scene& scene) {
  scene.tilts[o.tilt].value = values.head<2>();
}
Vec3 gatherTilt(const SceneGradient& gradient, const ControlOwner& o, const Vec3&) {
  return {gradient.tilts[o.tilt].x(), gradient.tilts[o.tilt].y(), 0};
}
void scatterTilt(const Vec3& rates, const ControlOwner& o, const Vec3&, SceneTangent& tangent) {
  tangent.tilts[o.tilt] += rates.head<2>();
}

}  // namespace

const ControlKind kTiltControl{"tilt",  OwnerKind::impact, false,   -kUnbounded, kUnbounded,  false,    tiltComponents,
                               nullptr, getTilt,           setTilt, gatherTilt,  scatterTilt, unitScale};

}  // namespace carom
