// SPDX-License-Identifier: MIT
#include "explore/worlds/world_table.h"

#include <cstring>

namespace carom {
namespace {

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

bool hasMotion(std::uint8_t status) {
  const auto plain = static_cast<std::uint8_t>(status & ~world_status::kUnreliable);
  return plain < world_status::kInvalidScene;
}

const char* nameOfWorldStatus(std::uint8_t status) {
  if (hasMotion(status)) return nameOf(static_cast<MotionStatus>(status & world_status::kMotion));
  if (status == world_status::kInvalidScene) return "invalid_scene";
  if (status == world_status::kNotComputable) return "not_computable";
  return status == world_status::kOutside ? "outside" : "crashed";
}

void WorldTable::append(const WorldTable& more) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(world, more.world), add(drawn, more.drawn), add(values, more.values), add(signature, more.signature);
  add(status, more.status), add(impacts, more.impacts), add(end, more.end), add(face, more.face),
      add(jacobian, more.jacobian);
}

bool WorldTable::operator==(const WorldTable& other) const {
  return numbers == other.numbers && rows == other.rows && boxes == other.boxes && has_jacobian == other.has_jacobian &&
         sameBits(world, other.world) && sameBits(drawn, other.drawn) && sameBits(values, other.values) &&
         sameBits(signature, other.signature) && sameBits(status, other.status) && sameBits(impacts, other.impacts) &&
         sameBits(end, other.end) && sameBits(face, other.face) && sameBits(jacobian, other.jacobian);
}

}  // namespace carom
