// SPDX-License-Identifier: MIT
#include <ode/ode.h>

#include <array>
#include <stdexcept>

#include "adjoint/scene/body_model.h"
#include "bench/charts/engines/engine.h"

// ODE's own time stepping. Contacts bounce by the restitution of the scene, CFM is 0 (its default of 1e-10 is seen at
// step sizes of 1e-5) but for what lies on a face: dWorldStep has no answer for redundant contacts without it.
// Everything else as it comes.

namespace carom::charts {
namespace {

constexpr int kMostContacts = 16;

void quiet(int, const char*, va_list) {}

// One for the whole program: the library must not be closed while a world of another engine is alive.
void initOnce() {
  static const bool done = [] {
    dInitODE2(0);
    dSetMessageHandler(quiet);
    return true;
  }();
  (void)done;
}

class OdeEngine final : public Engine {
 public:
  OdeEngine(const Scene& scene, double dt, bool quick, double cfm = 0)
      : dt_(dt), quick_(quick), pair_(commonPair(scene)) {
    initOnce();
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    dWorldSetCFM(world_, cfm);
    dWorldSetQuickStepNumIterations(world_, 50);
    dWorldSetContactSurfaceLayer(world_, 0);
    dWorldSetAutoDisableFlag(world_, 0);
    for (const Body& body : scene.bodies) add(body);
  }
  ~OdeEngine() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeEngine(const OdeEngine&) = delete;

  void step() override {
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->touch(a, b); });
    quick_ ? dWorldQuickStep(world_, dt_) : dWorldStep(world_, dt_);
    dJointGroupEmpty(contacts_);
  }

  BodyState state(int body) const override {
    const dBodyID b = bodies_.at(static_cast<std::size_t>(body));
    BodyState s;
    if (!b) return s;
    const dReal *x = dBodyGetPosition(b), *q = dBodyGetQuaternion(b), *v = dBodyGetLinearVel(b),
                *w = dBodyGetAngularVel(b);
    s.position = {x[0], x[1], x[2]}, s.velocity = {v[0], v[1], v[2]}, s.angular_velocity = {w[0], w[1], w[2]};
    s.orientation = Quat(q[0], q[1], q[2], q[3]);
    return s;
  }

 private:
  dGeomID geomOf(const Body& body) {
    if (const auto* s = std::get_if<Sphere>(&body.shape)) return dCreateSphere(space_, s->radius);
    if (const auto* b = std::get_if<Box>(&body.shape)) return dCreateBox(space_, b->size.x(), b->size.y(), b->size.z());
    if (const auto* p = std::get_if<Plane>(&body.shape))
      return dCreatePlane(space_, p->normal.x(), p->normal.y(), p->normal.z(), p->offset);
    throw std::invalid_argument("'" + body.name + "' is no sphere, box or plane");
  }

  void add(const Body& body) {
    const dGeomID geom = geomOf(body);
    bodies_.push_back(nullptr);
    const dQuaternion q = {body.orientation.w(), body.orientation.x(), body.orientation.y(), body.orientation.z()};
    if (body.fixed) {
      if (std::holds_alternative<Plane>(body.shape)) return;
      dGeomSetPosition(geom, body.position.x(), body.position.y(), body.position.z());
      dGeomSetQuaternion(geom, q);
      return;
    }
    const BodyModel model = modelOf(body);
    const dBodyID b = bodies_.back() = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, model.mass, 0, 0, 0, model.inertia[0], model.inertia[1], model.inertia[2], 0, 0, 0);
    dBodySetMass(b, &mass);
    dBodySetPosition(b, body.position.x(), body.position.y(), body.position.z());
    dBodySetQuaternion(b, q);
    dBodySetLinearVel(b, body.velocity.x(), body.velocity.y(), body.velocity.z());
    dBodySetAngularVel(b, body.angular_velocity.x(), body.angular_velocity.y(), body.angular_velocity.z());
    dGeomSetBody(geom, b);
  }

  void touch(dGeomID a, dGeomID b) {
    if (!dGeomGetBody(a) && !dGeomGetBody(b)) return;
    std::array<dContact, kMostContacts> contacts{};
    const int n = dCollide(a, b, kMostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      dContact& c = contacts[static_cast<std::size_t>(i)];
      c.surface.mode = dContactBounce;
      c.surface.bounce = pair_.elasticity;
      c.surface.bounce_vel = 0;
      c.surface.mu = pair_.friction;
      if (pair_.friction > 0) c.surface.mode |= dContactApprox1;  // a Coulomb cone, not a fixed limit of force
      dJointAttach(dJointCreateContact(world_, contacts_, &c), dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  double dt_;
  bool quick_;
  PairCoefficients pair_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> bodies_;
};

std::string version() { return std::string("ODE ") + CAROM_CHARTS_ODE + ", double precision, CFM 0"; }

}  // namespace

EngineKind odeStep() {
  return {"ODE", version() + ", dWorldStep", [](const Scene& scene, double dt) -> std::unique_ptr<Engine> {
            return std::make_unique<OdeEngine>(scene, dt, false);
          }};
}
EngineKind odeStepWithDefaultCfm() {
  return {"ODE", version() + ", dWorldStep, but CFM 1e-10",
          [](const Scene& scene, double dt) -> std::unique_ptr<Engine> {
            return std::make_unique<OdeEngine>(scene, dt, false, 1e-10);
          }};
}
EngineKind odeQuickStep() {
  return {"ODE quick", version() + ", dWorldQuickStep with 50 iterations",
          [](const Scene& scene, double dt) -> std::unique_ptr<Engine> {
            return std::make_unique<OdeEngine>(scene, dt, true);
          }};
}

}  // namespace carom::charts
