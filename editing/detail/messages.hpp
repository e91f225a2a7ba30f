// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/base/errors.h"

/// Small helpers for messages. Internal to editing/.
namespace carom::editing_detail {

/// Six significant digits: "0.45", "1.2e-07".
std::string number(double value);
/// Three significant digits, for sentences that people read while they work: "0.45", "1.2e-07".
std::string brief(double value);
/// Three significant digits, or as many as tell the number from another one that is named beside it.
std::string briefBeside(double value, double other);
/// A clause as a sentence: with a capital and a full stop.
std::string sentence(std::string clause);
/// "a, b and c".
std::string listOf(const std::vector<std::string>& items);

/// Runs a look-up by name and adds the place to its error.
template <class Find>
int findAt(const std::string& where, Find find) {
  try {
    return find();
  } catch (const InputError& error) {
    throw InputError(where, error.message());
  }
}

}  // namespace carom::editing_detail
