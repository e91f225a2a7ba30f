// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "formats/export/export_motion.h"
#include "tests/export/all_shapes.h"
#include "tests/export/hand_motion.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::export_tests {
namespace {

using Polygon = std::vector<Vec2>;

std::string svgOf(const Document& document) {
  const std::string path = temporaryPath("m.svg");
  exportMotion(path, document, handMotion(document.scene, document.duration, {}));
  return contentOf(path);
}

struct ViewText {
  std::string name, text;
  Vec3 viewer;  // unit, towards the viewer
};

// The pictures of documentOfAllShapes: bodies fly along x, so x runs to the right in both views.
std::vector<ViewText> viewsOf(const std::string& svg) {
  const std::size_t side = svg.find("id=\"view-side\""), top = svg.find("id=\"view-top\"");
  return {{"side", svg.substr(side, top - side), -Vec3::UnitY()}, {"top", svg.substr(top), Vec3::UnitZ()}};
}

// The first attribute `key` of an element drawn for a body.
std::string attribute(const std::string& text, const std::string& body, const std::string& key) {
  const std::size_t at = text.find("data-body=\"" + body + "\"");
  if (at == std::string::npos) return "";
  const std::size_t from = text.find(" " + key + "=\"", at) + key.size() + 3;
  return text.substr(from, text.find('"', from) - from);
}

// Closed polygons of path data: a point, then steps.
std::vector<Polygon> polygonsOf(std::string data) {
  std::vector<Polygon> out;
  for (std::size_t at = 0; (at = data.find('-', at)) != std::string::npos; at += 2) data.insert(at, " ");
  std::replace(data.begin(), data.end(), 'l', ' ');
  std::size_t at = 0;
  while ((at = data.find('M', at)) != std::string::npos) {
    std::istringstream in(data.substr(at + 1, data.find('Z', at) - at - 1));
    out.emplace_back();
    Vec2 point(0, 0);
    for (Vec2 step; in >> step.x() >> step.y();) out.back().push_back(point += step);
    ++at;
  }
  return out;
}

// The same of lines that are not closed.
std::vector<Polygon> openLinesOf(std::string data) {
  for (std::size_t at = 1; (at = data.find('M', at)) != std::string::npos; at += 2) data.insert(at, "Z");
  return polygonsOf(data + "Z");
}

double areaOf(const std::vector<Polygon>& polygons) {
  double twice = 0;
  for (const Polygon& p : polygons)
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
  return 0.5 * std::abs(twice);
}

int windingAt(const std::vector<Polygon>& polygons, const Vec2& at) {
  double turns = 0;
  for (const Polygon& p : polygons)
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec2 a = p[i] - at, b = p[(i + 1) % p.size()] - at;
      turns += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / (2 * std::numbers::pi);
    }
  return static_cast<int>(std::lround(turns));
}

// Area of the shadow of a convex shape, by Cauchy's projection of its faces or in closed form.
double shadow(const Shape& shape, const Quat& q, const Vec3& viewer) {
  const Vec3 d = q.conjugate() * viewer;
  const double along = std::abs(d.z()), beside = std::sqrt(1 - along * along);
  if (const Box* box = std::get_if<Box>(&shape)) {
    const Vec3& s = box->size;
    return std::abs(d.x()) * s.y() * s.z() + std::abs(d.y()) * s.x() * s.z() + along * s.x() * s.y();
  }
  if (const Capsule* c = std::get_if<Capsule>(&shape))
    return std::numbers::pi * c->radius * c->radius + 2 * c->radius * c->height * beside;
  if (const Cylinder* c = std::get_if<Cylinder>(&shape))
    return std::numbers::pi * c->radius * c->radius * along + 2 * c->radius * c->height * beside;
  // An ellipse and a point beside it: in the measure in which it is a unit circle the point is at Y, and its tangents
  // touch where the angle from it is acos(1/Y).
  if (const Cone* c = std::get_if<Cone>(&shape)) {
    const double low = std::max(along, 1e-9);  // of an ellipse that is a line
    const double ellipse = c->radius * c->radius * low, Y = c->height * beside / (c->radius * low);
    return ellipse * (Y > 1 ? std::numbers::pi - std::acos(1 / Y) + std::sqrt(Y * Y - 1) : std::numbers::pi);
  }
  const Hull& hull = std::get<Hull>(shape);
  double area = 0;
  for (const Surface::Face& face : hull.surface->faces) {
    Vec3 twice = Vec3::Zero();
    for (int k = 0; k < face.count; ++k) {
      const auto corner = [&](int i) {
        return hull.surface->vertices[static_cast<std::size_t>(
            hull.surface->corners[static_cast<std::size_t>(face.first + i % face.count)])];
      };
      twice += corner(k).cross(corner(k + 1));
    }
    area += std::max(0.0, 0.5 * hull.scale * hull.scale * twice.dot(d));
  }
  return area;
}

TEST(Silhouette, EveryBodyIsDrawnInBothViews) {
  for (const bool fixed : {true, false}) {
    const Document document = documentOfAllShapes(fixed);
    const std::string svg = svgOf(document);
    for (const ViewText& view : viewsOf(svg))
      for (const Body& body : document.scene.bodies) {
        if (body.name == "floor" && view.name == "top") continue;  // has no outline from above
        EXPECT_NE(view.text.find("data-body=\"" + body.name + "\""), std::string::npos)
            << body.name << " " << view.name;
        if (body.fixed) continue;  // fixed ones have no labels
        EXPECT_NE(svg.find(">" + body.name + "</text>"), std::string::npos) << body.name;
      }
    EXPECT_EQ(svg.find("nan"), std::string::npos);
  }
}

TEST(Silhouette, CoversTheShadowOfConvexShapes) {
  const Document document = documentOfAllShapes(true);
  const std::string svg = svgOf(document);
  for (const ViewText& view : viewsOf(svg)) {
    const double scale = std::stod(attribute(view.text, "sphere", "r")) / 0.1;
    for (const Body& body : document.scene.bodies) {
      if (body.name != "box" && body.name != "capsule" && body.name != "cylinder" && body.name != "cone" && body.name != "hull") continue;
      const double found = areaOf(polygonsOf(attribute(view.text, body.name, "d"))) / (scale * scale);
      // 48 points to a circle and tenths of a pixel.
      test::expectEntries(found, shadow(body.shape, body.orientation, view.viewer), 6e-3, body.name + " " + view.name,
                          1e-9);
    }
  }
}

// From the side, from above and below, and in between, where the apex is seen before the base or behind it.
TEST(Silhouette, CoversTheShadowOfAConeFromAllSides) {
  test::Random random(91);
  Document document = documentOfAllShapes(true);
  std::erase_if(document.scene.bodies, [](const Body& b) { return b.name == "mesh" || b.name == "compound"; });
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE("seed 91, turn " + std::to_string(i));
    for (Body& body : document.scene.bodies) {
      if (body.name != "cone") continue;
      body.shape = Cone{random.in(0.05, 0.25), random.in(0.05, 0.25)};
      body.orientation = i < 4 ? Quat(Eigen::AngleAxisd(i * std::numbers::pi / 2, Vec3::UnitX())) : random.rotation();
    }
    const std::string svg = svgOf(document);
    for (const ViewText& view : viewsOf(svg)) {
      const double scale = std::stod(attribute(view.text, "sphere", "r")) / 0.1;
      for (const Body& body : document.scene.bodies) {
        if (body.name != "cone") continue;
        const double found = areaOf(polygonsOf(attribute(view.text, "cone", "d"))) / (scale * scale);
        const double expected = shadow(body.shape, body.orientation, view.viewer);
        test::expectEntries(found, expected, 1e-2, view.name, expected);
      }
    }
  }
}

TEST(Silhouette, TheHandleOfTheMugHasAHole) {
  Document document = documentOfAllShapes(true);
  for (Body& body : document.scene.bodies)
    if (body.name == "mesh") body.orientation = Quat::Identity();
  const std::string text = viewsOf(svgOf(document)).front().text;
  const std::vector<Polygon> polygons = polygonsOf(attribute(text, "mesh", "d"));
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const Polygon& p : polygons)
    for (const Vec2& point : p) low = low.cwiseMin(point), high = high.cwiseMax(point);
  // The mug reaches from -0.04 m to its handle at 0.0745 m and is 0.0948 m high; pixels run downwards.
  const auto pixel = [&](double x, double z) {
    return Vec2(low.x() + (x + 0.04) / 0.1145 * (high.x() - low.x()), high.y() - z / 0.0948 * (high.y() - low.y()));
  };
  EXPECT_EQ(windingAt(polygons, pixel(0.053, 0.048)), 0) << "within the handle";
  EXPECT_NE(windingAt(polygons, pixel(0.0, 0.05)), 0) << "on the wall";
  EXPECT_NE(windingAt(polygons, pixel(0.0703, 0.048)), 0) << "on the handle";
  EXPECT_EQ(windingAt(polygons, pixel(0.060, 0.09)), 0) << "above the handle";
}

// Where parts overlap the filled area is one, and what lies inside or behind another part is not drawn.
TEST(Silhouette, PartsOfACompoundAreOneArea) {
  Document document = documentOfAllShapes(true);
  Compound cross;
  cross.parts.push_back({Box{{0.3, 0.1, 0.1}}, Vec3::Zero(), Quat::Identity()});
  cross.parts.push_back({Box{{0.1, 0.06, 0.3}}, Vec3::Zero(), Quat::Identity()});
  for (Body& body : document.scene.bodies)
    if (body.name == "compound") body.shape = cross, body.orientation = Quat::Identity();
  std::string text = viewsOf(svgOf(document)).front().text;
  const double scale = std::stod(attribute(text, "sphere", "r")) / 0.1;
  text = text.substr(text.find("data-body=\"compound\""));
  const std::vector<Polygon> area = polygonsOf(attribute(text, "compound", "d"));
  ASSERT_EQ(area.size(), 2u);
  for (const Polygon& bar : area)
    test::expectEntries(areaOf({bar}) / (scale * scale), 0.03, 6e-3, "a bar of the cross", 1e-9);
  const Vec2 middle = (area[0][0] + area[0][2]) / 2;
  EXPECT_EQ(std::abs(windingAt(area, middle)), 2);
  EXPECT_EQ(std::abs(windingAt(area, middle + scale * Vec2(0.1, 0))), 1);
  EXPECT_EQ(windingAt(area, middle + scale * Vec2(0.1, 0.1)), 0);

  text.resize(text.find("</g>"));
  int lines = 0;
  for (std::size_t at = text.find(" d=\"", text.find("/>")); at != std::string::npos; at = text.find(" d=\"", at + 1))
    for (const Polygon& line : openLinesOf(text.substr(at + 4, text.find('"', at + 4) - at - 4)))
      for (std::size_t i = 0; i + 1 < line.size(); ++i, ++lines) {
        const Vec2 p = (0.5 * (line[i] + line[i + 1]) - middle) / scale;
        EXPECT_FALSE(std::abs(p.x()) < 0.148 && std::abs(p.y()) < 0.048) << p.transpose();
      }
  EXPECT_GT(lines, 10);
}

}  // namespace
}  // namespace carom::export_tests
