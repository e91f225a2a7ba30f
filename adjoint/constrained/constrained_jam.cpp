// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_jam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// Of the pyramid around a cone of friction.
constexpr int kEdges = 24;
// What a weighted acceleration may have of rounding, as a share of its terms, and a proof must have more than.
constexpr double kJamRounding = 1e-12, kJamProved = 1e-9;
constexpr int kJamRounds = 600;

// min |G x + b| over x >= 0, by Lawson and Hanson's active set; gives G x + b.
Eigen::VectorXd leastRemainder(const Eigen::MatrixXd& G, const Eigen::VectorXd& b) {
  std::vector<Eigen::Index> in;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(G.cols());
  for (int round = 0; round < kJamRounds; ++round) {
    const Eigen::VectorXd pull = -(G.transpose() * (G * x + b));
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < G.cols(); ++i)
      if (std::ranges::find(in, i) == in.end() && (best < 0 || pull[i] > pull[best])) best = i;
    if (best < 0 || !(pull[best] > kJamRounding * b.norm())) break;
    in.push_back(best);
    while (!in.empty()) {
      const auto size = static_cast<Eigen::Index>(in.size());
      Eigen::MatrixXd part(G.rows(), size);
      for (Eigen::Index c = 0; c < size; ++c) part.col(c) = G.col(in[static_cast<std::size_t>(c)]);
      const Eigen::VectorXd to = CompleteOrthogonal(part, kJamRounding).solve(-b);
      double step = 1;
      Eigen::Index leave = -1;
      for (Eigen::Index c = 0; c < size; ++c) {
        const double from = x[in[static_cast<std::size_t>(c)]];
        if (to[c] <= 0 && from <= step * (from - to[c])) step = from > to[c] ? from / (from - to[c]) : 0, leave = c;
      }
      for (Eigen::Index c = 0; c < size; ++c) {
        double& value = x[in[static_cast<std::size_t>(c)]];
        value += step * (to[c] - value);
      }
      if (leave < 0) break;
      x[in[static_cast<std::size_t>(leave)]] = 0;
      in.erase(in.begin() + leave);
    }
  }
  return G * x + b;
}

}  // namespace

std::optional<ConstrainedJam> jamOf(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts) {
  const auto size = static_cast<Eigen::Index>(contacts.size());
  const ConstrainedDynamics free(body, {}, false);
  Eigen::VectorXd b(size);
  std::vector<Eigen::VectorXd> columns;
  for (Eigen::Index k = 0; k < size; ++k) b[k] = free.gapAcceleration(contacts[static_cast<std::size_t>(k)]);
  for (const ContactInstant<double>& c : contacts) {
    const auto add = [&](const Vec3& force) {
      const Vec3 spin = body.A * c.r.cross(force);
      Eigen::VectorXd column(size);
      for (Eigen::Index k = 0; k < size; ++k) {
        const ContactInstant<double>& at = contacts[static_cast<std::size_t>(k)];
        column[k] = at.n.dot(Vec3(force * body.inverse_mass + spin.cross(at.r)));
      }
      const double length = column.norm();
      if (length > 0) columns.push_back(column / length);
    };
    if (c.mode == ContactMode::slides || !(c.friction > 0)) {
      add(c.push());
      continue;
    }
    const Vec3 along = c.n.unitOrthogonal(), across = c.n.cross(along);
    const double outside = c.friction / elementary::cos(std::numbers::pi / kEdges);
    for (int i = 0; i < kEdges; ++i) {
      const auto [sine, cosine] = elementary::sincos(2 * std::numbers::pi * i / kEdges);
      add(c.n + outside * (cosine * along + sine * across));
    }
  }
  // Accelerations that are wanted, of either sign, are forces and room: G x + b = 0 with x >= 0.
  Eigen::MatrixXd G(size, static_cast<Eigen::Index>(columns.size()) + size);
  for (std::size_t i = 0; i < columns.size(); ++i) G.col(static_cast<Eigen::Index>(i)) = columns[i];
  G.rightCols(size) = -Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd w = -leastRemainder(G, b);
  w = w.cwiseMax(0);
  const double sum = w.sum();
  if (!(sum > kJamProved * b.norm())) return std::nullopt;
  w /= sum;
  const double deeper = -w.dot(b);
  if (!(deeper > kJamProved * b.norm())) return std::nullopt;
  for (const Eigen::VectorXd& column : columns)
    if (!(w.dot(column) <= kJamProved)) return std::nullopt;
  return ConstrainedJam{std::vector<double>(w.data(), w.data() + size), deeper};
}

}  // namespace carom::adjoint_detail
