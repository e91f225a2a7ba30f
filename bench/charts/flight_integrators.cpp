// SPDX-License-Identifier: MIT
// Ways to carry the rotation of a free body: error of the orientation against time, for tops of many kinds; and how the
// time grows with the angle that is turned in a flight.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adjoint/flight/flight_triaxial.hpp"
#include "bench/charts/chart.h"
#include "bench/charts/spin_models.h"
#include "tests/reference/replay.h"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

struct Top {
  std::string name;
  Vec3 inertia, spin;  // spin in principal axes, rad/s
  double duration;     // s
  int readings;
};

const Quat kStart = Quat(0.4, 0.3, -0.8, 0.2).normalized();

Vec3 boxMoments(const Vec3& size) {
  const Vec3 s = size.cwiseAbs2() / 12;
  return {s.y() + s.z(), s.z() + s.x(), s.x() + s.y()};
}

// Spins of 1000 rad/s turn for a second, slow ones of 1 rad/s for ten.
std::vector<Top> tops() {
  const Vec3 box = boxMoments({0.3, 0.2, 0.12}), direction = Vec3(2, -1, 2) / 3;
  const Vec3 nearly_middle = Vec3(1e-6, 1, 1e-6).normalized();
  return {{"symmetric", {1, 1, 1.7}, 1000 * direction, 1, 1},
          {"near-symmetric", {1, 1 + 1e-6, 1.7}, 1000 * direction, 1, 1},
          {"box slow", box, direction, 10, 1},
          {"box fast", box, 1000 * direction, 1, 1},
          {"strongly triaxial", {1, 3, 3.9}, 1000 * direction, 1, 1},
          {"middle axis", {1, 2, 2.5}, 100 * nearly_middle, 10, 1},
          {"needle", {1e-4, 1, 1.00005}, Vec3(1000, 2, -1), 0.1, 1},
          {"disc", {1, 1.0005, 2}, Vec3(30, -10, 999.5), 1, 1},
          {"short flight", box, 8 * direction, 0.4, 16}};
}

Spin spinOf(const Top& top) {
  Spin s{top.inertia, kStart, Vec3::Zero()};
  s.L = kStart * top.inertia.cwiseProduct(top.spin);
  return s;
}

double angleFrom(const Mat3& exact, const Quat& found) {
  const Vec3 twice_sin = unskew(exact.transpose() * found.toRotationMatrix());
  const double sine = 0.5 * twice_sin.norm();
  if (std::isnan(sine)) return sine;
  const double cosine = 0.5 * ((exact.transpose() * found.toRotationMatrix()).trace() - 1);
  return std::atan2(sine, cosine);
}

// What half a unit in the last place of every number of the start is worth at the end, rad.
double roundingOf(const Spin& s, double t) {
  TriaxialRotation rotation;
  rotation.begin(s.inertia.cwiseInverse(), s.q, s.L);
  rotation.extendTo(t);
  const RotationSensitivity S = rotation.sensitivityAt(t);
  return 1.1e-16 *
         (S.dtheta_dtheta.norm() + S.dtheta_dL.norm() * s.L.norm() + (S.dtheta_dI * s.inertia.asDiagonal()).norm());
}

std::vector<double> stepsOf(const SpinModel& model, const Top& top) {
  switch (model.steps) {
    case SpinModel::Steps::none:
      return {0};
    case SpinModel::Steps::fixed:
      return logSpaced(1 / top.spin.norm(), 1e-3 / top.spin.norm(), 7);
    case SpinModel::Steps::adaptive:
      return logSpaced(1e-3, 1e-15, 7);
  }
  return {};
}

void compare(Csv& csv, Progress& progress, const Top& top) {
  const Spin start = spinOf(top);
  progress.next(top.name + ", 50 digits");
  const Mat3 exact = reference::freeRotation(start.inertia, start.q, start.L, {top.duration}, false)[0].R;
  csv.row({top.name, "rounding of the start", 0, 0, roundingOf(start, top.duration)});
  for (const SpinModel& model : spinModels(start)) {
    progress.next(top.name + ", " + model.name);
    for (const double step : stepsOf(model, top)) {
      Spin end;
      const double seconds =
          bestSeconds([&] { end = model.carry(start, top.duration, step, top.readings); }, 0.03, 10000);
      csv.row({top.name, model.name, step, seconds, angleFrom(exact, end.q)});
    }
  }
}

// Time of a flight of the box that turns so far, read at 16 times.
void growth(Csv& csv, Progress& progress) {
  for (const double angle : logSpaced(0.1, 3162.2776601683795, 10)) {
    const Top top{"turns", boxMoments({0.3, 0.2, 0.12}), Vec3(2, -1, 2) / 3, angle, 16};
    const Spin start = spinOf(top);
    progress.next("turns of " + Cell(angle).text);
    const std::vector<SpinModel> models = spinModels(start);
    Spin end;
    for (const char* name : {"carom", "elliptic functions", "Taylor series", "Fehlberg 7(8)"})
      for (const SpinModel& model : models) {
        if (model.name != name) continue;
        const double seconds =
            bestSeconds([&] { end = model.carry(start, top.duration, 1e-13, top.readings); }, 0.05, 10000);
        csv.row({top.name, model.name, angle, seconds, roundingOf(start, angle)});
      }
  }
}

}  // namespace

void measure(Csv& csv) {
  csv.note("seconds: of the whole flight; error: angle of the orientation at its end against 50 digits, rad");
  csv.note("step: s; of embedded pairs the error allowed in one step, rad; 0: there is none");
  csv.note("rounding of the start: what half a unit in the last place of moments, orientation and momentum is worth");
  csv.note("turns: step is the angle turned, rad; Fehlberg 7(8) at 1e-13 a step; error is that of the rounding");
  for (const Top& top : tops())
    csv.note(top.name + ": moments " + Cell(top.inertia[0]).text + " " + Cell(top.inertia[1]).text + " " +
             Cell(top.inertia[2]).text + "; " + Cell(top.spin.norm()).text + " rad/s for " + Cell(top.duration).text +
             " s, read " + (top.readings == 1 ? "once" : std::to_string(top.readings) + " times"));
  csv.columns({"top", "method", "step", "seconds", "error"});
  Progress progress(9 * 10 + 10);
  for (const Top& top : tops()) compare(csv, progress, top);
  growth(csv, progress);
}

}  // namespace carom::charts
