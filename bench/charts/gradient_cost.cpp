// SPDX-License-Identifier: MIT
// What a gradient costs, over what the simulation costs, as controls, impacts and bodies become more; and what memory
// the motion and its linearisations take.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart.h"
#include "bench/pen.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

constexpr double kLongest = 1000;  // s of motion; the impacts end it
constexpr std::size_t kImpacts = 1000;

double heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

// One number that depends on all bodies: the sum of the coordinates of their places at the end.
std::vector<StateSeed> seedsOf(const Motion& motion) {
  std::vector<StateSeed> seeds;
  for (std::size_t i = 0; i < motion.scene->bodies.size(); ++i) {
    if (motion.scene->bodies[i].fixed) continue;
    StateSeed& seed = seeds.emplace_back();
    seed.body = static_cast<int>(i);
    seed.at = Instant::at(motion.end);
    seed.position = Vec3::Ones();
  }
  return seeds;
}

struct Run {
  Scene scene;
  Motion motion;
  double simulate = 0, motion_bytes = 0;

  Run(Scene made, std::size_t impacts) : scene(std::move(made)) {
    scene.gravity.setZero();  // so that nothing comes to rest
    SimulateOptions options;
    options.impact_limit = impacts;
    OdeContacts contacts(scene);
    const auto play = [&] { motion = carom::simulate(scene, contacts, kLongest, options); };
    play();
    motion = {};
    const double before = heapBytes();
    play();
    motion_bytes = heapBytes() - before;
    simulate = bestSeconds(play, 0.15, 200);
    if (motion.status != MotionStatus::impact_limit)
      throw std::runtime_error("a pen comes to an end after " + std::to_string(motion.impacts) +
                               " impacts: " + motion.message);
  }
};

struct Columns {
  Csv& csv;
  void row(const std::string& part, const std::string& scene, const Run& run, int controls, const std::string& method,
           double seconds, double bytes) const {
    csv.row({part, scene, controls, run.motion.impacts, movingBodies(run.scene), method, run.simulate, seconds,
             seconds / run.simulate, bytes});
  }
};

double adjointSeconds(const Run& run, double* bytes = nullptr) {
  const std::vector<StateSeed> seeds = seedsOf(run.motion);
  if (bytes) {
    const double before = heapBytes();
    DerivativeTape tape(run.motion);
    (void)adjoint(tape, seeds);
    *bytes = heapBytes() - before;
  }
  return bestSeconds([&] { (void)adjoint(run.motion, seeds); }, 0.15, 200);
}

// The first numbers of the moving bodies, of their places and velocities.
double& number(SceneTangent& direction, const Scene& scene, int k) {
  int body = k / 6;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!scene.bodies[i].fixed && body-- == 0)
      return k % 6 < 3 ? direction.bodies[i].position[k % 3] : direction.bodies[i].velocity[k % 3];
  throw std::logic_error("not so many numbers");
}

double tangentSeconds(const Run& run, int controls) {
  return bestSeconds(
      [&] {
        DerivativeTape tape(run.motion);
        for (int k = 0; k < controls; ++k) {
          SceneTangent direction(run.scene);
          number(direction, run.scene, k) = 1;
          const MotionTangent rates = tangent(tape, direction);
          for (const StateSeed& seed : seedsOf(run.motion)) (void)rates.at(seed.body, seed.at);
        }
      },
      0.1, 20);
}

void byControls(const Columns& out, Progress& progress) {
  const Run run(penOfBalls(200, 1), kImpacts);
  for (const int controls : {10, 32, 100, 316, 1000}) {
    progress.next(std::to_string(controls) + " controls");
    out.row("controls", "balls", run, controls, "adjoint", adjointSeconds(run), NAN);
    out.row("controls", "balls", run, controls, "tangent", tangentSeconds(run, controls), NAN);
    out.row("controls", "balls", run, controls, "differences", 2 * controls * run.simulate, NAN);
  }
}

void bySize(const Columns& out, Progress& progress, const std::string& part, const std::string& kind, int bodies,
            std::size_t impacts) {
  progress.next(part + ", " + kind);
  const Run run(kind == "balls" ? penOfBalls(bodies, 1) : penOfBoxes(bodies, 1), impacts);
  double tape = 0;
  const double seconds = adjointSeconds(run, &tape);
  out.row(part, kind, run, 0, "adjoint", seconds, run.motion_bytes + tape);
  out.row(part, kind, run, 0, "motion", run.simulate, run.motion_bytes);
}

}  // namespace

void measure(Csv& csv) {
  csv.note(
      "gradient of the sum of all places at the end of balls, or boxes with friction, in a pen of planes without "
      "gravity");
  csv.note("adjoint: by all numbers of the scene at once; tangent: one pass a control; differences: two simulations a");
  csv.note(
      "control, from the time of one. ratio: over the time of one simulation; bytes: of the heap, motion and tape");
  csv.columns({"part", "scene", "controls", "impacts", "bodies", "method", "simulate", "seconds", "ratio", "bytes"});
  const Columns out{csv};
  Progress progress(5 + 6 + 6 + 5 + 3);
  byControls(out, progress);
  for (const std::string kind : {"balls", "boxes"}) {
    for (const std::size_t impacts : {10, 32, 100, 316, 1000, 10000}) {
      if (kind == "boxes" && impacts > 1000) continue;  // would take long
      bySize(out, progress, "impacts", kind, 20, impacts);
    }
    for (const int bodies : {2, 5, 20, 64, 200, 640}) {
      if (kind == "boxes" && (bodies < 20 || bodies > 200)) continue;  // few of them lose their speed too soon
      bySize(out, progress, "bodies", kind, bodies, kImpacts);
    }
  }
}

}  // namespace carom::charts
