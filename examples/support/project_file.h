// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace carom {

/// The path of a file or folder of this repository, which stands where it was built: projectFile("examples/scenes/coin.json").
std::string projectFile(const std::string& name);

}  // namespace carom
