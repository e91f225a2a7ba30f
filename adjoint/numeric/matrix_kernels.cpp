// SPDX-License-Identifier: MIT
#include "adjoint/numeric/matrix_kernels.hpp"

CAROM_MATRIX_KERNELS()
