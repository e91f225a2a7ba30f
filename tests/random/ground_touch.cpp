// SPDX-License-Identifier: MIT
#include "tests/random/ground_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom::test {
namespace {

constexpr double kFlat = 1e-7;      // rad, of a rim
constexpr double kSupports = 1e-8;  // m, beyond the lowest
constexpr double kRight = std::numbers::pi / 2;
constexpr int kOfRim = 64, kNormals = 90;

// About the shape's origin, the points that may be the lowest ones along n.
std::vector<Vec3> lowestOf(const Shape& shape, const Mat3& R, const Vec3& n) {
  std::vector<Vec3> points;
  const Vec3 axis = R.col(2);
  const auto rim = [&](double height, double radius) {
    const Vec3 down = axis.cross(axis.cross(n));  // across the axis, even where it is all rounding
    if (down.norm() > 0) points.push_back(height * axis + radius * down.normalized());
    if (down.norm() > kFlat) return;
    for (int i = 0; i < kOfRim; ++i) {
      const double a = 2 * std::numbers::pi * i / kOfRim;
      points.push_back(height * axis + radius * (std::cos(a) * R.col(0) + std::sin(a) * R.col(1)));
    }
  };
  const auto corners = [&](const std::vector<Vec3>& vertices, double scale) {
    for (const Vec3& v : vertices) points.push_back(scale * (R * v));
  };
  if (const auto* ball = std::get_if<Sphere>(&shape)) points.push_back(-ball->radius * n);
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    for (const double s : {-0.5, 0.5}) points.push_back(s * capsule->height * axis - capsule->radius * n);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    for (const double s : {-0.5, 0.5}) rim(s * cylinder->height, cylinder->radius);
  if (const auto* cone = std::get_if<Cone>(&shape)) {
    points.push_back(0.5 * cone->height * axis);
    rim(-0.5 * cone->height, cone->radius);
  }
  if (const auto* box = std::get_if<Box>(&shape))
    for (int v = 0; v < 8; ++v)
      points.push_back(0.5 * (R * Vec3(v & 1 ? box->size[0] : -box->size[0], v & 2 ? box->size[1] : -box->size[1],
                                       v & 4 ? box->size[2] : -box->size[2])));
  if (const auto* hull = std::get_if<Hull>(&shape)) corners(hull->surface->vertices, hull->scale);
  if (const auto* mesh = std::get_if<Mesh>(&shape)) corners(mesh->surface->vertices, mesh->scale);
  return points;
}

// Seen along the normal that is turned from n to the wall by the angle.
Vec3 normalAt(const Ground& ground, double angle) {
  return ground.wall ? Vec3(std::cos(angle) * ground.n + std::sin(angle) * ground.wall->m) : ground.n;
}

double offsetAt(const Ground& ground, double angle) {
  return ground.wall ? std::cos(angle) * ground.c + std::sin(angle) * ground.wall->d : ground.c;
}

double heightAt(const Ground& ground, const PlacedShape& placed, double angle) {
  const Vec3 n = normalAt(ground, angle);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : lowestOf(placed.shape, placed.R, n)) least = std::min(least, n.dot(p));
  return least + n.dot(placed.x) - offsetAt(ground, angle);
}

// d/d angle of that height.
double heightRate(const Ground& ground, const PlacedShape& placed, double angle) {
  const Vec3 n = normalAt(ground, angle), along = normalAt(ground, angle + kRight);
  const std::vector<Vec3> points = lowestOf(placed.shape, placed.R, n);
  const Vec3 p = *std::ranges::min_element(points, {}, [&](const Vec3& q) { return n.dot(q); });
  return along.dot(p + placed.x) - offsetAt(ground, angle + kRight);
}

// The angle from which they are seen farthest apart: the best of many, and from there on to where the height falls.
double bestAngle(const Ground& ground, const PlacedShape& placed) {
  if (!ground.wall) return 0;
  int best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kNormals; ++i)
    if (const double h = heightAt(ground, placed, kRight * i / kNormals); h > most) most = h, best = i;
  double low = kRight * std::max(0, best - 1) / kNormals, high = kRight * std::min(kNormals, best + 1) / kNormals;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (heightRate(ground, placed, middle) > 0 ? low : high) = middle;
  }
  double angle = (low + high) / 2;
  for (const double end : {0.0, kRight})
    if (heightAt(ground, placed, end) >= heightAt(ground, placed, angle)) angle = end;
  return angle;
}

// Where a circle about `middle` meets the line across t at t.p = 0; all in one plane with unit normal n.
void crossings(const Vec3& middle, double radius, const Vec3& t, const Vec3& n, std::vector<Vec3>& out) {
  const double off = t.dot(middle);
  if (!(std::abs(off) < radius)) return;
  const Vec3 along = std::sqrt(radius * radius - off * off) * n.cross(t);
  out.push_back(middle - off * t + along);
  out.push_back(middle - off * t - along);
}

void addTouches(const Ground& ground, const PlacedShape& placed, double angle, double reach, std::vector<GroundTouch>& out) {
  const Vec3 n = normalAt(ground, angle);
  std::vector<Vec3> candidates = lowestOf(placed.shape, placed.R, n);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : candidates) least = std::min(least, n.dot(p));
  if (!(least + n.dot(placed.x) - offsetAt(ground, angle) <= reach)) return;
  std::erase_if(candidates, [&](const Vec3& p) { return !(n.dot(p) <= least + kSupports + reach); });
  if (!ground.wall) {
    for (const Vec3& p : candidates) out.push_back({n, p});
    return;
  }
  // On the top face or the wall they touch up to the edge, from elsewhere at the edge alone.
  const Vec3 edge = ground.c * ground.n + ground.wall->d * ground.wall->m - placed.x;
  const bool top = angle <= 0, side = angle >= kRight;
  const Vec3 across = top ? ground.wall->m : side ? ground.n : Vec3(n.cross(ground.n.cross(ground.wall->m)).normalized());
  std::vector<Vec3> points;
  for (const Vec3& p : candidates) {
    const double beyond = across.dot(p - edge);
    if (top || side ? beyond <= reach : std::abs(beyond) <= reach) points.push_back(p);
  }
  if (candidates.size() < kOfRim) {
    for (std::size_t i = 0; i < candidates.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double a = across.dot(candidates[i] - edge), b = across.dot(candidates[j] - edge);
        if (a * b < 0) points.push_back(candidates[i] + a / (a - b) * (candidates[j] - candidates[i]));
      }
  } else {  // a flat round face
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < kOfRim; ++i) middle += candidates[candidates.size() - kOfRim + static_cast<std::size_t>(i)] / kOfRim;
    const double radius = (candidates.back() - middle).norm();
    std::vector<Vec3> cut;
    crossings(middle - edge, radius, across, n, cut);
    for (const Vec3& p : cut) points.push_back(p + edge);
  }
  for (const Vec3& p : points) out.push_back({n, p});
}

}  // namespace

double depthIn(const Ground& ground, const PlacedShape& placed) {
  return -heightAt(ground, placed, bestAngle(ground, placed));
}

std::vector<GroundTouch> touchesOf(const Ground& ground, const PlacedShape& placed, double reach) {
  std::vector<GroundTouch> out;
  const double best = bestAngle(ground, placed);
  if (!(heightAt(ground, placed, best) <= reach)) return out;
  addTouches(ground, placed, 0, reach, out);
  if (!ground.wall) return out;
  addTouches(ground, placed, kRight, reach, out);
  if (best > 0 && best < kRight) addTouches(ground, placed, best, reach, out);
  return out;
}

}  // namespace carom::test
