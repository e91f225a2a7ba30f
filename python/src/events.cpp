// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/motion.hpp"

namespace carom::python {
namespace {

/// carom.Contact: one contact of an event, in the motion that it keeps.
struct PyContact {
  std::shared_ptr<const MotionContent> content;
  const Contact* contact;
  const Motion& motion() const { return content->motion; }
};

/// carom.Events: those of a motion, as a sequence.
struct PyEvents {
  std::shared_ptr<const MotionContent> content;
  const std::vector<Event>& all() const { return content->motion.events; }
  PyEvent at(long index) const {
    const long count = static_cast<long>(all().size());
    const long positive = index < 0 ? index + count : index;
    if (positive < 0 || positive >= count) throw nb::index_error("there is no such event");
    return {content, static_cast<int>(positive)};
  }
};

std::vector<PyEvent> eventsOf(const PyEvents& self, const nb::slice& which) {
  const auto [start, stop, step, count] = which.compute(self.all().size());
  std::vector<PyEvent> events;
  for (std::size_t k = 0; k < count; ++k) events.push_back(self.at(static_cast<long>(start) + static_cast<long>(k) * step));
  return events;
}

std::vector<PyContact> contactsOf(const PyEvent& self) {
  std::vector<PyContact> all;
  for (const Contact& contact : self.event().contacts) all.push_back({self.content, &contact});
  return all;
}

std::vector<std::string> participantsOf(const PyEvent& self) {
  std::vector<std::string> names;
  for (const Participant& participant : self.event().participants)
    names.push_back(nameIn(self.content->motion, participant.body));
  return names;
}

std::string describedEvent(const PyEvent& self) { return self.content->motion.describeEvent(self.index); }

std::pair<std::string, std::string> bodiesOfContact(const PyContact& self) {
  return {nameIn(self.motion(), self.contact->a), nameIn(self.motion(), self.contact->b)};
}

std::string featuresOf(const PyContact& self) {
  return self.motion().geometry->describe(self.contact->a, self.contact->b, self.contact->features);
}

nb::iterator eventsInOrder(const PyEvents& self) {
  nb::list events;
  for (long i = 0; i < static_cast<long>(self.all().size()); ++i) events.append(self.at(i));
  return nb::iter(events);
}

ReadOnly<-1> timesOf(const PyEvents& self) {
  std::vector<double> times;
  for (const Event& event : self.all()) times.push_back(event.time);
  const std::size_t count = times.size();
  return owning<ReadOnly<-1>>(std::move(times), {count});
}

template <class Word>
std::vector<std::string> wordsOf(const PyEvents& self, Word Event::* member) {
  std::vector<std::string> words;
  for (const Event& event : self.all()) words.emplace_back(nameOf(event.*member));
  return words;
}

template <class Number>
void bindNumber(nb::class_<PyContact>& contact, const char* name, Number Contact::* member, const char* text) {
  contact.def_prop_ro(name, [member](const PyContact& self) { return self.contact->*member; }, text);
}

void bindContact(nb::module_& module) {
  nb::class_<PyContact> contact(module, "Contact", "One contact of an event.");
  contact
      .def_prop_ro("bodies", &bodiesOfContact, nb::rv_policy::move, "Names of the two bodies, a and b.")
      .def_prop_ro("features", &featuresOf, "Where they meet: 'vertex 3 on face +z', in the order a, b.")
      .def_prop_ro("point", [](const PyContact& self) { return view(self.contact->at.point); }, "m, world")
      .def_prop_ro("normal", [](const PyContact& self) { return view(self.contact->at.normal); }, "Unit, from b to a.")
      .def_prop_ro("impulse_normal", [](const PyContact& self) { return view(self.contact->impulse_normal); },
                   "The normal that the impulse uses: `normal`, with the tilts of the scene.")
      .def_prop_ro("surface_velocity", [](const PyContact& self) { return view(self.contact->surface_velocity); },
                   "m/s, world: the velocity of a's moving surface less that of b's, beside the bodies' own.")
      .def_prop_ro("impulse", [](const PyContact& self) { return view(self.contact->impulse); }, "N s, on a")
      .def_prop_ro("elasticity", [](const PyContact& self) { return self.contact->pair.elasticity; },
                   "Coefficient of restitution in force.")
      .def_prop_ro("friction", [](const PyContact& self) { return self.contact->pair.friction; },
                   "Coulomb coefficient in force.")
      .def_prop_ro("tangential_elasticity",
                   [](const PyContact& self) { return self.contact->pair.tangential_elasticity; },
                   "Coefficient of tangential restitution in force.")
      .def("__repr__", [](const PyContact& self) {
        return "<Contact of '" + nameIn(self.motion(), self.contact->a) + "' and '" +
               nameIn(self.motion(), self.contact->b) + "', " + featuresOf(self) + ">";
      });
  bindNumber(contact, "approach", &Contact::approach, "m/s along the normal just before, < 0; about 0 if persistent.");
  bindNumber(contact, "counted", &Contact::counted, "Reported as an impact.");
  bindNumber(contact, "held", &Contact::held, "Persistent before the event.");
  bindNumber(contact, "lasts", &Contact::lasts, "Persistent from the event on.");
  bindNumber(contact, "captured", &Contact::captured, "Restitution was set to 0: its bounce would be too low.");
}

template <class Get>
void bindValue(nb::class_<PyEvent>& event, const char* name, Get get, const char* text) {
  event.def_prop_ro(name, [get](const PyEvent& self) { return get(self.event()); }, text);
}

void bindEvent(nb::module_& module) {
  nb::class_<PyEvent> event(module, "Event", "An event of a motion: the contacts of one instant, solved simultaneously.");
  event.def_ro("index", &PyEvent::index, "Among the events of its motion.")
      .def_prop_ro("contacts", &contactsOf, nb::rv_policy::move, "In increasing order of bodies.")
      .def_prop_ro("bodies", &participantsOf, nb::rv_policy::move, "Names of the moving bodies that take part.")
      .def("__str__", &describedEvent)
      .def("__repr__", [](const PyEvent& self) { return "<Event " + std::to_string(self.index) + ": " + describedEvent(self) + ">"; });
  bindValue(event, "time", [](const Event& e) { return e.time; }, "s");
  bindValue(event, "kind", [](const Event& e) { return nameOf(e.kind); },
            "'impact'; 'capture', after which contacts persist; 'transition', a change of contact mode without an impulse; "
            "or 'placed', a start in contact.");
  bindValue(event, "cause", [](const Event& e) { return nameOf(e.cause); }, "Of a transition: 'slip_ends', 'lifts', ...");
  bindValue(event, "mode", [](const Event& e) { return nameOf(e.mode); },
            "Branch of the impact law: 'frictionless', 'stick', 'slide' or 'joint'.");
  bindValue(event, "counts", [](const Event& e) { return e.counts(); }, "Is a reported impact of some body.");
  bindValue(event, "too_low", [](const Event& e) { return e.tooLow(); }, "Is an impact that is too low to be reported.");
  bindValue(event, "grazing", [](const Event& e) { return e.margins.grazing; },
            "Margin |n.u| / |u| before the impact: 0 is grazing, where derivatives do not exist.");
  bindValue(event, "stick_slip", [](const Event& e) { return e.margins.stick_slip; },
            "Margin from the boundary between sticking and sliding; 1 without friction.");
  bindValue(event, "wide", [](const Event& e) { return e.wide; }, "Computed with 32 digits.");
  bindValue(event, "settles_at", [](const Event& e) { return e.settles_at; },
            "Of a capture of one contact: s, when the infinite cascade of bounces would have ended; else None.");
}

}  // namespace

int eventOf(const MotionContent& motion, const EventName& event) {
  if (const auto* index = std::get_if<int>(&event)) return *index;
  const PyEvent& one = std::get<PyEvent>(event);
  if (one.content.get() != &motion) throw InputError("event", "found one of another motion");
  return one.index;
}

void bindEvents(nb::module_& module, nb::class_<PyMotion>& motion) {
  bindContact(module);
  bindEvent(module);
  nb::class_<PyEvents>(module, "Events", "The events of a motion in increasing order of time: a sequence, with columns.")
      .def("__len__", [](const PyEvents& self) { return self.all().size(); })
      .def("__getitem__", &PyEvents::at, nb::arg("index"))
      .def("__getitem__", &eventsOf, nb::arg("index"))
      .def("__iter__", &eventsInOrder, nb::sig("def __iter__(self) -> collections.abc.Iterator[Event]"))
      .def_prop_ro("time", &timesOf, kOwnArray, "s, one per event")
      .def_prop_ro("kind", [](const PyEvents& self) { return wordsOf(self, &Event::kind); }, "Event.kind of each.")
      .def_prop_ro("mode", [](const PyEvents& self) { return wordsOf(self, &Event::mode); }, "Event.mode of each.")
      .def("__repr__", [](const PyEvents& self) { return "<" + std::to_string(self.all().size()) + " events>"; });
  motion.def_prop_ro("events", [](const PyMotion& self) { return PyEvents{self.content}; }, nb::rv_policy::move,
                     "In increasing order of time; empty if they were not recorded.");
}

}  // namespace carom::python
