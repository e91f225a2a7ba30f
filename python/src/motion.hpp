// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "python/src/scene.hpp"

namespace carom::python {

/// A motion and, once it is differentiated, its tape: they cannot part. The tape is destroyed first.
class MotionContent {
 public:
  explicit MotionContent(std::shared_ptr<const Motion> of) : motion(*of), kept_(std::move(of)) {}

  const Motion& motion;

  /// Calls `use` with the tape, for one thread at a time. Not with the GIL: its holder may be who is waited for. Throws
  /// RuntimeError in a callback of `use`, which would wait for itself.
  template <class Use>
  auto withTape(Use use) const {
    if (user_ == std::this_thread::get_id())
      throw std::runtime_error("a callback of a derivative must not differentiate the same motion");
    const std::lock_guard lock(guard_);
    const User user(user_);
    if (!tape_) tape_ = std::make_unique<DerivativeTape>(motion);
    return use(*tape_);
  }

 private:
  class User {
   public:
    explicit User(std::atomic<std::thread::id>& user) : user_(user) { user_ = std::this_thread::get_id(); }
    ~User() { user_ = std::thread::id(); }
    User(const User&) = delete;
    User& operator=(const User&) = delete;

   private:
    std::atomic<std::thread::id>& user_;
  };

  std::shared_ptr<const Motion> kept_;
  mutable std::mutex guard_;
  mutable std::atomic<std::thread::id> user_;
  mutable std::unique_ptr<DerivativeTape> tape_;
};

/// carom.Motion; keeps its scene.
struct PyMotion {
  PyScene scene;
  std::shared_ptr<const MotionContent> content;
  const Motion& motion() const { return content->motion; }
};
PyMotion motionOf(const PyScene& scene, Motion motion);
PyMotion motionOf(const PyScene& scene, std::shared_ptr<const Motion> motion);

/// carom.Event: one event of a motion, which it keeps.
struct PyEvent {
  std::shared_ptr<const MotionContent> content;
  int index = 0;
  const Event& event() const { return content->motion.events[static_cast<std::size_t>(index)]; }
};

/// An event itself or its index.
using EventName = std::variant<PyEvent, int>;
/// Its index. Throws InputError for one of another motion; an index is checked where it is used.
int eventOf(const MotionContent& motion, const EventName& event);

/// Whether to delete it takes so long that others get the GIL meanwhile: with 4000 events it takes half a millisecond.
inline bool takesLong(const Motion& motion) { return motion.events.size() + motion.world_lines.size() > 300; }

/// The name of a body.
inline const std::string& nameIn(const Motion& motion, int body) {
  return motion.scene->bodies[static_cast<std::size_t>(body)].name;
}

void bindSimulate(nb::module_& module);
void bindMotion(nb::module_& module);
void bindEvents(nb::module_& module, nb::class_<PyMotion>& motion);
void bindPersistentContacts(nb::module_& module, nb::class_<PyMotion>& motion);
void bindSamples(nb::module_& module, nb::class_<PyMotion>& motion);

}  // namespace carom::python
