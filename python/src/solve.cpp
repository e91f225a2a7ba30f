// SPDX-License-Identifier: MIT
#include <exception>
#include <map>
#include <mutex>

#include "adjoint/base/errors.h"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// The value of a word. Throws InputError that lists the words.
template <class Value>
Value valueOf(const std::string& word, const char* where, const std::map<std::string, Value>& values) {
  const auto found = values.find(word);
  if (found != values.end()) return found->second;
  std::string words;
  for (const auto& [name, value] : values) words += (words.empty() ? "'" : ", '") + name + "'";
  throw InputError(where, "found '" + word + "', expected one of " + words);
}

/// Calls a progress callback from whatever thread; what it raises first ends the edit, without an answer.
class Callback {
 public:
  Callback(const nb::object& function, std::stop_source& stop) : function_(function), stop_(stop) {}

  bool operator()(const EditProgress& progress) {
    const GilHeld held;
    const InCallback in;
    try {
      return !calledBack(function_, progress).is(nb::bool_(false));
    } catch (...) {
      if (!raised_) raised_ = std::current_exception();
      stop_.request_stop();
      return false;
    }
  }
  /// With the GIL, after the edit.
  void finish() {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  const nb::object& function_;
  std::stop_source& stop_;
  std::exception_ptr raised_;  // guarded by the GIL
};

PyEditResult solvedBy(const PyEdit& self, EditOptions options, const nb::object& progress) {
  InCallback::refuse();
  requireFunction(progress, "progress");
  const OneAtATime::Use use(self.content->one, "the edit");
  std::stop_source stop;
  Callback callback(progress, stop);
  if (!progress.is_none()) options.progress = std::ref(callback);
  options.stop = stop.get_token();
  options.abandon = true;  // whoever presses Ctrl-C gets no answer
  std::optional<EditResult> result;
  try {
    runInterruptible(stop, [&] { result = self.content->edit.solve(options); });
  } catch (const EditAbandoned&) {
    callback.finish();
    throw;
  }
  callback.finish();
  const PyScene scene = sceneWith(self.content->scene, result->scene);
  PyMotion motion = motionOf(scene, std::move(result->motion));
  return {std::move(*result), scene, std::move(motion), self.content->scene};
}

PyEditResult solvedWith(const PyEdit& self, const std::string& effort, const std::string& sequence, int alternatives,
                        int seed, int threads, std::optional<double> time_budget, int max_iterations, double tolerance,
                        double graze_margin, const std::string& second_derivatives, bool certify, bool explain,
                        std::optional<std::size_t> step_limit, const nb::object& progress) {
  EditOptions options;
  options.effort = valueOf<Effort>(
      effort, "effort", {{"fast", Effort::fast}, {"normal", Effort::normal}, {"thorough", Effort::thorough}});
  options.sequence = valueOf<SequencePolicy>(sequence, "sequence",
                                             {{"smallest", SequencePolicy::smallest},
                                              {"prefer_start", SequencePolicy::prefer_start},
                                              {"stay", SequencePolicy::stay}});
  options.second_derivatives = valueOf<SecondDerivatives>(second_derivatives, "second_derivatives",
                                                          {{"exact", SecondDerivatives::exact},
                                                           {"secant", SecondDerivatives::secant},
                                                           {"limited_memory", SecondDerivatives::limited_memory}});
  options.alternatives = alternatives;
  options.seed = seed;
  options.threads = threads;
  if (time_budget) options.time_budget_seconds = *time_budget;
  options.max_iterations = max_iterations;
  options.tolerance = tolerance;
  options.graze_margin = graze_margin;
  options.certify = certify;
  options.explain = explain;
  if (step_limit) options.step_limit = *step_limit;
  return solvedBy(self, std::move(options), progress);
}

constexpr const char* kSolveText =
    "Solves the edit. The answer is a status with a message; it does not depend on the machine or the number of threads, "
    "unless time_budget (s) ends it. Ctrl-C raises KeyboardInterrupt.\n\n"
    "effort: work limit of the search, 'fast', 'normal' or 'thorough'. sequence: whether the impact sequence may change, "
    "'smallest', 'prefer_start' or 'stay'. alternatives: number of distinct solutions to search for. seed: of the sample "
    "sequence. threads: 0 for all cores. tolerance: of every row, dimensionless. graze_margin: how far inside an answer goes where a "
    "needed impact would be lost at a smaller change; 0: the smallest change itself. second_derivatives: 'exact', 'secant' or "
    "'limited_memory'. certify, explain: fill in certificate, and why_not if it is not solved. step_limit: of each motion. "
    "progress: called with an EditProgress, in another thread; if it returns False, the edit ends with the status "
    "'cancelled', and if it raises, with that. It must not solve another edit.\n\n"
    "Raises InputError for invalid input.";

}  // namespace

void bindSolve(nb::class_<PyEdit>& edit, nb::module_& module) {
  const auto none = nb::none();
  const EditOptions defaults;
  nb::class_<EditProgress>(module, "EditProgress", "Progress of an edit.")
      .def_ro("iteration", &EditProgress::iteration, "Steps so far.")
      .def_ro("objective", &EditProgress::objective, "1/2 sum (w z)^2")
      .def_ro("violation", &EditProgress::violation, "Largest error of a row, dimensionless.");
  edit.def("solve", &solvedWith, nb::kw_only(), nb::arg("effort") = "normal", nb::arg("sequence") = "smallest",
           nb::arg("alternatives") = defaults.alternatives, nb::arg("seed") = defaults.seed,
           nb::arg("threads") = defaults.threads, nb::arg("time_budget") = none,
           nb::arg("max_iterations") = defaults.max_iterations, nb::arg("tolerance") = defaults.tolerance,
           nb::arg("graze_margin") = defaults.graze_margin,
           nb::arg("second_derivatives") = "exact", nb::arg("certify") = true, nb::arg("explain") = true,
           nb::arg("step_limit") = none, nb::arg("progress") = none,
           nb::sig("def solve(self, *, effort: str = 'normal', sequence: str = 'smallest', alternatives: int = 1, seed: int "
                   "= 0, threads: int = 0, time_budget: float | None = None, max_iterations: int = 10000, tolerance: float "
                   "= 1e-09, graze_margin: float = 0.001, second_derivatives: str = 'exact', certify: bool = True, explain: bool = True, step_limit: "
                   "int | None = None, progress: collections.abc.Callable[[EditProgress], bool | None] | None = None) -> "
                   "EditResult"),
           kSolveText);
}

}  // namespace carom::python
