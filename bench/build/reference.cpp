// SPDX-License-Identifier: MIT
// What compiling is measured by (bench/build/cost): of the character of this project's sources, expressions of Eigen in
// many sizes, with numbers of one's own, among variants, maps and algorithms; but of the standard library and Eigen
// alone, so that no change of the project changes it. It is compiled and never run. Who changes it sets the limits anew.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace measured {

// A number with N derivatives.
template <int N>
struct Jet {
  double value = 0;
  Eigen::Matrix<double, N, 1> slope = Eigen::Matrix<double, N, 1>::Zero();

  Jet() = default;
  Jet(double constant) : value(constant) {}
  Jet(double number, Eigen::Matrix<double, N, 1> derivative) : value(number), slope(std::move(derivative)) {}

  friend Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Jet operator-(const Jet& a) { return {-a.value, -a.slope}; }
  friend Jet operator*(const Jet& a, const Jet& b) { return {a.value * b.value, a.slope * b.value + b.slope * a.value}; }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.slope - ratio * b.slope) / b.value};
  }
  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  Jet& operator/=(const Jet& b) { return *this = *this / b; }
  friend auto operator<=>(const Jet& a, const Jet& b) { return a.value <=> b.value; }
  friend bool operator==(const Jet& a, const Jet& b) { return a.value == b.value; }
};

}  // namespace measured

template <int N>
struct Eigen::NumTraits<measured::Jet<N>> : Eigen::NumTraits<double> {
  using Real = measured::Jet<N>;
  using NonInteger = measured::Jet<N>;
  using Nested = measured::Jet<N>;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N, MulCost = 2 * N };
};

namespace measured {

// Expressions of a pose, a lever and an inertia.
template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> response(const Eigen::Matrix<Scalar, 3, 3>& turn, const Eigen::Matrix<Scalar, 3, 1>& lever,
                                     const Eigen::Matrix<Scalar, 3, 1>& impulse) {
  const Eigen::Matrix<Scalar, 3, 3> inertia = turn * lever.asDiagonal() * turn.transpose();
  const Eigen::Matrix<Scalar, 3, 1> spin = inertia * lever.cross(impulse) + turn.transpose() * impulse;
  return (spin.cross(lever) + impulse - turn.col(2) * impulse.dot(lever)) / (Scalar(1.0) + lever.squaredNorm());
}

// Gauss' elimination, by blocks.
template <typename Scalar, int N>
Eigen::Matrix<Scalar, N, 1> eliminated(Eigen::Matrix<Scalar, N, N> rows, Eigen::Matrix<Scalar, N, 1> right) {
  for (int i = 0; i + 1 < N; ++i) {
    const int rest = N - i - 1;
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> factors = rows.col(i).tail(rest) / rows(i, i);
    rows.bottomRightCorner(rest, rest) -= factors * rows.row(i).tail(rest);
    right.tail(rest) -= factors * right(i);
  }
  return rows.template triangularView<Eigen::Upper>().solve(right);
}

template <int N>
double solved(const Eigen::Matrix<double, N, N>& matrix, const Eigen::Matrix<double, N, 1>& right) {
  const Eigen::Matrix<double, N, N> square = matrix.transpose() * matrix + Eigen::Matrix<double, N, N>::Identity();
  const Eigen::Matrix<double, N, 1> lower = square.ldlt().solve(right) + eliminated<double, N>(square, right);
  const Eigen::Matrix<double, N, 1> least = matrix.transpose() * (right - matrix * lower);
  return (least + matrix.partialPivLu().solve(lower)).norm();
}

template <int N>
double sloped(const Eigen::Matrix<Jet<N>, 3, 3>& turn, const Eigen::Matrix<Jet<N>, 3, 1>& lever) {
  const Eigen::Matrix<Jet<N>, 3, 1> moved = response<Jet<N>>(turn, lever, turn * lever);
  const Eigen::Matrix<Jet<N>, 3, 1> held = eliminated<Jet<N>, 3>(turn, moved);
  return held.dot(moved).slope.sum();
}

struct Ball { double radius; };
struct Box { Eigen::Vector3d half; };
struct Mesh { std::vector<Eigen::Vector3d> corners; };
using Shape = std::variant<Ball, Box, Mesh>;

// The support point of any shape in any direction, and what is farthest by name.
struct Support {
  Eigen::Vector3d direction;
  Eigen::Vector3d operator()(const Ball& ball) const { return ball.radius * direction.normalized(); }
  Eigen::Vector3d operator()(const Box& box) const { return direction.array().sign() * box.half.array(); }
  Eigen::Vector3d operator()(const Mesh& mesh) const {
    return *std::max_element(mesh.corners.begin(), mesh.corners.end(), [this](const auto& a, const auto& b) {
      return a.dot(direction) < b.dot(direction);
    });
  }
};

std::map<std::string, std::optional<Eigen::Vector3d>> farthest(const std::map<std::string, std::vector<Shape>>& shapes,
                                                               const Eigen::Vector3d& direction) {
  std::map<std::string, std::optional<Eigen::Vector3d>> answer;
  for (const auto& [name, parts] : shapes) {
    std::vector<std::pair<double, Eigen::Vector3d>> found;
    for (const Shape& part : parts) {
      const Eigen::Vector3d point = std::visit(Support{direction}, part);
      found.emplace_back(point.dot(direction), point);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    answer[name] = found.empty() ? std::nullopt : std::optional(found.front().second);
  }
  return answer;
}

template <int... N>
double all(const Eigen::MatrixXd& matrix, std::integer_sequence<int, N...>) {
  std::vector<std::function<double()>> tasks;
  (tasks.emplace_back([&matrix] {
    return solved<N + 2>(matrix.topLeftCorner<N + 2, N + 2>(), matrix.col(0).head<N + 2>()) +
           sloped<N + 2>(matrix.topLeftCorner<3, 3>().template cast<Jet<N + 2>>(),
                         matrix.col(0).head<3>().template cast<Jet<N + 2>>());
  }), ...);
  return std::accumulate(tasks.begin(), tasks.end(), 0.0, [](double sum, const auto& task) { return sum + task(); });
}

double reference(const Eigen::MatrixXd& matrix, const std::map<std::string, std::vector<Shape>>& shapes) {
  double sum = all(matrix, std::make_integer_sequence<int, 2>());
  for (const auto& [name, point] : farthest(shapes, matrix.col(0).head<3>())) {
    sum += point ? point->norm() : static_cast<double>(name.size());
  }
  return sum;
}

}  // namespace measured
