// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <regex>

#include "formats/svg/export_svg.h"
#include "tests/export/hand_motion.h"
#include "tests/export/svg_reader.h"

namespace carom::export_tests {
namespace {

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

std::string svgOf(const Document& document, const Motion& motion, const Motion* before = nullptr) {
  return drawnSvg(document, motion, before);
}

TEST(ExportSvg, IsWellFormedAndHoldsNoNan) {
  const Motion motion = handMotion(), before = handMotion(handDocument().scene, 1.2, {});
  const std::string svg = svgOf(handDocument(), motion, &before);
  expectGoodPicture(svg);
  EXPECT_FALSE(std::regex_search(svg, std::regex("\\b(nan|inf)\\b", std::regex::icase)));
  EXPECT_NE(svg.find("viewBox=\"0 0 800 "), std::string::npos);
  EXPECT_NE(svg.find("ball &lt;1&gt;"), std::string::npos);
}

TEST(ExportSvg, EachViewMarksEveryImpactOnce) {
  const Motion motion = handMotion();
  const SvgPicture picture(svgOf(handDocument(), motion));
  EXPECT_EQ(picture.ofClass("impact", "side").size(), motion.events.size());
  EXPECT_EQ(picture.ofClass("impact", "top").size(), motion.events.size());
}

TEST(ExportSvg, ReadersOfScreensGetATitleAndADescription) {
  const Motion motion = handMotion();
  const std::string svg = svgOf(handDocument(), motion, &motion);
  EXPECT_EQ(count(svg, "role=\"img\" aria-labelledby=\"title desc\""), 1);
  EXPECT_EQ(count(svg, "<title id=\"title\">"), 1);
  EXPECT_EQ(count(svg, "of 3 moving bodies with 3 impacts in 1.2 seconds, and of the motion before the edit, with 2 nails."), 1);
}

// The file is made for 800 pixels across; nothing in it is smaller than what a browser shows as small print.
TEST(ExportSvg, NoTextIsSmall) {
  const SvgPicture picture(svgOf(handDocument(), handMotion()));
  for (int i = 0; i < static_cast<int>(picture.elements().size()); ++i) {
    if (picture.elements()[static_cast<std::size_t>(i)].name != "text") continue;
    EXPECT_GE(std::stod(picture.inherited(i, "font-size")), 12);
  }
}

TEST(ExportSvg, ANailIsAHoopAndAFreeComponentALine) {
  const std::string svg = svgOf(handDocument(), handMotion());
  const std::size_t top = svg.find("id=\"view-top\"");
  // The book's nail is a hoop in both views; of the ball's only x is nailed: a line in both.
  EXPECT_EQ(count(svg.substr(0, top), "class=\"nail\""), 1);
  EXPECT_EQ(count(svg.substr(top), "class=\"nail\""), 1);
  EXPECT_EQ(count(svg, "class=\"nail-line\""), 2);
  EXPECT_EQ(count(svg, "class=\"target-pose\""), 2);
}

/// Coordinates of all hoops of a view.
std::vector<Vec2> hoopsOf(const std::string& view) {
  static const std::regex hoop("class=\"nail\" cx=\"([-.0-9]+)\" cy=\"([-.0-9]+)\"");
  std::vector<Vec2> out;
  for (std::sregex_iterator it(view.begin(), view.end(), hoop); it != std::sregex_iterator(); ++it)
    out.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  return out;
}

std::string sideOf(const std::string& svg) { return svg.substr(0, svg.find("id=\"view-top\"")); }
std::string topOf(const std::string& svg) { return svg.substr(svg.find("id=\"view-top\"")); }

TEST(ExportSvg, ARangeIsABarOrAnAreaWithItsHoopWithin) {
  Document document = handDocument();
  Target height{"position", {2.1, 0.2, any}};
  height.min = {any, any, 0.3}, height.max = {any, any, 0.8};
  document.constraints = {{"book", 1.1, {height}}};
  const std::string bar = svgOf(document, handMotion());
  expectGoodPicture(bar);
  EXPECT_EQ(count(sideOf(bar), "class=\"nail-range\""), 1);
  EXPECT_EQ(count(topOf(bar), "class=\"nail-range\""), 0);  // it lies along the line of sight
  EXPECT_EQ(hoopsOf(sideOf(bar)).size(), 1u);
  EXPECT_EQ(count(bar, "range of a nail"), 1);

  document.constraints[0].targets[0].value = {any, any, any};
  document.constraints[0].targets[0].min = {any, 0, any};
  document.constraints[0].targets[0].max = {any, 0.5, 0.8};
  const std::string areas = svgOf(document, handMotion());  // without ends on some sides
  expectGoodPicture(areas);
  EXPECT_EQ(count(sideOf(areas), "class=\"nail-range\""), 1);
  EXPECT_EQ(count(topOf(areas), "class=\"nail-range\""), 1);
}

TEST(ExportSvg, ANailAtSomeTimeIsDrawnWhereTheMotionIsNearest) {
  const Motion motion = handMotion();
  const double met = 0.7315;
  Document document = handDocument();
  const Vec3 place = motion.stateAt("book", met).position;
  document.constraints = {{"book", between(0.5, 0.9), {{"position", {place.x(), place.y(), place.z()}}}}};
  const std::string svg = svgOf(document, motion);
  EXPECT_NE(svg.find("book at 0.7315 s (0.5 to 0.9 s)"), std::string::npos) << svg;
  EXPECT_EQ(hoopsOf(sideOf(svg)).size(), 1u);
  document.constraints = {{"book", between(1.25, 1.3), {{"velocity", {any, any, 0}}}}};  // after the end
  EXPECT_TRUE(hoopsOf(sideOf(svgOf(document, motion))).empty());
}

TEST(ExportSvg, ANailSeenFromAnotherBodyIsDrawnInTheWorld) {
  const Motion motion = handMotion();
  Document document = handDocument(), world = handDocument();
  const BodyState top = motion.stateAt("top", 0.6);
  const Vec3 offset(0.1, -0.2, 0.3), place = top.position + top.orientation * offset;
  document.constraints = {{"book", 0.6, {{"position", {0.1, -0.2, 0.3}}, {"orientation", {1, 0, 0, 0}}}, "top"}};
  world.constraints = {{"book", 0.6, {{"position", {place.x(), place.y(), place.z()}}}}};
  const std::string seen = svgOf(document, motion), direct = svgOf(world, motion);
  const auto a = hoopsOf(seen), b = hoopsOf(direct);
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE((a[k] - b[k]).norm() <= 0.02) << a[k] << b[k];
  EXPECT_EQ(count(seen, "class=\"target-pose\""), 2);
  EXPECT_NE(seen.find("relative to top"), std::string::npos);

  // A free component is the motion's own, along the axes of the other body.
  document.constraints = {{"book", 0.6, {{"position", {any, -0.2, 0.3}}}, "top"}};
  const std::string free = svgOf(document, motion);
  expectGoodPicture(free);
  EXPECT_EQ(hoopsOf(free).size(), 2u);
  EXPECT_EQ(count(free, "class=\"nail-range\""), 2);
}

TEST(ExportSvg, RegionsAreOutlinesWithinTheFrame) {
  Document document = handDocument();
  Constraint kept{"ball <1>", 0.0, {}};
  kept.regions = {{.side = Region::Side::avoid, .shape = Sphere{0.2}, .position = {1.5, 0.6, 1.4}},
                  {.side = Region::Side::inside,
                   .shape = Box{{3, 2, 2.5}},
                   .position = {1, 0, 1},
                   .orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY())),
                   .during = {{0.2, 0.8}}}};
  document.constraints = {kept};
  const std::string svg = svgOf(document, handMotion());
  expectGoodPicture(svg);
  for (const std::string& view : {sideOf(svg), topOf(svg)}) {
    EXPECT_EQ(count(view, "class=\"avoid\""), 1);
    EXPECT_EQ(count(view, "class=\"inside\""), 1);
    EXPECT_EQ(count(view, "ball &lt;1&gt; stays in, 0.2 to 0.8 s"), 1);
    EXPECT_EQ(count(view, "class=\"nail\""), 0);
  }
  EXPECT_EQ(count(svg, "id=\"hatch-avoid\""), 1);
  EXPECT_EQ(count(svg, "region to stay out of"), 1);
  EXPECT_EQ(count(svgOf(handDocument(), handMotion()), "hatch-avoid"), 0);
}

TEST(ExportSvg, TheMotionBeforeIsDrawnOnlyWhenGiven) {
  const Motion motion = handMotion();
  EXPECT_EQ(count(svgOf(handDocument(), motion), "class=\"before\""), 0);
  EXPECT_EQ(count(svgOf(handDocument(), motion, &motion), "class=\"before\""), 2);
}

TEST(ExportSvg, ThinAndEmptyMotionsAreDrawnAsWell) {
  Document document = handDocument();
  document.constraints.clear();
  document.scene.bodies.resize(2);
  expectGoodPicture(svgOf(document, handMotion(document.scene, 1, {})));  // nothing moves
  document = handDocument();
  expectGoodPicture(svgOf(document, handMotion(document.scene, 0, {})));  // no time passes
  document.scene.bodies[2].velocity = {0, 3, 0};
  expectGoodPicture(svgOf(document, handMotion(document.scene, 5, {})));  // along y
}

}  // namespace
}  // namespace carom::export_tests
