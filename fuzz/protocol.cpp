// SPDX-License-Identifier: MIT
// Messages of a page of the studio, as they come from a socket; controls and constraints with a scene, as its session reads them.
#include <string>
#include <variant>

#include "fuzz/require.h"
#include "fuzz/targets.h"
#include "studio/protocol.h"

namespace carom::fuzz {
namespace {

using namespace studio;

constexpr double kDuration = 2;

Scene smallScene() {
  Scene scene;
  scene.materials.push_back(Material());
  scene.materials.back().name = "felt";
  Body floor, hat;
  floor.name = "coatrack", floor.fixed = true, floor.shape = Sphere{0.5};
  hat.name = "hat", hat.material = "felt", hat.shape = Sphere{0.1}, hat.mass = 0.2, hat.position = Vec3(0, 0, 2);
  scene.bodies = {floor, hat};
  return scene;
}

/// What is read with the scene, too.
void readParts(const Command& command) {
  static const Scene scene = smallScene();
  const auto controls = [&](const std::string& json) {
    if (!json.empty()) readControlsText(json, scene, "/controls");
  };
  const auto constraint = [&](const std::string& json) {
    if (!json.empty()) readConstraintText(json, scene, kDuration, "/constraint");
  };
  if (const auto* grab = std::get_if<Grab>(&command.what)) controls(grab->also_vary);
  if (const auto* set = std::get_if<SetControls>(&command.what)) controls(set->controls);
  if (const auto* nail = std::get_if<MakeNail>(&command.what)) constraint(nail->constraint);
  if (const auto* nail = std::get_if<SetNail>(&command.what)) constraint(nail->constraint);
}

}  // namespace

void readProtocol(std::string_view bytes) {
  try {
    const Command command = readCommand(bytes);
    require(command.id > 0, "a message has a number");
    require(!std::holds_alternative<Gone>(command.what) && !std::holds_alternative<Found>(command.what),
            "no message is one of the server's own");
    require(!(endsHold(command) && std::holds_alternative<Drag>(command.what)), "a drag ends nothing");
    readParts(command);
  } catch (const InputError& error) {
    requireMessage(error);
  }
}

}  // namespace carom::fuzz
