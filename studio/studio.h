// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "editing/session_journal.h"
#include "studio/limits.h"

namespace carom::studio {

/// Work is limited in counted units, not in time, so that a drag gives the same result on every machine.
SessionOptions countedWork();

/// How the studio is started.
struct StudioOptions {
  std::string scene;        ///< document that is open at first; empty: none
  std::string folder;       ///< what pages may open and save in; empty: the scene's, else the current one
  unsigned short port = 0;  ///< 0: one that is free
  std::string share;        ///< folder of the page, three.js and the example scenes; empty: as installed
  Limits limits;            ///< what clients may take
  SessionOptions solving = countedWork();  ///< how sessions solve
  std::string recent = {};  ///< file of the scenes that were opened last; empty: they are not kept
  std::function<void(const std::string& address)> ready;  ///< it serves; called once, with the address of the page
  std::stop_token stop;                                   ///< ends it
};

/// Serves the page of the studio on this machine until it is stopped; gives the exit code of the program. Throws
/// InputError: a scene that cannot be read, no page, no three.js, a port that cannot be had.
int studio(const StudioOptions& options);

}  // namespace carom::studio
