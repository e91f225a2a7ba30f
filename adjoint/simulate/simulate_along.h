// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"

namespace carom {

/// A motion along a given impact sequence.
struct MotionAlong {
  Motion motion;          ///< with events, so that it can be differentiated
  bool complete = false;  ///< every impact of the sequence up to the duration was found
  std::string why_not;    ///< the reason if not complete; then the motion is known up to motion.end only

  std::size_t left_out = 0;    ///< impacts after the duration, or after such a one of the same body
  bool order_changed = false;  ///< impacts of different bodies have another order in time than in `like`
  bool mode_changed = false;   ///< an impact sticks that slid in `like`, or the reverse
};

/// The motion of `scene` constrained to the impact sequence of `like`: the same bodies meet with the same features,
/// each body in the same order. An impact is where the gap of these features reaches zero from above, found by
/// Newton's method from its previous time; no other impacts are searched for. So the motion varies smoothly with the
/// scene where `simulate` jumps to another sequence: features extend past their edges, and bodies pass through others
/// that they did not meet in `like`. Equals the motion of `simulate` if that has the same signature, which is not
/// checked.
///
/// `geometry` is that of `scene`: ContactSource::geometry() after begin(scene), or like.geometry if all dimensions
/// and centres of mass are those of like's scene. With the scene of `like` the result is `like` to the last bit.
///
/// A joint impact stays one as long as its contacts meet within one instant (docs/equations.md section 4); its time
/// is that of the mean gap, weighted by the normal impulses in `like`. Overlaps at the start are those of `like`.
///
/// Throws InputError if `scene` is invalid, or has other bodies, materials or tilts than like's scene.
MotionAlong simulateAlong(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry,
                          double duration);
/// A duration is in seconds, no bool and no character.
template <NoTime T>
MotionAlong simulateAlong(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry, T duration) = delete;

}  // namespace carom
