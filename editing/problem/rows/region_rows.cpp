// SPDX-License-Identifier: MIT
#include "editing/problem/rows/region_rows.hpp"

#include <algorithm>
#include <limits>

#include "adjoint/derivative/tangent.h"
#include "editing/problem/rows/region_way.hpp"

namespace carom::editing_detail {

int rowsOf(const Region& region) {
  return region.side == Region::Side::inside && std::holds_alternative<Box>(region.shape) ? 6 : 1;
}

std::string rowName(const Region& region, int component) {
  if (region.side == Region::Side::avoid) return "avoid";
  if (rowsOf(region) == 1) return "inside";
  return std::string("inside.") + (component % 2 == 0 ? '+' : '-') + "xyz"[component / 2];
}

std::optional<Clearance> leastClearance(const Motion& motion, int body, const BoundRegion& bound, int component) {
  if (!(motion.end >= bound.to)) return std::nullopt;
  const WorldLine& line = motion.world_lines[static_cast<std::size_t>(body)];
  const Mat3 R = bound.region.orientation.normalized().toRotationMatrix();
  Clearance clearance;
  clearance.value = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < line.arcs.size(); ++k) {
    const bool last = k + 1 == line.arcs.size();
    const double end = last ? motion.end : line.arcs[k + 1].start();
    if (end < bound.from || line.arcs[k].start() > bound.to) continue;
    const double from = std::max(bound.from, line.arcs[k].start()), to = std::min(bound.to, end);
    const PlaceOnWay candidate = leastOnArc(line.arcs[k], bound, component, from, to);
    if (!(candidate.value < clearance.value)) continue;
    // the start of a later arc is the end of the one before
    if (candidate.first && from > bound.from && clearance.value < std::numeric_limits<double>::infinity()) continue;
    clearance.value = candidate.value;
    clearance.time = candidate.time;
    clearance.seed = {};
    clearance.seed.body = body;
    clearance.seed.center_of_mass = R * candidate.gradient;
    // at an impact the place is read at a time that moves with the causes
    const bool at_event = !last && candidate.last && to == end && end < bound.to;
    const bool inside = !candidate.first && !candidate.last;
    clearance.between = R * candidate.between;
    clearance.keeps = !clearance.between.isZero(0) ? Clearance::Keeps::two_faces
                      : inside                     ? Clearance::Keeps::least
                                                   : Clearance::Keeps::place;
    const Vec3 n = R * candidate.gradient.normalized();
    clearance.bend = candidate.bend * (Mat3::Identity() - n * n.transpose());
    clearance.seed.at = at_event ? Instant::before(line.events[k]) : Instant::at(clearance.time);
  }
  return clearance;
}

Eigen::VectorXd clearanceTimeRate(const Clearance& c, DerivativeTape& tape,
                                  std::span<const ReadingDirection> controls) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(controls.size()));
  if (c.keeps == Clearance::Keeps::place) return {};
  const Motion& motion = tape.motion();
  const int k = motion.arcAt(c.seed.body, c.time);
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(c.seed.body)].arcs[static_cast<std::size_t>(k)];
  const Vec3 v = arc.velocityAt(c.time), n = c.seed.center_of_mass;
  const double bend = n.dot(accelerationAt(arc, c.time)) + v.dot(c.bend * v);  // of the clearance by the time
  for (std::size_t j = 0; j < controls.size(); ++j) {
    const BodyStateRate d = tangent(tape, controls[j].scene).at(c.seed.body, Instant::at(c.time));
    const auto at = static_cast<Eigen::Index>(j);
    if (c.keeps == Clearance::Keeps::two_faces) {
      r[at] = -c.between.dot(d.center_of_mass) / c.between.dot(v);
    } else {
      r[at] = -(n.dot(d.velocity) + v.dot(c.bend * d.center_of_mass)) / bend;
    }
  }
  return r;
}

}  // namespace carom::editing_detail
