#include "editing/edit.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "adjoint/errors.h"
#include "adjoint/simulate.h"
#include "editing/edit_result.h"
#include "editing/edit_solution.h"

namespace carom {

Edit::Edit(const Scene& scene, ContactSource& contacts, double duration)
    : scene_(scene), contacts_(contacts), duration_(duration) {}

Edit::Edit(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
           std::vector<Constraint> constraints)
    : Edit(scene, contacts, duration) {
  controls_ = std::move(controls);
  for (Constraint& constraint : constraints) nails_.push_back({next_id_++, std::move(constraint)});
}

Nail Edit::nail(const std::string& body, When at) {
  nails_.push_back({next_id_, Constraint{body, std::move(at), {}}});
  return Nail(this, next_id_++);
}

void Edit::unnail(const Nail& nail) {
  std::erase_if(nails_, [&](const Nailed& nailed) { return nailed.id == nail.id_; });
}

std::vector<Constraint> Edit::constraints() const {
  std::vector<Constraint> constraints;
  for (const Nailed& nailed : nails_) constraints.push_back(nailed.constraint);
  return constraints;
}

EditProblem Edit::problem() const { return EditProblem(scene_, contacts_, duration_, controls_, constraints()); }

EditResult Edit::solve(const EditOptions& options) const {
  const auto began = std::chrono::steady_clock::now();
  const EditProblem problem = this->problem();
  EditSearch search(problem, options);
  const EditSolution solution = findSolution(search);
  EditResult result = verify(scene_, search, solution);
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  return result;
}

Nail& Nail::set(Target target) {
  for (Edit::Nailed& nailed : edit_->nails_) {
    if (nailed.id != id_) continue;
    std::vector<Target>& targets = nailed.constraint.targets;
    const auto same = std::find_if(targets.begin(), targets.end(), [&](const Target& other) {
      return other.quantity == target.quantity && other.body_point == target.body_point;
    });
    if (same != targets.end()) {
      *same = std::move(target);
    } else {
      targets.push_back(std::move(target));
    }
    return *this;
  }
  throw InputError("this nail was removed");
}

Nail& Nail::position(const Vec3& p) { return set({"position", {p.x(), p.y(), p.z()}}); }
Nail& Nail::orientation(const Quat& q) { return set({"orientation", {q.w(), q.x(), q.y(), q.z()}}); }
Nail& Nail::velocity(const Vec3& v) { return set({"velocity", {v.x(), v.y(), v.z()}}); }
Nail& Nail::angularVelocity(const Vec3& w) { return set({"angular_velocity", {w.x(), w.y(), w.z()}}); }
Nail& Nail::time(double t) { return set({"time", {t}}); }
Nail& Nail::point(const Vec3& body_point, const Vec3& world) {
  return set({"point", {world.x(), world.y(), world.z()}, body_point});
}

const char* nameOf(EditStatus status) {
  constexpr const char* kNames[] = {
      "solved", "solved_sequence_changed", "infeasible", "not_converged", "out_of_time", "cancelled", "bad_start"};
  return kNames[static_cast<int>(status)];
}

}  // namespace carom
