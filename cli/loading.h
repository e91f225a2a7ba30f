// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "editing/problem/edit_problem.hpp"
#include "formats/base/document.h"
#include "formats/base/in_file.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::cli {

using namespace editing_detail;

/// A scene document that is ready to be simulated.
struct Loaded {
  /// Of a file, or of standard input ("-"). Throws FormatError: the file cannot be read, the document is not valid, or
  /// bodies overlap at the start and that is refused.
  Loaded(const Output& out, const std::string& file, const MotionArguments& arguments = {});

  std::string path;  ///< as errors call it
  Document document;
  OdeContacts contacts;
  std::size_t step_limit;

  /// As far as it comes before the limit of work or a signal.
  Motion simulate(const Output& out);
};

/// A warning for people for every two bodies that overlap at the start.
void warnOfOverlaps(const Output& out, const Loaded& loaded);

/// Throws Interrupted where a signal stopped the motion.
void requireNotStopped(const Motion& motion);

/// A warning for people when the motion ended before its duration.
void warnIfEnded(const Output& out, const Motion& motion);

/// Of a command whose answer is a motion that no signal stopped.
Exit exitOf(const Motion& motion);

/// The rows and controls of a document at the scene as written: bounds are checked, then left out, so that derivatives
/// are those of what is written. Throws FormatError: nothing varies, nothing is held, or either is not possible.
EditProblem derivativeProblem(Loaded& loaded);

/// Simulates a problem at some values up to its horizon. Throws Interrupted where a signal stops it.
Motion simulateStoppable(const Output& out, EditProblem& problem, const Eigen::VectorXd& values);

/// Reads all rows in a motion. Throws FormatError naming the first constraint that the motion does not have.
RowValues requireRows(const std::string& path, const EditProblem& problem, const Motion& motion);

}  // namespace carom::cli
