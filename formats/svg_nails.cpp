#include "formats/detail/svg_nails.hpp"

#include <cmath>

#include "formats/detail/svg_canvas.hpp"

namespace carom {
namespace {

// Of the body when the nail holds; nothing when that moment does not come.
std::optional<BodyState> stateAt(const Motion& motion, int body, const When& when) {
  if (when.impact == 0) {
    if (!(when.time >= 0 && when.time <= motion.end)) return std::nullopt;
    return motion.stateAt(body, when.time);
  }
  const int with = when.with.empty() ? -1 : bodyIndex(*motion.scene, when.with);
  const std::optional<int> event = motion.findImpact(body, when.impact, with);
  if (!event) return std::nullopt;
  return motion.stateBefore(*event, body);
}

std::string labelOf(const Constraint& constraint) {
  const When& at = constraint.at;
  if (at.impact == 0) return constraint.body + " at " + shortNumber(at.time) + " s";
  return constraint.body + " at impact " + std::to_string(at.impact) + (at.with.empty() ? "" : " with " + at.with);
}

bool isFinite(const std::vector<double>& values) {
  for (const double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

void read(const Target& target, Nail& nail) {
  if ((target.quantity == "position" || target.quantity == "point") && target.value.size() == 3) {
    nail.target = Vec3(target.value[0], target.value[1], target.value[2]);
    nail.nails_position = true;
  }
  if (target.quantity == "orientation" && target.value.size() == 4 && isFinite(target.value)) {
    const Quat q(target.value[0], target.value[1], target.value[2], target.value[3]);
    if (q.norm() > 0) nail.orientation = q.normalized();
  }
}

}  // namespace

std::vector<Nail> nailsOf(const Document& document, const Motion& motion) {
  std::vector<Nail> nails;
  for (const Constraint& constraint : document.constraints) {
    Nail nail;
    nail.body = bodyIndex(*motion.scene, constraint.body);
    nail.label = labelOf(constraint);
    bool on_origin = true;
    for (const Target& target : constraint.targets) {
      read(target, nail);
      on_origin = on_origin && target.quantity != "point";
    }
    const std::optional<BodyState> state = stateAt(motion, nail.body, constraint.at);
    if (!nail.nails_position && !state) continue;
    if (!nail.nails_position) nail.target = state->position;
    Vec3 origin = on_origin ? nail.target : Vec3::Constant(NAN);
    if (state)
      for (int i = 0; i < 3; ++i)
        if (!std::isfinite(origin[i])) origin[i] = state->position[i];
    if (origin.allFinite()) nail.pose_origin = origin;
    nails.push_back(std::move(nail));
  }
  return nails;
}

}  // namespace carom
