// SPDX-License-Identifier: MIT
#include "studio/sketch.h"

#include <algorithm>
#include <set>

#include "adjoint/base/errors.h"
#include "editing/session.h"
#include "studio/throw_of.h"

namespace carom::studio {
namespace {

/// Places of a curve that are held.
constexpr int kPlaces = 10;
/// Of the time along the curve: how far from its own time a place may be met, either way.
constexpr double kTimeRange = 0.25;
/// Samples of the path by which its length is measured.
constexpr int kPathSamples = 400;
/// Of an error as large as the body beside a change of a control by its natural scale.
constexpr double kWeight = 10;
/// Simulations of the first answer.
constexpr int kFirstSimulations = 3;

/// A line through places, by its length.
class Polyline {
 public:
  void add(const Vec3& place) {
    along_.push_back(places_.empty() ? 0 : along_.back() + (place - places_.back()).norm());
    places_.push_back(place);
  }
  double length() const { return along_.back(); }
  /// Where a length is: an index, which has a fraction.
  double indexAt(double length) const {
    const auto after = std::ranges::upper_bound(along_, length);
    if (after == along_.begin()) return 0;
    if (after == along_.end()) return static_cast<double>(along_.size() - 1);
    const double before = *std::prev(after);
    return static_cast<double>(after - along_.begin() - 1) + (length - before) / (*after - before);
  }
  Vec3 at(double length) const {
    const double index = indexAt(length);
    const auto k = std::min(static_cast<std::size_t>(index), places_.size() - 1), next = std::min(k + 1, places_.size() - 1);
    return places_[k] + (index - static_cast<double>(k)) * (places_[next] - places_[k]);
  }

 private:
  std::vector<Vec3> places_;
  std::vector<double> along_;
};

/// Where the centre of mass of a body is from a time on.
Polyline centrePath(const Motion& motion, int body, double from) {
  Polyline path;
  const Vec3 center = (*motion.models)[static_cast<std::size_t>(body)].center;
  for (int k = 0; k <= kPathSamples; ++k) {
    const BodyState state = motion.stateAt(body, std::min(motion.end, from + (motion.end - from) * k / kPathSamples));
    path.add(state.position + state.orientation * center);
  }
  return path;
}

/// The enforced nails that the motion can evaluate.
std::vector<Constraint> enforced(const SessionSnapshot& snapshot) {
  std::vector<Constraint> held;
  for (const auto& [id, constraint] : snapshot.content.nails)
    if (std::ranges::find(snapshot.nails, id) != snapshot.nails.end()) held.push_back(constraint);
  return held;
}

/// The controls, and the throw of the body where none of them moves it then.
std::vector<Control> controlsFor(EditSession& session, const Sketch& sketch) {
  std::vector<Control> controls = session.controls();
  session.grab(sketch.body, sketch.from, {}, throwOf(sketch.body), AlsoVary::where_nothing_moves_it);
  const bool freed = session.controls().size() > controls.size();
  session.cancel();
  if (freed) std::ranges::copy(throwOf(sketch.body), std::back_inserter(controls));
  return controls;
}

}  // namespace

std::vector<Constraint> sketchedNails(const Motion& motion, const Sketch& sketch, const std::string& notes) {
  const int body = bodyIndex(*motion.scene, sketch.body);
  if (!(sketch.from < motion.end)) throw InputError("/from", "found a time behind the end of the motion, expected one before it");
  Polyline curve;
  for (const Vec3& place : sketch.places) curve.add(place);
  if (!(curve.length() > 0)) throw InputError("/places", "found a curve of no length, expected a longer one");
  const Polyline path = centrePath(motion, body, sketch.from);
  if (!(path.length() > 0)) throw InputError("/body", "'" + sketch.body + "' does not move from there on");
  const double left = motion.end - sketch.from, reach = std::min(curve.length(), path.length());
  const auto timeAt = [&](double share) { return sketch.from + left * path.indexAt(share * reach) / kPathSamples; };
  const double range = kTimeRange * (timeAt(1) - sketch.from);
  std::vector<Constraint> nails;
  for (int k = 0; k < kPlaces; ++k) {
    const double share = static_cast<double>(k) / (kPlaces - 1), time = timeAt(share);
    Target target = targetOf("point", WantedVector(curve.at(share * curve.length())));
    target.body_point = (*motion.models)[static_cast<std::size_t>(body)].center;
    Constraint nail{sketch.body, between(std::max(sketch.from, time - range), std::min(motion.end, time + range)), {target}};
    nail.notes = notes;
    nail.soft = kWeight;
    nails.push_back(std::move(nail));
  }
  return nails;
}

std::string sketchNotes(const std::vector<std::pair<NailId, Constraint>>& nails) {
  std::set<std::string> taken;
  for (const auto& [id, nail] : nails) taken.insert(nail.notes);
  int n = 1;
  while (taken.contains("sketch " + std::to_string(n))) ++n;
  return "sketch " + std::to_string(n);
}

SessionContent fitSketch(const SessionSnapshot& snapshot, ContactSource& contacts, const Sketch& sketch,
                         const std::function<void(const std::shared_ptr<const Motion>&)>& first, const std::stop_token& stop) {
  const SessionContent& now = snapshot.content;
  SessionOptions options;
  options.sequence = snapshot.sequence;
  options.tolerance = snapshot.tolerance;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  SessionOptions quick = options;
  quick.drag_simulations = kFirstSimulations;
  quick.release_iterations = 0;
  EditSession begun(now.scene, contacts, now.duration, now.controls, enforced(snapshot), quick);
  const std::vector<Constraint> drawn = sketchedNails(begun.motion(), sketch, sketchNotes(now.nails));
  const std::vector<Control> controls = controlsFor(begun, sketch);
  SessionContent content = begun.content();
  content.controls = controls;
  for (const Constraint& nail : drawn) content.nails.emplace_back(NailId(), nail);
  begun.setContent(content, "sketch");
  const SessionUpdate near = begun.meetNails(stop);
  if (!stop.stop_requested()) first(near.motion);
  std::vector<Constraint> all = enforced(snapshot);
  all.insert(all.end(), drawn.begin(), drawn.end());
  EditSession fitted(near.scene(), contacts, now.duration, controls, all, options);
  fitted.meetNails(stop);
  content.scene = fitted.scene();
  content.nails = now.nails;
  for (const Constraint& nail : drawn) content.nails.emplace_back(NailId(), nail);
  return content;
}

}  // namespace carom::studio
