// SPDX-License-Identifier: MIT
#include "python/src/arrays.hpp"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

PyEdit madeEdit(const PyScene& scene, std::optional<double> duration, std::vector<Control> controls,
                std::vector<Constraint> constraints) {
  const Computing free;
  return {std::make_shared<EditContent>(scene, duration.value_or(scene.document().duration), std::move(controls),
                                        std::move(constraints))};
}

PyEdit documentEdit(const PyScene& scene) {
  const Document& document = scene.document();
  return madeEdit(scene, std::nullopt, document.controls, document.constraints);
}

PyEdit& variedEdit(PyEdit& self, const nb::args& controls) {
  const OneAtATime::Use use(self.content->one, "the edit");
  const std::vector<Control> all = controlsIn(controls);  // all of them or none
  for (const Control& control : all) self.content->edit.vary(control);
  return self;
}

PyNail nailedIn(const PyEdit& self, const std::string& body, const WhenArgument& at) {
  const OneAtATime::Use use(self.content->one, "the edit");
  const When when = whenOf(at);
  return {self.content, self.content->edit.nail(body, when), "'" + body + "', " + whenText(when)};
}

void unnailed(const PyEdit& self, const PyNail& nail) {
  if (nail.content != self.content) throw nb::value_error("the nail belongs to another edit");
  const OneAtATime::Use use(self.content->one, "the edit");
  self.content->edit.unnail(nail.nail);
}

PyEdit& hitting(PyEdit& self, const std::string& body, const std::string& with, const Interval& during,
                const std::optional<ImpactOf>& after, const std::optional<ImpactOf>& before) {
  const OneAtATime::Use use(self.content->one, "the edit");
  self.content->edit.hit(body, Hit{with, during, after, before});
  return self;
}

PyEdit& sequenced(PyEdit& self, const std::vector<std::string>& impacts) {
  const OneAtATime::Use use(self.content->one, "the edit");
  self.content->edit.sequence(impacts);
  return self;
}

std::string reprOfEdit(const PyEdit& self) {
  const Edit& edit = self.content->edit;
  return "<Edit with " + std::to_string(edit.controls().size()) + " controls and " +
         std::to_string(edit.constraints().size()) + " constraints>";
}

/// For Python's collector. A function is referred to once, whatever nails there are: the edit alone shows it.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const auto& content = nb::inst_ptr<PyEdit>(self)->content;
  if (!content || content.use_count() > 1) return 0;
  for (const auto& function : content->functions) Py_VISIT(function->ptr());
  return 0;
}

int clear(PyObject* self) {
  if (!nb::inst_ready(self)) return 0;
  const auto& content = nb::inst_ptr<PyEdit>(self)->content;
  if (!content) return 0;
  for (const auto& function : content->functions) *function = nb::none();
  return 0;
}

PyType_Slot collected[] = {
    {Py_tp_traverse, reinterpret_cast<void*>(traverse)}, {Py_tp_clear, reinterpret_cast<void*>(clear)}, {0, nullptr}};

constexpr const char* kEditText =
    "Finds the smallest weighted change of scene parameters such that the motion meets constraints: minimise 1/2 sum (w z)^2, "
    "z the change of a parameter in units of its natural scale, subject to the constraints, physical validity and bounds. "
    "The answer is verified: its scene is simulated again.\n\n"
    "    edit = Edit(scene)\n"
    "    edit.vary(velocity('ball'), elasticity('court', min=0.5, max=0.9))\n"
    "    edit.nail('ball', nth_impact(2)).position(5, 0.5, None)\n"
    "    result = edit.solve()\n\n"
    "An edit begins without controls and constraints; Edit.of(scene) has those of the document.";

}  // namespace

void bindEdits(nb::module_& module) {
  bindControls(module);
  bindMoments(module);
  bindNails(module);
  bindEditResults(module);
  const auto none = nb::none();
  const auto self = nb::rv_policy::none;
  nb::class_<PyEdit> edit(module, "Edit", nb::type_slots(collected), kEditText);
  edit.def("__init__",
           [](PyEdit* made, const PyScene& scene, std::optional<double> duration) {
             new (made) PyEdit(madeEdit(scene, duration, {}, {}));
           },
           nb::arg("scene"), nb::arg("duration") = none)
      .def_static("of", &documentEdit, nb::arg("scene"), "The edit of a document: its controls and constraints.")
      .def("vary", &variedEdit, nb::arg("controls"), self, nb::sig("def vary(self, *controls: Control) -> Edit"),
           "Adds controls: what may change.")
      .def("nail", &nailedIn, nb::arg("body"), nb::arg("at"),
           "Adds a nail of a body at a time, s, or a When; without targets yet. Chain them: .position(5, 0.5, None).")
      .def("unnail", &unnailed, nb::arg("nail"), "Removes a nail.")
      .def("hit", &hitting, nb::arg("body"), nb::arg("with_"), nb::kw_only(), nb::arg("during") = none,
           nb::arg("after") = none, nb::arg("before") = none, self,
           "Requires that a body hits another one, within `during` (first and last second), after and before other "
           "impacts.")
      .def("sequence", &sequenced, nb::arg("impacts"), self,
           "Requires an impact sequence: ['cue red', 'cue rail*', '...', 'cue yellow'].")
      .def_prop_ro("controls", [](const PyEdit& of) { return of.content->edit.controls(); }, nb::rv_policy::copy,
                   "What may change.")
      .def("__repr__", &reprOfEdit);
  bindMotionFunctions(module, edit);
  bindSolve(edit, module);
  bindEvaluator(module, edit);
}

}  // namespace carom::python
