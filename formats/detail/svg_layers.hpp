#pragma once

#include <vector>

#include "formats/detail/svg_canvas.hpp"
#include "formats/detail/svg_nails.hpp"
#include "formats/detail/svg_view.hpp"

namespace carom {

/// What a picture shows.
struct Picture {
  const Motion& motion;
  const Motion* before = nullptr;  ///< null: nothing to compare with
  std::vector<NailMark> nails;
  std::vector<RegionMark> regions;
  double ghost_interval = 0.1;  ///< s
};

inline constexpr const char* kNailColour = "#12924f";
inline constexpr const char* kImpactColour = "#d7263d";
inline constexpr const char* kAvoidColour = "#c2410c";
inline constexpr const char* kBeforeColour = "#8b929b";
inline constexpr double kHoopRadius = 9;

/// Layers of one view, from back to front. Everything but the axes is drawn inside the clip of the panel.
void drawAxes(SvgCanvas& canvas, const View& view);
void drawFixedBodies(SvgCanvas& canvas, const View& view, const Picture& picture);
/// Outlines of the regions that bodies keep to.
void drawRegions(SvgCanvas& canvas, const View& view, const Picture& picture);
void drawPathsBefore(SvgCanvas& canvas, const View& view, const Picture& picture);
void drawGhosts(SvgCanvas& canvas, const View& view, const Picture& picture);
void drawPaths(SvgCanvas& canvas, const View& view, const Picture& picture);
/// The outline of a body at a nailed pose.
void drawPose(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q);
/// The part of space where a nailed place may lie: a bar or an area, to the border of the panel where it has no end.
void drawAllowed(SvgCanvas& canvas, const View& view, const AllowedBox& box);
/// The middle of the upper border of what is seen of a region, in pixels: where its label goes.
Vec2 topOf(const RegionMark& region, const View& view);
/// Impacts, nails with their poses, and all labels.
void drawMarks(SvgCanvas& canvas, const View& view, const Picture& picture);

/// Whether there is room for numbers beside the impacts.
bool impactsAreNumbered(const Picture& picture);

/// A step of 1, 2 or 5 times a power of ten, not below `least`.
double niceStep(double least);

/// The legend: its height for a width, and the drawing with its top left corner at (x, y).
double legendHeight(const Picture& picture, double width);
void drawLegend(SvgCanvas& canvas, const Picture& picture, double x, double y, double width);

}  // namespace carom
