// SPDX-License-Identifier: MIT
#include "formats/svg/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace carom::formats_detail {
namespace {

constexpr std::size_t kMostNumbered = 60, kMostMarks = 300;

Vec3 impactPlace(const Event& event) {
  Vec3 sum = Vec3::Zero();
  for (const Contact& contact : event.contacts) sum += contact.at.point;
  return event.contacts.empty() ? sum : Vec3(sum / static_cast<double>(event.contacts.size()));
}

/// Each impact joins the first mark near it, or becomes one. Marks are found by squares of kImpactsApart.
std::vector<ImpactMark> markedImpacts(const Motion& motion, const View& view) {
  std::vector<ImpactMark> marks;
  std::unordered_map<long, std::vector<std::size_t>> squares;
  const auto keyOf = [](long column, long row) { return column * 1'000'003L + row; };
  int number = 0;
  for (const Event& event : motion.events) {
    if (!event.counts()) continue;
    ++number;
    const Vec2 p = view.pixel(impactPlace(event));
    const long column = std::lround(p.x() / kImpactsApart), row = std::lround(p.y() / kImpactsApart);
    ImpactMark* near = nullptr;
    for (long i = -1; i <= 1 && !near; ++i)
      for (long j = -1; j <= 1 && !near; ++j)
        for (const std::size_t k : squares[keyOf(column + i, row + j)])
          if (!near && (marks[k].pixel - p).norm() < kImpactsApart) near = &marks[k];
    if (near) {
      near->numbers.push_back(number);
    } else {
      squares[keyOf(column, row)].push_back(marks.size());
      marks.push_back({p, {number}});
    }
  }
  return marks;
}

}  // namespace

std::string ImpactMark::words() const {
  constexpr std::size_t kLongest = 11;
  std::string out;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    out += (out.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (last > i) out += (last == i + 1 ? ", " : "\u2013") + std::to_string(numbers[last]);
    i = last;
  }
  if (out.size() <= kLongest) return out;
  return std::to_string(numbers.front()) + " \u2026 " + std::to_string(numbers.back()) + " (" +
         std::to_string(numbers.size()) + ")";
}

ImpactPlan planImpacts(const Motion& motion, const std::vector<View>& views) {
  ImpactPlan plan;
  const std::size_t count = motion.impacts;
  if (count == 0) return plan;
  if (count <= kMostMarks) {
    bool apart = true;  // most of them
    for (const View& view : views) {
      plan.marks.push_back(markedImpacts(motion, view));
      apart = apart && 2 * plan.marks.back().size() >= count;
      plan.merged = plan.merged || plan.marks.back().size() < count;
    }
    plan.as = count <= kMostNumbered ? ImpactPlan::As::numbered : ImpactPlan::As::marks;
    if (apart || count <= kMostNumbered) return plan;
  }
  plan = {};
  plan.as = ImpactPlan::As::cells;
  double most = 1;
  for (const View& view : views) {
    plan.cells.emplace_back(view.panel, kImpactCell);
    for (const Event& event : motion.events)
      if (event.counts()) plan.cells.back().add(view.pixel(impactPlace(event)), 1);
    most = std::max(most, plan.cells.back().largest());
  }
  plan.classes = countClasses(static_cast<int>(most));
  return plan;
}

}  // namespace carom::formats_detail
