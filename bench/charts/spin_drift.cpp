// SPDX-License-Identifier: MIT
// Energy and angular momentum of free tops over many revolutions, by the ways of flight_integrators.cpp.

#include <algorithm>
#include <cmath>

#include "bench/charts/chart.h"
#include "bench/charts/spin_models.h"

namespace carom::charts {
namespace {

struct Top {
  std::string name;
  Vec3 inertia, spin;
  double share;  // of the revolutions below
};

// How a method goes: its step in revolutions or the error allowed in one step, and how far it can go in seconds.
struct Way {
  std::string method;
  double step, revolutions;
};
const std::vector<Way> kWays = {{"carom", 0, 1e6},
                                {"elliptic functions", 0, 1e6},
                                {"Euler RK4", 1.0 / 32, 1e6},
                                {"RK4", 1.0 / 32, 1e5},
                                {"Lie group 4", 1.0 / 32, 1e5},
                                {"splitting 2", 1.0 / 32, 1e5},
                                {"Fehlberg 7(8)", 1e-11, 1e5},
                                {"Dormand-Prince 5(4)", 1e-8, 1e5}};
// A new flight of carom begins after so many revolutions, as by an impact that changes nothing: what rounding does to
// the start of a flight adds up.
constexpr double kFlight = 10;

double largerThanNothing(double drift) { return std::isnan(drift) ? drift : std::max(drift, 1e-17); }

void carry(Csv& csv, const Top& top, const Way& way) {
  Spin start{top.inertia, Quat(0.4, 0.3, -0.8, 0.2).normalized(), Vec3::Zero()};
  start.L = start.q * top.inertia.cwiseProduct(top.spin);
  const double period = 2 * M_PI / top.spin.norm();
  for (const SpinModel& model : spinModels(start)) {
    if (model.name != way.method) continue;
    const double step = model.steps == SpinModel::Steps::fixed ? way.step * period : way.step;
    Spin spin = start;
    double done = 0, seconds = 0;
    for (double goal = 1; goal <= way.revolutions * top.share * 1.001; goal *= 10) {
      const double from = now();
      if (model.name == "elliptic functions") {
        spin = model.carry(start, goal * period, step, 1);
      } else {
        while (done < goal) {
          const double part = std::min(goal - done, kFlight);
          spin = model.carry(spin, part * period, step, 1);
          done += part;
        }
      }
      seconds += now() - from;
      csv.row({top.name, model.name, goal, largerThanNothing(std::abs(spin.energy() / start.energy() - 1)),
               largerThanNothing((spin.L - start.L).norm() / start.L.norm()), seconds});
    }
  }
}

}  // namespace

void measure(Csv& csv) {
  csv.note("energy, momentum: change since the start, over what it was at the start; none is written 1e-17");
  csv.note("RK4, Euler RK4, Lie group 4, splitting 2 in 32 steps a revolution; Fehlberg 7(8) at 1e-11 rad a step;");
  csv.note(
      "Dormand-Prince 5(4) at 1e-8; slow methods go 1e5 revolutions, and all a tenth of that near the middle axis");
  csv.note("carom begins a flight anew after each 10 revolutions; elliptic functions go from the start at once");
  csv.note("A slow top is a fast one in other units of time: there is nothing else in it to measure");
  csv.columns({"top", "method", "revolutions", "energy", "momentum", "seconds"});
  const std::vector<Top> tops = {
      {"box", Vec3(0.04 + 0.0144, 0.0144 + 0.09, 0.09 + 0.04) / 12, 1000 * Vec3(2, -1, 2) / 3, 1},
      {"middle axis", {1, 2, 2.5}, 100 * Vec3(1e-3, 1, 1e-3).normalized(), 0.1}};
  Progress progress(static_cast<int>(tops.size() * kWays.size()));
  for (const Top& top : tops)
    for (const Way& way : kWays) {
      progress.next(top.name + ", " + way.method);
      carry(csv, top, way);
    }
}

}  // namespace carom::charts
