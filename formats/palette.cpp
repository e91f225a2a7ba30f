#include "formats/palette.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace carom {
namespace {

constexpr Colour rgb(int code) { return {(code >> 16 & 255) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0}; }

constexpr std::array kMoving = {rgb(0x2f6fb7), rgb(0xe07b28), rgb(0x8a4fa8), rgb(0xc9393f),
                                rgb(0x1f9aa0), rgb(0x8c6239), rgb(0xd65fa3), rgb(0x6b7f1a)};
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

Colour bodyColour(const Scene& scene, int body) {
  const bool fixed = scene.bodies[body].fixed;
  std::size_t rank = 0;
  for (int i = 0; i < body; ++i) rank += scene.bodies[i].fixed == fixed;
  return fixed ? kFixed[rank % kFixed.size()] : kMoving[rank % kMoving.size()];
}

}  // namespace carom
