// SPDX-License-Identifier: MIT
#include "formats/svg/layout.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "formats/drawing/motion_extent.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kLeft = 66, kRight = 16, kBetween = 8;
constexpr double kTallest = 430, kLowest = 110, kBothTogether = 660;  // panel heights
constexpr double kTitleRoom = 30;                // above each panel
constexpr double kMargin = 0.06;                 // around the content, share of its longest side

Extent fixedExtent(const Body& body, const Vec3& centre) {
  if (!std::holds_alternative<Plane>(body.shape)) return shapeExtent(body.shape, body.position, body.orientation);
  const Plane& plane = std::get<Plane>(body.shape);
  const Vec3 n = body.orientation * plane.normal;
  const Vec3 foot = centre + (n.dot(body.position) + plane.offset - n.dot(centre)) * n;
  return Extent(foot, foot);
}

/// Regions and the ends of ranges, those that are not much larger than all the rest.
void extendByConstrainedPlaces(const Picture& picture, Extent& shown) {
  const Vec3 reach = Vec3::Constant(shown.sizes().maxCoeff());
  const Extent near(shown.min() - reach, shown.max() + reach);
  for (const RegionMark& region : picture.regions) {
    const Extent part = near.intersection(shapeExtent(region.shape, region.position, region.orientation));
    if (!part.isEmpty()) shown.extend(part);
  }
  for (const NailMark& nail : picture.nails) {
    if (!nail.allowed) continue;
    const AllowedBox& box = *nail.allowed;
    const Vec3 middle = box.axes.conjugate() * (near.center() - box.origin);
    for (const Vec3* corner : {&box.low, &box.high}) {
      const Vec3 inner = corner->array().isFinite().select(*corner, middle);
      const Vec3 place = box.origin + box.axes * inner;
      if (near.contains(place)) shown.extend(place);
    }
  }
}

// What moves and is nailed, and of the fixed bodies as much as lies near it: a floor of a kilometre is not shown whole.
Extent shownExtent(const Picture& picture) {
  Extent shown = motionExtent(picture.motion);
  if (picture.before) shown.extend(motionExtent(*picture.before));
  for (const NailMark& nail : picture.nails) {
    Vec3 target = nail.target;
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(target[i])) target[i] = shown.center()[i];
    shown.extend(target);
    if (nail.pose_origin) {
      const Shape& shape = picture.motion.scene->bodies[nail.body].shape;
      const Vec3 radius = Vec3::Constant(radiusAbout(shape, Vec3::Zero()));
      shown.extend(Extent(*nail.pose_origin - radius, *nail.pose_origin + radius));
    }
  }
  extendByConstrainedPlaces(picture, shown);
  const Vec3 reach = Vec3::Constant(0.35 * shown.sizes().maxCoeff()), centre = shown.center();
  const Extent near(shown.min() - reach, shown.max() + reach);
  for (const Body& body : picture.motion.scene->bodies) {
    if (!body.fixed) continue;
    const Extent part = near.intersection(fixedExtent(body, centre));
    if (!part.isEmpty()) shown.extend(part);
  }
  return shown;
}

int acrossAxis(const Picture& picture) {
  double travel[2] = {0, 0};
  const auto& bodies = picture.motion.scene->bodies;
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
    if (!bodies[body].fixed)
      for (int axis = 0; axis < 2; ++axis)
        travel[axis] = std::max(travel[axis], pathExtent(picture.motion, body).sizes()[axis]);
  return travel[1] > 1.0001 * travel[0] ? 1 : 0;
}

}  // namespace

std::vector<View> layOutViews(const Picture& picture, double width, double top) {
  const Extent shown = shownExtent(picture);
  const double margin = kMargin * shown.sizes().maxCoeff();
  const Extent framed(shown.min() - Vec3::Constant(margin), shown.max() + Vec3::Constant(margin));
  const int across = acrossAxis(picture), depth = 1 - across;
  const Vec3 size = framed.sizes();
  const double whole = width - kLeft - kRight, half = 0.5 * (width - 2 * kLeft - kBetween - kRight);
  // One above the other, or side by side where that shows as much in less room: of things taller than they are wide.
  const double stacked = std::min({whole / size[across], kTallest / size.z(), kTallest / size[depth],
                                   kBothTogether / (size.z() + size[depth])});
  const double beside = std::min({half / size[across], kTallest / size.z(), kTallest / size[depth]});
  const bool is_beside = beside >= 0.85 * stacked;
  const double scale = is_beside ? beside : stacked;

  View side, above;
  side.name = "side", side.title = "Side view";
  above.name = "top", above.title = "Top view";
  side.up_axis = 2, above.up_axis = depth;
  above.up_is_negative = across == 1;  // right-handed seen from above: with y to the right, x runs downwards
  double left = kLeft;
  for (View* view : {&side, &above}) {
    view->across_axis = across;
    view->scale = scale;
    const double panel_width = is_beside ? half : whole;
    const double own_height = std::max(kLowest, scale * size[view->up_axis]);
    const double height = is_beside ? std::max(kLowest, scale * std::max(size.z(), size[depth])) : own_height;
    view->panel = {left, top + kTitleRoom, panel_width, height};
    view->low = view->project(framed.center()) - Vec2(panel_width, height) / (2 * scale);
    if (is_beside)
      left += half + kBetween + kLeft;
    else
      top += kTitleRoom + height + kAxisRoom;
  }
  return {side, above};
}

}  // namespace carom::formats_detail
