// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/cases.h"
#include "tests/reference/replay.h"

namespace carom::reference {

inline Sequence sequenceOf(const Motion& motion) {
  Sequence sequence;
  for (const Event& event : motion.events) {
    if (event.contacts.size() != 1) throw std::runtime_error("the reference knows no joint impacts");
    const Contact& c = event.contacts[0];
    sequence.push_back({event.time, c.a, c.b, c.at.point, c.at.normal});
  }
  return sequence;
}

/// A scene simulated, and replayed along the product's own sequence.
struct Replayed {
  Scene scene;
  Motion motion;
  Reference reference;
};

inline Replayed replayOf(const Case& c, bool backwards) {
  Scene scene = backwards ? reversed(c.scene()) : c.scene();
  OdeContacts contacts(scene);
  Motion motion = simulate(scene, contacts, c.duration);
  Reference reference(scene, sequenceOf(motion));
  return {std::move(scene), std::move(motion), std::move(reference)};
}

inline std::vector<Row> rowsOf(const Replayed& run, double duration) {
  std::vector<Row> rows;
  for (std::size_t body = 0; body < run.scene.bodies.size(); ++body) {
    if (run.scene.bodies[body].fixed) continue;
    for (int i = 0; i < kTimeComponent; ++i) rows.push_back({static_cast<int>(body), -1, duration, i});
  }
  for (std::size_t event = 0; event < run.motion.events.size(); ++event) {
    for (const Participant& p : run.motion.events[event].participants) {
      for (int i = 0; i <= kTimeComponent; ++i) rows.push_back({p.body, static_cast<int>(event), 0, i});
    }
  }
  return rows;
}

inline StateSeed seedOf(const Row& row) {
  StateSeed seed;
  seed.body = row.body;
  seed.at = row.event < 0 ? Instant::at(row.time) : Instant::before(row.event);
  Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
  (row.component == kTimeComponent ? seed.time : (*parts[row.component / 3])[row.component % 3]) = 1;
  return seed;
}

}  // namespace carom::reference
