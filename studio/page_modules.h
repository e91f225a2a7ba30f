// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "studio/page_files.h"

namespace carom::studio {

/// The modules that a module of the page needs, itself included, for an import map: by their addresses without the first
/// "/" ("view/view.js"), which are the names that they import each other by. Throws InputError for one that is missing.
std::map<std::string, std::string> modulesFrom(const PageFiles& files, const std::string& first);

}  // namespace carom::studio
