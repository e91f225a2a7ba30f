// SPDX-License-Identifier: MIT
// Bodies that slide, roll and rest, in every format: tables say what a body does, pictures show where, and films have
// no more keys than it takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "formats/export/export_csv.h"
#include "formats/gltf/write/keys.hpp"
#include "formats/svg/export_svg.h"
#include "tests/export/svg_reader.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"

namespace carom::export_tests {
namespace {

using namespace formats_detail;
using namespace test;

constexpr double kMinute = 60;

/// A ball that bounces to rest, one that slides and rolls, a block that slides to rest, and one that has always rested.
Scene everyPath() {
  return makeScene({0, 0, -9.81}, 0.4, 0.3,
                   {makeBall("drop", 0.1, {0, 0, 0.6}), makeBall("roll", 0.1, {0, 0.5, 0.1}, {0.8, 0, 0}),
                    makeBox("slide", {0.2, 0.2, 0.1}, {0, -0.5, 0.05}, {1, 0, 0}),
                    makeBox("stay", {0.2, 0.2, 0.1}, {-0.5, 0, 0.05}), makePlane("floor", Vec3::UnitZ(), 0)});
}
/// A block and a ball that slide across a slope that falls along y: their paths are no parabolas.
Scene bends() {
  const Vec3 gravity = downSlope(20);
  return makeScene({0, gravity.x(), gravity.z()}, 0.5, 0.3,
                   {makeBox("block", {0.4, 0.3, 0.2}, {0, 0, 0.1}, {2, 0, 0}),
                    makeBall("ball", 0.1, {0, -2, 0.1}, {3, -0.5, 0}), makePlane("floor", Vec3::UnitZ(), 0)});
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(LastingExport, TheTableSaysWhatABodyDoes) {
  const Motion motion = playLasting(everyPath(), 2);
  std::istringstream in(csvText(motion, 100));
  std::string line;
  std::getline(in, line);
  EXPECT_TRUE(line.ends_with(",path\r")) << line;
  std::map<std::string, std::string> last;
  for (; std::getline(in, line); line.clear()) {
    const std::vector<std::string> cells = cellsOf(line.substr(0, line.size() - 1));
    ASSERT_EQ(cells.size(), 18u) << line;
    const int body = bodyIndex(*motion.scene, cells[1]);
    int arc = motion.arcAt(body, std::stod(cells[0]));
    if (!cells[3].empty()) {
      const Event& event = motion.events[static_cast<std::size_t>(std::stoi(cells[3])) - 1];
      arc = event.find(body)->arc + (cells[2] == "after" ? 1 : 0);
    }
    const std::vector<Arc>& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
    EXPECT_EQ(cells[17], nameOf(arcs[static_cast<std::size_t>(arc)].kind()));
    last[cells[1]] = cells[17];
  }
  EXPECT_EQ(last, (std::map<std::string, std::string>{
                      {"drop", "rest"}, {"roll", "roll"}, {"slide", "rest"}, {"stay", "rest"}}));
}

std::string pictureOf(const Motion& motion) {
  Document document;
  document.scene = *motion.scene;
  document.duration = motion.duration;
  return drawnSvg(document, motion);
}

TEST(LastingExport, ThePictureShowsWhereContactLasts) {
  const Motion motion = playLasting(everyPath(), 2);
  const std::string svg = pictureOf(motion);
  expectGoodPicture(svg);
  const SvgPicture picture(svg);
  for (const char* view : {"side", "top"}) {
    EXPECT_EQ(picture.ofClass("roll", view).size(), 1u) << view;
    EXPECT_EQ(picture.ofClass("slide", view).size(), 2u) << view;
    EXPECT_EQ(picture.ofClass("rest", view).size(), 3u) << view;
  }
  const auto words = picture.words();
  for (const char* word : {"rolls", "slides", "rests"}) EXPECT_NE(words.find(word), std::string::npos) << word;
}

TEST(LastingExport, WhatTurnsAboutAnEdgePivots) {
  Body box = makeBox("box", {0.1, 0.1, 0.3}, {0, 0, 0.15 * std::cos(0.4) + 0.05 * std::sin(0.4)});
  box.orientation = Quat(std::cos(0.2), 0, std::sin(0.2), 0);
  const Motion motion = playLasting(makeScene({0, 0, -9.81}, 0, 1, {box, makePlane("floor", Vec3::UnitZ(), 0)}), 1);
  ASSERT_EQ(motion.world_lines[0].arcs[1].kind(), ArcKind::pivot);
  const SvgPicture picture(pictureOf(motion));
  EXPECT_EQ(picture.ofClass("pivot", "side").size(), 1u);
  EXPECT_NE(picture.words().find("pivots"), std::string::npos) << picture.words();
  std::size_t rows = 0;
  std::istringstream in(csvText(motion, 100));
  for (std::string line; std::getline(in, line);) rows += line.ends_with(",pivot\r") ? 1 : 0;
  EXPECT_GT(rows, 20u);
}

TEST(LastingExport, ThePictureSaysWhoLiesOnWhom) {
  Body lift = makeBox("lift", {2, 2, 0.2}, {4, 0, -0.1}, {0, 0, 0.5});
  lift.kinematic = true;
  lift.mass.reset();
  const Motion motion = playLasting(makeScene({0, 0, -9.81}, 0, 0.5,
                                              {fixedBody(makeBox("floor", {4, 4, 1}, {0, 0, -0.5})), makeBox("left", {1, 1, 1}, {-0.6, 0, 0.5}),
                                               makeBox("right", {1, 1, 1}, {0.6, 0, 0.5}), makeBox("top", {1, 1, 1}, {0, 0, 1.5}), lift,
                                               makeBox("parcel", {0.5, 0.5, 0.5}, {4, 0, 0.25}, {0, 0, 0.5})}),
                                    1);
  ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
  const std::string svg = pictureOf(motion);
  expectGoodPicture(svg);
  for (const char* words : {"<title>top rests on left and right</title>", "<title>left rests on floor</title>", "<title>parcel rides on lift</title>"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(SvgPicture(svg).ofClass("ride", "side").size(), 1u);
}

TEST(LastingExport, ThePictureMarksWhatCountsAsAnImpact) {
  const Motion motion = playLasting(everyPath(), 2);
  ASSERT_GT(motion.events.size(), 2 * motion.impacts);  // bounces lower than a micrometre, and changes of what lasts
  const SvgPicture picture(pictureOf(motion));
  std::size_t marked = 0;
  for (const int mark : picture.ofClass("impact", "side"))
    marked += static_cast<std::size_t>(picture.elements()[static_cast<std::size_t>(mark)].number("data-count"));
  EXPECT_EQ(marked, motion.impacts);
  EXPECT_NE(picture.words().find(std::to_string(motion.impacts) + " impacts"), std::string::npos) << picture.words();
}

double distanceFrom(const std::vector<Vec2>& line, const Vec2& p) {
  double least = (line.front() - p).norm();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 d = line[i + 1] - line[i];
    const double share = d.squaredNorm() > 0 ? std::clamp(d.dot(p - line[i]) / d.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (line[i] + share * d - p).norm());
  }
  return least;
}

TEST(LastingExport, ThePictureFollowsASlideRoundABend) {
  const Motion motion = playLasting(bends(), 1.2);
  ASSERT_GT(motion.world_lines[0].arcs[1].accelerationVariation(), 0);
  const SvgPicture picture(pictureOf(motion));
  const std::vector<int> lines = picture.ofClass("path", "top");
  ASSERT_EQ(lines.size(), 2u);
  double worst = 0;
  for (int body = 0; body < 2; ++body) {
    const int line = lines[static_cast<std::size_t>(body)];
    const auto drawn = pathPoints(picture.elements()[static_cast<std::size_t>(line)].attributes.at("d"), 64);
    for (int i = 0; i <= 400; ++i) {
      const Vec3 x = motion.stateAt(body, motion.end * i / 400).position;
      worst = std::max(worst, distanceFrom(drawn.front(), picture.pixel("top", x.x(), x.y())));
    }
  }
  EXPECT_TRUE(worst <= 0.27) << worst << " px";  // 0.25, and what the numbers of the axes are rounded to
}

TEST(LastingExport, ABodyAtRestHasFewKeys) {
  const Motion motion = playLasting(everyPath(), kMinute);
  EXPECT_EQ(motion.status, MotionStatus::complete) << motion.message;
  for (const int body : {0, 2, 3}) {
    const FrameKeys frames = frameKeys(motion, body, 60, 1e-4);
    const double moves = body == 3 ? 0 : body == 0 ? 2 : 0.4;  // s
    EXPECT_LT(static_cast<double>(frames.moves.times.size()), 20 + 1500 * moves) << body;
    EXPECT_LT(cubicKeys(motion, body).times.size(), 100u) << body;
    EXPECT_LT(turnKeys(motion, body).times.size(), 100u) << body;
    EXPECT_EQ(frames.moves.times.back(), static_cast<float>(kMinute));
  }
}

double straight(const TranslationKeys& keys, std::size_t k, double t, int axis) {
  const double share = (t - keys.times[k]) / (keys.times[k + 1] - keys.times[k]);
  return (1 - share) * keys.values[k][axis] + share * keys.values[k + 1][axis];
}
double cubic(const TranslationKeys& keys, std::size_t k, double t, int axis) {
  const double d = static_cast<double>(keys.times[k + 1]) - keys.times[k], s = (t - keys.times[k]) / d;
  const double end = s * s * (3 - 2 * s);
  return (1 - end) * keys.values[k][axis] + d * s * (1 - s) * (1 - s) * keys.out_tangents[k][axis] +
         end * keys.values[k + 1][axis] - d * s * s * (1 - s) * keys.in_tangents[k + 1][axis];
}

TEST(LastingExport, KeysFollowSlidesRollsAndBends) {
  for (const Scene& scene : {everyPath(), bends()}) {
    const Motion motion = playLasting(scene, 1.2);
    for (int body = 0; body + 1 < static_cast<int>(scene.bodies.size()); ++body) {
      SCOPED_TRACE(scene.bodies[static_cast<std::size_t>(body)].name);
      const TranslationKeys frames = frameKeys(motion, body, 24, 1e-4).moves, few = cubicKeys(motion, body);
      double by_lines = 0, by_cubics = 0;
      for (int i = 0; i < 2000; ++i) {
        const double t = motion.end * (i + 0.5) / 2000;
        const Vec3 x = motion.stateAt(body, t).position;
        const auto before = [&](const TranslationKeys& keys) {
          const auto after = std::ranges::upper_bound(keys.times, static_cast<float>(t));
          return static_cast<std::size_t>(after - keys.times.begin()) - 1;
        };
        for (int axis = 0; axis < 3; ++axis) {
          by_lines = std::max(by_lines, std::abs(straight(frames, before(frames), t, axis) - x[axis]));
          by_cubics = std::max(by_cubics, std::abs(cubic(few, before(few), t, axis) - x[axis]));
        }
      }
      EXPECT_TRUE(by_lines <= 1e-4) << by_lines;
      EXPECT_TRUE(by_cubics <= 1e-5) << by_cubics;
      EXPECT_LT(few.times.size(), 2000u);
    }
  }
}

}  // namespace
}  // namespace carom::export_tests
