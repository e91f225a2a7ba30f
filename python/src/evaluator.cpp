// SPDX-License-Identifier: MIT
#include "editing/nlp_evaluator.h"

#include "python/src/arrays.hpp"
#include "python/src/edit.hpp"
#include "python/src/evaluator_batch.hpp"
#include "python/src/xla_rows.hpp"

namespace carom::python {
namespace {

/// carom.NlpEvaluator. Its edit is kept because that shows to Python's collector what functions the rows call.
struct PyEvaluator {
  nb::object edit;
  PyScene scene;
  NlpEvaluator evaluator;
  std::shared_ptr<const OfferedEvaluator> offered = nullptr;  // once carom.jax has asked
};

/// carom.NlpPoint; keeps its evaluator for the same reason.
struct PyPoint {
  nb::object evaluator;
  PyScene scene;
  std::shared_ptr<const NlpPoint> point;
};

/// carom.NlpJacobian and carom.NlpGradient.
struct PyJacobian {
  PyScene scene;
  NlpJacobian jacobian;
};
struct PyNlpGradient {
  PyScene scene;
  NlpGradient gradient;
};

PyEvaluator evaluatorOf(const nb::object& edit, std::optional<std::size_t> step_limit) {
  const auto& content = nb::cast<const PyEdit&>(edit).content;
  const OneAtATime::Use use(content->one, "the edit");
  NlpEvaluator evaluator = [&] {
    const Computing free;
    return step_limit ? content->edit.evaluator(*step_limit) : content->edit.evaluator();
  }();
  return {edit, content->scene, std::move(evaluator)};
}

PyPoint pointAt(const nb::object& self, const ArrayLike& x) {
  const auto& of = nb::cast<const PyEvaluator&>(self);
  const Eigen::VectorXd values = columnOf(x, "x");
  Watch watch;
  NlpPoint point = [&] {
    const Computing free;
    return of.evaluator.at(values, watch.stop(), watch.progress());
  }();
  watch.finish();
  const bool takes_long = point.available() && takesLong(point.motion());
  return {self, of.scene, sharedFreely(std::make_unique<const NlpPoint>(std::move(point)), takes_long)};
}

PyScene sceneAt(const PyEvaluator& self, const ArrayLike& x) {
  const Eigen::VectorXd values = columnOf(x, "x");
  const Computing free;
  return sceneWith(self.scene, self.evaluator.sceneAt(values));
}

/// A copy, without what the evaluator keeps.
PyMotion motionOfPoint(const PyPoint& self) {
  const Computing free;
  const Motion& motion = self.point->motion();
  return motionOf(sceneWith(self.scene, *motion.scene), Motion(motion));
}

Array<-1, -1> hessianOf(const PyPoint& self, double objective_weight, const ArrayLike& row_weights) {
  const Eigen::VectorXd weights = columnOf(row_weights, "row_weights");
  const Eigen::MatrixXd hessian = [&] {
    const Computing free;
    return self.point->hessian(objective_weight, weights);
  }();
  return copied<Array<-1, -1>>(hessian);
}

Array<-1> hessianTimes(const PyPoint& self, double objective_weight, const ArrayLike& row_weights,
                       const ArrayLike& direction) {
  const Eigen::VectorXd weights = columnOf(row_weights, "row_weights"), along = columnOf(direction, "direction");
  const Eigen::VectorXd product = [&] {
    const Computing free;
    return self.point->hessianTimes(objective_weight, weights, along);
  }();
  return copied<Array<-1>>(product);
}

std::vector<PyReliability> reliabilityOf(const PyJacobian& self) {
  std::vector<PyReliability> rows;
  for (const Reliability& row : self.jacobian.reliability) rows.emplace_back(row, self.scene.scene());
  return rows;
}

/// For Python's collector: what an object keeps.
template <class Kept, nb::object Kept::* member>
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self)) Py_VISIT((nb::inst_ptr<Kept>(self)->*member).ptr());
  return 0;
}
template <class Kept, nb::object Kept::* member>
PyType_Slot kCollected[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse<Kept, member>)}, {0, nullptr}};

void bindVariables(nb::module_& module) {
  nb::class_<NlpVariable>(module, "NlpVariable",
                          "A variable of an edit as a nonlinear program: a control parameter, or the time of a nail `between` "
                          "two times.")
      .def_ro("name", &NlpVariable::name, "\"velocity.x of 'hat'\"")
      .def_ro("component", &NlpVariable::component, "'x', 'value'; of a time 'time'.")
      .def_ro("control", &NlpVariable::control, "Index of its Control; -1: a time.")
      .def_ro("constraint", &NlpVariable::constraint, "Of a time: index of its constraint; else -1.")
      .def_ro("start", &NlpVariable::start, "SI, of the scene; of a time where its constraint is most nearly met.")
      .def_ro("lower", &NlpVariable::lower, "Lower bound, SI; -inf if none.")
      .def_ro("upper", &NlpVariable::upper, "Upper bound, SI; inf if none.")
      .def_ro("scale", &NlpVariable::scale, "SI: natural scale of a change, over the weight of the control.")
      .def_ro("logarithmic", &NlpVariable::logarithmic,
              "A change costs z^2 / 2 with z = log(x / start) start / scale; else z = (x - start) / scale. Times cost nothing.")
      .def("__repr__", [](const NlpVariable& self) {
        return "<NlpVariable " + self.name + " from " + numberText(self.start) + ", " + numberText(self.lower) + " to " +
               numberText(self.upper) + ">";
      });
  nb::class_<NlpRow>(module, "NlpRow",
                     "A row of an edit as a nonlinear program: lower <= value <= upper; an equation has equal bounds. After "
                     "the rows of constraints and of Edit.require come those of physical validity.")
      .def_ro("name", &NlpRow::name, "\"position.x of 'hat' at 1.4 s\"")
      .def_ro("constraint", &NlpRow::constraint, "Index of its constraint; -1: of Edit.require, or validity.")
      .def_ro("control", &NlpRow::control, "Of validity: index of its Control; else -1.")
      .def_ro("lower", &NlpRow::lower, "Lower bound, SI; -inf if none.")
      .def_ro("upper", &NlpRow::upper, "Upper bound, SI; inf if none.")
      .def_ro("scale", &NlpRow::scale, "Natural scale of the value, SI.")
      .def("__repr__", [](const NlpRow& self) {
        return "<NlpRow " + self.name + ", " + numberText(self.lower) + " to " + numberText(self.upper) + ">";
      });
}

void bindDerivativesOf(nb::module_& module) {
  nb::class_<PyJacobian>(module, "NlpJacobian", "First derivatives of all rows.")
      .def_prop_ro("entries", [](const PyJacobian& self) { return copied<ReadOnly<-1, -1>>(self.jacobian.entries); },
                   kOwnArray, "(rows, variables), SI by SI.")
      .def_prop_ro("reliability", &reliabilityOf, nb::rv_policy::move, "Of each row.")
      .def("__repr__", [](const PyJacobian& self) {
        return "<NlpJacobian of " + std::to_string(self.jacobian.entries.rows()) + " rows by " +
               std::to_string(self.jacobian.entries.cols()) + " variables>";
      });
  nb::class_<PyNlpGradient>(module, "NlpGradient", "First derivatives of the objective.")
      .def_prop_ro("entries", [](const PyNlpGradient& self) { return copied<ReadOnly<-1>>(self.gradient.entries); },
                   kOwnArray, "(variables,), by SI.")
      .def_prop_ro("reliability",
                   [](const PyNlpGradient& self) { return PyReliability(self.gradient.reliability, self.scene.scene()); },
                   nb::rv_policy::move, "Of an objective of Edit.minimise.")
      .def("__repr__", [](const PyNlpGradient& self) {
        return "<NlpGradient of " + std::to_string(self.gradient.entries.size()) + " variables>";
      });
}

constexpr const char* kPointText =
    "One evaluated point of an NlpEvaluator: immutable, safe in several threads; derivatives are computed at every call. "
    "Functions raise NotComputable, with the reason, if the point is not available or the derivative does not exist in "
    "doubles, and InputError for arguments of the wrong size.";

void bindPoint(nb::module_& module) {
  nb::class_<PyPoint> point(module, "NlpPoint", nb::type_slots(kCollected<PyPoint, &PyPoint::evaluator>), kPointText);
  point.def_prop_ro("x", [](const PyPoint& self) { return copied<ReadOnly<-1>>(self.point->x()); }, kOwnArray,
                    "(variables,), SI.")
      .def_prop_ro("available", [](const PyPoint& self) { return self.point->available(); },
                   "All rows and the objective exist: the scene is valid and the motion has all that they read.")
      .def_prop_ro("message", [](const PyPoint& self) { return self.point->message(); },
                   "Why not, in a sentence; empty if available.")
      .def_prop_ro("motion", &motionOfPoint, nb::rv_policy::move, "Simulated as far as something counts.")
      .def_prop_ro("values", [](const PyPoint& self) { return copied<ReadOnly<-1>>(self.point->values()); }, kOwnArray,
                   "(rows,), of all rows, SI.")
      .def_prop_ro("objective", [](const PyPoint& self) { return self.point->objective(); },
                   "What the edit minimises: 1/2 sum (w z)^2, or that of Edit.minimise.")
      .def_prop_ro("signature",
                   [](const PyPoint& self) {
                     const Computing free;
                     return self.point->signature();
                   },
                   "The impact sequence as far as it counts: derivatives relate points with equal signatures.")
      .def_prop_ro("has_hessian",
                   [](const PyPoint& self) {
                     const Computing free;
                     return self.point->hasHessian();
                   },
                   "Second derivatives are implemented for this motion and all rows.")
      .def("gradient",
           [](const PyPoint& self) {
             const Computing free;
             return PyNlpGradient{self.scene, self.point->gradient()};
           },
           "Of the objective, by one reverse pass.")
      .def("jacobian",
           [](const PyPoint& self) {
             const Computing free;
             return PyJacobian{self.scene, self.point->jacobian()};
           },
           "Of all rows, by one reverse pass each.")
      .def("hessian", &hessianOf, nb::arg("objective_weight"), nb::arg("row_weights"),
           "Second derivatives of objective_weight * objective + row_weights . rows, (variables, variables): exact and "
           "symmetric. NotComputable without has_hessian, unless what has none has the weight 0.")
      .def("hessian_times", &hessianTimes, nb::arg("objective_weight"), nb::arg("row_weights"), nb::arg("direction"),
           "The product of that matrix with a direction, for the cost of some reverse passes.")
      .def("__repr__", [](const PyPoint& self) {
        return self.point->available() ? "<NlpPoint of " + std::to_string(self.point->x().size()) + " variables and " +
                                            std::to_string(self.point->values().size()) + " rows>"
                                      : "<NlpPoint, not available: " + self.point->message() + ">";
      });
}

constexpr const char* kEvaluatorText =
    "An edit as a nonlinear program, for solvers other than Edit.solve:\n\n"
    "    minimise objective(x)  subject to  lower <= rows(x) <= upper  and the bounds of the variables,\n\n"
    "with x in SI: one number per control parameter, then one per nail `between` two times. Within one impact sequence "
    "(NlpPoint.signature) all of it is smooth; where the sequence changes, rows may jump. Edit.evaluator makes it. Safe in "
    "several threads; later changes of the edit do not change it.";

}  // namespace

void bindEvaluator(nb::module_& module, nb::class_<PyEdit>& edit) {
  bindVariables(module);
  bindDerivativesOf(module);
  bindPoint(module);
  nb::class_<PyEvaluator> evaluator(module, "NlpEvaluator", nb::type_slots(kCollected<PyEvaluator, &PyEvaluator::edit>),
                                    kEvaluatorText);
  evaluator
      .def_prop_ro("variables", [](const PyEvaluator& self) { return self.evaluator.variables(); }, nb::rv_policy::copy,
                   "x, in this order.")
      .def_prop_ro("rows", [](const PyEvaluator& self) { return self.evaluator.rows(); }, nb::rv_policy::copy,
                   "Rows, in this order.")
      .def_prop_ro("start", [](const PyEvaluator& self) { return copied<ReadOnly<-1>>(self.evaluator.start()); }, kOwnArray,
                   "(variables,), NlpVariable.start of all.")
      .def_prop_ro("lower", [](const PyEvaluator& self) { return copied<ReadOnly<-1>>(self.evaluator.lower()); }, kOwnArray,
                   "(variables,), lower bounds.")
      .def_prop_ro("upper", [](const PyEvaluator& self) { return copied<ReadOnly<-1>>(self.evaluator.upper()); }, kOwnArray,
                   "(variables,), upper bounds.")
      .def("at", &pointAt, nb::arg("x"), nb::sig("def at(self, x: numpy.typing.ArrayLike) -> NlpPoint"),
           "Simulates the scene with these values, up to where nothing later counts, and reads all rows. Ctrl-C raises "
           "KeyboardInterrupt. Raises InputError if x has another size or a number that is not finite, and what functions of "
           "the motion raise; a point that cannot be evaluated says why (NlpPoint.message).")
      .def("rows_at",
           [](const PyEvaluator& self, const ArrayLike& x, bool jacobian, int threads) {
             return rowsAt(self.evaluator, x, jacobian, threads);
           },
           nb::arg("x"), nb::kw_only(), nb::arg("jacobian") = false, nb::arg("threads") = 1,
           nb::sig("def rows_at(self, x: numpy.typing.ArrayLike, *, jacobian: bool = False, threads: int = 1) -> "
                   "tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64] | None]"),
           "The values of all rows at many points x (count, variables): (count, rows), and with `jacobian` their Jacobians "
           "(count, rows, variables), computed in that many threads. Raises NotComputable for the first point that is not "
           "available, else as `at`.")
      .def("scene_at", &sceneAt, nb::arg("x"), "The scene with these values of its parameters. Raises InputError like `at`.")
      .def("__repr__", [](const PyEvaluator& self) {
        return "<NlpEvaluator of " + std::to_string(self.evaluator.variables().size()) + " variables and " +
               std::to_string(self.evaluator.rows().size()) + " rows>";
      });
  edit.def("evaluator", &evaluatorOf, nb::arg("step_limit") = nb::none(),
           nb::sig("def evaluator(self, step_limit: int | None = None) -> NlpEvaluator"),
           "The same edit as a nonlinear program, for a solver of your own. step_limit: of each motion. Raises as `solve` "
           "does.");
  module.def("xla_number",
             [](PyEvaluator& self) {
               if (!self.offered) self.offered = std::make_shared<const OfferedEvaluator>(self.evaluator);
               return self.offered->number();
             },
             nb::arg("evaluator"), "The number by which programs of XLA find an evaluator while it lives.");
  module.def("xla_handler", &xlaHandler, nb::sig("def xla_handler() -> dict[str, typing.Any]"),
             "Stages of the handler by which XLA computes rows, and the type of its state, as capsules for jax.ffi; empty "
             "where it was not built.");
}

}  // namespace carom::python
