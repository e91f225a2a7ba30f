// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "adjoint/motion/motion.h"

namespace carom {

/// A motion along a given impact sequence.
struct MotionAlong {
  Motion motion;          ///< with events, so that it can be differentiated
  bool complete = false;  ///< every impact that was to be found up to the duration was found
  std::string why_not;    ///< a sentence when not complete; then the motion is known up to motion.end only

  std::size_t left_out = 0;    ///< impacts that come after the duration, or after such a one of the same body
  bool order_changed = false;  ///< impacts of different bodies come in another order of time than in `like`
  bool mode_changed = false;   ///< an impact sticks that slid in `like`, or the other way round
};

/// The motion of `scene` when its impacts are those of `like`: the same bodies meet with the same features, each body
/// in the same order. An impact is where the gap of these features comes to zero from above, found by Newton's method
/// from where it was; nothing else is looked for. So the motion varies smoothly with the scene where `simulate` jumps
/// to another sequence: features go on past their edges, and bodies pass through what they did not meet before.
/// Whether `simulate` would give this motion is not said; it does where it has the same signature.
///
/// `geometry` is that of `scene`: ContactSource::geometry() after begin(scene), or like.geometry where all dimensions
/// and centres of mass are those of like's scene. With the scene of `like` the answer is `like` to the last bit.
///
/// A joint impact goes on as long as its contacts meet within one instant (docs/equations.md section 4); its time is
/// that of the mean gap, weighted by the normal impulses that it had in `like`. Overlaps at the start are those of
/// `like`.
///
/// Throws InputError where `scene` has not the bodies, materials and tilts of like's scene, or makes no sense.
MotionAlong simulateAlong(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry,
                          double duration);

}  // namespace carom
