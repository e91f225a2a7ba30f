// SPDX-License-Identifier: MIT
// `carom studio` as a process: how it starts, what it prints, how the browser is opened, how it ends.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/cli/run_command.h"
#include "tests/studio/share_folder.h"
#include "tests/studio/test_scene.h"

namespace carom::test {
namespace {

using studio::ShareFolder;

struct StudioCommand : testing::Test {
  ShareFolder share;

  void SetUp() override { share.write("work/bounce.json", studio::kTestScene); }
  std::string quoted(const std::string& name) const { return "'" + (share / name).string() + "'"; }
  /// The command with its scene, its output in the file `out`, and once it serves `then`; then it is told to end.
  CommandRun serve(const std::string& before, const std::string& options, const std::string& then) const {
    return runShell(before + " carom studio " + quoted("work/bounce.json") + " --page '" + share.path() + "' " +
                    options + " > " + quoted("out") + " & " + then + "; kill -TERM $!; wait $!");
  }
};

TEST_F(StudioCommand, PrintsOneLineAndEndsCleanly) {
  // reading the first line waits for it
  const CommandRun run =
      runShell("mkfifo " + quoted("pipe") + "; carom studio " + quoted("work/bounce.json") + " --page '" +
               share.path() + "' --no-open > " + quoted("pipe") + " & { read line; kill -TERM $!; cat; } < " +
               quoted("pipe") + " > " + quoted("more") + "; wait $!; code=$?; echo \"$line\"; exit $code");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("http://127.0.0.1:"), 0u) << run.out;
  EXPECT_EQ(run.out.size() - run.out.find("/#"), 2u + 64u + 1u) << run.out;
  EXPECT_EQ(share.read("more"), "");
  EXPECT_EQ(run.err, "");
}

// A browser that is opened outlives the studio: it must not hold its port, be ended with it, or write into its output.
TEST_F(StudioCommand, OpensABrowserThatStandsOnItsOwn) {
  // what a waiting shell blocks and opens for itself is not looked at
  share.write("bin/xdg-open",
              "#!/bin/sh\necho to the output\n{ echo \"$1\"; cut -d ' ' -f 1,6 /proc/$$/stat; "
              "grep SigBlk /proc/self/status; ls -l /proc/$$/fd; } > " +
                  quoted("seen") + "\n");
  std::filesystem::permissions(share / "bin/xdg-open", std::filesystem::perms::owner_all);
  ASSERT_EQ(runShell("mkfifo " + quoted("seen")).code, 0);
  const CommandRun run = serve("DISPLAY=:7 PATH=" + quoted("bin") + ":$PATH", "", "cat " + quoted("seen"));
  EXPECT_EQ(run.code, 0) << run.err;
  std::istringstream seen(run.out);
  std::string address, ids, blocked;
  std::getline(seen, address), std::getline(seen, ids), std::getline(seen, blocked);
  EXPECT_EQ(share.read("out"), address + "\n");
  for (const char* ours : {"socket:", "anon_inode:"}) EXPECT_EQ(run.out.find(ours), std::string::npos) << run.out;
  const std::size_t space = ids.find(' ');
  ASSERT_NE(space, std::string::npos) << run.out;
  EXPECT_EQ(ids.substr(0, space), ids.substr(space + 1)) << "a session of its own";
  EXPECT_EQ(blocked.find_first_not_of("SigBlk:\t 0"), std::string::npos) << blocked;
}

TEST_F(StudioCommand, SaysWhatIsMissing) {
  share.remove("three/build/three.core.js");
  const CommandRun run = runCommand({"studio", "--no-open", "--page", share.path()});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("three.js is not installed"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("run scripts/setup studio"), std::string::npos) << run.err;
  EXPECT_EQ(runCommand({"studio", "--port", "x"}).code, 2);
  EXPECT_EQ(runCommand({"studio", "nowhere.json", "--page", ShareFolder().path()}).code, 1);
}

}  // namespace
}  // namespace carom::test
