// SPDX-License-Identifier: MIT
#pragma once

namespace carom::cli {

/// What `carom info` says of its build.
struct BuildFacts {
  const char* type;      ///< "Release"
  const char* compiler;  ///< with its version
  const char* ode;       ///< versions of libraries whose headers stay in their own places
  const char* ipopt;
};
BuildFacts buildFacts();

}  // namespace carom::cli
