// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace carom {

/// What figures were measured on: processor, number of cores, compiler, versions of libraries and of carom, date.
std::string machineLine();

}  // namespace carom
