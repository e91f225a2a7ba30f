// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>

namespace carom::ode_bridge_detail {

/// Initialises the collision library once in the process and gives the lock that guards creation and destruction of its
/// objects, which share state between threads.
std::unique_lock<std::mutex> lockOde();

/// Sets up the collision library's data of the calling thread, once a thread.
void prepareOdeThread();

}  // namespace carom::ode_bridge_detail
