// SPDX-License-Identifier: MIT
// docs/tutorial.md as a reader meets it: its files are those of the repository, every command runs and prints what the
// page shows, its pictures are there. scripts/tutorial does the work, and writes the page again where it is to change.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "examples/support/project_file.h"
#include "tests/cli/run_command.h"

namespace carom {
namespace {

TEST(Tutorial, ThePageShowsWhatHappens) {
  const std::string command = "'" + projectFile("scripts/tutorial") + "' --check '" + test::commandPath() + "' 2>&1";
  FILE* const run = popen(command.c_str(), "r");
  ASSERT_NE(run, nullptr);
  std::string printed;
  char part[4096];
  while (const std::size_t count = std::fread(part, 1, sizeof part, run)) printed.append(part, count);
  const int status = pclose(run);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << printed;
}

}  // namespace
}  // namespace carom
