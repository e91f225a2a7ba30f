// SPDX-License-Identifier: MIT
#include "python/src/arrays.hpp"

#include "adjoint/base/errors.h"

namespace carom::python {
namespace {

using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

std::string shapeText(const std::vector<long>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? ", " : "") + (shape[i] < 0 ? std::string("n") : std::to_string(shape[i]));
  return text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace

Numbers numbersOf(const ArrayLike& argument, const char* where) {
  try {
    const nb::object array = nb::module_::import_("numpy").attr("asarray")(argument);
    const std::string kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    const bool empty = nb::cast<std::size_t>(array.attr("size")) == 0;
    if (kind != "f" && kind != "i" && kind != "u" && !empty)
      throw InputError(where, "found values of the type " + pythonText(array.attr("dtype")) +
                                  ", expected real numbers");
    return nb::cast<Numbers>(array.attr("astype")("float64", nb::arg("order") = "C", nb::arg("copy") = false));
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw InputError(where, "found what is no array of numbers: " + pythonText(error.value()));
  }
}

Numbers numbersOf(const ArrayLike& argument, const char* where, const std::vector<long>& shape) {
  Numbers numbers = numbersOf(argument, where);
  std::vector<long> found;
  for (std::size_t i = 0; i < numbers.ndim(); ++i) found.push_back(static_cast<long>(numbers.shape(i)));
  bool same = found.size() == shape.size();
  for (std::size_t i = 0; same && i < found.size(); ++i) same = shape[i] < 0 || shape[i] == found[i];
  if (!same) throw InputError(where, "found the shape " + shapeText(found) + ", expected " + shapeText(shape));
  return numbers;
}

Vec3 vectorOf(const ArrayLike& argument, const char* where) {
  const Numbers numbers = numbersOf(argument, where, {3});
  return Eigen::Map<const Vec3>(numbers.data());
}

Quat quaternionOf(const ArrayLike& argument, const char* where) {
  const Numbers numbers = numbersOf(argument, where, {4});
  const double* q = numbers.data();
  return Quat(q[0], q[1], q[2], q[3]);
}

Eigen::VectorXd columnOf(const ArrayLike& argument, const char* where) {
  const Numbers numbers = numbersOf(argument, where, {-1});
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Mat3 matrixOf(const ArrayLike& argument, const char* where) {
  const Numbers numbers = numbersOf(argument, where, {3, 3});
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
}

}  // namespace carom::python
