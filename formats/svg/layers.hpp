// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/base/short_text.hpp"
#include "formats/drawing/nail_marks.hpp"
#include "formats/svg/canvas.hpp"
#include "formats/svg/impacts.hpp"
#include "formats/svg/legend.hpp"
#include "formats/svg/looks.hpp"
#include "formats/svg/shade.hpp"
#include "formats/svg/view.hpp"

namespace carom::formats_detail {

/// What a picture shows.
struct Picture {
  const Motion& motion;
  const Motion* before = nullptr;  ///< null: nothing to compare with
  std::vector<NailMark> nails;
  std::vector<RegionMark> regions;
  PathPlan paths = {};
  ShadePlan shade = {};
  ImpactPlan impacts = {};
};

inline constexpr const char* kNailColour = "#12924f";
inline constexpr const char* kImpactColour = "#d7263d";
inline constexpr const char* kAvoidColour = "#c2410c";
inline constexpr const char* kBeforeColour = "#7b828c";
inline constexpr const char* kCrowdColour = "#5d7187";
inline constexpr double kHoopRadius = 9;

/// One view while it is drawn. A layer that would take more than `most` bytes is drawn again at the next level, with
/// less detail; a layer may stop as soon as it is full.
struct LayerPage {
  SvgCanvas& canvas;
  Legend& legend;
  const Picture& picture;
  const View& view;
  std::size_t index = 0;  ///< of the view
  int level = 0;          ///< 0: all detail
  std::size_t most = 0;

  bool full() const { return canvas.size() > most; }
};

/// A layer of the picture. At its last level it never takes more than `most` bytes.
struct Layer {
  void (*draw)(const LayerPage& page);
  int levels = 1;
  std::size_t most = 0;  ///< bytes, both views together
};

void drawAxes(SvgCanvas& canvas, const View& view);

// From back to front; everything but the axes is drawn inside the clip of the panel.
void drawFixedBodies(const LayerPage& page);
inline constexpr int kFixedLevels = 4;
void drawCrowd(const LayerPage& page);
/// Impacts summed in cells, below the paths.
void drawImpactCells(const LayerPage& page);
/// Outlines of the regions that bodies keep to.
void drawRegions(const LayerPage& page);
void drawPathsBefore(const LayerPage& page);
inline constexpr int kBeforeLevels = 4;
void drawGhosts(const LayerPage& page);
inline constexpr int kGhostLevels = 6;
/// When the ghosts are, with all detail.
std::vector<double> ghostTimes(const Picture& picture);
/// Where bodies that have lines roll, slide, pivot, ride and rest: below their lines.
void drawContacts(const LayerPage& page);
inline constexpr int kContactLevels = 2;
void drawPaths(const LayerPage& page);
void drawNails(const LayerPage& page);
void drawImpactMarks(const LayerPage& page);
/// Names, numbers and what nails say, where there is room.
void drawLabels(const LayerPage& page);

/// Where a nail is seen, in pixels; a component that the nail leaves free is NaN.
Vec2 seenNail(const View& view, const NailMark& nail);
/// The part of space where a nailed place may lie: a bar or an area, to the border of the panel where it has no end.
/// Whether anything of it is seen.
bool drawAllowed(SvgCanvas& canvas, const View& view, const AllowedBox& box);

/// A step of 1, 2 or 5 times a power of ten, not below `least`.
double niceStep(double least);

}  // namespace carom::formats_detail
