// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/contact_source.h"
#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "explore/draws/points.h"
#include "explore/worlds/world_table.h"

namespace carom {

namespace explore_detail {
struct ExplorationState;
}

/// What worlds are drawn from, and what is read of them.
struct ExploreOptions {
  Points points = Points::random;  ///< where numbers come from
  /// Another seed gives other worlds. Sobol's points are those of the sequence with 0, else shifted.
  std::uint64_t seed = 0;
  bool gradients = false;  ///< the derivatives of all rows with respect to the drawn numbers, too
  /// Of each world, see SimulateOptions::step_limit.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
};

/// A number that is drawn.
struct DrawnNumber {
  std::string name;  ///< "velocity.x of 'ball'"; of an orientation a component of the world rotation vector from the
                     ///< written one
  int control = -1;  ///< index of its Control
  std::string component;  ///< "x", "value"
};

/// A number that is read of every world: one of a constraint, soft ones included.
struct ExploredRow {
  std::string name;             ///< "position.x of 'ball' at 1.4 s"
  std::string unit;             ///< " m", with a space before it; empty where there is none
  int constraint = -1;          ///< index of its Constraint
  double lower = 0;             ///< SI, least value that the constraint asks for
  double upper = 0;             ///< SI, largest; equal where it asks for a number
  double scale = 1;             ///< natural scale of the value, SI
  bool isRange() const { return !(lower == upper); }  ///< whether it asks for a range
};

/// Many worlds of one scene: its controls drawn from their distributions, its constraints read. A world is a function
/// of the scene, the options and its index, so that any part of the table has the same bits wherever and whenever it is
/// computed. Independent of what it was made from, unless the contact source has no ContactSource::another.
/// Thread-safe.
class Exploration {
 public:
  /// Throws InputError for what makes no sense; for distributions it names "/controls/<i>/distribution/...". Controls
  /// without a distribution stay as the scene has them.
  Exploration(const Scene& scene, ContactSource& contacts, double duration, const std::vector<Control>& controls,
              const std::vector<Constraint>& constraints, const ExploreOptions& options = {});
  /// A duration is in seconds, no bool and no character.
  template <NoTime T>
  Exploration(const Scene& scene, ContactSource& contacts, T duration, const std::vector<Control>& controls,
              const std::vector<Constraint>& constraints, const ExploreOptions& options = {}) = delete;

  const std::vector<DrawnNumber>& numbers() const;  ///< drawn, in the order of the table
  const std::vector<ExploredRow>& rows() const;     ///< read, likewise
  const std::vector<std::string>& boxes() const;    ///< names of the moving bodies that are boxes, likewise
  const std::vector<std::string>& notes() const;    ///< sentences, on what bounds cut off
  const ExploreOptions& options() const;            ///< as given

  /// Worlds first to first + count - 1, one row each, whatever becomes of them. Throws InputError for an index of a
  /// world that there is not. Once a stop is requested it ends with the last world that is complete.
  WorldTable chunk(std::uint64_t first, std::uint64_t count, std::stop_token stop = {}) const;

  /// The scene of a world as simulated. Throws InputError where that is not valid.
  Scene sceneAt(std::uint64_t world) const;
  /// Its motion, with everything that can be asked of it. Throws as sceneAt, and NotComputable.
  Motion motionOf(std::uint64_t world) const;

 private:
  std::shared_ptr<explore_detail::ExplorationState> state_;
};

}  // namespace carom
