// SPDX-License-Identifier: MIT
#include "formats/drawing/turn_keys.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "formats/drawing/motion_extent.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

void add(RotationKeys& keys, double t, const KeyPiece& piece) {
  const auto time = static_cast<float>(t);
  if (!keys.times.empty() && !(time > keys.times.back())) return;
  Quat q = toBodyState(piece.arc->model(), piece.arc->stateAt(piece.storedTime(t))).orientation;
  if (!keys.values.empty() && keys.values.back().dot(q) < 0) q.coeffs() *= -1;
  keys.times.push_back(time);
  keys.values.push_back(q);
}

}  // namespace

double KeyPiece::storedTime(double t) const { return std::clamp<double>(static_cast<float>(t), arc->start(), to); }

std::vector<KeyPiece> arcsOf(const Motion& motion, int body) {
  const auto& arcs = motion.world_lines[body].arcs;
  std::vector<KeyPiece> pieces;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k)
    pieces.push_back({&arcs[k], arcs[k].start(), arcEnd(motion, body, k)});
  return pieces;
}

void requireFew(double keys, const Motion& motion, int body) {
  const auto& bodies = motion.scene->bodies;
  const std::size_t moving = movingCount(*motion.scene);
  const bool few_alone = keys <= kMaxKeys;
  if (few_alone && keys * static_cast<double>(moving) <= kMaxKeysOfAll) return;
  const double most = few_alone ? std::floor(kMaxKeysOfAll / static_cast<double>(moving)) : kMaxKeys;
  throw InputError("body '" + bodies[body].name + "'",
                   "would need " + numberText(std::ceil(keys)) + " keys, at most " + numberText(most) + " are written" +
                       (few_alone ? " of each of " + std::to_string(moving) + " moving bodies" : "") +
                       "; a shorter motion, fewer frames a second, a larger tolerance or cubic keys need less");
}

std::vector<KeyPiece> evenPieces(const Motion& motion, int body, const std::function<double(const Arc&)>& rate) {
  std::vector<KeyPiece> cut;
  double total = 1;
  for (const auto& [arc, from, to] : arcsOf(motion, body)) {
    const double count = std::max(1.0, std::ceil((to - from) * rate(*arc))), step = (to - from) / count;
    requireFew(total += count, motion, body);
    for (double i = 0; i < count; ++i)
      cut.push_back({arc, from + i * step, i + 1 < count ? from + (i + 1) * step : to});
  }
  return cut;
}

RotationKeys turnKeys(const std::vector<KeyPiece>& pieces) {
  RotationKeys keys;
  for (const KeyPiece& piece : pieces) add(keys, piece.from, piece);
  if (!pieces.empty()) add(keys, pieces.back().to, pieces.back());
  return keys;
}

double rateOfTurns(const Arc& arc, const TurnSpacing& spacing) {
  if (arc.tier() == Tier::none) return 0;  // keeps its orientation
  return std::max(std::sqrt(arc.spinRateBound() / (8 * spacing.tolerance)), arc.spinBound() / spacing.most);
}

}  // namespace carom::formats_detail
