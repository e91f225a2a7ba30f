// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/session_alternatives.h"
#include "editing/session_remedies.h"
#include "studio/face_up.h"
#include "studio/mailbox.h"
#include "studio/views.h"

namespace carom::studio {

/// What was found for a question of a page, in the background.
struct Findings {
  std::int64_t question = 0;  ///< the number that the worker gave it
  bool more = false;          ///< it is looked on for
  std::string problem;        ///< why nothing was found; empty otherwise
  SessionWhyNot why;          ///< what would help
  SessionAlternatives others;                             ///< other motions that meet the same
  std::vector<std::shared_ptr<const MotionView>> motions;  ///< of each of them
  FaceUpFound face;                                        ///< a body with a face up
  std::shared_ptr<const Motion> first;                     ///< the first answer to a sketch
  std::optional<SessionContent> fitted;                    ///< the scene whose path goes along it, with its nails
};

/// Puts what would help into the mailbox, again and again as it is found out, until `more` is false. Stopped: nothing any more.
void findRemedies(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const std::stop_token& stop);
/// The same with at most `most` other motions, once.
void findAlternatives(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, int most,
                      const std::stop_token& stop);
/// The same with a body with a face up: the number of tries again and again, the scene at the end.
void findFaceUpFor(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const FaceUp& wanted,
                   const std::stop_token& stop);
/// The same with a path along a drawn curve: the first answer, then the scene.
void findSketchFor(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const Sketch& wanted,
                   const std::stop_token& stop);

}  // namespace carom::studio
