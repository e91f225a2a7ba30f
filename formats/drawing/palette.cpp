// SPDX-License-Identifier: MIT
#include "formats/drawing/palette.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "adjoint/base/arguments.hpp"

namespace carom::formats_detail {

using namespace adjoint_detail;

namespace {

constexpr Colour rgb(int code) { return {(code >> 16 & 255) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0}; }

// At least 0.09 apart in Oklab, as seen by protanopes, deuteranopes and tritanopes too (tests/export/palette_test.cpp).
constexpr std::array kMoving = {rgb(0x2468b8), rgb(0xd4740a), rgb(0x652092), rgb(0x0b97ff),
                                rgb(0x861911), rgb(0xc07bbd), rgb(0x195555), rgb(0x84610e)};
constexpr std::array kFixed = {rgb(0xb9bec4), rgb(0xa7adb5), rgb(0xc9c6c0), rgb(0x9aa3a6)};

double linearOf(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

}  // namespace

std::string Colour::hex() const {
  const auto byte = [](double s) { return static_cast<int>(std::lround(255 * std::clamp(s, 0.0, 1.0))); };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(r), byte(g), byte(b));
  return text;
}

std::array<double, 3> Colour::linear() const { return {linearOf(r), linearOf(g), linearOf(b)}; }

Colour Colour::mixedWith(const Colour& other, double share) const {
  return {r + share * (other.r - r), g + share * (other.g - g), b + share * (other.b - b)};
}

std::vector<Colour> bodyColours() { return {kMoving.begin(), kMoving.end()}; }

Colour bodyColour(const Scene& scene, int body) {
  const bool fixed = scene.bodies[checkedIndex("bodyColour", "body", body, scene.bodies.size())].fixed;
  std::size_t rank = 0;
  for (int i = 0; i < body; ++i) rank += scene.bodies[i].fixed == fixed;
  return fixed ? kFixed[rank % kFixed.size()] : kMoving[rank % kMoving.size()];
}

}  // namespace carom::formats_detail
