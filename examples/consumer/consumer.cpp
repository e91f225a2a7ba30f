// SPDX-License-Identifier: MIT
// Simulates a scene document and asks how the place of its last body at the end depends on its throw.
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

int main(int count, char** arguments) try {
  if (count != 2) {
    std::fprintf(stderr, "usage: consumer scene.json\n");
    return 2;
  }
  const carom::Document document = carom::readDocument(arguments[1]);
  carom::OdeContacts contacts(document.scene);
  const carom::Motion motion = carom::simulate(document.scene, contacts, document.duration);

  carom::StateSeed along_x;  // the x of the last body at the end
  along_x.body = static_cast<int>(document.scene.bodies.size()) - 1;
  along_x.at = carom::Instant::at(motion.end);
  along_x.position = carom::Vec3::UnitX();
  const carom::SceneGradient gradient = carom::adjoint(motion, std::vector{along_x});
  const carom::Vec3 by_velocity = gradient.bodies.back().velocity;

  std::printf("%s: %zu impacts, dx/dv = %g %g %g s\n", document.scene.bodies.back().name.c_str(), motion.events.size(),
              by_velocity.x(), by_velocity.y(), by_velocity.z());
  return by_velocity.allFinite() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "consumer: %s\n", error.what());
  return 1;
}
