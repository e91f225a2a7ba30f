// SPDX-License-Identifier: MIT
#include "formats/svg/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom::formats_detail {
namespace {

constexpr double kSquare = 32;      // px, of taken boxes
constexpr double kInkSquare = 3;    // px, of what is drawn
constexpr double kInkCost = 14;     // all of a label on lines
constexpr double kLabelRim = 1;          // px between labels
constexpr double kLeaderFrom = 15;  // px: a label this far from its mark has a leader line
constexpr double kLeaderStep = 2.5;

struct LabelRing {
  double gap;      // px between mark and label
  double penalty;  // in units of kInkCost
  int directions;
};
constexpr std::array<LabelRing, 6> kRings = {
    {{3, 0, 8}, {8, 3, 8}, {17, 8, 16}, {28, 11, 16}, {42, 15, 16}, {60, 20, 24}}};

/// The box of words in a direction from a mark, its nearest point `gap` away: the corner that faces the mark slides from
/// one end of the box to the other as the direction turns.
PixelBox boxBeside(const Vec2& anchor, double gap, double angle, double width, double height) {
  const Vec2 out(std::cos(angle), -std::sin(angle)), at = anchor + gap * out;
  return {at.x() - 0.5 * (1 - out.x()) * width, at.y() - 0.5 * (1 - out.y()) * height, width, height};
}

Vec2 nearestPoint(const PixelBox& box, const Vec2& p) {
  return {std::clamp(p.x(), box.x, box.x + box.width), std::clamp(p.y(), box.y, box.y + box.height)};
}

template <class Visit>
void forEachSquare(const PixelBox& box, double size, const Visit& visit) {
  for (int i = static_cast<int>(std::floor(box.x / size)); i <= static_cast<int>((box.x + box.width) / size); ++i)
    for (int j = static_cast<int>(std::floor(box.y / size)); j <= static_cast<int>((box.y + box.height) / size); ++j)
      visit(i, j);
}

/// Points along a leader line, with the small boxes about them.
template <class Visit>
void forEachStep(const Vec2& from, const Vec2& to, const Visit& visit) {
  const double steps = std::max(1.0, std::ceil((to - from).norm() / kLeaderStep));
  for (double i = 0; i <= steps; ++i) {
    const Vec2 p = from + (i / steps) * (to - from);
    visit(p, PixelBox{p.x() - 1, p.y() - 1, 2, 2});
  }
}

}  // namespace

LabelPlacer::LabelPlacer(const PixelBox& panel)
    : panel_(panel),
      ink_columns_(static_cast<int>(panel.width / kInkSquare) + 1),
      ink_rows_(static_cast<int>(panel.height / kInkSquare) + 1),
      ink_(static_cast<std::size_t>(ink_columns_) * static_cast<std::size_t>(ink_rows_), 0) {}

void LabelPlacer::avoid(const PixelBox& mark) {
  if (!panel_.overlaps(mark)) return;
  forEachSquare(mark, kSquare, [&](int i, int j) { taken_near_[{i, j}].push_back(taken_.size()); });
  taken_.push_back(mark);
}

void LabelPlacer::avoidIfPossible(const Vec2& point) {
  if (!panel_.contains(point)) return;
  const int column = static_cast<int>((point.x() - panel_.x) / kInkSquare);
  const int row = static_cast<int>((point.y() - panel_.y) / kInkSquare);
  ink_[static_cast<std::size_t>(row * ink_columns_ + column)] = 1;
}

void LabelPlacer::avoidIfPossible(const PixelBox& box) {
  for (double x = box.x; x <= box.x + box.width; x += kInkSquare)
    for (double y = box.y; y <= box.y + box.height; y += kInkSquare) avoidIfPossible(Vec2(x, y));
}

bool LabelPlacer::isFree(const PixelBox& box) const {
  if (!panel_.grownBy(-3).contains(box)) return false;
  bool free = true;
  forEachSquare(box, kSquare, [&](int i, int j) {
    const auto found = taken_near_.find({i, j});
    if (!free || found == taken_near_.end()) return;
    for (const std::size_t k : found->second) free = free && !taken_[k].overlaps(box);
  });
  return free;
}

bool LabelPlacer::leaderIsFree(const Vec2& from, const Vec2& to, const Vec2& anchor, double radius) const {
  bool free = true;
  forEachStep(from, to, [&](const Vec2& p, const PixelBox& box) {
    free = free && ((p - anchor).norm() <= radius + 4 || isFree(box));
  });
  return free;
}

double LabelPlacer::inkUnder(const PixelBox& box) const {
  double squares = 0, drawn = 0;
  const PixelBox inside{box.x - panel_.x, box.y - panel_.y, box.width, box.height};
  forEachSquare(inside, kInkSquare, [&](int i, int j) {
    ++squares;
    if (i >= 0 && j >= 0 && i < ink_columns_ && j < ink_rows_)
      drawn += ink_[static_cast<std::size_t>(j * ink_columns_ + i)];
  });
  // A line through a label covers a fifth of it or so, and is as bad as can be.
  return std::min(1.0, 5 * drawn / squares);
}

/// The label in a box that is free; nothing where its leader line would cross another label or mark.
std::optional<PlacedLabel> LabelPlacer::labelAt(const PixelBox& box, const Vec2& anchor, double radius) const {
  PlacedLabel label{box, {box.x, box.y + 0.82 * box.height}, std::nullopt};
  const Vec2 to = nearestPoint(box, anchor), away = to - anchor;
  if (away.norm() <= radius + kLeaderFrom) return label;
  const Vec2 from = anchor + (radius + 1) * away.normalized(), end = to - 1.5 * away.normalized();
  if (!leaderIsFree(from, end, anchor, radius)) return std::nullopt;
  label.leader = {from, end};
  return label;
}

void LabelPlacer::take(const PlacedLabel& label) {
  avoid(label.box);
  if (!label.leader) return;
  forEachStep(label.leader->first, label.leader->second, [&](const Vec2&, const PixelBox& box) { avoid(box); });
}

std::optional<PlacedLabel> LabelPlacer::place(const std::vector<Vec2>& anchors, double radius, const std::string& words,
                                              double font_size) {
  const double width = textWidth(words, font_size, true);
  std::optional<PlacedLabel> best;
  double least = std::numeric_limits<double>::infinity();
  for (const LabelRing& ring : kRings) {
    if (ring.penalty >= least) break;
    for (const Vec2& anchor : anchors)
      for (int k = 0; k < ring.directions; ++k) {
        // From the upper right on, anticlockwise.
        const double angle = 2 * std::numbers::pi * (k + 0.125 * ring.directions) / ring.directions;
        const PixelBox box = boxBeside(anchor, radius + ring.gap, angle, width, font_size);
        if (!isFree(box.grownBy(kLabelRim))) continue;
        const double cost = ring.penalty + kInkCost * inkUnder(box);
        if (!(cost < least)) continue;
        if (const std::optional<PlacedLabel> label = labelAt(box, anchor, radius)) best = label, least = cost;
      }
  }
  if (best) take(*best);
  return best;
}

}  // namespace carom::formats_detail
