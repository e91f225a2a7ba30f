// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/motion/lasting_contact.h"
#include "python/src/motion.hpp"

namespace carom::python {
namespace {

/// carom.PersistentContact, with names in place of indices.
struct PyPersistentContact {
  std::string body, with, kind;
  std::vector<std::string> features;
  double from = 0, to = 0;
};

/// carom.StartOverlap, likewise.
struct PyOverlap {
  std::string a, b, text;
  double depth = 0;
  std::optional<double> parted;
};

std::vector<PyPersistentContact> contactsOfMotion(const PyMotion& self) {
  const Computing free;
  const Motion& motion = self.motion();
  std::vector<PyPersistentContact> all;
  for (const LastingContact& contact : lastingContacts(motion)) {
    const auto [a, b] = std::minmax(contact.body, contact.with);  // the order of features
    std::vector<std::string> features;
    for (const FeaturePair& pair : contact.features) features.push_back(motion.geometry->describe(a, b, pair));
    all.push_back({nameIn(motion, contact.body), nameIn(motion, contact.with), nameOf(contact.kind), std::move(features),
                   contact.from, contact.to});
  }
  return all;
}

std::vector<PyOverlap> overlapsOf(const PyMotion& self) {
  const Computing free;
  const Motion& motion = self.motion();
  std::vector<PyOverlap> all;
  for (const StartOverlap& overlap : motion.overlaps)
    all.push_back({nameIn(motion, overlap.a), nameIn(motion, overlap.b), describeOverlap(*motion.scene, overlap),
                   overlap.depth, overlap.parted});
  return all;
}

std::string reprOfContact(const PyPersistentContact& self) {
  return "<PersistentContact: '" + self.body + "' on '" + self.with + "', " + self.kind + ", " + numberText(self.from) +
         " to " + numberText(self.to) + " s>";
}

}  // namespace

void bindPersistentContacts(nb::module_& module, nb::class_<PyMotion>& motion) {
  using Persistent = PyPersistentContact;
  nb::class_<Persistent>(module, "PersistentContact", "A body rests, slides, rolls, pivots or rides on another one.")
      .def_ro("body", &Persistent::body, "Name of the body on a path in contact.")
      .def_ro("with_", &Persistent::with, "Name of what it is in contact with.")
      .def_ro("kind", &Persistent::kind, "'rest', 'slide', 'roll', 'pivot' or 'ride'.")
      .def_ro("features", &Persistent::features, "Where the two touch, in the order of bodies in the scene.")
      .def_ro("from_", &Persistent::from, "s")
      .def_ro("to", &Persistent::to, "s; the end of the motion if it continues.")
      .def("__repr__", &reprOfContact);
  nb::class_<PyOverlap>(module, "StartOverlap",
                        "Two bodies that overlap at the start; they do not collide until they have separated.")
      .def_ro("a", &PyOverlap::a, "Name of a body.")
      .def_ro("b", &PyOverlap::b, "Name of the other one.")
      .def_ro("depth", &PyOverlap::depth, "m, at the start")
      .def_ro("parted", &PyOverlap::parted, "s; None if they overlap up to the end of the motion.")
      .def("__str__", [](const PyOverlap& self) { return self.text; })
      .def("__repr__", [](const PyOverlap& self) { return "<StartOverlap: " + self.text + ">"; });
  motion.def_prop_ro("contacts", &contactsOfMotion, nb::rv_policy::move,
                     "All persistent contacts, by increasing start time. Raises InputError if events were not recorded.")
      .def_prop_ro("overlaps", &overlapsOf, nb::rv_policy::move, "Pairs that overlap at the start.");
}

}  // namespace carom::python
