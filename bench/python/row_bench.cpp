// SPDX-License-Identifier: MIT
// What bench/python/figures.py compares Python with: simulations of a scene with one adjoint row each, in
// microseconds of the processor.
//   row_bench SCENE BODY ROUNDS     prints the least time of the rounds; the row is the x of the body at the end
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: row_bench SCENE BODY ROUNDS\n");
    return 2;
  }
  constexpr int kCalls = 2000;  // of a round
  const Document document = readDocument(argv[1]);
  OdeContacts contacts(document.scene);
  StateSeed seed;
  seed.body = bodyIndex(document.scene, argv[2]), seed.at = Instant::at(document.duration), seed.position = {1, 0, 0};
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int round = std::atoi(argv[3]); round > 0; --round) {
    const std::clock_t began = std::clock();  // of the processor: other processes count little
    for (int i = 0; i < kCalls; ++i) {
      const Motion motion = simulate(document.scene, contacts, document.duration);
      Reliability reliability;
      sum += adjoint(motion, std::span(&seed, 1), &reliability).bodies[static_cast<std::size_t>(seed.body)].velocity.x();
    }
    least = std::min(least, 1e6 * static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / kCalls);
  }
  std::printf("%.4f\n", least);
  return sum == sum ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "row_bench: %s\n", error.what());
  return 1;
}
