// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// How a world ended: in its lowest four bits the MotionStatus, and flags; or one of the codes from invalidScene to
/// crashed.
namespace world_status {
inline constexpr std::uint8_t kMotion = 0x0f;        ///< mask of the MotionStatus
inline constexpr std::uint8_t kNoDerivative = 0x10;  ///< a derivative does not exist, and is NaN
inline constexpr std::uint8_t kMissingRow =
    0x20;  ///< a row does not exist in this motion, or a required impact is not there
inline constexpr std::uint8_t kInvalidScene = 64;   ///< not simulated: the drawn values make no valid scene
inline constexpr std::uint8_t kNotComputable = 65;  ///< numerical failure
inline constexpr std::uint8_t kOutside =
    66;  ///< not simulated: a joint distribution drew a value outside of its bounds
inline constexpr std::uint8_t kCrashed = 67;       ///< the process that simulated it died
inline constexpr std::uint8_t kUnreliable = 0x80;  ///< a derivative exists, and is not to be relied on
}  // namespace world_status

/// Whether a world has a motion, which may have ended early.
bool hasMotion(std::uint8_t status);
/// The word of a status without its flags: "complete", ..., "invalid_scene", "not_computable", "outside", "crashed".
const char* nameOfWorldStatus(std::uint8_t status);

/// One row a world, by columns; matrices row by row.
struct WorldTable {
  std::size_t numbers = 0;    ///< drawn a world
  std::size_t rows = 0;       ///< of constraints
  std::size_t boxes = 0;      ///< whose face up is read
  bool has_jacobian = false;  ///< whether gradients were asked for

  std::vector<std::uint64_t> world;  ///< its index
  std::vector<double> drawn;         ///< worlds x numbers, SI
  std::vector<double> values;        ///< worlds x rows, SI; NaN where there is none
  std::vector<std::uint64_t>
      signature;  ///< hash of the impact sequence (64-bit FNV-1a of Motion::signature); 0 without a motion
  std::vector<std::uint8_t> status;    ///< see world_status
  std::vector<std::uint32_t> impacts;  ///< reported impacts
  std::vector<double> end;             ///< s, up to which the motion is known; NaN without a motion
  /// worlds x boxes: the face whose normal is nearest to straight up at the end: 1 to 6 for +x, -x, +y, -y, +z, -z of
  /// the box; 0 where the motion ended early, or there is no gravity.
  std::vector<std::uint8_t> face;
  std::vector<double>
      jacobian;  ///< worlds x rows x numbers: of the values with respect to the drawn ones; NaN where there is none

  std::size_t size() const { return world.size(); }  ///< worlds
  void append(const WorldTable& more);               ///< of the same exploration
  bool operator==(const WorldTable& other) const;    ///< the same bits
};

}  // namespace carom
