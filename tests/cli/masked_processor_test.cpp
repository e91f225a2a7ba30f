// SPDX-License-Identifier: MIT
// The command gives the same bytes where the C library is told that the processor has neither fused multiply-add nor
// AVX2. In test_cli itself the functions are ours, as in the command; so the C library's are asked for by dlsym.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "formats/documents/journal_json.h"
#include "formats/documents/scene_json.h"
#include "tests/cli/run_command.h"
#include "tests/cli/short_session.h"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

using Words = std::vector<std::string>;

/// glibc's way to leave out what processors may lack, for the processes that start while it lives.
class Mask {
 public:
  Mask() { setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F", 1); }
  ~Mask() { unsetenv("GLIBC_TUNABLES"); }
  Mask(const Mask&) = delete;
  Mask& operator=(const Mask&) = delete;
};

// Also run in processes of its own, with the mask and without, for what it prints.
TEST(LibraryOfC, HasSines) {
  void* library = dlopen("libm.so.6", RTLD_NOW);
  if (library == nullptr) GTEST_SKIP() << "no libm.so.6";
  const auto sine = reinterpret_cast<double (*)(double)>(dlsym(library, "sin"));
  ASSERT_NE(sine, nullptr);
  for (int i = 1; i <= 2000; ++i) {
    const double value = sine(0.0037 * i);
    EXPECT_TRUE(std::abs(value) <= 1);
    std::printf("sine %a\n", value);
  }
}

// What libraries look for when they are loaded: with cli/c_functions.cpp linked in, they find ours in the program.
TEST(LibraryOfC, GivesWayToTheProgram) {
  Dl_info program{}, found{};
  ASSERT_NE(dladdr(reinterpret_cast<void*>(&sceneNames), &program), 0);
  for (const char* name : {"sin", "cos", "tan", "sincos", "atan2", "exp", "log", "log10", "pow", "sinh", "cosh", "cbrt",
                           "hypot"}) {
    ASSERT_NE(dladdr(dlsym(RTLD_DEFAULT, name), &found), 0) << name;
    EXPECT_EQ(found.dli_fbase, program.dli_fbase) << name << " is found in " << found.dli_fname;
  }
}

std::string sinesOfTheLibrary() {
  const CommandRun run = runProgram("/proc/self/exe", {"--gtest_brief=1", "--gtest_filter=LibraryOfC.HasSines"});
  std::string sines;
  for (std::size_t at = run.out.find("sine "); at != std::string::npos; at = run.out.find("sine ", at + 1))
    sines += run.out.substr(at, run.out.find('\n', at) + 1 - at);
  return sines;
}

/// Whether the mask changes anything here: without fused multiply-add, or with another C library, it does not.
bool maskIsFelt() {
  const std::string plain = sinesOfTheLibrary();
  const Mask mask;
  return !plain.empty() && sinesOfTheLibrary() != plain;
}

/// Exit code and output without the time that it took, then the file that it wrote.
std::string answerOf(Words arguments, bool writes) {
  const std::string out = temporaryPath("written");
  if (writes) arguments.insert(arguments.end(), {"-o", out});
  arguments.push_back("--json");
  const CommandRun run = runCommand(arguments);
  EXPECT_NE(run.code, 1) << run.err;
  const std::string timeless = std::regex_replace(run.out, std::regex("\"\\w*milliseconds\": [0-9.e+-]+"), "");
  return std::to_string(run.code) + "\n" + timeless + (writes ? readText(out) : "");
}

/// Thirty boxes in a pen: a bit that differs in one flight has changed everything some hundred impacts later.
std::string writtenPen() {
  Random random(30);
  Document document;
  document.duration = 3;
  for (int k = 0; k < 3; ++k) {
    document.scene.bodies.push_back(makePlane("low " + std::to_string(k), Vec3::Unit(k), 0));
    document.scene.bodies.push_back(makePlane("high " + std::to_string(k), -Vec3::Unit(k), -1.2));
  }
  for (int i = 0; i < 30; ++i) {
    const Vec3 at = 0.3 * Vec3(i % 4 + 0.5, i / 4 % 4 + 0.5, i / 16 + 0.5), velocity = random.vec(3);
    Body box = makeBox(std::to_string(i), {0.1, 0.14, 0.08}, at, velocity);
    box.angular_velocity = random.vec(5);
    document.scene.bodies.push_back(box);
  }
  document.scene.gravity = Vec3(0, 0, -9.81);
  document.scene.materials = {makeMaterial("m", 0.97, 0.2)};
  const std::string path = temporaryPath("pen.json");
  saveDocument(path, document);
  return path;
}

class MaskedProcessor : public testing::Test {
 protected:
  void SetUp() override {
    static const bool felt = maskIsFelt();
    if (!felt) GTEST_SKIP() << "masking FMA and AVX2 does not change the sines of this C library on this processor";
  }
  static void expectSameBytes(const Words& arguments, bool writes = false) {
    const std::string plain = answerOf(arguments, writes);
    EXPECT_GE(plain.size(), 100u);
    const Mask mask;
    const bool same = answerOf(arguments, writes) == plain;
    EXPECT_TRUE(same) << "carom " << arguments[0] << " " << arguments[1] << " differs";
  }
};

TEST_F(MaskedProcessor, MotionsAreTheSame) {
  for (const std::string& name : sceneNames()) expectSameBytes({"simulate", scenePath(name)});
  expectSameBytes({"simulate", writtenPen()});
}

TEST_F(MaskedProcessor, DerivativesAreTheSame) {
  for (const char* name : {"book-on-shelf", "hat-on-coatrack", "meeting", "only-causes", "die-face-down"})
    expectSameBytes({"gradient", scenePath(name)});
}

TEST_F(MaskedProcessor, EditsAreTheSame) {
  for (const char* name : {"book-on-shelf", "only-causes", "mug-on-mark", "ball-into-cup", "hat-on-coatrack", "dice"})
    expectSameBytes({"edit", scenePath(name), "--seconds", "600"}, true);
}

TEST_F(MaskedProcessor, ReplaysAreTheSame) {
  const std::string path = temporaryPath("masked-journal.json");
  saveJournal(path, {shortSession(), ""});
  expectSameBytes({"replay", path}, true);
}

TEST_F(MaskedProcessor, PicturesAndExportsAreTheSame) {
  const auto drawn = [&](const std::string& file) {
    EXPECT_EQ(runCommand({"export", scenePath("dice"), "-o", temporaryPath(file)}).code, 0);
    return readText(temporaryPath(file));
  };
  for (const char* file : {"masked.svg", "masked.glb", "masked.csv"}) {
    const std::string plain = drawn(file);
    EXPECT_GE(plain.size(), 100u);
    const Mask mask;
    const bool same = drawn(file) == plain;
    EXPECT_TRUE(same) << file;
  }
}

}  // namespace
}  // namespace carom::test
