// SPDX-License-Identifier: MIT
#include "editing/solve/ipopt_solver.hpp"

#include <IpStdCInterface.h>
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "editing/detail/thrown_by_user.hpp"
#include "editing/solver_library.h"

#ifdef __SANITIZE_ADDRESS__
#undef RTLD_DEEPBIND  // its functions have to come first
#define RTLD_DEEPBIND 0
#endif

namespace carom::editing_detail {
namespace {

constexpr Number kIpoptInfinity = 2e19;  // beyond Ipopt's nlp_upper_bound_inf

std::mutex& ipoptMutex() {
  static std::mutex mutex;
  return mutex;
}

/// What setSolverLibrary named, and whether a library is open; both under the mutex.
struct NamedLibrary {
  std::string path;
  bool open = false;
};
NamedLibrary& namedLibrary() {
  static NamedLibrary library;
  return library;
}

/// Ipopt's C interface. The library is opened when the first program is solved: it brings a dozen others along, whose
/// relocation would cost every process more time than a small simulation.
struct IpoptLibrary {
  decltype(&CreateIpoptProblem) create = nullptr;
  decltype(&FreeIpoptProblem) free = nullptr;
  decltype(&AddIpoptStrOption) add_text = nullptr;
  decltype(&AddIpoptNumOption) add_number = nullptr;
  decltype(&AddIpoptIntOption) add_integer = nullptr;
  decltype(&SetIntermediateCallback) set_callback = nullptr;
  decltype(&IpoptSolve) solve = nullptr;
  std::string error;  ///< why it cannot be used; empty if it can

  IpoptLibrary() {
    void* handle = open();
    if (handle == nullptr) {
      error = "Ipopt, which solves edits, could not be opened: " + std::string(dlerror());
      return;
    }
    find(handle, "CreateIpoptProblem", create), find(handle, "FreeIpoptProblem", free);
    find(handle, "AddIpoptStrOption", add_text), find(handle, "AddIpoptNumOption", add_number);
    find(handle, "AddIpoptIntOption", add_integer), find(handle, "SetIntermediateCallback", set_callback);
    find(handle, "IpoptSolve", solve);
  }

 private:
  static void* open() {
    NamedLibrary& named = namedLibrary();
    named.open = true;
    if (!named.path.empty()) return dlopen(named.path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    const std::string path = CAROM_IPOPT_LIBRARY;  // as it was found when carom was built, else wherever it is now
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    return handle != nullptr ? handle : dlopen(path.substr(path.rfind('/') + 1).c_str(), RTLD_NOW | RTLD_LOCAL);
  }

  template <class Function>
  void find(void* handle, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    if (function == nullptr) error = "Ipopt, which solves edits, has no function " + std::string(name) + ".";
  }
};

const IpoptLibrary& ipoptLibrary() {
  static const IpoptLibrary library;
  return library;
}

/// A NonlinearProgram as Ipopt sees it; the functions below are given to it with the adapter as their last argument.
class Adapter {
 public:
  explicit Adapter(NonlinearProgram& program) : program_(program), n_(program.variables()), m_(program.constraints()) {}

  std::exception_ptr thrown() const { return thrown_; }
  int iterations() const { return iterations_; }

  IpoptProblem createProblem(const IpoptLibrary& ipopt) {
    const NonlinearProgram::Bounds bounds = program_.bounds();
    std::vector<Number> x_lower = limits(bounds.x_lower), x_upper = limits(bounds.x_upper);
    std::vector<Number> g_lower = limits(bounds.g_lower), g_upper = limits(bounds.g_upper);
    IpoptProblem problem = ipopt.create(n_, x_lower.data(), x_upper.data(), m_, g_lower.data(), g_upper.data(),
                                        m_ * n_, program_.hasHessian() ? n_ * (n_ + 1) / 2 : 0, kCStyle, objective,
                                        constraintValues, gradient, jacobian, hessian);
    if (problem != nullptr) ipopt.set_callback(problem, iteration);
    return problem;
  }

 private:
  static constexpr Index kCStyle = 0;  // indices from 0

  static Adapter& self(UserDataPtr data) { return *static_cast<Adapter*>(data); }
  Eigen::VectorXd point(const Number* x) const { return Eigen::Map<const Eigen::VectorXd>(x, n_); }

  static Bool objective(Index, Number* x, Bool, Number* value, UserDataPtr data) {
    Adapter& a = self(data);
    return a.evaluate([&] { return a.program_.objective(a.point(x), *value) && std::isfinite(*value); });
  }

  static Bool gradient(Index n, Number* x, Bool, Number* values, UserDataPtr data) {
    Adapter& a = self(data);
    return a.evaluate([&] { return a.program_.gradient(a.point(x), a.vector_) && a.copyVector(n, values); });
  }

  static Bool constraintValues(Index, Number* x, Bool, Index m, Number* values, UserDataPtr data) {
    Adapter& a = self(data);
    return a.evaluate([&] { return a.program_.constraintValues(a.point(x), a.vector_) && a.copyVector(m, values); });
  }

  // Both matrices are dense, row by row; of the Hessian the lower triangle.
  static Bool jacobian(Index, Number* x, Bool, Index, Index entries, Index* rows, Index* columns, Number* values,
                       UserDataPtr data) {
    Adapter& a = self(data);
    if (values == nullptr) {
      for (Index i = 0; i < a.m_; ++i)
        for (Index j = 0; j < a.n_; ++j) *rows++ = i, *columns++ = j;
      return TRUE;
    }
    return a.evaluate([&] {
      if (!a.program_.jacobian(a.point(x), a.matrix_)) return false;
      a.vector_ = a.matrix_.reshaped<Eigen::RowMajor>();
      return a.copyVector(entries, values);
    });
  }

  static Bool hessian(Index, Number* x, Bool, Number factor, Index m, Number* lambda, Bool, Index entries, Index* rows,
                      Index* columns, Number* values, UserDataPtr data) {
    Adapter& a = self(data);
    if (values == nullptr) {
      for (Index i = 0; i < a.n_; ++i)
        for (Index j = 0; j <= i; ++j) *rows++ = i, *columns++ = j;
      return TRUE;
    }
    return a.evaluate([&] {
      const Eigen::VectorXd multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m);
      if (!a.program_.hessian(a.point(x), factor, multipliers, a.matrix_)) return false;
      a.vector_.resize(entries);
      Index k = 0;
      for (Index i = 0; i < a.n_; ++i)
        for (Index j = 0; j <= i; ++j) a.vector_[k++] = a.matrix_(i, j);
      return a.copyVector(entries, values);
    });
  }

  static Bool iteration(Index, Index count, Number objective, Number inf_pr, Number, Number, Number, Number, Number,
                        Number, Index, UserDataPtr data) {
    Adapter& a = self(data);
    a.iterations_ = count;
    if (a.thrown_) return FALSE;
    try {
      return a.program_.iteration({count, objective, inf_pr});
    } catch (...) {
      a.thrown_ = std::current_exception();
      return FALSE;
    }
  }

  static std::vector<Number> limits(const Eigen::VectorXd& bounds) {
    std::vector<Number> limits;
    for (const double bound : bounds) limits.push_back(std::clamp(bound, -kIpoptInfinity, kIpoptInfinity));
    return limits;
  }

  bool copyVector(Index size, Number* values) const {
    if (!vector_.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd>(values, size) = vector_;
    return true;
  }

  /// Ipopt takes a refused point calmly; an exception must not pass through it. What the caller threw waits for its end.
  template <class Evaluation>
  bool evaluate(Evaluation evaluation) {
    if (thrown_) return false;
    try {
      return evaluation();
    } catch (const ThrownByUser&) {
      thrown_ = std::current_exception();
      return false;
    } catch (...) {
      return false;
    }
  }

  NonlinearProgram& program_;
  Index n_, m_;
  Eigen::VectorXd vector_;
  Eigen::MatrixXd matrix_;
  int iterations_ = 0;
  std::exception_ptr thrown_;
};

struct Outcome {
  ApplicationReturnStatus code;
  SolverStatus status;
  const char* message;
};

constexpr Outcome kOutcomes[] = {
    {Solve_Succeeded, SolverStatus::converged, "The solver converged."},
    {Solved_To_Acceptable_Level, SolverStatus::acceptable, "The solver converged to its acceptable tolerance."},
    {Feasible_Point_Found, SolverStatus::converged, "The solver found a feasible point."},
    {Infeasible_Problem_Detected, SolverStatus::infeasible,
     "The solver converged to a point of local infeasibility."},
    {Search_Direction_Becomes_Too_Small, SolverStatus::no_progress, "The solver's steps became too small."},
    {Diverging_Iterates, SolverStatus::no_progress, "The solver's iterates diverged."},
    {User_Requested_Stop, SolverStatus::stopped, "The solver was stopped."},
    {Maximum_Iterations_Exceeded, SolverStatus::iteration_limit, "The solver reached its limit of iterations."},
    {Restoration_Failed, SolverStatus::no_progress, "The solver could not come nearer to the constraints."},
    {Error_In_Step_Computation, SolverStatus::no_progress, "The solver could not compute a step."},
    {Not_Enough_Degrees_Of_Freedom, SolverStatus::too_few_variables,
     "There are more equations than unknowns."},
    {Invalid_Number_Detected, SolverStatus::cannot_evaluate, "The initial point could not be evaluated."},
};

void explain(ApplicationReturnStatus code, SolverResult& result) {
  result.status = SolverStatus::failed;
  result.message = "The solver failed (Ipopt status " + std::to_string(static_cast<int>(code)) + ").";
  for (const Outcome& outcome : kOutcomes) {
    if (outcome.code == code) result.status = outcome.status, result.message = outcome.message;
  }
}

/// What a solve is done with: copies of the words, because the C interface takes them as char*.
class Options {
 public:
  Options(const IpoptLibrary& ipopt, IpoptProblem problem) : ipopt_(ipopt), problem_(problem) {}
  void text(std::string name, std::string value) { ipopt_.add_text(problem_, name.data(), value.data()); }
  void number(std::string name, double value) { ipopt_.add_number(problem_, name.data(), value); }
  void integer(std::string name, int value) { ipopt_.add_integer(problem_, name.data(), value); }

 private:
  const IpoptLibrary& ipopt_;
  IpoptProblem problem_;
};

void setOptions(const NonlinearProgram& program, const SolverOptions& o, Options ipopt) {
  ipopt.text("option_file_name", "");  // no ipopt.opt of the current folder
  ipopt.integer("print_level", 0);
  ipopt.text("sb", "yes");
  ipopt.text("linear_solver", "mumps");
  ipopt.text("hessian_approximation", program.hasHessian() ? "exact" : "limited-memory");
  ipopt.text("nlp_scaling_method", "none");  // programs are dimensionless
  ipopt.integer("max_iter", o.max_iterations);
  ipopt.number("tol", o.tolerance);
  ipopt.number("constr_viol_tol", o.constraint_tolerance);
  ipopt.number("acceptable_tol", 100 * o.tolerance);
  ipopt.number("acceptable_constr_viol_tol", 100 * o.constraint_tolerance);
  ipopt.number("bound_relax_factor", 0);  // bounds are physical
  ipopt.number("mu_init", o.barrier);
  ipopt.number("bound_push", o.bound_push);
  ipopt.number("bound_frac", o.bound_push);
  ipopt.number("slack_bound_push", o.bound_push);
  ipopt.number("slack_bound_frac", o.bound_push);
  ipopt.integer("min_refinement_steps", 0);
}

SolverResult solveLocked(NonlinearProgram& program, const SolverOptions& options) {
  SolverResult result;
  const IpoptLibrary& ipopt = ipoptLibrary();
  if (!ipopt.error.empty()) {
    result.message = ipopt.error;
    return result;
  }
  Adapter adapter(program);
  const std::unique_ptr<IpoptProblemInfo, decltype(ipopt.free)> problem(adapter.createProblem(ipopt), ipopt.free);
  if (!problem) {
    result.message = "Ipopt could not be started.";
    return result;
  }
  setOptions(program, options, Options(ipopt, problem.get()));
  result.x = program.start();
  result.multipliers = Eigen::VectorXd::Zero(program.constraints());
  const auto code = ipopt.solve(problem.get(), result.x.data(), nullptr, &result.objective, result.multipliers.data(),
                                nullptr, nullptr, &adapter);
  explain(code, result);
  result.iterations = adapter.iterations();
  if (adapter.thrown()) std::rethrow_exception(adapter.thrown());
  return result;
}

}  // namespace

SolverResult solveWithIpopt(NonlinearProgram& program, const SolverOptions& options) {
  const std::lock_guard<std::mutex> lock(ipoptMutex());
  if (program.variables() == 0) {
    SolverResult result;
    result.status = SolverStatus::too_few_variables;
    result.message = "There are no unknowns.";
    result.x = Eigen::VectorXd(0);
    return result;
  }
  SolverResult result = solveLocked(program, options);
  if (result.x.size() != program.variables()) result.x = program.start();
  return result;
}

}  // namespace carom::editing_detail

void carom::setSolverLibrary(const std::string& path) {
  const std::lock_guard<std::mutex> lock(editing_detail::ipoptMutex());
  editing_detail::NamedLibrary& named = editing_detail::namedLibrary();
  if (named.open) throw InputError("solver library", "Ipopt is open already: name its library before the first edit");
  named.path = path;
}
