#pragma once

#include <string>

namespace carom {

/// What figures were measured on: processor, number of cores, compiler, versions of Eigen and carom.
std::string machineLine();

}  // namespace carom
