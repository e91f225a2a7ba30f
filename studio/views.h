// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/drawing/display.h"

/// What a page shows of scenes and motions: by value, so that any thread may keep, compare and send it.
namespace carom::studio {

/// A reported impact (Event::counts).
struct ImpactView {
  double time = 0;                        ///< s
  Vec3 point = Vec3::Zero();              ///< m, the middle of its contacts
  std::vector<int> bodies;                ///< that take part, in increasing order
  std::vector<int> nth;                   ///< of each of them: this is its n-th impact, 1 = first; 0 where it has none
  std::vector<std::array<int, 2>> pairs;  ///< that meet, each once (Event::meets)
  ImpactMode mode = ImpactMode::stick;    ///< branch of the impact law

  bool operator==(const ImpactView&) const = default;  ///< the same numbers
};

/// A stretch of persistent contact: a body rests, slides, rolls, pivots or rides on others (LastingContact).
struct ContactView {
  int body = -1;
  std::vector<int> on;            ///< in increasing order
  ArcKind kind = ArcKind::rest;   ///< what it does there
  double from = 0, to = 0;        ///< s

  bool operator==(const ContactView&) const = default;  ///< the same numbers
};

/// A motion.
struct MotionView {
  Vec3 gravity = Vec3::Zero();                   ///< of the scene, m/s^2
  double end = 0;                                ///< s, known up to here
  MotionStatus status = MotionStatus::complete;  ///< why it ends there
  std::string message;                           ///< one sentence
  std::vector<ImpactView> impacts;               ///< in increasing order of time
  std::vector<ContactView> contacts;             ///< in increasing order of their start, at most 2000
  std::vector<DisplayTrack> tracks;              ///< one a body, fixed ones included
  std::int64_t scene = 0;                        ///< of which scene: counted as they are opened
};
/// Throws InputError as displayTrack does.
MotionView viewOf(const Motion& motion);

/// An endless plane: its points x, in the axes of the shape, have normal . x = offset.
struct PlaneView {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;            ///< m

  bool operator==(const PlaneView&) const = default;  ///< the same numbers
};

/// A body as it is drawn.
struct BodyView {
  std::string name;                     ///< in the scene
  bool fixed = false;                   ///< never moves
  std::string colour;                   ///< "#rrggbb"
  std::optional<double> radius;         ///< m, bounding radius about the centre of mass; none for a plane
  Vec3 center = Vec3::Zero();           ///< of mass, in the axes of the shape, m
  Vec3 position = Vec3::Zero();         ///< m, of the shape's origin at the start
  Quat orientation = Quat::Identity();  ///< shape to world at the start
  std::optional<PlaneView> plane;       ///< where it is one, which has no mesh
  DisplayMesh mesh;                     ///< in the axes of the shape

  /// Whether they look alike; where a body starts does not count, but for fixed ones.
  bool looksLike(const BodyView& other) const;
};

/// A scene.
struct SceneView {
  std::vector<BodyView> bodies;  ///< all of them, in the order of the scene
  Vec3 low = Vec3::Zero();       ///< corner of a box around everything that moves, shapes included, m
  Vec3 high = Vec3::Zero();      ///< the other corner
  std::int64_t scene = 0;        ///< counted as scenes are opened: nothing of one belongs to another
};
/// `motion` is of the scene that is shown.
SceneView sceneViewOf(const Motion& motion);

}  // namespace carom::studio
