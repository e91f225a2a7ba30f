// SPDX-License-Identifier: MIT
#include <exception>

#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/session.hpp"

namespace carom::python {
namespace {

using Words = std::vector<std::string>;
using Place = std::optional<ArrayLike>;

PyUpdate grabbed(const PySession& self, const std::string& body, const WhenArgument& at, const Place& body_point,
                 bool contact, bool orientation, const Words& components, bool place,
                 const std::vector<Control>& also_vary, bool where_nothing_moves_it) {
  Grip grip;
  if (body_point) grip.body_point = vectorOf(*body_point, "body_point");
  grip.contact = contact;
  grip.orientation = orientation;
  grip.components = components;
  grip.place = place;
  const AlsoVary wanted = where_nothing_moves_it ? AlsoVary::where_nothing_moves_it : AlsoVary::always;
  const When when = whenOf(at);
  return callShort(self, [&](EditSession& session) { return session.grab(body, when, grip, also_vary, wanted); });
}

PyUpdate dragged(const PySession& self, const ArrayLike& place, const Place& orientation) {
  const Vec3 to = vectorOf(place, "place");
  const std::optional<Quat> turned = orientation ? std::optional(quaternionOf(*orientation, "orientation")) : std::nullopt;
  return callShort(self, [&](EditSession& session) {
    return turned ? session.dragTo(to, *turned) : session.dragTo(to);
  });
}

PyUpdate slid(const PySession& self, const ArrayLike& place, const Words& components) {
  const Vec3 to = vectorOf(place, "place");
  return callShort(self, [&](EditSession& session) { return session.slideTo(to, components); });
}

/// A call that gives an update and may take long.
template <class Call>
PyUpdate updated(const PySession& self, Call call) {
  std::optional<SessionUpdate> update;
  callLong(self, [&](EditSession& session, std::stop_source& stop) { update = call(session, stop.get_token()); });
  return {self.content->scene, std::move(*update)};
}

PyUpdate dwelt(const PySession& self, const nb::object& better) {
  requireFunction(better, "better");
  std::exception_ptr raised;
  std::optional<SessionUpdate> update;
  callLong(self, [&](EditSession& session, std::stop_source& stop) {
    const auto tell = [&](const SessionUpdate& found) {
      const GilHeld held;
      const InCallback in;
      try {
        calledBack(better, PyUpdate{self.content->scene, found});
      } catch (...) {
        raised = std::current_exception();
        stop.request_stop();
      }
    };
    update = better.is_none() ? session.dwell(stop.get_token()) : session.dwell(stop.get_token(), tell);
  });
  if (raised) std::rethrow_exception(raised);
  return {self.content->scene, std::move(*update)};
}

PyUpdate releasedNailed(const PySession& self, const std::string& at) {
  if (at != "target" && at != "where_it_got")
    throw InputError("at", "found '" + at + "', expected 'target' or 'where_it_got'");
  const NailAt where = at == "target" ? NailAt::target : NailAt::where_it_got;
  return updated(self, [&](EditSession& session, std::stop_token stop) { return session.releaseNailed(where, stop); });
}

void bindGrabs(nb::class_<PySession>& session) {
  const auto none = nb::none();
  session
      .def("grab", &grabbed, nb::arg("body"), nb::arg("at"), nb::kw_only(), nb::arg("body_point") = none,
           nb::arg("contact") = false, nb::arg("orientation") = false, nb::arg("components") = Words(),
           nb::arg("place") = true, nb::arg("also_vary") = std::vector<Control>(),
           nb::arg("where_nothing_moves_it") = false,
           "Grabs a moving body at a time, s, or an impact (nth_impact), or at rest. Everything up to `release` is one undo "
           "step. body_point: a point in the axes of the shape (default: its origin). contact: of an impact, the mean of its "
           "contacts. orientation: hold it as well. components: those that are held, 'x', 'y', 'z'; empty: all. place=False: "
           "the orientation alone. also_vary: controls that are added, only `where_nothing_moves_it` if that is set.")
      .def("grab_nail",
           [](const PySession& self, int id) {
             return callShort(self, [&](EditSession& of) { return of.grabNail(NailId{id}); });
           },
           nb::arg("id"), "Grabs a nail: its target position is dragged.")
      .def("drag_to", &dragged, nb::arg("place"), nb::arg("orientation") = none,
           "Moves the grabbed point to a place in the world, m, or towards it; with an orientation, w, x, y, z, for grips that "
           "hold it.")
      .def("slide_to", &slid, nb::arg("place"), nb::arg("components"),
           "For grips of a contact, over a surface: these two components are held from here on.");
}

}  // namespace

void bindGestures(nb::class_<PySession>& session) {
  bindGrabs(session);
  session
      .def("dwell", &dwelt, nb::arg("better") = nb::none(),
           nb::sig("def dwell(self, better: collections.abc.Callable[[SessionUpdate], object] | None = None) -> "
                   "SessionUpdate"),
           "Continues towards the same target without a time limit. `better` is called with each better motion, in another "
           "thread; it must not call the session.")
      .def("release",
           [](const PySession& self) {
             return updated(self, [](EditSession& of, std::stop_token stop) { return of.release(stop); });
           },
           "Ends the drag: minimises the change, or searches further for the target if it was not reached.")
      .def("release_nailed", &releasedNailed, nb::arg("at") = "target",
           "The same, and leaves a nail: at the last 'target', or 'where_it_got'.")
      .def("cancel",
           [](const PySession& self) { return callShort(self, [](EditSession& of) { return of.cancel(); }); },
           "Ends the drag and restores the state before the grab.")
      .def_prop_ro("is_grabbed",
                   [](const PySession& self) { return readFrom(self, [](EditSession& of) { return of.isGrabbed(); }); },
                   "Between grab and release, or cancel.")
      .def("undo", [](const PySession& self) { return callShort(self, [](EditSession& of) { return of.undo(); }); },
           "Undoes one step; within a gesture, cancels it.")
      .def("redo", [](const PySession& self) { return callShort(self, [](EditSession& of) { return of.redo(); }); },
           "Redoes one step.");
}

}  // namespace carom::python
