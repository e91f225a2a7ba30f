// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"

/// How far the impacts of a motion are from being others. Internal to editing/.
namespace carom::editing_detail {

/// One way in which the impacts of a motion can change: a number that is 0 where they do, with its derivative with respect to the
/// changes of an edit. To first order that is |value| / |gradient| away.
struct EventMargin {
  enum class Way {
    grazes,   ///< (n.u)^2 of a contact, m^2/s^2: near grazing it is the square that varies smoothly
    slides,   ///< mu P_n - w.P_t of a contact that sticks, N s, w the tangential direction in which it is nearest
    sticks,   ///< the same of a contact that slides, w along P_t; negative. P: before the cone cuts it back
    leaves,   ///< the value of a FeatureLimit: m, or a sine
    parts,    ///< gap of one contact of several at one instant: 0 as it is, m
    order,    ///< time from one impact to the next, s
    is_read,  ///< time from an impact to an instant at which a body of it is read, s; may be negative. Of a body that
              ///< is held at rest: time from its coming to rest to the end of the motion
  };
  Way way = Way::grazes;
  int event = -1;
  double value = 0;
  Eigen::VectorXd gradient;
  std::string what;  ///< "the impact of 'box' with 'wall' at 0.8 s starts to slide"

  /// |value| / |gradient|; infinite where nothing that varies has an influence.
  double distance() const;
};

/// An instant at which a constraint reads a body; body -1: all impacts up to then count.
struct ReadInstant {
  int body = -1;
  double time = 0;
  bool end = false;  ///< the end of the motion, which the impacts that count must come before
  int rest = -1;     ///< event with which `body` comes to rest, which must come before the end, too
};

/// The margins of the first `count` events, of the order up to the one after them, and of all events to the instants.
/// `byChanges` turns a derivative with respect to scene parameters into that with respect to the changes. Left out are bodies, and parts
/// of a compound, that nothing meets as it is and something would meet then.
std::vector<EventMargin> eventMargins(DerivativeTape& tape, std::size_t count, const std::vector<ReadInstant>& instants,
                                      const std::function<Eigen::VectorXd(const SceneGradient&)>& byChanges);

}  // namespace carom::editing_detail
