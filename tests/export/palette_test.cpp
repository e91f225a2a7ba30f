// SPDX-License-Identifier: MIT
#include "formats/drawing/palette.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/types.h"

namespace carom::export_tests {

using namespace formats_detail;

namespace {

// Linear light as people see it who lack one kind of cone (Machado, Oliveira and Fernandes 2009, severity 1).
std::vector<Mat3> visions() {
  std::vector<Mat3> out(4, Mat3::Identity());
  out[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  out[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  out[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return out;
}

Vec3 linearOf(const Colour& colour) {
  const auto [r, g, b] = colour.linear();
  return {r, g, b};
}

// Oklab (Ottosson 2020).
Vec3 oklabOf(const Vec3& linear) {
  Mat3 cones, lab;
  cones << 0.4122214708, 0.5363325363, 0.0514459929, 0.2119034982, 0.6806995451, 0.1073969566, 0.0883024619,
      0.2817188376, 0.6299787005;
  lab << 0.2104542553, 0.7936177850, -0.0040720468, 1.9779984951, -2.4285922050, 0.4505937099, 0.0259040371,
      0.7827717662, -0.8086757660;
  const Vec3 lms = cones * linear.cwiseMax(0).cwiseMin(1);
  return lab * Vec3(std::cbrt(lms.x()), std::cbrt(lms.y()), std::cbrt(lms.z()));
}

TEST(Palette, ColoursOfBodiesAreToldApartByEveryone) {
  const std::vector<Colour> colours = bodyColours();
  ASSERT_GE(colours.size(), 8u);
  for (const Mat3& vision : visions())
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double apart =
            (oklabOf(vision * linearOf(colours[i])) - oklabOf(vision * linearOf(colours[j]))).norm();
        EXPECT_TRUE(apart >= 0.09) << colours[i].hex() << " " << colours[j].hex() << " " << apart;
      }
}

TEST(Palette, ColoursOfBodiesAreSeenOnWhite) {
  for (const Colour& colour : bodyColours()) {
    const double luminance = Vec3(0.2126, 0.7152, 0.0722).dot(linearOf(colour));
    EXPECT_TRUE(1.05 / (luminance + 0.05) >= 3) << colour.hex();
  }
}

TEST(Palette, BodiesOfExportsHaveTheSameColoursInTheirOrder) {
  Scene scene;
  for (int i = 0; i < 20; ++i) {
    Body body;
    body.fixed = i % 3 == 0;
    scene.bodies.push_back(body);
  }
  const std::vector<Colour> colours = bodyColours();
  std::size_t rank = 0;
  for (int i = 0; i < 20; ++i) {
    if (i % 3 == 0) continue;
    EXPECT_EQ(bodyColour(scene, i).hex(), colours[rank++ % colours.size()].hex());
  }
}

}  // namespace
}  // namespace carom::export_tests
