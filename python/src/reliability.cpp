// SPDX-License-Identifier: MIT
#include "python/src/derivatives.hpp"

namespace carom::python {
namespace {

std::vector<std::string> sentencesOf(const PyReliability& self) {
  const Reliability& of = self.reliability;
  std::vector<std::string> sentences;
  for (const std::string& text : {of.message, of.friction_message, of.beginning_message, of.seam_message})
    if (!text.empty()) sentences.push_back(text);
  return sentences;
}

std::string reprOfReliability(const PyReliability& self) {
  std::string text = self.reliability.reliable ? "<Reliability: reliable" : "<Reliability: not reliable";
  for (std::size_t i = 0; i < self.unreliable_for.size(); ++i)
    text += (i == 0 ? ", but not with respect to " : ", ") + self.unreliable_for[i];
  return text + ", smallest margin " + numberText(self.reliability.smallest_margin) + ">";
}

}  // namespace

PyReliability::PyReliability(const Reliability& of, const Scene& scene) : reliability(of) {
  const auto body = [&](int index) { return "'" + scene.bodies[static_cast<std::size_t>(index)].name + "'"; };
  for (const int material : of.frictions)
    unreliable_for.push_back("friction of '" + scene.materials[static_cast<std::size_t>(material)].name + "'");
  for (const int index : of.beginning) unreliable_for.push_back("velocity and angular_velocity of " + body(index));
  for (const int index : of.seams) unreliable_for.push_back("position, orientation and size of " + body(index));
}

void bindReliability(nb::module_& module) {
  nb::class_<PyReliability>(module, "Reliability",
                            "Reliability of a derivative: the smallest margins of the events that it passes through.")
      .def_prop_ro("reliable", [](const PyReliability& self) { return self.reliability.reliable; },
                   "No margin is below 1e-6. Says nothing of what `unreliable_for` names.")
      .def_ro("unreliable_for", &PyReliability::unreliable_for,
              "Parameters with respect to which the derivative is unreliable, one-sided or undefined, in words.")
      .def_prop_ro("sentences", &sentencesOf, "The reasons; empty if nothing is unreliable.")
      .def_prop_ro("events", [](const PyReliability& self) { return self.reliability.events; },
                   "Number of events that the quantity depends on.")
      .def_prop_ro("smallest_margin", [](const PyReliability& self) { return self.reliability.smallest_margin; },
                   "Distance from where derivatives do not exist, dimensionless.")
      .def_prop_ro("message", [](const PyReliability& self) { return self.reliability.message; },
                   "The reason if it is not reliable.")
      .def("__repr__", &reprOfReliability);
}

}  // namespace carom::python
