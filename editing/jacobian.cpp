#include "editing/jacobian.h"

#include <cmath>
#include <limits>

#include "adjoint/adjoint.h"
#include "adjoint/errors.h"
#include "adjoint/tangent.h"
#include "editing/control_families.h"
#include "editing/text.h"

namespace carom {
namespace {

double checkedDuration(double duration) {
  if (!(duration > 0) || !std::isfinite(duration)) {
    throw InputError("/duration", "found " + number(duration) + ", expected a time greater than 0 s");
  }
  return duration;
}

const Scene& checkedScene(const Scene& scene) {
  validate(scene);
  return scene;
}

std::vector<Asked> askedOf(const ControlSet& controls, const ConstraintSet& constraints) {
  const std::vector<bool> orientation = constraints.asksOrientation();
  std::vector<Asked> asked(orientation.size());
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = {orientation[i], false};
  for (const BoundControl& bound : controls.controls()) {
    const bool shapes_inertia = bound.kind == &kInertiaControl || bound.kind == &kSizeControl;
    if (shapes_inertia) asked[static_cast<std::size_t>(bound.owner.body)].inertia = true;
  }
  return asked;
}

Eigen::MatrixXd unknown(const EditProblem& problem) {
  return Eigen::MatrixXd::Constant(problem.constraints.size(), problem.controls.size(),
                                   std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

EditProblem::EditProblem(const Scene& scene, ContactSource& contact_source, double length,
                         const std::vector<Control>& varied, const std::vector<Constraint>& held)
    : contacts(&contact_source),
      controls(checkedScene(scene), varied),
      constraints(controls.startScene(), held),
      validity(controls),
      duration(checkedDuration(length)),
      horizon(constraints.horizon(duration)),
      asked(askedOf(controls, constraints)) {}

Motion simulateAt(const EditProblem& problem, const Eigen::VectorXd& values, double until) {
  SimulateOptions options;
  options.asked = problem.asked;
  return simulate(problem.controls.sceneAt(values), *problem.contacts, until, options);
}

Eigen::MatrixXd jacobianByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows, std::vector<Reliability>* reliability) {
  Eigen::MatrixXd J = unknown(problem);
  if (reliability) reliability->assign(static_cast<std::size_t>(J.rows()), {});
  DerivativeTape tape(motion);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    const StateSeed& seed = rows.seeds[i];
    if (seed.body < 0) continue;
    const SceneGradient gradient = adjoint(tape, {&seed, 1}, reliability ? &(*reliability)[i] : nullptr);
    J.row(i) = problem.controls.gather(gradient, values).transpose();
  }
  return J;
}

Eigen::MatrixXd jacobianByTangent(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows) {
  Eigen::MatrixXd J = unknown(problem);
  DerivativeTape tape(motion);
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const SceneTangent direction = problem.controls.scatter(Eigen::VectorXd::Unit(J.cols(), j), values);
    const MotionTangent moved = tangent(tape, direction);
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      const StateSeed& seed = rows.seeds[i];
      if (seed.body >= 0) J(i, j) = moved.at(seed.body, seed.at).dot(seed);
    }
  }
  return J;
}

RowsAndJacobian evaluateByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByAdjoint(problem, values, out.motion, out.rows, &out.reliability);
  return out;
}

RowsAndJacobian evaluateByTangent(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByTangent(problem, values, out.motion, out.rows);
  return out;
}

}  // namespace carom
