// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::test {

/// The motion of a scene whose bodies must not overlap at the start: throws InputError where they do.
inline Motion playRefusing(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.refuse_overlaps = true;
  return simulate(scene, contacts, duration, options);
}

}  // namespace carom::test
