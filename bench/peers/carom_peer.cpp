// SPDX-License-Identifier: MIT
// carom on the work of its peers: reads a scene document, simulates it, reads numbers at the end and derives each by
// every number of the scene in one adjoint pass; prints all, and the time of one simulation with its derivatives.
//   carom_peer scene.json REPETITIONS BODY.QUANTITY.INDEX...   QUANTITY: position velocity angular_velocity rotation

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

struct Wanted {
  int body = 0, index = 0;
  std::string quantity;
};

struct Answer {
  std::vector<double> values;
  std::vector<SceneGradient> rows;
};

Wanted parse(const Scene& scene, const std::string& text) {
  std::istringstream in(text);
  std::string body, quantity, index;
  std::getline(in, body, '.');
  std::getline(in, quantity, '.');
  std::getline(in, index);
  return {bodyIndex(scene, body), std::stoi(index), quantity};
}

// Value of one number, and the seed of its derivatives. The rotation matrix is numbered row by row.
double read(const Wanted& wanted, const BodyState& state, StateSeed& seed) {
  const int i = wanted.index;
  if (wanted.quantity == "position") return seed.position[i] = 1, state.position[i];
  if (wanted.quantity == "velocity") return seed.velocity[i] = 1, state.velocity[i];
  if (wanted.quantity == "angular_velocity") return seed.angular_velocity[i] = 1, state.angular_velocity[i];
  if (wanted.quantity != "rotation") throw std::invalid_argument("'" + wanted.quantity + "' is not known");
  const Vec3 column = state.orientation.toRotationMatrix().col(i % 3);
  seed.orientation = column.cross(Vec3::Unit(i / 3));  // (turn x column) . e_i = turn . (column x e_i)
  return column[i / 3];
}

Answer answer(const Document& document, ContactSource& contacts, const std::vector<Wanted>& wanted) {
  const Motion motion = simulate(document.scene, contacts, document.duration);
  if (motion.status != MotionStatus::complete) throw std::runtime_error(motion.message);
  DerivativeTape tape(motion);
  Answer result;
  for (const Wanted& one : wanted) {
    StateSeed seed;
    seed.body = one.body;
    seed.at = Instant::at(document.duration);
    result.values.push_back(read(one, motion.stateAt(one.body, document.duration), seed));
    result.rows.push_back(adjoint(tape, std::span(&seed, 1)));
  }
  return result;
}

void print(const Vec3& v) { std::printf("[%.17g,%.17g,%.17g]", v.x(), v.y(), v.z()); }

void print(const Document& document, const Answer& result, double seconds) {
  std::printf("{\"seconds\":%.6g,\"rows\":[", seconds);
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const SceneGradient& row = result.rows[k];
    std::printf("%s{\"value\":%.17g,\"elasticity\":%.17g,\"bodies\":{", k ? "," : "", result.values[k],
                row.materials[0].elasticity);
    for (std::size_t i = 0; i < row.bodies.size(); ++i) {
      const BodyDerivative& body = row.bodies[i];
      std::printf("%s\"%s\":{\"mass\":%.17g,\"position\":", i ? "," : "", document.scene.bodies[i].name.c_str(),
                  body.mass);
      print(body.position);
      std::printf(",\"velocity\":"), print(body.velocity);
      std::printf(",\"angular_velocity\":"), print(body.angular_velocity);
      std::printf(",\"inertia\":"), print(body.inertia);
      std::printf("}");
    }
    std::printf("}}");
  }
  std::printf("]}\n");
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3) throw std::invalid_argument("carom_peer scene.json REPETITIONS BODY.QUANTITY.INDEX...");
  const Document document = readDocument(arguments[0]);
  OdeContacts contacts(document.scene);
  std::vector<Wanted> wanted;
  for (std::size_t i = 2; i < arguments.size(); ++i) wanted.push_back(parse(document.scene, arguments[i]));
  double best = std::numeric_limits<double>::infinity();
  Answer result;
  for (int i = std::stoi(arguments[1]); i > 0; --i) {
    const auto start = std::chrono::steady_clock::now();
    result = answer(document, contacts, wanted);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  print(document, result, best);
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  try {
    carom::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carom_peer: %s\n", error.what());
    return 1;
  }
  return 0;
}
