// SPDX-License-Identifier: MIT
#include "editing/edit_result.h"

#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "formats/export/export_motion.h"
#include "python/src/arrays.hpp"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// carom.Alternative: its scene with the rest of the document.
struct PyAlternative {
  EditAlternative alternative;
  PyScene scene;
};

/// A sentence of "name before -> after", as the command prints it.
std::string changedText(const ChangedNumber& number) {
  char text[80];
  std::snprintf(text, sizeof text, " %.6g -> %.6g", number.before, number.after);
  return number.name + text;
}

std::string residualText(const ConstrainedNumber& number) {
  char text[80];
  std::snprintf(text, sizeof text, " = %.6g, error %.2g", number.value, number.error);
  return number.name + text;
}

std::string reprOfResult(const PyEditResult& self) {
  const EditResult& result = self.result;
  std::string text = std::string("<EditResult ") + nameOf(result.status);
  for (const ChangedNumber& number : result.changed)
    if (number.before != number.after) text += "\n  " + changedText(number);
  if (!result.solved()) text += ": " + result.message;
  return text + ">";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

constexpr std::size_t kStepsOfAPicture = 3'000'000;  // as the command: a few seconds

/// The motion over that of the scene before, dashed.
std::string pictureOf(const PyEditResult& self) {
  const Computing free;
  const Motion& after = self.motion.motion();
  SimulateOptions limited;
  limited.step_limit = kStepsOfAPicture;
  SceneContent::Contacts contacts(*self.before.content);
  const Motion before = simulate(self.before.scene(), *contacts, after.duration, limited);
  ExportOptions options;
  options.before = &before;
  const std::string picture = motionText("svg", self.scene.document().name, self.scene.document(), after, options);
  return picture.substr(picture.find("<svg"));
}

/// What a notebook shows: the status, a table of the changes, a picture.
std::string shownInNotebook(const PyEditResult& self) {
  std::string html = "<p>" + escaped(nameOf(self.result.status)) + ". " + escaped(self.result.message) +
                     "</p><table><tr><th></th><th>before</th><th>after</th><th>share</th></tr>";
  for (const ChangedNumber& number : self.result.changed) {
    char cells[120];
    std::snprintf(cells, sizeof cells, "</td><td>%.6g</td><td>%.6g</td><td>%.3g</td></tr>", number.before, number.after,
                  number.share);
    html += "<tr><td>" + escaped(number.name) + cells;
  }
  return html + "</table>" + pictureOf(self);
}

std::vector<PyAlternative> alternativesOf(const PyEditResult& self) {
  std::vector<PyAlternative> all;
  for (const EditAlternative& alternative : self.result.alternatives)
    all.push_back({alternative, sceneWith(self.scene, alternative.scene)});
  return all;
}

void bindNumbers(nb::module_& module) {
  nb::class_<ChangedNumber>(module, "ChangedNumber", "A control parameter of an edit.")
      .def_ro("control", &ChangedNumber::control, "Index of its Control.")
      .def_ro("name", &ChangedNumber::name, "\"velocity.x of 'hat'\"")
      .def_ro("component", &ChangedNumber::component, "'x'")
      .def_ro("before", &ChangedNumber::before, "SI, initially")
      .def_ro("after", &ChangedNumber::after, "SI, in the result")
      .def_ro("share", &ChangedNumber::share, "Fraction of the objective: (w z)^2 / sum.")
      .def_ro("standard_deviation", &ChangedNumber::standard_deviation,
              "Of a number fitted to soft constraints, SI; None where it is not determined.")
      .def("__repr__", [](const ChangedNumber& self) { return "<ChangedNumber " + changedText(self) + ">"; });
  nb::class_<ConstrainedNumber>(module, "ConstrainedNumber", "A constrained quantity, in the verified motion.")
      .def_ro("constraint", &ConstrainedNumber::constraint, "Index of its constraint; -1: a function of the motion.")
      .def_ro("name", &ConstrainedNumber::name, "\"position.x of 'hat' at 1.4 s\"")
      .def_ro("component", &ConstrainedNumber::component, "'position.x'")
      .def_ro("value", &ConstrainedNumber::value, "SI; NaN if it cannot be evaluated.")
      .def_ro("target", &ConstrainedNumber::target, "SI; NaN for a range.")
      .def_ro("error", &ConstrainedNumber::error, "SI; NaN if it cannot be evaluated.")
      .def_ro("scaled_error", &ConstrainedNumber::scaled_error, "Dimensionless.")
      .def_ro("lower", &ConstrainedNumber::lower, "Lower bound, SI; -inf if none.")
      .def_ro("upper", &ConstrainedNumber::upper, "Upper bound, SI; inf if none.")
      .def("__repr__", [](const ConstrainedNumber& self) { return "<ConstrainedNumber " + residualText(self) + ">"; });
  nb::class_<Fit>(module, "Fit", "A fit to soft constraints.")
      .def_ro("rows", &Fit::rows, "Errors; 0: there are no soft constraints.")
      .def_ro("parameters", &Fit::parameters, "Independent ones that neither hard constraints nor bounds hold.")
      .def_ro("sum_of_squares", &Fit::sum_of_squares, "Of the weighted errors in natural scales.")
      .def_ro("deviation", &Fit::deviation, "Standard deviation of one of them; None if there are too few.")
      .def_ro("message", &Fit::message, "Why some or all numbers have no standard deviation.")
      .def("__repr__", [](const Fit& self) { return "<Fit of " + std::to_string(self.rows) + " errors>"; });
  nb::class_<MetTime>(module, "MetTime", "The time at which a constraint is met that leaves it open.")
      .def_ro("constraint", &MetTime::constraint, "Index of its constraint.")
      .def_ro("name", &MetTime::name, "\"'hat' between 1 s and 2 s\"")
      .def_ro("from_", &MetTime::from, "s, start of the interval")
      .def_ro("to", &MetTime::to, "s, end of the interval")
      .def_ro("time", &MetTime::time, "s")
      .def("__repr__", [](const MetTime& self) { return "<MetTime " + self.name + ">"; });
  nb::class_<SequenceChange>(module, "SequenceChange", "A difference between two impact sequences.")
      .def_prop_ro("kind", [](const SequenceChange& self) { return nameOf(self.kind); },
                   "'went', 'came', 'moved', 'mode', 'order', 'contact' or 'passed'.")
      .def_ro("before", &SequenceChange::before, "Index of the event of the motion before; -1 if none.")
      .def_ro("after", &SequenceChange::after, "Index of the event of the motion after; -1 if none.")
      .def_ro("matters", &SequenceChange::matters, "To the constraints.")
      .def("__str__", [](const SequenceChange& self) { return self.sentence; })
      .def("__repr__", [](const SequenceChange& self) { return "<SequenceChange: " + self.sentence + ">"; });
}

void bindChecks(nb::module_& module) {
  nb::class_<Certificate>(module, "Certificate", "Checks of a motion that are independent of how it was computed.")
      .def_ro("taken", &Certificate::taken, "False: nothing was checked, the numbers are unspecified.")
      .def_ro("residual", &Certificate::residual, "Largest |error| of a constraint, SI.")
      .def_ro("scaled_residual", &Certificate::scaled_residual, "The same, dimensionless.")
      .def_ro("energy_drift", &Certificate::energy_drift, "Largest relative change of the energy in a flight.")
      .def_ro("energy_gain", &Certificate::energy_gain, "Largest relative growth of the kinetic energy in an impact.")
      .def_ro("deepest_penetration", &Certificate::deepest_penetration, "m; None if it was not measured.")
      .def_ro("signature_radius", &Certificate::signature_radius,
              "First-order distance to the nearest boundary of the impact sequence, in the norm that the edit minimises; inf "
              "if none is found.")
      .def_ro("signature_event", &Certificate::signature_event, "What happens there; empty if none is found.")
      .def_prop_ro("signature_step", [](const Certificate& self) { return copied<ReadOnly<-1>>(self.signature_step); },
                   kOwnArray, "The change that leads there, one number per control parameter; empty if none is found.")
      .def("__repr__", [](const Certificate& self) {
        if (!self.taken) return std::string("<Certificate: nothing was checked>");
        return "<Certificate: residual " + numberText(self.residual) + ", energy drift " + numberText(self.energy_drift) +
               ", signature radius " + numberText(self.signature_radius) + ">";
      });
  nb::class_<WhyNot>(module, "WhyNot", "Diagnosis of an edit that does not meet its constraints.")
      .def_ro("sentences", &WhyNot::sentences, "All of it as text; empty if nothing was found.")
      .def_ro("rows", &WhyNot::rows, "Number of rows.")
      .def_ro("rank", &WhyNot::rank, "Of their derivatives with respect to the controls.")
      .def_ro("extended_rank", &WhyNot::extended_rank, "Of those with respect to all parameters that could vary.")
      .def("__repr__", [](const WhyNot& self) {
        std::string text = "<WhyNot";
        for (const std::string& sentence : self.sentences) text += "\n  " + sentence;
        return text + ">";
      });
}

void bindAlternative(nb::module_& module) {
  using Alternative = PyAlternative;
  nb::class_<Alternative>(module, "EditAlternative", "Another solution of an edit, verified like the result itself.")
      .def_prop_ro("scene", [](const Alternative& self) { return self.scene; }, "With its new values.")
      .def_prop_ro("changed", [](const Alternative& self) { return self.alternative.changed; }, nb::rv_policy::copy,
                   "Parameters that changed.")
      .def_prop_ro("objective", [](const Alternative& self) { return self.alternative.objective; }, "1/2 sum (w z)^2")
      .def_prop_ro("much_dearer", [](const Alternative& self) { return self.alternative.much_dearer; },
                   "Its objective is more than 10 times that of the result.")
      .def_prop_ro("residual", [](const Alternative& self) { return self.alternative.residual; }, "Largest |error|, SI.")
      .def_prop_ro("scaled_residual", [](const Alternative& self) { return self.alternative.scaled_residual; },
                   "The same, dimensionless.")
      .def_prop_ro("sequence", [](const Alternative& self) { return self.alternative.sequence; }, "One line per impact.")
      .def_prop_ro("sequence_changes", [](const Alternative& self) { return self.alternative.sequence_changes; },
                   nb::rv_policy::copy, "From the initial motion.")
      .def("__repr__", [](const Alternative& self) {
        std::string text = "<EditAlternative";
        for (const ChangedNumber& number : self.alternative.changed) text += "\n  " + changedText(number);
        return text + ">";
      });
}

template <class Value>
void bindMember(nb::class_<PyEditResult>& result, const char* name, Value EditResult::* member, const char* text) {
  result.def_prop_ro(name, [member](const PyEditResult& self) { return self.result.*member; }, nb::rv_policy::copy, text);
}

void bindOutcomeOf(nb::class_<PyEditResult>& result) {
  bindMember(result, "message", &EditResult::message, "What happened, in sentences.");
  bindMember(result, "met", &EditResult::met, "Verified: all constraints are met in `motion`, in a cancelled edit too.");
  bindMember(result, "changed", &EditResult::changed, "All control parameters.");
  bindMember(result, "residuals", &EditResult::residuals, "All constrained quantities.");
  bindMember(result, "soft_residuals", &EditResult::soft_residuals, "All quantities of soft constraints.");
  bindMember(result, "fit", &EditResult::fit, "To soft constraints.");
  bindMember(result, "times", &EditResult::times, "Of constraints that leave their time open.");
  bindMember(result, "residual", &EditResult::residual, "Largest |error| of the motion, SI (mixed units).");
  bindMember(result, "scaled_residual", &EditResult::scaled_residual, "The same, dimensionless.");
  bindMember(result, "objective", &EditResult::objective, "1/2 sum (w z)^2");
  bindMember(result, "iterations", &EditResult::iterations, "Of all stages together.");
  bindMember(result, "milliseconds", &EditResult::milliseconds, "Wall time.");
  bindMember(result, "sequence_before", &EditResult::sequence_before, "Of the initial motion, one line per impact.");
  bindMember(result, "sequence_after", &EditResult::sequence_after, "Of the result, one line per impact.");
  bindMember(result, "signature_changed", &EditResult::signature_changed,
             "Whether impacts that can affect the constraints differ.");
  bindMember(result, "sequence_changes", &EditResult::sequence_changes, "From the initial motion.");
  bindMember(result, "growth", &EditResult::growth, "Amplification of small changes in the initial motion.");
  bindMember(result, "certificate", &EditResult::certificate, "Of the motion.");
  bindMember(result, "why_not", &EditResult::why_not, "If the edit is infeasible or did not converge.");
}

}  // namespace

void bindEditResults(nb::module_& module) {
  bindNumbers(module);
  bindChecks(module);
  bindAlternative(module);
  nb::class_<PyEditResult> result(module, "EditResult", "Answer of an edit.");
  bindOutcomeOf(result);
  result
      .def_prop_ro("status", [](const PyEditResult& self) { return nameOf(self.result.status); },
                   "'solved', 'solved_sequence_changed', 'infeasible' (proven), 'not_converged', 'out_of_time', "
                   "'cancelled' or 'bad_start'.")
      .def_prop_ro("solved", [](const PyEditResult& self) { return self.result.solved(); },
                   "Verified, with any impact sequence, and not cancelled.")
      .def_prop_ro("scene", [](const PyEditResult& self) { return self.scene; },
                   "With its new values: the best point found, whatever the status.")
      .def_prop_ro("motion", [](const PyEditResult& self) { return self.motion; }, "Of that scene, simulated again.")
      .def_prop_ro("alternatives", &alternativesOf, nb::rv_policy::move, "Further solutions, if they were asked for.")
      .def_prop_ro("reliability",
                   [](const PyEditResult& self) { return PyReliability(self.result.reliability, self.scene.scene()); },
                   nb::rv_policy::move, "Of the derivatives at the result, worst row.")
      .def("_repr_html_", &shownInNotebook,
           "What a notebook shows: the status, a table of the changes, and a picture with the motion before dashed.")
      .def("__repr__", &reprOfResult);
}

}  // namespace carom::python
