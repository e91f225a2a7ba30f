#pragma once

#include <span>
#include <string>
#include <vector>

/// Small text helpers for messages. Internal to editing/.
namespace carom {

/// Six significant digits: "0.45", "1.2e-07".
std::string number(double value);
/// "a, b and c".
std::string listOf(const std::vector<std::string>& items);

}  // namespace carom
