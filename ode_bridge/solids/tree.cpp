// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

constexpr double kUp = 1 + 4 * std::numeric_limits<double>::epsilon();  // outweighs the rounding of a distance

struct Ball {
  Vec3 center;
  double radius;
};

double ballRadius(const Piece& p) { return p.radius > 0 ? kUp * (p.core_radius + p.radius) : p.core_radius; }

// The smallest ball about two others.
Vec3 middleOf(const Ball& a, const Ball& b) {
  const Vec3 apart = b.center - a.center;
  const double distance = apart.norm();
  if (distance + b.radius <= a.radius) return a.center;
  if (distance + a.radius <= b.radius) return b.center;
  return a.center + 0.5 * (1 + (b.radius - a.radius) / distance) * apart;
}

// Halves the pieces at the median along the longest side of the box about their middles, until one is left.
class TreeMaker {
 public:
  explicit TreeMaker(Solid& solid) : solid_(solid), order_(solid.pieces.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    solid_.nodes.clear();
    solid_.nodes.reserve(2 * order_.size());
  }

  void grow() {
    grow(0, order_.size());
    solid_.nodes[0].center = Vec3::Zero();
    solid_.nodes[0].radius = radiusAbout(Vec3::Zero(), 0, order_.size());
  }

 private:
  const Piece& piece(std::size_t i) const { return solid_.pieces[static_cast<std::size_t>(order_[i])]; }

  int grow(std::size_t first, std::size_t last) {
    const auto index = solid_.nodes.size();
    solid_.nodes.emplace_back();
    Node node;
    if (last - first == 1) {
      node.piece = order_[first];
      node.center = piece(first).center;
      node.radius = ballRadius(piece(first));
    } else {
      const std::size_t half = first + (last - first) / 2;
      split(first, half, last);
      node.left = grow(first, half);
      node.right = grow(half, last);
      const Ball ball = ballAbout(node, first, last);
      node.center = ball.center;
      node.radius = ball.radius;
    }
    solid_.nodes[index] = node;
    return static_cast<int>(index);
  }

  // Equal middles keep the order of the pieces, so that a solid has one tree only.
  void split(std::size_t first, std::size_t half, std::size_t last) {
    Vec3 low = piece(first).center, high = low;
    for (std::size_t i = first; i < last; ++i)
      low = low.cwiseMin(piece(i).center), high = high.cwiseMax(piece(i).center);
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [&](int a, int b) {
      const double along_a = solid_.pieces[static_cast<std::size_t>(a)].center[axis];
      const double along_b = solid_.pieces[static_cast<std::size_t>(b)].center[axis];
      return along_a != along_b ? along_a < along_b : a < b;
    });
  }

  // About the middle of the children's balls or of the box about the pieces, whichever needs less to hold the pieces.
  Ball ballAbout(const Node& node, std::size_t first, std::size_t last) const {
    const auto child = [this](int i) {
      const Node& n = solid_.nodes[static_cast<std::size_t>(i)];
      return Ball{n.center, n.radius};
    };
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 radius = Vec3::Constant(ballRadius(piece(i)));
      low = low.cwiseMin(piece(i).center - radius), high = high.cwiseMax(piece(i).center + radius);
    }
    const Vec3 between = middleOf(child(node.left), child(node.right)), of_box = 0.5 * (low + high);
    const double radius = radiusAbout(between, first, last), box_radius = radiusAbout(of_box, first, last);
    return radius <= box_radius ? Ball{between, radius} : Ball{of_box, box_radius};
  }

  double radiusAbout(const Vec3& center, std::size_t first, std::size_t last) const {
    double largest = 0;
    for (std::size_t i = first; i < last; ++i) {
      const double core = coreRadius(solid_, piece(i), center), radius = piece(i).radius;
      largest = std::max(largest, core > 0 && radius > 0 ? kUp * (core + radius) : core + radius);
    }
    return largest;
  }

  Solid& solid_;
  std::vector<int> order_;
};

}  // namespace

double coreRadius(const Solid& solid, const Piece& piece, const Vec3& center) {
  if (piece.core == Piece::Core::half_space) return kInfinity;
  if (piece.core == Piece::Core::frustum) {
    const Vec3 to = piece.center - center;
    const double along = std::abs(piece.axis.dot(to)), across = piece.axis.cross(to).norm();
    return kUp * elementary::hypot(along + piece.half_length, across + std::max(piece.rho, piece.rho_high));
  }
  double largest = 0;
  for (int i = 0; i < piece.points.count; ++i)
    largest =
        std::max(largest, (solid.points[static_cast<std::size_t>(piece.points.first + i)] - center).squaredNorm());
  return kUp * std::sqrt(largest);
}

// Counted, then filled in, in the order of the edges.
void addNeighbours(Solid& solid) {
  std::vector<int>& first = solid.neighbour_first;
  first.assign(solid.vertices.size() + 1, 0);
  const auto ends = [&](const SolidEdge& e, const auto& visit) {
    if (e.from < 0) return;
    visit(static_cast<std::size_t>(e.from), e.to);
    visit(static_cast<std::size_t>(e.to), e.from);
  };
  for (const SolidEdge& e : solid.edges) ends(e, [&](std::size_t v, int) { ++first[v + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  solid.neighbours.resize(static_cast<std::size_t>(first.back()));
  std::vector<int> next(first.begin(), first.end() - 1);
  for (const SolidEdge& e : solid.edges)
    ends(e, [&](std::size_t v, int other) { solid.neighbours[static_cast<std::size_t>(next[v]++)] = other; });
}

void addTree(Solid& solid) { TreeMaker(solid).grow(); }

}  // namespace carom::solids
