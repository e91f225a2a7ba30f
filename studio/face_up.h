// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "adjoint/motion/contact_source.h"
#include "editing/session_snapshot.h"
#include "studio/protocol.h"

namespace carom::studio {

/// A scene in which a body comes to rest with a face up.
struct FaceUpFound {
  std::optional<SessionContent> content;  ///< none: not found, or stopped
  std::string message;                    ///< why not; empty otherwise
  int tried = 0;                          ///< throws, or iterations of an edit
};

/// Looks for a throw with which a body comes to rest with the face of this normal up, and with its centre of mass at
/// `place` where that is given; up is against gravity, which has to be along -z. A body that no control names keeps its throw: it is held
/// another way round where its shape and mass are the same then, starts from elsewhere, and only where that does not do, its velocities
/// change, too, a little more with every try. A body with controls is edited within them, with what is nailed. `tell` is called with the
/// number of throws tried, now and then. Deterministic. Throws InputError for a body that cannot come to rest, an up that has no length,
/// and what edits throw. For the thread that owns `contacts`.
FaceUpFound findFaceUp(const SessionSnapshot& snapshot, ContactSource& contacts, const FaceUp& wanted,
                       const std::function<void(int)>& tell, const std::stop_token& stop);

}  // namespace carom::studio
