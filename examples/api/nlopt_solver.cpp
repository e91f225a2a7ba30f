// SPDX-License-Identifier: MIT
// An edit solved by NLopt's SLSQP, an optimiser that knows nothing of carom: it asks the evaluator of the edit for values
// and exact first derivatives. Variables and rows are divided by their natural scales, as solvers like it.
#include <nlopt.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

// x = start + scale y: what NLopt varies is y.
struct Scaled {
  const NlpEvaluator& program;
  Eigen::VectorXd start, scale;

  explicit Scaled(const NlpEvaluator& of) : program(of), start(of.start()), scale(start.size()) {
    for (Eigen::Index i = 0; i < scale.size(); ++i) scale[i] = of.variables()[static_cast<std::size_t>(i)].scale;
  }
  NlpPoint at(const double* y) const {
    return program.at(start + scale.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(y, start.size())));
  }
};

double objective(unsigned n, const double* y, double* gradient, void* data) {
  const auto& scaled = *static_cast<const Scaled*>(data);
  const NlpPoint point = scaled.at(y);
  if (!point.available()) return HUGE_VAL;
  if (gradient) {
    const Eigen::VectorXd g = point.gradient().entries.cwiseProduct(scaled.scale);
    for (unsigned i = 0; i < n; ++i) gradient[i] = g[i];
  }
  return point.objective();
}

void equations(unsigned m, double* result, unsigned n, const double* y, double* gradient, void* data) {
  const auto& scaled = *static_cast<const Scaled*>(data);
  const NlpPoint point = scaled.at(y);
  const std::vector<NlpRow>& rows = scaled.program.rows();
  const Eigen::MatrixXd J = point.available() && gradient ? point.jacobian().entries : Eigen::MatrixXd();
  for (unsigned i = 0; i < m; ++i) {
    result[i] = point.available() ? (point.values()[i] - rows[i].lower) / rows[i].scale : HUGE_VAL;
    for (unsigned j = 0; j < n && J.size() > 0; ++j) gradient[i * n + j] = J(i, j) * scaled.scale[j] / rows[i].scale;
  }
}

}  // namespace

int main() {
  Scene scene;
  scene.materials = {{.name = "court", .elasticity = 0.7, .friction = 0.4}};
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};

  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball"), elasticity("court").within(0.5, 0.9));
  edit.nail("ball", nthImpact(2)).position({4.2, 0.5, any});
  const NlpEvaluator program = edit.evaluator();
  Scaled scaled(program);
  const auto n = static_cast<unsigned>(scaled.start.size());
  const auto m = static_cast<unsigned>(program.rows().size());

  const Eigen::VectorXd lower = (program.lower() - scaled.start).cwiseQuotient(scaled.scale);
  const Eigen::VectorXd upper = (program.upper() - scaled.start).cwiseQuotient(scaled.scale);
  const std::vector<double> tolerances(m, 1e-10);
  nlopt_opt optimiser = nlopt_create(NLOPT_LD_SLSQP, n);
  nlopt_set_min_objective(optimiser, objective, &scaled);
  nlopt_add_equality_mconstraint(optimiser, m, equations, &scaled, tolerances.data());
  nlopt_set_lower_bounds(optimiser, lower.data());
  nlopt_set_upper_bounds(optimiser, upper.data());
  nlopt_set_xtol_rel(optimiser, 1e-12);
  nlopt_set_maxeval(optimiser, 200);
  std::vector<double> y(n, 0);
  double least = 0;
  const nlopt_result ended = nlopt_optimize(optimiser, y.data(), &least);
  nlopt_destroy(optimiser);

  const NlpPoint answer = scaled.at(y.data());
  const EditResult result = edit.solve();
  std::printf("NLopt %s; rows are met: %s\n", ended > 0 ? "converged" : "failed",
              std::abs(answer.values()[0] - 4.2) < 1e-8 && std::abs(answer.values()[1] - 0.5) < 1e-8 ? "yes" : "no");
  std::printf("objective %.6f, that of solve() %.6f\n", least, result.objective);
  for (std::size_t i = 0; i < n; ++i)
    std::printf("%-24s %8.5f  %8.5f\n", program.variables()[i].name.c_str(), answer.x()[static_cast<Eigen::Index>(i)],
                result.changed[i].after);
}
