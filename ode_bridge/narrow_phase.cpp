// SPDX-License-Identifier: MIT
#include "ode_bridge/narrow_phase.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "ode_bridge/library.hpp"

namespace carom::ode_bridge_detail {

struct NarrowPhase::Geoms {
  std::vector<dGeomID> geoms;  // boxes only: the other pairs have one candidate each

  ~Geoms() {
    const LockedOdeCalls calls;
    clear();
  }
  void clear() {
    for (dGeomID g : geoms)
      if (g) dGeomDestroy(g);
    geoms.clear();
  }
};

NarrowPhase::NarrowPhase() : geoms_(std::make_unique<Geoms>()) {}
NarrowPhase::~NarrowPhase() = default;

void NarrowPhase::reset(const std::vector<Solid>& solids) {
  bool same = geoms_->geoms.size() == solids.size();
  for (std::size_t i = 0; same && i < solids.size(); ++i) same = (geoms_->geoms[i] != nullptr) == solids[i].box;
  if (same) return;  // sizes are set at every call
  const LockedOdeCalls calls;
  geoms_->clear();
  for (const Solid& s : solids) geoms_->geoms.push_back(s.box ? dCreateBox(nullptr, 1, 1, 1) : nullptr);
}

namespace {

// In units of `unit`, 1/m.
void place(dGeomID geom, const Placed& p, double margin, double unit) {
  const Vec3 size = 2 * unit * (p.solid->half.array() + margin), x = unit * p.k.x;
  const Mat3& R = p.k.R;
  const dMatrix3 rotation = {R(0, 0), R(0, 1), R(0, 2), 0, R(1, 0), R(1, 1), R(1, 2), 0, R(2, 0), R(2, 1), R(2, 2), 0};
  dGeomBoxSetLengths(geom, size.x(), size.y(), size.z());
  dGeomSetPosition(geom, x.x(), x.y(), x.z());
  dGeomSetRotation(geom, rotation);
}

}  // namespace

std::optional<Vec3> NarrowPhase::candidateNormal(int a, int b, const Placed& placed_a, const Placed& placed_b,
                                                 double margin) const {
  const dGeomID ga = geoms_->geoms[static_cast<std::size_t>(a)], gb = geoms_->geoms[static_cast<std::size_t>(b)];
  if (!ga || !gb) return std::nullopt;
  const OdeCalls calls;
  // the library has lengths of its own that it takes for none: of a power of two the boxes are of about 1
  const double unit = std::ldexp(1, -std::ilogb(std::max(placed_a.solid->bound(), placed_b.solid->bound())));
  place(ga, placed_a, margin, unit);
  place(gb, placed_b, margin, unit);
  dContactGeom contact;
  if (dCollide(ga, gb, 1, &contact, sizeof contact) < 1) return std::nullopt;
  const Vec3 n(contact.normal[0], contact.normal[1], contact.normal[2]);
  if (!(std::abs(n.norm() - 1) < 1e-6)) return std::nullopt;
  return n.normalized();
}

}  // namespace carom::ode_bridge_detail
