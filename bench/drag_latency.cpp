// SPDX-License-Identifier: MIT
// Latency of drags: the path of a mouse at 60 Hz against edit sessions, in scenes of one to ten bodies.
//   drag_bench [--csv FILE] [--seconds S] [--seeds N] [--first SEED] [--scene NAME] [--simulations N]
//              [--release S] [--no-clock] [--frames]
// Prints, for each scene, the median, 95th percentile and longest time of an update, how many of them came to the
// target (of the targets that are not behind a wall), how far the worst stayed from it, and how long the release took.
// --no-clock: no update is cut by the clock, so that all but the times is the same in every run.
// Frames without a verified motion are counted too. "p95 cpu" is the time of the processor: what other programs take
// from it does not count.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

#include "bench/drag_scenes.h"
#include "bench/machine.h"
#include "editing/problem/controls/control_set.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom {

using namespace editing_detail;

namespace {

struct Arguments {
  std::string csv, scene;
  double seconds = 5;
  int seeds = 4, first = 1;
  SessionOptions session = {};
  bool frames = false;
};

struct Measured {
  std::vector<double> milliseconds, processor;  // of the clock, and of the processor alone
  std::vector<double> release;                  // ms, of the ends of gestures
  int release_at_target = 0, release_cut = 0;
  int at_target = 0, behind_wall = 0, without_motion = 0, ends_early = 0, sequence_changed = 0, cut = 0;
  double worst_distance = 0, worst_nail = 0, simulations = 0;
  std::size_t impacts = 0;

  int inReach() const { return static_cast<int>(milliseconds.size()) - behind_wall; }
  static double percentile(std::vector<double> sorted, double p) {
    std::sort(sorted.begin(), sorted.end());
    const auto at = static_cast<std::size_t>(p * static_cast<double>(sorted.size() - 1) + 0.5);
    return sorted[at];
  }
};

int numbersThatVary(const DragCase& c) {
  const ControlSet controls(c.scene, c.controls);
  return controls.size();
}

int moving(const Scene& scene) {
  return static_cast<int>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return !b.fixed; }));
}

void drag(const DragCase& c, const Arguments& arguments, std::uint64_t seed, Measured& out) {
  OdeContacts contacts(c.scene);
  EditSession session(c.scene, contacts, c.duration, c.controls, c.nails, arguments.session);
  session.grab(c.body, c.at, c.grip);
  out.impacts = session.motion().events.size();
  for (const Vec3& place : mousePath(session.grabbedPlace(), c.wide, arguments.seconds, seed)) {
    const std::clock_t before = std::clock();
    const SessionUpdate u = session.dragTo(place);
    out.processor.push_back(1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    out.milliseconds.push_back(u.milliseconds);
    out.at_target += u.reached;
    out.behind_wall += place.x() > c.farthest_x;
    out.ends_early += u.motion && u.motion->status != MotionStatus::complete;
    out.without_motion += !u.motion || u.motion->duration != c.duration;
    out.sequence_changed += u.sequence_changed;
    out.cut += u.cut_by_clock;
    out.simulations += u.simulations;
    if (place.x() <= c.farthest_x) out.worst_distance = std::max(out.worst_distance, u.distance);
    out.worst_nail = std::max(out.worst_nail, u.scaled_nail_error);
    if (arguments.frames)
      std::printf("%s %zu: %.3f ms, %.3f ms of the processor, %zu impacts, %d simulations, %d steps, %s, %.2e m%s %s\n",
                  c.name.c_str(), out.milliseconds.size(), u.milliseconds, out.processor.back(),
                  u.motion->events.size(), u.simulations, u.iterations, nameOf(u.stage), u.distance,
                  u.reached ? "" : " short", u.message.c_str());
  }
  const SessionUpdate end = session.release();
  out.release.push_back(end.milliseconds);
  out.release_at_target += end.reached;
  out.release_cut += end.cut_by_clock;
  if (arguments.frames)
    std::printf("%s release: %.0f ms, %d iterations, %s, %.2e m%s%s %s\n", c.name.c_str(), end.milliseconds,
                end.iterations, nameOf(end.stage), end.distance, end.reached ? "" : " short",
                end.cut_by_clock ? " cut" : "", end.message.c_str());
}

void writeHeader(std::ostream& csv) {
  csv << "# " << machineLine() << "\n"
      << "scene,bodies,controls,impacts,frames,p50_ms,p95_ms,max_ms,processor_p95_ms,limit_ms,targets_in_reach,at_"
         "target,"
         "worst_distance_m,worst_nail,simulations_per_frame,frames_in_other_sequence,frames_ending_early,"
         "frames_cut_by_clock,frames_without_motion,releases,release_p50_ms,release_max_ms,releases_at_target,"
         "releases_cut_by_clock\n";
}

void write(std::ostream& csv, const DragCase& c, const Measured& m) {
  const auto frames = static_cast<double>(m.milliseconds.size());
  csv << c.name << ',' << moving(c.scene) << ',' << numbersThatVary(c) << ',' << m.impacts << ',' << frames << ','
      << Measured::percentile(m.milliseconds, 0.5) << ',' << Measured::percentile(m.milliseconds, 0.95) << ','
      << Measured::percentile(m.milliseconds, 1) << ',' << Measured::percentile(m.processor, 0.95) << ',' << c.limit
      << ',' << m.inReach() << ',' << m.at_target << ',' << m.worst_distance << ',' << m.worst_nail << ','
      << m.simulations / frames << ',' << m.sequence_changed << ',' << m.ends_early << ',' << m.cut << ','
      << m.without_motion << ',' << m.release.size() << ',' << Measured::percentile(m.release, 0.5) << ','
      << Measured::percentile(m.release, 1) << ',' << m.release_at_target << ',' << m.release_cut << '\n';
}

void print(const DragCase& c, const Measured& m) {
  const auto frames = static_cast<double>(m.milliseconds.size());
  std::printf("%-14s %6d %8d %7zu %6.0f %8.3f %8.3f %8.3f %8.3f %6.0f %8.1f%% %11.2e %8.1e %6.1f %8.0f %8.0f\n",
              c.name.c_str(), moving(c.scene), numbersThatVary(c), m.impacts, frames,
              Measured::percentile(m.milliseconds, 0.5), Measured::percentile(m.milliseconds, 0.95),
              Measured::percentile(m.milliseconds, 1), Measured::percentile(m.processor, 0.95), c.limit,
              100.0 * m.at_target / std::max(1, m.inReach()), m.worst_distance, m.worst_nail, m.simulations / frames,
              Measured::percentile(m.release, 0.5), Measured::percentile(m.release, 1));
}

int run(const Arguments& arguments) {
  std::ofstream csv;
  if (!arguments.csv.empty()) {
    csv.open(arguments.csv);
    writeHeader(csv);
  }
  std::printf("%s\n%-14s %6s %8s %7s %6s %8s %8s %8s %8s %6s %9s %11s %8s %6s %8s %8s\n", machineLine().c_str(),
              "scene", "bodies", "controls", "impacts", "frames", "p50 ms", "p95 ms", "max ms", "p95 cpu", "limit",
              "at target", "furthest, m", "nails", "sims", "release", "longest");
  bool kept = true;
  for (const DragCase& c : dragCases()) {
    if (!arguments.scene.empty() && c.name != arguments.scene) continue;
    Measured m;
    for (int k = 0; k < arguments.seeds; ++k) drag(c, arguments, static_cast<std::uint64_t>(arguments.first + k), m);
    print(c, m);
    if (csv.is_open()) write(csv, c, m);
    kept = kept && Measured::percentile(m.milliseconds, 0.95) <= c.limit && m.without_motion == 0;
  }
  std::printf("%s\n", kept ? "All limits kept." : "Not all limits kept.");
  return 0;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  carom::Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--csv" && more) {
      arguments.csv = argv[++i];
    } else if (word == "--first" && more) {
      arguments.first = std::atoi(argv[++i]);
    } else if (word == "--scene" && more) {
      arguments.scene = argv[++i];
    } else if (word == "--seconds" && more) {
      arguments.seconds = std::atof(argv[++i]);
    } else if (word == "--seeds" && more) {
      arguments.seeds = std::atoi(argv[++i]);
    } else if (word == "--simulations" && more) {
      arguments.session.drag_simulations = std::atoi(argv[++i]);
    } else if (word == "--release" && more) {
      arguments.session.release_seconds = std::atof(argv[++i]);
    } else if (word == "--no-clock") {
      arguments.session.drag_seconds = arguments.session.release_seconds = std::numeric_limits<double>::infinity();
    } else if (word == "--frames") {
      arguments.frames = true;
    } else {
      std::fprintf(stderr,
                   "usage: %s [--csv FILE] [--seconds S] [--seeds N] [--first SEED] [--scene NAME] [--simulations N] "
                   "[--release S] [--no-clock] [--frames]\n",
                   argv[0]);
      return 2;
    }
  }
  return carom::run(arguments);
}
