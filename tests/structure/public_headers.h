// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_rules.h"

namespace carom::structure {

/// In the libraries a header that ends in .h is public and is installed; one that ends in .hpp is not. Sentences about
/// public headers that include private ones, which nobody has who installs carom.
std::vector<std::string> privateIncludes(const std::string& path, const std::string& text);

/// The types and aliases that a header defines at the scope of a namespace, as carom::gltf::Frame.
std::vector<std::string> definedTypes(const std::string& text);

/// Types that a private header defines in namespace carom itself, where the names are those of users.
std::vector<std::string> privateNamesInCarom(const std::string& path, const std::string& text);

/// Types of the libraries that two headers define: one program cannot hold both.
std::vector<std::string> typesDefinedTwice(const Sources& sources);

/// Public types of the libraries that no program in examples/ uses. Not asked of the templates behind a type (PoseOf
/// behind Pose) and of what only the answers of the command are made of.
std::vector<std::string> typesWithoutExample(const Sources& sources);

}  // namespace carom::structure
