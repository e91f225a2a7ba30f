// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/motion/contact_source.h"
#include "editing/session_snapshot.h"

namespace carom {

/// A change of what may vary, or of what is held, with which a target that was not reached may be.
struct SessionRemedy {
  /// Kind of remedy.
  enum class Kind {
    vary,     ///< a further control
    widen,    ///< a bound of a control further out
    release,  ///< without a nail
  };
  Kind kind = Kind::vary;  ///< which of them
  std::string name;        ///< what it does: "Let the elasticity of 'felt' change"
  double removes = 0;      ///< share of the error removed, to first order; in [0, 1]
  bool tried = false;      ///< solved for with it
  bool solves = false;     ///< and everything was met: verified
  /// The session with it, for EditSession::setContent; the scene is the solution where it solves, otherwise as it was.
  SessionContent content;
};
/// "vary", "widen" or "release".
const char* nameOf(SessionRemedy::Kind kind);

/// Why a gesture did not reach its target, and what would help.
struct SessionWhyNot {
  std::string sentence;  ///< what stands in its way beyond SessionObstacle; may be empty
  /// Those that solve first; gravity, tilts and fixed bodies behind the others; then by `removes`.
  std::vector<SessionRemedy> remedies;
};

/// Diagnoses a gesture that did not reach its target (SessionSnapshot::reached): by first derivatives where it ended, as
/// WhyNot does, and by solving with each remedy, each for at most half a second. `told` is called with what is known
/// before the first of these and after each. Empty if the target was reached. For the thread that owns `contacts`.
SessionWhyNot whyNot(const SessionSnapshot& snapshot, ContactSource& contacts,
                     const std::function<void(const SessionWhyNot&)>& told = {}, std::stop_token stop = {});

}  // namespace carom
