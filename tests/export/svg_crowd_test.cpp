// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/svg/export_svg.h"
#include "tests/export/hand_motion.h"
#include "tests/export/svg_reader.h"

namespace carom::export_tests {
namespace {

class Dice {
 public:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Vec3 vec(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

 private:
  std::mt19937_64 engine_{12};
};

Body ballOf(const std::string& name, const Vec3& x, const Vec3& v) {
  Body body;
  body.name = name, body.shape = Sphere{0.03}, body.mass = 0.1, body.position = x, body.velocity = v;
  return body;
}

/// Balls in a room of 2 m, over a floor; `impacts` of them in all, with the floor and with each other in turn.
struct Crowd {
  Document document;
  Motion motion;
};
Crowd crowdOf(int balls, int impacts, double duration) {
  Crowd crowd;
  Dice dice;
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  crowd.document.scene.bodies = {floor};
  crowd.document.duration = duration;
  for (int i = 0; i < balls; ++i)
    crowd.document.scene.bodies.push_back(
        ballOf("ball " + std::to_string(i + 1), Vec3(0, 0, 1.2) + dice.vec(1), dice.vec(1)));
  // Towards the middle, so that nothing flies away.
  std::vector<Bounce> bounces;
  const Scene& scene = crowd.document.scene;
  std::vector<Vec3> at(scene.bodies.size()), speed(scene.bodies.size());
  std::vector<double> since(scene.bodies.size(), 0);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) at[i] = scene.bodies[i].position, speed[i] = scene.bodies[i].velocity;
  for (int k = 0; k < impacts; ++k) {
    const double t = duration * (k + 1) / (impacts + 1);
    const auto body = static_cast<std::size_t>(1 + k % balls);
    const double h = t - since[body];
    at[body] += h * speed[body] + 0.5 * h * h * scene.gravity, since[body] = t;
    speed[body] = Vec3(0, 0, 1.2) - at[body] + dice.vec(1);
    const double next = std::max(1e-9, duration * balls / (impacts + 1));  // until its next impact, which takes it back
    speed[body] = (Vec3(0, 0, 1.2) + dice.vec(0.8) - at[body]) / next - 0.5 * next * scene.gravity;
    bounces.push_back({t, static_cast<int>(body), k % 3 == 0 || balls == 1 ? 0 : static_cast<int>(1 + (k + 1) % balls),
                       speed[body], Vec3::Zero()});
  }
  crowd.motion = handMotion(scene, duration, bounces);
  return crowd;
}

TEST(ExportSvgCrowd, PicturesOfAnyNumberOfBodiesAreGoodAndSmall) {
  struct Case {
    int balls, impacts;
  };
  for (const Case& c : {Case{1, 3000}, Case{2, 20}, Case{10, 45}, Case{10, 200}, Case{24, 5000}, Case{25, 30},
                        Case{100, 300}, Case{100, 5000}, Case{1000, 33000}, Case{10000, 10000}}) {
    SCOPED_TRACE(std::to_string(c.balls) + " balls, " + std::to_string(c.impacts) + " impacts");
    const Crowd crowd = crowdOf(c.balls, c.impacts, 1);
    const std::string svg = drawnSvg(crowd.document, crowd.motion);
    expectGoodPicture(svg);
    EXPECT_EQ(svg, drawnSvg(crowd.document, crowd.motion)) << "not the same twice";
    if (c.balls > 1000) continue;
    const std::string both = drawnSvg(crowd.document, crowd.motion, &crowd.motion);
    expectGoodPicture(both);
  }
}

TEST(ExportSvgCrowd, ManyImpactsAreDotsWhoseLegendSaysHowMany) {
  const Crowd crowd = crowdOf(50, 4000, 1);
  const std::string svg = drawnSvg(crowd.document, crowd.motion);
  const SvgPicture picture(svg);
  EXPECT_TRUE(picture.ofClass("impact").empty());
  for (const char* view : {"side", "top"}) {
    // A cell has at most one dot.
    std::set<std::pair<double, double>> places;
    std::size_t dots = 0;
    for (const int i : picture.ofClass("impact-cell", view))
      for (const auto& dot : pathPoints(picture.elements()[static_cast<std::size_t>(i)].attributes.at("d"), 1))
        places.emplace(dot.front().x(), dot.front().y()), ++dots;
    EXPECT_EQ(places.size(), dots) << view;
    EXPECT_GT(dots, 100u) << view;
  }
  EXPECT_NE(picture.words().find("4000 impacts"), std::string::npos);
  EXPECT_NE(picture.words().find("1\u2013"), std::string::npos) << picture.words();
}

// Each mark stands for one impact or for several in one place; none is lost.
TEST(ExportSvgCrowd, MarksStandForEveryImpact) {
  for (const int impacts : {1, 40, 60, 61, 300}) {
    const Crowd crowd = crowdOf(8, impacts, 1);
    const SvgPicture picture(drawnSvg(crowd.document, crowd.motion));
    for (const char* view : {"side", "top"}) {
      double sum = 0;
      for (const int i : picture.ofClass("impact", view))
        sum += picture.elements()[static_cast<std::size_t>(i)].number("data-count");
      EXPECT_EQ(sum, impacts) << view;
    }
  }
}

struct Look {
  std::string colour, dashes;
  bool operator==(const Look&) const = default;
};

std::vector<Look> looksOf(const SvgPicture& picture) {
  std::vector<Look> looks;
  for (const int i : picture.ofClass("path", "side")) {
    const auto& attributes = picture.elements()[static_cast<std::size_t>(i)].attributes;
    looks.push_back({attributes.at("stroke"), attributes.contains("stroke-dasharray") ? attributes.at("stroke-dasharray") : ""});
  }
  return looks;
}

TEST(ExportSvgCrowd, BodiesThatMeetHaveDifferentColours) {
  // Each ball meets the next three of a ring, far from the others.
  constexpr int kBalls = 20;
  Document document;
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  document.scene.bodies = {floor};
  for (int i = 0; i < kBalls; ++i) {
    const double angle = 2 * M_PI * i / kBalls;
    document.scene.bodies.push_back(ballOf("ball " + std::to_string(i), {4 * std::cos(angle), 4 * std::sin(angle), 1}, {0, 0, 0.1}));
  }
  std::vector<Bounce> bounces;
  for (int i = 0; i < kBalls; ++i)
    for (int k = 1; k <= 3; ++k)
      bounces.push_back({0.001 * (3 * i + k), 1 + i, 1 + (i + k) % kBalls, {0, 0, 0.1}, {0, 0, 0}});
  const std::vector<Look> looks = looksOf(SvgPicture(drawnSvg(document, handMotion(document.scene, 0.1, bounces))));
  ASSERT_EQ(looks.size(), static_cast<std::size_t>(kBalls));
  for (int i = 0; i < kBalls; ++i) {
    for (int k = 1; k <= 3; ++k)
      EXPECT_NE(looks[static_cast<std::size_t>(i)].colour, looks[static_cast<std::size_t>((i + k) % kBalls)].colour)
          << i << " and " << (i + k) % kBalls;
    for (int j = 0; j < i; ++j) EXPECT_FALSE(looks[static_cast<std::size_t>(i)] == looks[static_cast<std::size_t>(j)]);
  }
}

TEST(ExportSvgCrowd, EveryLineHasALookOfItsOwn) {
  for (const int balls : {3, 8, 9, 24, 25, 200}) {
    const Crowd crowd = crowdOf(balls, 3 * balls, 1);
    const SvgPicture picture(drawnSvg(crowd.document, crowd.motion));
    const std::vector<Look> looks = looksOf(picture);
    EXPECT_EQ(looks.size(), balls <= 24 ? static_cast<std::size_t>(balls) : 8u);
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(looks[i] == looks[j]) << balls << ": " << i << " and " << j;
    if (balls <= 24) continue;
    EXPECT_NE(picture.words().find(std::to_string(balls - 8) + " more bodies"), std::string::npos);
  }
}

TEST(ExportSvgCrowd, ATopOfTenThousandTurnsIsDrawn) {
  Document document;
  Body top = ballOf("top", {0, 0, 1}, {0.4, 0, 0});
  top.shape = Box{{0.1, 0.2, 0.3}}, top.angular_velocity = {2 * M_PI * 1000, 60, 40};
  document.scene.bodies = {top};
  document.scene.gravity = {0, 0, -0.01};
  expectGoodPicture(drawnSvg(document, handMotion(document.scene, 10, {})));
}

TEST(ExportSvgCrowd, ThousandsOfFixedBodiesAndNailsAndLongNamesStaySmall) {
  Document document = handDocument();
  Dice dice;
  for (int i = 0; i < 6000; ++i) {
    Body brick;
    brick.name = "brick " + std::to_string(i), brick.fixed = true, brick.shape = Box{{0.05, 0.03, 0.02}};
    brick.position = Vec3(1, 0, 1) + dice.vec(1), brick.orientation = Quat(1, dice.in(-1, 1), 0.2, 0.1).normalized();
    document.scene.bodies.push_back(brick);
  }
  document.scene.bodies[2].name = std::string(300'000, '<');
  document.constraints.clear();
  for (int i = 0; i < 3000; ++i)
    document.constraints.push_back(
        {"top", 0.0003 * i, {{"position", {dice.in(0, 2), dice.in(0, 1), dice.in(0, 1)}, Vec3::Zero()},
                             {"orientation", {1, 0, 0, 0}, Vec3::Zero()}}});
  const std::string svg = drawnSvg(document, handMotion(document.scene, 1.2, {}));
  expectGoodPicture(svg);
  const std::string words = SvgPicture(svg).words();
  EXPECT_NE(words.find("Left out for lack of room: "), std::string::npos);
  EXPECT_NE(words.find("nails ("), std::string::npos) << words.substr(0, 2000);
}

TEST(ExportSvgCrowd, PlacesFarFromTheOriginHaveReadableAxes) {
  for (const double far : {1e3, 1e6, 1e9, 1e14, 1e17}) {
    SCOPED_TRACE(far);
    Document document;
    document.scene.bodies = {ballOf("ball", {far, -far, 1}, {1, 0.2, 2})};
    expectGoodPicture(drawnSvg(document, handMotion(document.scene, 0.5, {})));
  }
  for (const double size : {1e-6, 1e6}) {
    SCOPED_TRACE(size);
    Document document;
    document.scene.bodies = {ballOf("ball", {0, 0, size}, {size, 0, size})};
    document.scene.bodies[0].shape = Sphere{0.1 * size};
    document.scene.gravity *= size;
    expectGoodPicture(drawnSvg(document, handMotion(document.scene, 1, {})));
  }
}

// Of every path as it is drawn: no place of it is further from the true path than the picture says, nor the other way.
TEST(ExportSvgCrowd, PathsAreNeverWrongByMoreThanThePictureSays) {
  for (const int impacts : {3, 40, 1500}) {
    SCOPED_TRACE(impacts);
    const Crowd crowd = crowdOf(2, impacts, 1);
    const std::string svg = drawnSvg(crowd.document, crowd.motion);
    const SvgPicture picture(svg);
    const std::size_t said = svg.find("off by at most ");
    ASSERT_NE(said, std::string::npos);
    const double tolerance = std::stod(svg.substr(said + 15));
    const std::vector<int> paths = picture.ofClass("path", "side");
    ASSERT_EQ(paths.size(), 2u);
    const Vec2 origin = picture.pixel("side", 0, 0), unit = picture.pixel("side", 1, 1) - origin;
    const int across = picture.words().find("x (m)\nSide") != std::string::npos ? 0 : 1;
    for (int ball = 0; ball < 2; ++ball) {
      const auto& d = picture.elements()[static_cast<std::size_t>(paths[static_cast<std::size_t>(ball)])].attributes.at("d");
      const std::vector<Vec2> drawn = pathPoints(d, 64).front();
      constexpr int kSamples = 4000;
      double furthest = 0;
      for (int i = 0; i <= kSamples; ++i) {
        const Vec3 x = crowd.motion.stateAt(ball + 1, static_cast<double>(i) / kSamples).position;
        const Vec2 p = origin + unit.cwiseProduct(Vec2(x[across], x.z()));
        double least = 1e9;
        for (std::size_t k = 0; k + 1 < drawn.size() && least > 0.02; ++k) {
          const Vec2 a = drawn[k], e = drawn[k + 1] - a;
          const double s = e.squaredNorm() > 0 ? std::clamp(e.dot(p - a) / e.squaredNorm(), 0.0, 1.0) : 0;
          least = std::min(least, (p - a - s * e).norm());
        }
        furthest = std::max(furthest, least);
      }
      // The numbers of the axes stand to a hundredth of a pixel, a curve is read in 64 pieces.
      EXPECT_TRUE(furthest <= tolerance + 0.06) << furthest << " of " << tolerance;
    }
  }
}

}  // namespace
}  // namespace carom::export_tests
