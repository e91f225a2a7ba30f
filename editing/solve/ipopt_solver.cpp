// SPDX-License-Identifier: MIT
#include "editing/solve/ipopt_solver.h"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>

namespace carom {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr Number kIpoptInfinity = 2e19;  // beyond Ipopt's nlp_upper_bound_inf

std::mutex& ipoptMutex() {
  static std::mutex mutex;
  return mutex;
}

bool expired(const SolverOptions& options) {
  return options.deadline && std::chrono::steady_clock::now() >= *options.deadline;
}

/// A NonlinearProgram as Ipopt sees it.
class Adapter final : public Ipopt::TNLP {
 public:
  Adapter(NonlinearProgram& program, const SolverOptions& options, SolverResult& result)
      : program_(program),
        options_(options),
        result_(result),
        n_(program.variables()),
        m_(program.constraints()),
        jacobian_places_(program.jacobianPlaces()) {
    if (program.hasHessian()) hessian_places_ = program.hessianPlaces();
  }

  bool outOfTime() const { return out_of_time_; }
  std::exception_ptr thrown() const { return thrown_; }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag, IndexStyleEnum& index_style) override {
    n = n_, m = m_;
    nnz_jac_g = static_cast<Index>(jacobian_places_.size());
    nnz_h_lag = static_cast<Index>(hessian_places_.size());
    index_style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    const NonlinearProgram::Bounds bounds = program_.bounds();
    copyBounds(bounds.x_lower, x_l), copyBounds(bounds.x_upper, x_u);
    copyBounds(bounds.g_lower, g_l), copyBounds(bounds.g_upper, g_u);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number* z_L, Number* z_U, Index, bool init_lambda,
                          Number* lambda) override {
    Eigen::Map<Eigen::VectorXd>(x, n_) = program_.start();
    static_cast<void>(z_L), static_cast<void>(z_U);
    if (init_lambda) std::fill(lambda, lambda + m_, 0);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& f) override {
    return evaluate([&] { return program_.objective(point(x), f) && std::isfinite(f); });
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* df) override {
    return evaluate([&] {
      if (!program_.gradient(point(x), vector_) || !vector_.allFinite()) return false;
      Eigen::Map<Eigen::VectorXd>(df, n_) = vector_;
      return true;
    });
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    return evaluate([&] {
      if (!program_.constraintValues(point(x), vector_) || !vector_.allFinite()) return false;
      Eigen::Map<Eigen::VectorXd>(g, m_) = vector_;
      return true;
    });
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (!values) return copyPlaces(jacobian_places_, rows, columns);
    return evaluate([&] {
      if (!program_.jacobianEntries(point(x), vector_) || !vector_.allFinite()) return false;
      Eigen::Map<Eigen::VectorXd>(values, entries) = vector_;
      return true;
    });
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* lambda, bool, Index entries,
              Index* rows, Index* columns, Number* values) override {
    if (!values) return copyPlaces(hessian_places_, rows, columns);
    return evaluate([&] {
      const Eigen::VectorXd multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m_);
      if (!program_.hessianEntries(point(x), factor, multipliers, vector_) || !vector_.allFinite()) return false;
      Eigen::Map<Eigen::VectorXd>(values, entries) = vector_;
      return true;
    });
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number objective, Number inf_pr, Number, Number,
                             Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    if (expired(options_)) {
      out_of_time_ = true;
      return false;
    }
    try {
      return program_.iteration({iteration, objective, inf_pr});
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number* lambda, Number objective, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    result_.x = point(x);
    if (m_ > 0) result_.multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m_);
    result_.objective = objective;
  }

 private:
  Eigen::VectorXd point(const Number* x) const { return Eigen::Map<const Eigen::VectorXd>(x, n_); }

  static void copyBounds(const Eigen::VectorXd& from, Number* to) {
    for (Eigen::Index i = 0; i < from.size(); ++i) to[i] = std::clamp(from[i], -kIpoptInfinity, kIpoptInfinity);
  }

  static bool copyPlaces(const std::vector<NonlinearProgram::Place>& places, Index* rows, Index* columns) {
    for (const NonlinearProgram::Place& place : places) *rows++ = place.row, *columns++ = place.column;
    return true;
  }

  /// Ipopt takes a refused point calmly, an exception not: it ends the whole solve.
  template <class Evaluation>
  bool evaluate(Evaluation evaluation) {
    if (expired(options_)) {
      out_of_time_ = true;
      return false;
    }
    try {
      return evaluation();
    } catch (...) {
      return false;
    }
  }

  NonlinearProgram& program_;
  const SolverOptions& options_;
  SolverResult& result_;
  Index n_, m_;
  std::vector<NonlinearProgram::Place> jacobian_places_, hessian_places_;
  Eigen::VectorXd vector_;
  bool out_of_time_ = false;
  std::exception_ptr thrown_;
};

struct Outcome {
  Ipopt::ApplicationReturnStatus code;
  SolverStatus status;
  const char* message;
};

constexpr Outcome kOutcomes[] = {
    {Ipopt::Solve_Succeeded, SolverStatus::converged, "The solver converged."},
    {Ipopt::Solved_To_Acceptable_Level, SolverStatus::acceptable, "The solver converged to its looser tolerance."},
    {Ipopt::Feasible_Point_Found, SolverStatus::converged, "The solver found a feasible point."},
    {Ipopt::Infeasible_Problem_Detected, SolverStatus::infeasible,
     "The solver stopped where the violation cannot be made smaller nearby."},
    {Ipopt::Search_Direction_Becomes_Too_Small, SolverStatus::no_progress, "The solver's steps became too small."},
    {Ipopt::Diverging_Iterates, SolverStatus::no_progress, "The solver's points ran away."},
    {Ipopt::User_Requested_Stop, SolverStatus::stopped, "The solver was stopped."},
    {Ipopt::Maximum_Iterations_Exceeded, SolverStatus::iteration_limit, "The solver reached its limit of iterations."},
    {Ipopt::Maximum_CpuTime_Exceeded, SolverStatus::out_of_time, "The solver ran out of time."},
    {Ipopt::Restoration_Failed, SolverStatus::no_progress, "The solver could not come nearer to the constraints."},
    {Ipopt::Error_In_Step_Computation, SolverStatus::no_progress, "The solver could not compute a step."},
    {Ipopt::Not_Enough_Degrees_Of_Freedom, SolverStatus::too_few_variables,
     "There are more equations than numbers that vary."},
    {Ipopt::Invalid_Number_Detected, SolverStatus::cannot_evaluate, "The start could not be evaluated."},
};

void explain(Ipopt::ApplicationReturnStatus code, SolverResult& result) {
  result.status = SolverStatus::failed;
  result.message = "The solver failed (Ipopt status " + std::to_string(static_cast<int>(code)) + ").";
  for (const Outcome& outcome : kOutcomes) {
    if (outcome.code == code) result.status = outcome.status, result.message = outcome.message;
  }
}

void setOptions(const NonlinearProgram& program, const SolverOptions& o, Ipopt::OptionsList& ipopt) {
  ipopt.SetIntegerValue("print_level", 0);
  ipopt.SetStringValue("sb", "yes");
  ipopt.SetStringValue("linear_solver", "mumps");
  ipopt.SetStringValue("hessian_approximation", program.hasHessian() ? "exact" : "limited-memory");
  ipopt.SetStringValue("nlp_scaling_method", "none");  // programs are dimensionless
  ipopt.SetIntegerValue("max_iter", o.max_iterations);
  ipopt.SetNumericValue("tol", o.tolerance);
  ipopt.SetNumericValue("constr_viol_tol", o.constraint_tolerance);
  ipopt.SetNumericValue("acceptable_tol", 100 * o.tolerance);
  ipopt.SetNumericValue("acceptable_constr_viol_tol", 100 * o.constraint_tolerance);
  ipopt.SetNumericValue("bound_relax_factor", 0);  // bounds are physical
  ipopt.SetNumericValue("mu_init", o.barrier);
  ipopt.SetNumericValue("bound_push", o.bound_push);
  ipopt.SetNumericValue("bound_frac", o.bound_push);
  ipopt.SetNumericValue("slack_bound_push", o.bound_push);
  ipopt.SetNumericValue("slack_bound_frac", o.bound_push);
  ipopt.SetIntegerValue("min_refinement_steps", 0);
}

SolverResult solveLocked(NonlinearProgram& program, const SolverOptions& options) {
  SolverResult result;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  setOptions(program, options, *application->Options());
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    result.message = "Ipopt could not be started.";
    return result;
  }
  Ipopt::SmartPtr<Adapter> adapter = new Adapter(program, options, result);
  explain(application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(adapter))), result);
  if (IsValid(application->Statistics())) result.iterations = application->Statistics()->IterationCount();
  if (adapter->thrown()) std::rethrow_exception(adapter->thrown());
  if (adapter->outOfTime()) result.status = SolverStatus::out_of_time, result.message = "The solver ran out of time.";
  return result;
}

}  // namespace

SolverResult solveWithIpopt(NonlinearProgram& program, const SolverOptions& options) {
  const std::lock_guard<std::mutex> lock(ipoptMutex());
  if (program.variables() == 0) {
    SolverResult result;
    result.status = SolverStatus::too_few_variables;
    result.message = "Nothing may vary.";
    result.x = Eigen::VectorXd(0);
    return result;
  }
  SolverResult result = solveLocked(program, options);
  if (result.x.size() != program.variables()) result.x = program.start();
  return result;
}

}  // namespace carom
