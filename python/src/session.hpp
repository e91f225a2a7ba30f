// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "editing/session.h"
#include "python/src/edit.hpp"

namespace carom::python {

/// A session with what it keeps by reference.
class PySessionContent {
 public:
  PySessionContent(PyScene of, double duration, std::vector<Control> controls, std::vector<Constraint> nails,
                  const SessionOptions& options)
      : scene(std::move(of)),
        contacts(*scene.content),
        session(scene.scene(), *contacts, duration, std::move(controls), std::move(nails), options) {}

  const PyScene scene;  ///< initial
  SceneContent::Contacts contacts;
  EditSession session;
  OneAtATime one;
};

/// carom.EditSession.
struct PySession {
  std::shared_ptr<PySessionContent> content;
};

/// carom.SessionUpdate; its motion is made for Python when it is asked for, and then kept.
struct PyUpdate {
  PyScene original;
  SessionUpdate update;
  std::optional<PyMotion> motion = std::nullopt;
};

/// Calls `call` with the session and a stop token, without the GIL, in a thread of its own: Ctrl-C ends it.
template <class Call>
void callLong(const PySession& self, Call call) {
  InCallback::refuse();
  const OneAtATime::Use use(self.content->one, "the session");
  std::stop_source stop;
  runInterruptible(stop, [&] { call(self.content->session, stop); });
}

/// The same in this thread, for what ends soon by itself: a thread takes as long as half an update of a drag.
template <class Call>
PyUpdate callShort(const PySession& self, Call call) {
  InCallback::refuse();
  const OneAtATime::Use use(self.content->one, "the session");
  const Computing free;
  return {self.content->scene, call(self.content->session)};
}

/// Reads the session, or changes what is not solved for; not while it computes. Without the GIL: what is read is C++.
template <class Read>
auto readFrom(const PySession& self, Read read) {
  const OneAtATime::Use use(self.content->one, "the session");
  const Computing free;
  return read(self.content->session);
}

void bindSessions(nb::module_& module);
void bindSessionUpdates(nb::module_& module);
void bindGestures(nb::class_<PySession>& session);
void bindSessionContent(nb::class_<PySession>& session);
void bindReplay(nb::module_& module);
void bindSessionNails(nb::module_& module, nb::class_<PySession>& session);

}  // namespace carom::python
