// SPDX-License-Identifier: MIT
#include "ode_bridge/broad_phase.hpp"

#include <algorithm>

#include "ode_bridge/library.hpp"

#include <ode/ode.h>

namespace carom::ode_bridge_detail {

struct BroadPhase::Space {
  dSpaceID space = nullptr;
  std::vector<dGeomID> geoms;

  ~Space() {
    const LockedOdeCalls calls;
    clear();
    dSpaceDestroy(space);
  }
  void clear() {
    for (dGeomID geom : geoms)
      if (geom) dGeomDestroy(geom);
    geoms.clear();
  }
  // Keeps the geometry of a body when it is of the wanted class already.
  dGeomID ofClass(int body, int wanted) {
    dGeomID& geom = geoms[static_cast<std::size_t>(body)];
    if (geom && dGeomGetClass(geom) == wanted) return geom;
    const LockedOdeCalls calls;
    if (geom) dGeomDestroy(geom);
    geom = wanted == dPlaneClass ? dCreatePlane(space, 0, 0, 1, 0) : dCreateBox(space, 1, 1, 1);
    dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(body)));
    return geom;
  }
};

namespace {

constexpr unsigned long kMoving = 1, kFixed = 2;

// The callback only notes pairs: an exception here would leave the space locked for good.
void note(void* data, dGeomID a, dGeomID b) {
  auto& pairs = *static_cast<std::vector<std::pair<int, int>>*>(data);
  const auto index = [](dGeomID g) { return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(g))); };
  pairs.emplace_back(index(a), index(b));
}

}  // namespace

BroadPhase::BroadPhase() : space_(std::make_unique<Space>()) {
  const LockedOdeCalls calls;
  space_->space = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  dSpaceSetCleanup(space_->space, 0);
}

BroadPhase::~BroadPhase() = default;

void BroadPhase::reset(std::size_t count) {
  if (space_->geoms.size() == count) return;  // every body gets its bounds anew
  const LockedOdeCalls calls;
  space_->clear();
  space_->geoms.assign(count, nullptr);
}

void BroadPhase::setBounds(int body, const Bounds& b, bool moving) {
  const OdeCalls calls;
  const dGeomID geom = space_->ofClass(body, dBoxClass);
  // the library wants sizes above 0; larger boxes only list more pairs
  const Vec3 centre = 0.5 * (b.low + b.high), size = (b.high - b.low).cwiseMax(1e-12);
  dGeomSetPosition(geom, centre.x(), centre.y(), centre.z());
  dGeomBoxSetLengths(geom, size.x(), size.y(), size.z());
  dGeomSetCategoryBits(geom, moving ? kMoving : kFixed);
  dGeomSetCollideBits(geom, moving ? kMoving | kFixed : kMoving);
}

void BroadPhase::setHalfSpace(int body, const Vec3& normal, double offset) {
  const OdeCalls calls;
  const dGeomID geom = space_->ofClass(body, dPlaneClass);
  dGeomPlaneSetParams(geom, normal.x(), normal.y(), normal.z(), offset);
  dGeomSetCategoryBits(geom, kFixed);
  dGeomSetCollideBits(geom, kMoving);
}

void BroadPhase::pairs(std::vector<std::pair<int, int>>& out) const {
  const OdeCalls calls;
  out.clear();
  dSpaceCollide(space_->space, &out, note);
  for (auto& [a, b] : out)
    if (a > b) std::swap(a, b);
}

}  // namespace carom::ode_bridge_detail
