// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/session_journal.h"

namespace carom::formats_detail {

/// One gesture as an object of a journal; names of files are relative to the folder.
std::string gestureText(const SessionGesture& gesture, const std::string& folder);

}  // namespace carom::formats_detail
