// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// Internal to the libraries: not installed, and no public header includes it.

/// What Eigen's products of large matrices of doubles come down to, compiled once, in matrix_kernels.cpp, and not again
/// in each of the twenty objects that multiply some. It is among the headers that all libraries that compute are compiled
/// with (carom_headers); who leaves it out gets the same, compiled there.
namespace carom::adjoint_detail {

template <int order>
using KernelInput = Eigen::internal::const_blas_data_mapper<double, Eigen::Index, order>;
using KernelOutput = Eigen::internal::blas_data_mapper<double, Eigen::Index, Eigen::ColMajor, Eigen::Unaligned, 1>;
using KernelTraits = Eigen::internal::gebp_traits<double, double>;

}  // namespace carom::adjoint_detail

#define CAROM_MATRIX_KERNELS(declare)                                                                                   \
  namespace Eigen::internal {                                                                                           \
  declare template struct gebp_kernel<double, double, Index, carom::adjoint_detail::KernelOutput,                       \
                                      carom::adjoint_detail::KernelTraits::mr, carom::adjoint_detail::KernelTraits::nr, \
                                      false, false>;                                                                    \
  declare template struct gemm_pack_lhs<                                                                                \
      double, Index, carom::adjoint_detail::KernelInput<ColMajor>, carom::adjoint_detail::KernelTraits::mr,             \
      carom::adjoint_detail::KernelTraits::LhsProgress, carom::adjoint_detail::KernelTraits::LhsPacket4Packing,         \
      ColMajor>;                                                                                                        \
  declare template struct gemm_pack_lhs<                                                                                \
      double, Index, carom::adjoint_detail::KernelInput<RowMajor>, carom::adjoint_detail::KernelTraits::mr,             \
      carom::adjoint_detail::KernelTraits::LhsProgress, carom::adjoint_detail::KernelTraits::LhsPacket4Packing,         \
      RowMajor>;                                                                                                        \
  declare template struct gemm_pack_rhs<double, Index, carom::adjoint_detail::KernelInput<ColMajor>,                    \
                                        carom::adjoint_detail::KernelTraits::nr, ColMajor>;                             \
  declare template struct gemm_pack_rhs<double, Index, carom::adjoint_detail::KernelInput<RowMajor>,                    \
                                        carom::adjoint_detail::KernelTraits::nr, RowMajor>;                             \
  declare template struct general_matrix_vector_product<Index, double, carom::adjoint_detail::KernelInput<ColMajor>,    \
                                                        ColMajor, false, double,                                        \
                                                        carom::adjoint_detail::KernelInput<RowMajor>, false>;           \
  declare template struct general_matrix_vector_product<Index, double, carom::adjoint_detail::KernelInput<RowMajor>,    \
                                                        RowMajor, false, double,                                        \
                                                        carom::adjoint_detail::KernelInput<ColMajor>, false>;           \
  }

CAROM_MATRIX_KERNELS(extern)
