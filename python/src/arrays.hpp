// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/types.h"
#include "python/src/bindings.hpp"

namespace carom::python {

// Two kinds of arrays, float64 in C order: attributes give read-only ones, so that writing to a part of what is computed
// anew at each access is an error instead of being lost; functions give arrays that belong to the caller.

template <int... sizes>
using ReadOnly = nb::ndarray<nb::numpy, const double, nb::shape<sizes...>, nb::c_contig>;
template <int... sizes>
using Array = nb::ndarray<nb::numpy, double, nb::shape<sizes...>, nb::c_contig>;

/// A view of what an object holds; as an attribute it keeps the object alive.
inline ReadOnly<3> view(const Vec3& vector) { return ReadOnly<3>(vector.data()); }
inline ReadOnly<4> view(const Eigen::Vector4d& vector) { return ReadOnly<4>(vector.data()); }
inline ReadOnly<2> view(const Vec2& vector) { return ReadOnly<2>(vector.data()); }

/// An array with its own memory: the numbers in C order. For attributes pass kOwnArray along.
template <class ArrayType>
ArrayType owning(std::vector<double> numbers, std::initializer_list<std::size_t> shape) {
  if (numbers.empty()) numbers.reserve(1);  // an address, of an array without entries, too
  auto kept = std::make_unique<std::vector<double>>(std::move(numbers));
  const nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
  return ArrayType(kept.release()->data(), shape, owner);
}
/// A copy of a vector, and of a matrix in C order.
template <class ArrayType>
ArrayType copied(const Eigen::VectorXd& vector) {
  return owning<ArrayType>({vector.data(), vector.data() + vector.size()}, {static_cast<std::size_t>(vector.size())});
}
template <class ArrayType>
ArrayType copied(const Eigen::MatrixXd& matrix) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) numbers.push_back(matrix(i, j));
  return owning<ArrayType>(std::move(numbers), {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())});
}
/// An attribute that is an array with its own memory needs no other owner.
inline constexpr auto kOwnArray = nb::rv_policy::automatic;

/// (w, x, y, z), as in documents.
inline Eigen::Vector4d wxyz(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// An argument that NumPy reads as an array of numbers: a sequence, an array.
class ArrayLike : public nb::object {
  static bool isAny(PyObject*) { return true; }
  NB_OBJECT_DEFAULT(ArrayLike, nb::object, "numpy.typing.ArrayLike", isAny)
};

/// float64 in C order, of whatever shape. Throws InputError naming `where`: no real numbers.
nb::ndarray<const double, nb::c_contig, nb::device::cpu> numbersOf(const ArrayLike& argument, const char* where);
/// The same in this shape, -1: any size. Throws InputError naming `where`, the shape found and that expected.
nb::ndarray<const double, nb::c_contig, nb::device::cpu> numbersOf(const ArrayLike& argument, const char* where,
                                                                   const std::vector<long>& shape);
Vec3 vectorOf(const ArrayLike& argument, const char* where);  ///< 3 numbers
Quat quaternionOf(const ArrayLike& argument, const char* where);  ///< w, x, y, z, as they are
Mat3 matrixOf(const ArrayLike& argument, const char* where);      ///< 3x3
Eigen::VectorXd columnOf(const ArrayLike& argument, const char* where);  ///< any number of numbers

}  // namespace carom::python
