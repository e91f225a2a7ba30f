// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/base/errors.h"
#include "editing/session_journal.h"
#include "formats/base/document.h"
#include "studio/protocol.h"

/// Bodies that come, go, are copied and renamed: the whole content of a session after such a step. Bodies that stay are
/// taken over to the bit. All throw InputError for what the document cannot be.
namespace carom::studio {

/// A document as it is in a session: its controls and constraints are those of the content, in the same order.
struct EditedDocument {
  const Document& document;
  const SessionContent& content;
};

/// With a body of a document (JSON) at the end; where its name is taken it is "ball 2". `on`: it touches there, with its
/// shape's origin above the point.
SessionContent withBody(const EditedDocument& now, const std::string& body, const std::optional<OnSurface>& on);
/// Without a body, and without the controls, constraints and tilts that name it.
SessionContent withoutBody(const EditedDocument& now, const std::string& body);
/// With the same body again at the end, called "ball 2", beside it where nothing is in its way.
SessionContent withCopy(const EditedDocument& now, const std::string& body);
/// With another name for a body, wherever it is named.
SessionContent renamed(const EditedDocument& now, const std::string& body, const std::string& name);

/// Bodies would overlap at the start. The message names them.
class Overlap : public InputError {
 public:
  Overlap(const std::string& message, std::string body, std::optional<Vec3> place)
      : InputError(message), body_(std::move(body)), place_(std::move(place)) {}
  const std::string& body() const { return body_; }           ///< that was changed
  const std::optional<Vec3>& place() const { return place_; }  ///< m, of its shape's origin, where it is free; none found

 private:
  std::string body_;
  std::optional<Vec3> place_;
};
/// Throws Overlap where a body that is new, or placed or shaped otherwise than before, overlaps another.
void requireRoom(const Scene& scene, const Scene& before);

}  // namespace carom::studio
