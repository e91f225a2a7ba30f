// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "formats/base/document.h"
#include "ode_bridge/ode_contacts.h"
#include "python/src/bindings.hpp"
#include "python/src/computing.hpp"

namespace carom::python {

/// A document with the contact sources of its simulations. Immutable for its users; any number of threads.
class SceneContent {
 public:
  /// `text`: what it was read from; it has every digit, of an inertia matrix, too.
  explicit SceneContent(Document of, std::optional<std::string> from_text = std::nullopt)
      : document(std::move(of)), text(std::move(from_text)) {}

  const Document document;
  const std::optional<std::string> text;

  /// A contact source for one simulation at a time, back in the scene once this ends: to make one takes as long as a
  /// short motion.
  class Contacts {
   public:
    explicit Contacts(const SceneContent& scene);
    ~Contacts();
    Contacts(const Contacts&) = delete;
    Contacts& operator=(const Contacts&) = delete;
    ContactSource& operator*() { return *source_; }

   private:
    const SceneContent& scene_;
    std::unique_ptr<OdeContacts> source_;
  };

 private:
  /// It goes to the thread that used it last, if that comes back: its memory is in the cache of that processor.
  struct Idle {
    std::unique_ptr<OdeContacts> source;
    std::thread::id last_used_by;
  };

  mutable std::mutex guard_;
  mutable std::vector<Idle> idle_;
};

/// carom.Scene.
struct PyScene {
  std::shared_ptr<const SceneContent> content;
  const Document& document() const { return content->document; }
  const Scene& scene() const { return content->document.scene; }
};

/// The scene of a document with other values, such as an edit's answer.
PyScene sceneWith(const PyScene& original, const Scene& values);

/// A body by name or by its index.
using BodyName = std::variant<std::string, int>;
/// Its index. Throws InputError for an unknown one.
int bodyOf(const Scene& scene, const BodyName& body);

void bindScene(nb::module_& module);

}  // namespace carom::python
