// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/base/format_error.h"

namespace carom::formats_detail {

/// Runs a function and adds the file to the places that its errors name. An error that names the file as its place is
/// one of the file as a whole.
template <class Function>
auto inFile(const std::string& path, const Function& function) {
  try {
    return function();
  } catch (const FormatError&) {
    throw;
  } catch (const InputError& error) {
    throw FormatError(path, error.where() == path ? "" : error.where(), error.message());
  }
}

}  // namespace carom::formats_detail
