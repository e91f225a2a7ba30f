#include "adjoint/simulate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "adjoint/errors.h"
#include "adjoint/impact/impact.h"
#include "adjoint/impact/tilt.h"
#include "adjoint/simulator.h"

namespace carom {

Motion simulate(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options) {
  if (!(duration >= 0 && duration <= 1e9))
    throw InputError("found a duration of " + std::to_string(duration) + " s, expected a finite number >= 0");
  validate(scene);
  return Simulator(scene, contacts, duration, options).run();
}

Motion Simulator::run() {
  start();
  for (Prediction next; takeNext(next);) {
    if (motion_.events.size() >= impact_limit_) {
      finish(MotionStatus::impact_limit, next.time,
             "stopped after " + std::to_string(impact_limit_) + " impacts, the limit that was set");
      return std::move(motion_);
    }
    Draft draft = resolve(next);
    if (!separates(draft)) return std::move(motion_);
    const bool last = accumulates(draft);
    commit(std::move(draft));
    if (last) return std::move(motion_);
  }
  finish(MotionStatus::complete, motion_.duration, "complete");
  return std::move(motion_);
}

Simulator::Simulator(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options)
    : scene_(scene), contacts_(contacts), impact_limit_(options.impact_limit) {
  const std::size_t n = scene.bodies.size();
  motion_.scene = std::make_shared<const Scene>(scene);
  auto models = std::make_shared<std::vector<BodyModel>>();
  for (const Body& body : scene.bodies) {
    models->push_back(modelOf(body));
    material_.push_back(&materialOf(scene, body));
  }
  motion_.models = std::move(models);
  motion_.plan = makePlan(scene, options.asked);
  motion_.duration = duration;
  motion_.world_lines.resize(n);
  version_.assign(n, 0);
  impacts_.assign(n, 0);
}

void Simulator::start() {
  contacts_.begin(scene_);
  motion_.geometry = contacts_.geometry();
  const int n = static_cast<int>(scene_.bodies.size());
  for (int b = 0; b < n; ++b) {
    const auto i = static_cast<std::size_t>(b);
    const BodyModel& model = (*motion_.models)[i];
    motion_.world_lines[i].arcs.emplace_back(model, motion_.plan.bodies[i].tier, scene_.gravity, 0.0,
                                             startState(scene_.bodies[i], model));
    contacts_.setPath(b, arcOf(b), 0, motion_.duration);
  }
  for (int b = 0; b < n; ++b)
    if (arcOf(b).moving()) predictBody(b, 0);
}

// The earliest prediction whose arcs still are what they were.
bool Simulator::takeNext(Prediction& next) {
  while (!queue_.empty()) {
    next = queue_.top();
    queue_.pop();
    if (!holds(next)) continue;
    if (!next.isHorizon()) return true;
    predictBody(next.a, next.time);
  }
  return false;
}

bool Simulator::holds(const Prediction& p) const {
  return version_[static_cast<std::size_t>(p.a)] == p.version_a &&
         (p.isHorizon() || version_[static_cast<std::size_t>(p.b)] == p.version_b);
}

// Contacts of one instant are solved together: those predicted for it, all features that touch in it, and those that
// the solved impact itself brings about within it, on contacts that were not separating before; then it is solved
// again.
Simulator::Draft Simulator::resolve(const Prediction& first) {
  std::vector<Contact> contacts = contactsOfInstant(first);
  for (;;) {
    Draft result = draft(first.time, contacts);
    predict(result);
    if (!joinInstant(result, contacts)) return result;
  }
}

// Takes the predictions out of the queue that share the instant and, directly or through others, a moving body.
std::vector<Contact> Simulator::contactsOfInstant(const Prediction& first) {
  std::vector<Prediction> same, kept;
  while (!queue_.empty() && queue_.top().time <= first.time + kInstant) {
    if (holds(queue_.top())) (queue_.top().isHorizon() ? kept : same).push_back(queue_.top());
    queue_.pop();
  }
  std::vector<int> bodies{first.a, first.b};
  std::vector<Contact> contacts;
  addTouching(first.time, first.a, first.b, first.features, contacts);
  const auto shares = [&](const Prediction& p) {
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](int b) { return (b == p.a || b == p.b) && arcOf(b).moving(); });
  };
  for (auto next = std::find_if(same.begin(), same.end(), shares); next != same.end();
       next = std::find_if(same.begin(), same.end(), shares)) {
    addTouching(first.time, next->a, next->b, next->features, contacts);
    bodies.insert(bodies.end(), {next->a, next->b});
    same.erase(next);
  }
  for (const Prediction& p : same) queue_.push(p);
  for (const Prediction& p : kept) queue_.push(p);
  return contacts;
}

// The contact at the given features, and whatever else of the pair touches within the instant and was not separating.
void Simulator::addTouching(double time, int a, int b, const FeaturePair& features, std::vector<Contact>& contacts) {
  const auto known = [&](const FeaturePair& f) {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const Contact& c) { return c.a == a && c.b == b && c.features == f; });
  };
  if (known(features)) return;
  const Contact first = makeContact(time, a, b, features);
  contacts.push_back(first);
  const double reach = kInstant * std::abs(first.approach);
  for (const FeaturePair& f : contacts_.touching(a, b, arcOf(a), arcOf(b), time, reach)) {
    if (known(f)) continue;
    const Contact c = makeContact(time, a, b, f);
    if (c.approach <= kLowestBounce) contacts.push_back(c);
  }
}

Contact Simulator::makeContact(double time, int a, int b, const FeaturePair& features) {
  const Kinematics ka = arcOf(a).kinematicsAt(time), kb = arcOf(b).kinematicsAt(time);
  Contact c;
  c.a = a;
  c.b = b;
  c.features = features;
  c.at = motion_.geometry->contact(a, b, features, {ka.x, ka.R}, {kb.x, kb.R});
  c.pair = combine(*material_[static_cast<std::size_t>(a)], *material_[static_cast<std::size_t>(b)]);
  const auto tilt = [&](int body) {
    return arcOf(body).moving() ? tiltOf(body, impacts_[static_cast<std::size_t>(body)] + 1) : -1;
  };
  c.tilt_a = tilt(a);
  c.tilt_b = tilt(b);
  const auto value = [&](int t) { return t < 0 ? Vec2(0, 0) : scene_.tilts[static_cast<std::size_t>(t)].value; };
  c.impulse_normal =
      c.tilt_a < 0 && c.tilt_b < 0 ? c.at.normal : tiltedNormal(c.at.normal, value(c.tilt_a), value(c.tilt_b));
  c.approach = c.at.normal.dot(ka.v + ka.w.cross(c.at.point - ka.x) - kb.v - kb.w.cross(c.at.point - kb.x));
  return c;
}

int Simulator::tiltOf(int body, int impact) const {
  for (std::size_t i = 0; i < scene_.tilts.size(); ++i)
    if (scene_.tilts[i].impact == impact && scene_.bodies[static_cast<std::size_t>(body)].name == scene_.tilts[i].body)
      return static_cast<int>(i);
  return -1;
}

Simulator::Draft Simulator::draft(double time, const std::vector<Contact>& contacts) {
  Draft d;
  d.event.time = time;
  d.event.contacts = contacts;
  std::vector<int> bodies;
  for (const Contact& c : contacts)
    for (int body : {c.a, c.b})
      if (arcOf(body).moving()) bodies.push_back(body);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (int body : bodies) {
    const auto& arcs = motion_.world_lines[static_cast<std::size_t>(body)].arcs;
    d.event.participants.push_back({body, static_cast<int>(arcs.size()) - 1,
                                    impacts_[static_cast<std::size_t>(body)] + 1, arcs.back().stateAt(time)});
  }
  const std::vector<State> after = solveImpact(d.event, *motion_.models);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto b = static_cast<std::size_t>(bodies[i]);
    d.arcs.emplace_back((*motion_.models)[b], motion_.plan.bodies[b].tier, scene_.gravity, time, after[i]);
  }
  return d;
}

// First impacts of one body with whoever may be near, each searched no further than the earliest one found: nothing of
// the body's arc beyond that will happen, unless the other body is struck before. For that case the time is put down as
// a horizon, from which the search goes on when it is reached with the arc still in force.
template <class ArcOf, class VersionOf>
void Simulator::searchBody(int body, double from, const ArcOf& arc_of, const VersionOf& version_of,
                           std::vector<Prediction>& found) {
  double until = motion_.duration;
  contacts_.neighbours(body, neighbours_);
  for (int other : neighbours_) {
    const int a = std::min(body, other), b = std::max(body, other);
    const auto impact = contacts_.firstImpact(a, b, arc_of(a), arc_of(b), from, until);
    if (!impact) continue;
    until = std::min(std::max(impact->time, from) + kInstant, motion_.duration);
    found.push_back({impact->time, a, b, impact->features, version_of(a), version_of(b)});
  }
  if (until < motion_.duration) found.push_back({until, body, -1, {}, version_of(body), 0});
}

void Simulator::predictBody(int body, double from) {
  std::vector<Prediction> found;
  searchBody(
      body, from, [&](int b) -> Arc& { return arcOf(b); }, [&](int b) { return version_[static_cast<std::size_t>(b)]; },
      found);
  for (const Prediction& p : found) queue_.push(p);
}

// The same for the participants of a draft, on their arcs after the event.
void Simulator::predict(Draft& d) {
  const auto draftArc = [&](int body) -> Arc* {
    const Participant* p = d.event.find(body);
    return p ? &d.arcs[static_cast<std::size_t>(p - d.event.participants.data())] : nullptr;
  };
  for (std::size_t i = 0; i < d.arcs.size(); ++i)
    contacts_.setPath(d.event.participants[i].body, d.arcs[i], d.event.time, motion_.duration);
  for (const Participant& p : d.event.participants)
    searchBody(
        p.body, d.event.time,
        [&](int b) -> Arc& {
          Arc* arc = draftArc(b);
          return arc ? *arc : arcOf(b);
        },
        [&](int b) { return version_[static_cast<std::size_t>(b)] + (draftArc(b) ? 1 : 0); }, d.predictions);
}

bool Simulator::joinInstant(const Draft& d, std::vector<Contact>& contacts) {
  const Prediction* soonest = nullptr;
  for (const Prediction& p : d.predictions)
    if (!p.isHorizon() && p.time <= d.event.time + kInstant && (!soonest || *soonest > p)) {
      const bool known = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return c.a == p.a && c.b == p.b && c.features == p.features;
      });
      if (known) continue;
      // a contact that was separating before is an impact of its own, after this one
      if (makeContact(d.event.time, p.a, p.b, p.features).approach > kLowestBounce) continue;
      soonest = &p;
    }
  if (!soonest) return false;
  addTouching(d.event.time, soonest->a, soonest->b, soonest->features, contacts);
  return true;
}

void Simulator::commit(Draft&& d) {
  const int index = static_cast<int>(motion_.events.size());
  for (std::size_t i = 0; i < d.arcs.size(); ++i) {
    const auto b = static_cast<std::size_t>(d.event.participants[i].body);
    motion_.world_lines[b].arcs.push_back(std::move(d.arcs[i]));
    motion_.world_lines[b].events.push_back(index);
    ++version_[b];
    ++impacts_[b];
  }
  for (const Prediction& p : d.predictions) queue_.push(p);
  motion_.events.push_back(std::move(d.event));
}

void Simulator::finish(MotionStatus status, double end, std::string message) {
  motion_.status = status;
  motion_.end = end;
  motion_.message = std::move(message);
  for (WorldLine& line : motion_.world_lines) line.arcs.back().extendTo(end);
}

}  // namespace carom
