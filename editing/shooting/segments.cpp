// SPDX-License-Identifier: MIT
#include "editing/shooting/segments.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adjoint/base/errors.h"
#include "editing/controls/control_families.h"
#include "editing/controls/natural_scales.h"
#include "editing/shooting/state_parts.h"

namespace carom {
namespace {

/// A segment may last so many times as long as the one of the motion that was cut.
constexpr double kLongestSegment = 10;

bool startsMotion(const ControlKind* kind) {
  return kind == &kPositionControl || kind == &kOrientationControl || kind == &kVelocityControl ||
         kind == &kAngularVelocityControl;
}

bool hasRegions(const EditProblem& problem) {
  const std::vector<Constraint>& constraints = problem.constraints.constraints();
  return std::any_of(constraints.begin(), constraints.end(), [](const Constraint& c) { return !c.regions.empty(); });
}

/// Builds the segments one after another.
class Cutter {
 public:
  Cutter(const EditProblem& problem, const EditPoint& point, const Cut& cut)
      : problem_(problem),
        motion_(point.motion),
        free_times_(point.rows.times),
        cut_(cut),
        parts_(stateParts(problem, point.motion)) {
    number();
  }
  Segments run(const EditPoint& point);

 private:
  int count() const { return static_cast<int>(cut_.nodes.size()) + 1; }
  const Node* nodeAt(int k) const {
    return k > 0 && k < count() ? &cut_.nodes[static_cast<std::size_t>(k - 1)] : nullptr;
  }
  double timeOf(int k) const { return k == 0 ? 0 : k < count() ? nodeAt(k)->time : motion_.duration; }
  Affine startOf(int k) const;
  int impactsBefore(int body, double time, int with = -1) const;
  bool falls(double time, int k) const { return time <= timeOf(k + 1) && (k == 0 || time > timeOf(k)); }

  void number();
  void build(int k);
  Scene sceneOf(int k) const;
  void addControls(int k);
  void addConstraints(int k);
  void addHeld(int k, int index);
  void addRegions(int k, int index, Constraint& constraint);
  void addEndState(int k);
  void addImpactTime(int k, int body, int event);
  void setTime(int k, Constraint& constraint, const Affine& time);
  void mapUnknowns(int k, Segment& segment) const;
  void mapRows(int k, Segment& segment) const;
  int rowOf(int constraint, int target, int region, int component) const;

  const EditProblem& problem_;
  const Motion& motion_;
  const Eigen::VectorXd& free_times_;
  const Cut& cut_;
  std::vector<StateParts> parts_;
  Segments out_;

  // Of the segment being built.
  Scene scene_;
  std::vector<Control> controls_;
  std::vector<int> control_of_;  // the edit's; -1: a state at the node
  std::vector<Constraint> constraints_;
  struct Origin {
    SegmentRow::Role role = SegmentRow::Role::held;
    int constraint = -1;       // held: the edit's
    std::vector<int> regions;  // held: the edit's
    int state = -1;            // end_state: its first unknown in the next segment
    Affine time;               // when it is read, s from the start of the segment
  };
  std::vector<Origin> origins_;
};

void Cutter::number() {
  ShootingVariables& v = out_.variables;
  v.size = v.edit = problem_.unknowns();
  const bool ride = !hasRegions(problem_);
  for (const Node& node : cut_.nodes) {
    v.node_time.push_back(ride ? v.size++ : -1);
    v.node_state.push_back(v.size);
    for (int body : node.bodies) v.size += parts_[static_cast<std::size_t>(body)].size();
    out_.node_time_scale.push_back(naturalScales(problem_.controls.startScene(), node.body_after).time);
  }
}

Affine Cutter::startOf(int k) const {
  Affine time;
  time.constant = timeOf(k);
  if (k == 0) return time;
  const auto node = static_cast<std::size_t>(k - 1);
  if (out_.variables.node_time[node] >= 0)
    time += Affine::variable(out_.variables.node_time[node], out_.node_time_scale[node]);
  return time;
}

int Cutter::impactsBefore(int body, double time, int with) const {
  int count = 0;
  for (int e : motion_.world_lines[static_cast<std::size_t>(body)].events) {
    const Event& event = motion_.events[static_cast<std::size_t>(e)];
    if (event.time <= time && (with < 0 || event.touches(body, with))) ++count;
  }
  return count;
}

Scene Cutter::sceneOf(int k) const {
  Scene scene = problem_.controls.writtenScene();
  for (std::size_t b = 0; k > 0 && b < scene.bodies.size(); ++b) {
    Body& body = scene.bodies[b];
    if (body.fixed) continue;
    const BodyState state = motion_.stateAt(static_cast<int>(b), timeOf(k));
    body.position = state.position, body.orientation = state.orientation.normalized();
    body.velocity = state.velocity, body.angular_velocity = state.angular_velocity;
  }
  std::vector<Tilt> tilts;
  for (Tilt tilt : scene.tilts) {
    tilt.impact -= impactsBefore(bodyIndex(scene, tilt.body), timeOf(k));
    if (k == 0 || tilt.impact > 0) tilts.push_back(std::move(tilt));
  }
  scene.tilts = std::move(tilts);
  return scene;
}

void Cutter::addControls(int k) {
  const std::vector<BoundControl>& edit = problem_.controls.controls();
  for (std::size_t c = 0; c < edit.size(); ++c) {
    Control control = edit[c].control;
    const int body = edit[c].owner.body;
    if (k > 0 && startsMotion(edit[c].kind) && !scene_.bodies[static_cast<std::size_t>(body)].fixed) continue;
    if (edit[c].kind->owner == OwnerKind::impact) {
      control.impact -= impactsBefore(body, timeOf(k));
      const int here = impactsBefore(body, timeOf(k + 1)) - impactsBefore(body, timeOf(k));
      if (control.impact < 1 || control.impact > here) continue;
    }
    controls_.push_back(std::move(control));
    control_of_.push_back(static_cast<int>(c));
  }
  const Node* node = nodeAt(k);
  if (!node) return;
  for (int body : node->bodies) {
    const std::string& name = scene_.bodies[static_cast<std::size_t>(body)].name;
    const StateParts& parts = parts_[static_cast<std::size_t>(body)];
    controls_.push_back(position(name));
    if (parts.orientation) controls_.push_back(orientation(name));
    controls_.push_back(velocity(name));
    if (parts.spin) controls_.push_back(angularVelocity(name));
  }
  control_of_.resize(controls_.size(), -1);
}

/// A constraint of the segment is read at a time, which may vary.
void Cutter::setTime(int k, Constraint& constraint, const Affine& time) {
  origins_.back().time = time - startOf(k);
  const Affine& local = origins_.back().time;
  constraint.at = local.isConstant() ? When(std::max(0.0, local.constant))
                                     : between(0, kLongestSegment * (timeOf(k + 1) - timeOf(k)) + local.constant);
}

void Cutter::addHeld(int k, int index) {
  Constraint constraint = problem_.constraints.constraints()[static_cast<std::size_t>(index)];
  const int body = bodyIndex(scene_, constraint.body);
  const std::vector<Region> regions = std::exchange(constraint.regions, {});
  origins_.push_back({});
  Origin& origin = origins_.back();
  origin.constraint = index;
  bool here = !constraint.targets.empty();
  When& at = constraint.at;
  if (here && at.impact > 0) {
    const int with = at.with.empty() ? -1 : bodyIndex(scene_, at.with);
    const std::optional<int> event = motion_.findImpact(body, at.impact, with);
    here = event && falls(motion_.events[static_cast<std::size_t>(*event)].time, k);
    at.impact -= impactsBefore(body, timeOf(k), with);
  } else if (here && at.span) {
    const std::vector<FreeTime>& all = problem_.constraints.freeTimes();
    const auto free = std::find_if(all.begin(), all.end(), [&](const FreeTime& f) { return f.constraint == index; });
    const int f = static_cast<int>(free - all.begin());
    here = falls(free_times_[f], k);
    Affine time = Affine::variable(problem_.controls.size() + f, free->scale);
    time.constant = free->from;
    if (here) setTime(k, constraint, time);
  } else if (here) {
    here = falls(at.time, k);
    if (here) setTime(k, constraint, Affine{at.time, {}});
  }
  if (!here) constraint.targets.clear(), at = When(0.0);
  constraint.regions = regions;
  addRegions(k, index, constraint);
  if (constraint.targets.empty() && constraint.regions.empty()) {
    origins_.pop_back();
  } else {
    constraints_.push_back(std::move(constraint));
  }
}

void Cutter::addRegions(int k, int, Constraint& constraint) {
  std::vector<Region> here;
  for (std::size_t r = 0; r < constraint.regions.size(); ++r) {
    Region region = constraint.regions[r];
    const auto [from, to] = region.during ? *region.during : std::pair(0.0, problem_.duration);
    const double first = std::max(from, timeOf(k)) - timeOf(k), last = std::min(to, timeOf(k + 1)) - timeOf(k);
    if (!(last > first)) continue;
    region.during = {first, last};
    here.push_back(std::move(region));
    origins_.back().regions.push_back(static_cast<int>(r));
  }
  constraint.regions = std::move(here);
}

void Cutter::addEndState(int k) {
  const Node* next = nodeAt(k + 1);
  if (!next) return;
  int state = out_.variables.node_state[static_cast<std::size_t>(k)];
  for (int b : next->bodies) {
    const StateParts& parts = parts_[static_cast<std::size_t>(b)];
    const BodyState at = motion_.stateAt(b, next->time);
    const auto target = [](const char* word, const Vec3& v) { return Target{word, {v.x(), v.y(), v.z()}}; };
    Constraint constraint{scene_.bodies[static_cast<std::size_t>(b)].name, When(0.0), {}};
    constraint.targets.push_back(target("position", at.position));
    const Quat q = at.orientation.normalized();
    if (parts.orientation) constraint.targets.push_back({"orientation", {q.w(), q.x(), q.y(), q.z()}});
    constraint.targets.push_back(target("velocity", at.velocity));
    if (parts.spin) constraint.targets.push_back(target("angular_velocity", at.angular_velocity));
    origins_.push_back({SegmentRow::Role::end_state, -1, {}, state, {}});
    setTime(k, constraint, startOf(k + 1));
    constraints_.push_back(std::move(constraint));
    state += parts.size();
  }
}

void Cutter::addImpactTime(int k, int body, int event) {
  const int n =
      impactsBefore(body, motion_.events[static_cast<std::size_t>(event)].time) - impactsBefore(body, timeOf(k));
  Constraint constraint{scene_.bodies[static_cast<std::size_t>(body)].name, nthImpact(n), {{"time", {0}}}};
  constraints_.push_back(std::move(constraint));
}

void Cutter::addConstraints(int k) {
  for (std::size_t i = 0; i < problem_.constraints.constraints().size(); ++i) addHeld(k, static_cast<int>(i));
  addEndState(k);
  const auto rides = [&](int node) { return node > 0 && node < count() && !startOf(node).isConstant(); };
  if (rides(k)) {
    origins_.push_back({SegmentRow::Role::first_impact, -1, {}, -1, {}});
    addImpactTime(k, nodeAt(k)->body_after, nodeAt(k)->after);
  }
  if (rides(k + 1)) {
    origins_.push_back({SegmentRow::Role::last_impact, -1, {}, -1, {}});
    addImpactTime(k, nodeAt(k + 1)->body_before, nodeAt(k + 1)->before);
  }
}

void Cutter::mapUnknowns(int k, Segment& segment) const {
  const ControlSet &here = segment.problem.controls, &edit = problem_.controls;
  int state = k > 0 ? out_.variables.node_state[static_cast<std::size_t>(k - 1)] : -1;
  for (const Variable& v : here.variables()) {
    const int control = control_of_[static_cast<std::size_t>(v.control)];
    if (control < 0) {
      segment.unknowns.push_back(Affine::variable(state++));
      continue;
    }
    const auto same = std::find_if(edit.variables().begin(), edit.variables().end(), [&](const Variable& other) {
      return other.control == control && other.slot == v.slot;
    });
    // The same change has to mean the same value.
    if (same == edit.variables().end() || same->start != v.start || same->scale != v.scale)
      throw InputError("found " + here.describeVariable(static_cast<int>(&v - here.variables().data())) +
                       " with another scale in a segment, expected that of the whole edit");
    segment.unknowns.push_back(Affine::variable(static_cast<int>(same - edit.variables().begin())));
  }
  for (const FreeTime& free : segment.problem.constraints.freeTimes())
    segment.unknowns.push_back(1 / free.scale * origins_[static_cast<std::size_t>(free.constraint)].time);
}

int Cutter::rowOf(int constraint, int target, int region, int component) const {
  const std::vector<Row>& rows = problem_.constraints.rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].constraint == constraint && rows[i].target == target && rows[i].region == region &&
        rows[i].component == component)
      return static_cast<int>(i);
  return -1;
}

void Cutter::mapRows(int k, Segment& segment) const {
  static_cast<void>(k);
  std::vector<int> states(origins_.size(), 0);
  for (const Row& row : segment.problem.constraints.rows()) {
    const Origin& origin = origins_[static_cast<std::size_t>(row.constraint)];
    SegmentRow of{origin.role, -1};
    if (origin.role == SegmentRow::Role::held) {
      const int region = row.region < 0 ? -1 : origin.regions[static_cast<std::size_t>(row.region)];
      of.index = rowOf(origin.constraint, row.target, region, row.component);
    } else if (origin.role == SegmentRow::Role::end_state) {
      of.index = origin.state + states[static_cast<std::size_t>(row.constraint)]++;
    }
    segment.rows.push_back(of);
  }
}

void Cutter::build(int k) {
  scene_ = sceneOf(k);
  controls_.clear(), control_of_.clear(), constraints_.clear(), origins_.clear();
  addControls(k);
  addConstraints(k);
  std::shared_ptr<ContactSource> contacts = problem_.contacts->another();
  ContactSource& source = contacts ? *contacts : *problem_.contacts;
  const double length = timeOf(k + 1) - timeOf(k);
  Segment segment(EditProblem(scene_, source, length, controls_, constraints_));
  segment.contacts = std::move(contacts);
  segment.start = startOf(k);
  if (nodeAt(k + 1)) segment.end = startOf(k + 1);
  segment.horizon = problem_.horizon;
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    segment.reads_impacts |= origins_[i].role == SegmentRow::Role::held && constraints_[i].at.impact > 0;
  mapUnknowns(k, segment);
  mapRows(k, segment);
  out_.segments.push_back(std::move(segment));
}

Segments Cutter::run(const EditPoint& point) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(out_.variables.size);
  x.head(problem_.unknowns()) = point.changes;
  const double end = problem_.constraints.extentIn(motion_, free_times_).time;
  double after = motion_.end;  // up to the middle of the flight after the last impact that counts
  for (const Event& event : motion_.events)
    if (event.time > end) after = std::min(after, event.time);
  const double last = std::min(motion_.end, end + 0.5 * (after - end));
  for (int k = 0; k < count(); ++k) {
    build(k);
    const double until = k + 1 < count() ? timeOf(k + 1) : last;
    if (out_.segments.back().follow(motion_, x, timeOf(k), until, cut_.bodies)) continue;
    out_.segments.clear();
    out_.why_not = "Started from the middle of a flight, the motion meets other impacts than before.";
    break;
  }
  return std::move(out_);
}

}  // namespace

Segments makeSegments(const EditProblem& problem, const EditPoint& point, const Cut& cut) {
  return Cutter(problem, point, cut).run(point);
}

}  // namespace carom
