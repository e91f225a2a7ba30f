// SPDX-License-Identifier: MIT
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <stdexcept>

#include "adjoint/scene/body_model.h"
#include "bench/charts/engines/engine.h"

// Bullet's sequential impulses, in double precision. As it comes it makes contacts before bodies touch and does not
// bounce below 0.2 m/s; both are switched off, and overlap is mended beside the velocities (split impulse).

namespace carom::charts {
namespace {

btVector3 bt(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

class BulletEngine final : public Engine {
 public:
  BulletEngine(const Scene& scene, double dt) : dt_(dt), dispatcher_(&configuration_) {
    world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_, &solver_, &configuration_);
    world_->setGravity(bt(scene.gravity));
    btContactSolverInfo& info = world_->getSolverInfo();
    info.m_numIterations = 50;
    info.m_restitutionVelocityThreshold = 0;
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = 0;
    info.m_damping = 0;
    const PairCoefficients pair = commonPair(scene);
    // the coefficients of two bodies are multiplied
    for (const Body& body : scene.bodies) add(body, std::sqrt(pair.elasticity), std::sqrt(pair.friction));
  }
  ~BulletEngine() override {
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
  }
  BulletEngine(const BulletEngine&) = delete;

  void step() override { world_->stepSimulation(dt_, 0); }

  BodyState state(int body) const override {
    const btRigidBody& b = *bodies_.at(static_cast<std::size_t>(body));
    const btQuaternion q = b.getWorldTransform().getRotation();
    BodyState s;
    s.position = vec(b.getWorldTransform().getOrigin());
    s.orientation = Quat(q.w(), q.x(), q.y(), q.z());
    s.velocity = vec(b.getLinearVelocity()), s.angular_velocity = vec(b.getAngularVelocity());
    return s;
  }

 private:
  std::unique_ptr<btCollisionShape> shapeOf(const Body& body) {
    if (const auto* s = std::get_if<Sphere>(&body.shape)) return std::make_unique<btSphereShape>(s->radius);
    if (const auto* b = std::get_if<Box>(&body.shape)) return std::make_unique<btBoxShape>(bt(0.5 * b->size));
    if (const auto* p = std::get_if<Plane>(&body.shape))
      return std::make_unique<btStaticPlaneShape>(bt(p->normal), p->offset);
    throw std::invalid_argument("'" + body.name + "' is no sphere, box or plane");
  }

  void add(const Body& body, double restitution, double friction) {
    shapes_.push_back(shapeOf(body));
    const BodyModel model = body.fixed ? BodyModel{} : modelOf(body);
    btRigidBody::btRigidBodyConstructionInfo info(model.mass, nullptr, shapes_.back().get(), bt(model.inertia));
    const Quat& q = body.orientation;
    info.m_startWorldTransform = btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), bt(body.position));
    info.m_restitution = restitution;
    info.m_friction = friction;
    auto b = std::make_unique<btRigidBody>(info);
    b->setDamping(0, 0);
    b->setActivationState(DISABLE_DEACTIVATION);
    b->setContactProcessingThreshold(0);
    if (!body.fixed) {
      b->setLinearVelocity(bt(body.velocity));
      b->setAngularVelocity(bt(body.angular_velocity));
    }
    world_->addRigidBody(b.get());
    bodies_.push_back(std::move(b));
  }

  double dt_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

EngineKind bullet() {
  return {"Bullet",
          std::string("Bullet ") + CAROM_CHARTS_BULLET +
              ", double precision, 50 iterations, contacts only where bodies overlap, split impulse",
          [](const Scene& scene, double dt) -> std::unique_ptr<Engine> {
            return std::make_unique<BulletEngine>(scene, dt);
          }};
}

}  // namespace carom::charts
