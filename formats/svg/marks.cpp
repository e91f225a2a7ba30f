// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "formats/svg/layers.hpp"
#include "formats/svg/path.hpp"

namespace carom::formats_detail {

namespace {

constexpr std::array kDotSizes = {2.4, 3.9, 5.3, 6.8, 8.4};  // px, diameters for the classes of the cells' sums

std::string classWords(int low, int high) {
  return low == high ? std::to_string(high) : std::to_string(low) + "\u2013" + std::to_string(high);
}

// A diamond; one that stands for several impacts is larger, and says how many in its data.
void drawImpactMark(SvgCanvas& canvas, const ImpactMark& mark, double radius) {
  const double r = mark.numbers.size() > 1 ? 1.25 * radius : radius;
  SvgPath diamond;
  diamond.move(mark.pixel + Vec2(0, -r));
  for (const Vec2& corner : {Vec2(r, 0), Vec2(0, r), Vec2(-r, 0)}) diamond.line(mark.pixel + corner);
  diamond.close();
  canvas.element("path", {{"data-count", std::to_string(mark.numbers.size())}, {"d", diamond.data()}});
}

}  // namespace

void drawImpactMarks(const LayerPage& page) {
  const ImpactPlan& plan = page.picture.impacts;
  if (plan.marks.empty()) return;
  page.canvas.open("g", {{"class", classOf(Mark::impact)},
                         {"fill", kImpactColour},
                         {"stroke", "#ffffff"},
                         {"stroke-width", "1.2"}});
  for (const ImpactMark& mark : plan.marks[page.index]) drawImpactMark(page.canvas, mark, plan.radius());
  page.canvas.close();
  std::string words = plan.as == ImpactPlan::As::numbered ? "impact, numbered" : "impact";
  if (plan.merged) words += " (larger: several within " + shortNumber(kImpactsApart) + " px)";
  page.legend.add({Mark::impact, words, kImpactColour});
}

void drawImpactCells(const LayerPage& page) {
  const ImpactPlan& plan = page.picture.impacts;
  if (plan.cells.empty()) return;
  page.canvas.open("g", {{"class", classOf(Mark::impact_cell)},
                         {"stroke", kImpactColour},
                         {"stroke-linecap", "round"},
                         {"stroke-opacity", "0.85"}});
  const std::string impacts = counted(page.picture.motion.impacts, "impact");
  Legend::Entry entry{Mark::impact_cell, impacts + ", as many in a cell:", kImpactColour};
  int low = 1;
  for (std::size_t k = 0; k < plan.classes.size(); ++k) {
    const double size = kDotSizes[k + kDotSizes.size() - plan.classes.size()];
    const std::string dots = plan.cells[page.index].dots(low - 1, plan.classes[k]);
    if (!dots.empty()) page.canvas.element("path", {{"d", dots}, {"stroke-width", svgNumber(size)}});
    entry.scale.push_back({classWords(low, plan.classes[k]), size, 0.85});
    low = plan.classes[k] + 1;
  }
  page.canvas.close();
  page.legend.add(entry);
}

}  // namespace carom::formats_detail
