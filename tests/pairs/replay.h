// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "tests/pairs/encounter.h"
#include "tests/reference/numbers.h"

namespace carom::pairs {

/// The first impact of two bodies replayed in 50-digit arithmetic, with features and mode of the impact frozen; its
/// derivatives are central differences in that arithmetic, far below double rounding.
using Fine = reference::Real;
using FineVector = exact::Vec<Fine>;
using FineMatrix = exact::Mat<Fine>;

/// One body as written; each number can be nudged on its own.
struct BodyNumbers {
  bool moving = false, has_density = false, inertia_derived = true;
  exact::ShapeNumbers<Fine> shape;
  Fine mass_or_density;
  FineVector moments;
  FineMatrix axes;  ///< principal to shape axes, of written moments
  FineVector position, velocity, spin;
  FineMatrix orientation;
};
struct PairNumbers {
  FineVector gravity;
  reference::MaterialNumbers materials[2];
  BodyNumbers bodies[2];
};
PairNumbers pairNumbers(const Scene& scene);

/// One number that can vary, and its place in a derivative. `body` is the one whose mass or shape it belongs to, or -1.
struct PairKnob {
  std::string name;
  int body = -1;
  std::function<void(PairNumbers&, const Fine& change)> nudge;
  std::function<double&(SceneDerivative&)> entry;
};
std::vector<PairKnob> knobsOf(const PairNumbers& numbers);

/// What is compared: time, normal (from body 1 to body 0) and point of the impact; of each body that moves position,
/// rotation, velocity and spin just before the impact and at a fixed time after it.
struct PairRow {
  enum class Of { time, normal, point, before, after };
  Of of = Of::time;
  int body = -1;
  int component = 0;  ///< 0-2 position, 3-5 rotation vector, 6-8 velocity, 9-11 spin; or of the vector
  std::string name() const;
};
std::vector<PairRow> rowsOf(const PairNumbers& numbers);

class Replay {
 public:
  /// `impact` is the brute-force answer, good enough to start from; the mode of the impact is found.
  Replay(const Scene& scene, const FirstImpact& impact, double after);
  ~Replay();

  const PairNumbers& numbers() const;
  ImpactMode mode() const;
  double time() const;
  /// d(rows)/d(knob), in the order of rowsOf.
  std::vector<double> derivative(const PairKnob& knob) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace carom::pairs
