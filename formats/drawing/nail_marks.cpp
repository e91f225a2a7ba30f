// SPDX-License-Identifier: MIT
#include "formats/drawing/nail_marks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "editing/problem/rows/contact_place.hpp"
#include "editing/problem/rows/instants.hpp"
#include "editing/problem/rows/refined_times.hpp"
#include "formats/base/short_text.hpp"

namespace carom::formats_detail {

using namespace editing_detail;

namespace {

/// Nothing when that moment does not come.
std::optional<Instant> momentOf(const Constraint& constraint, const Motion& motion, int body) {
  const When& at = constraint.at;
  if (!at.span) return findInstant(motion, body, at);
  Constraint alone = constraint;
  alone.regions.clear();
  const double time = refinedTimes(ConstraintSet(*motion.scene, {alone}, motion.duration), motion)[0];
  return time <= motion.end ? std::optional(Instant::at(time)) : std::nullopt;
}

Vec3 placeOfContact(const Constraint& constraint, const Motion& motion, int body, const Instant& moment) {
  const std::string& with = constraint.at.with;
  return contactPlace(motion, moment.event, body, with.empty() ? -1 : bodyIndex(*motion.scene, with));
}

std::string nailLabel(const Constraint& constraint, const std::optional<Instant>& moment) {
  const When& at = constraint.at;
  std::string text = constraint.body + " at ";
  if (at.impact > 0) {
    text += "impact " + std::to_string(at.impact) + (at.with.empty() ? "" : " with " + at.with);
  } else if (at.rest) {
    text += "rest";
  } else {
    text += shortNumber(moment ? moment->time : at.time) + " s";
  }
  if (at.span) text += " (" + shortNumber(at.span->first) + " to " + shortNumber(at.span->second) + " s)";
  if (!constraint.relative_to.empty()) text += ", relative to " + constraint.relative_to;
  return text;
}

double limitOf(const std::vector<TargetNumber>& limits, std::size_t i, double none) {
  return limits.empty() || std::isnan(limits[i]) ? none : double{limits[i]};
}

/// What the targets of a nail are seen from, and the body in it; nothing when the nail's moment does not come.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Quat axes = Quat::Identity();
  std::optional<Vec3> seen;  ///< where the body, or the point, is in it
};

/// Between the ends that are there, as near as it can be to where the motion is.
double nearestIn(double low, double high, const std::optional<double>& seen) {
  if (seen) return std::clamp(*seen, low, high);
  return std::isinf(low) ? high : std::isinf(high) ? low : 0.5 * (low + high);
}

void readPlace(const Target& target, const Frame& frame, bool is_relative, NailMark& nail) {
  AllowedBox box;
  box.origin = frame.origin, box.axes = frame.axes;
  Vec3 place;
  bool has_range = false, has_free = false;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double value = target.value[k];
    const bool held = std::isfinite(value);
    box.low[i] = held ? value : limitOf(target.min, k, -kInfinity);
    box.high[i] = held ? value : limitOf(target.max, k, kInfinity);
    const bool is_free = std::isinf(box.low[i]) && std::isinf(box.high[i]);
    const auto seen = frame.seen ? std::optional<double>((*frame.seen)[i]) : std::nullopt;
    place[i] = held ? value : !is_free ? nearestIn(box.low[i], box.high[i], seen) : is_relative && seen ? *seen : NAN;
    has_free = has_free || is_free;
    has_range = has_range || (!held && !is_free);
  }
  nail.nails_position = true;
  nail.target = is_relative ? Vec3(frame.origin + frame.axes * place) : place;
  Vec3 shown = nail.target;
  for (int i = 0; i < 3 && frame.seen; ++i)
    if (!std::isfinite(shown[i])) shown[i] = (frame.origin + frame.axes * *frame.seen)[i];
  if (shown.allFinite()) nail.place = shown;
  if (has_range || (is_relative && has_free)) nail.allowed = box;
}

void readPose(const Target& target, const Frame& frame, NailMark& nail) {
  if (target.value.size() != 4) return;
  const Quat q(target.value[0], target.value[1], target.value[2], target.value[3]);
  if (q.coeffs().allFinite() && q.norm() > 0) nail.orientation = frame.axes * q.normalized();
}

std::optional<NailMark> nailOf(const Constraint& constraint, const Motion& motion) {
  NailMark nail;
  nail.body = bodyIndex(*motion.scene, constraint.body);
  const std::optional<Instant> moment = momentOf(constraint, motion, nail.body);
  const bool is_relative = !constraint.relative_to.empty();
  if (is_relative && !moment) return std::nullopt;
  nail.label = nailLabel(constraint, moment);
  std::optional<BodyState> state;
  if (moment) state = stateAt(motion, nail.body, *moment);
  Frame frame;
  if (is_relative) {
    const BodyState other = stateAt(motion, bodyIndex(*motion.scene, constraint.relative_to), *moment);
    frame.origin = other.position, frame.axes = other.orientation;
  }
  bool on_origin = true;
  for (const Target& target : constraint.targets) {
    if (target.quantity == "orientation") readPose(target, frame, nail);
    const bool contact = target.quantity == "contact";
    if ((target.quantity != "position" && target.quantity != "point" && !contact) || target.value.size() != 3) continue;
    if (target.quantity != "position") on_origin = false;
    if (state) {
      const Vec3 place = contact ? placeOfContact(constraint, motion, nail.body, *moment)
                                 : Vec3(state->position + state->orientation * target.body_point);  // its own for a position
      frame.seen = frame.axes.conjugate() * (place - frame.origin);
    }
    readPlace(target, frame, is_relative, nail);
  }
  if (!nail.nails_position && !state) return std::nullopt;
  if (!nail.nails_position) nail.target = state->position;
  Vec3 origin = on_origin ? nail.target : Vec3::Constant(NAN);
  if (state)
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(origin[i])) origin[i] = state->position[i];
  if (origin.allFinite()) nail.pose_origin = origin;
  return nail;
}

}  // namespace

std::vector<NailMark> nailsOf(const Document& document, const Motion& motion) {
  std::vector<NailMark> nails;
  for (const Constraint& constraint : document.constraints) {
    if (constraint.targets.empty()) continue;
    if (std::optional<NailMark> nail = nailOf(constraint, motion)) nails.push_back(*std::move(nail));
  }
  return nails;
}

std::vector<RegionMark> regionsOf(const Document& document) {
  std::vector<RegionMark> marks;
  for (const Constraint& constraint : document.constraints)
    for (const Region& region : constraint.regions) {
      std::string label = constraint.body + (region.side == Region::Side::avoid ? " stays out" : " stays in");
      if (region.during)
        label += ", " + shortNumber(region.during->first) + " to " + shortNumber(region.during->second) + " s";
      const Shape shape = std::visit([](const auto& part) { return Shape(part); }, region.shape);
      marks.push_back({region.side, shape, region.position, region.orientation.normalized(), label});
    }
  return marks;
}

}  // namespace carom::formats_detail
