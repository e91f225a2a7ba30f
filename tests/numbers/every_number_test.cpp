// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>

#include "cli/command_line.h"
#include "examples/support/project_file.h"
#include "tests/numbers/changes.h"
#include "tests/numbers/isolated.h"

// Every number of every example, one at a time, becomes 0, a denormal, 1e300, no number at all, ...; then every command
// is called. Whatever the document says, a command ends by itself, with one of its exit codes, with a sentence where it
// is not done, and without numbers that are none. The whole of it takes hours, so a sample is run: CAROM_TEST_SCALE
// multiplies it ("all": every case), CAROM_TEST_SEED draws another one. CAROM_TEST_COMMANDS=validate,simulate runs only
// these, CAROM_TEST_SCENES only documents whose names begin so.

namespace carom::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kSample = 700;
#if defined(__SANITIZE_ADDRESS__)
constexpr unsigned kSeconds = 100;
#else
constexpr unsigned kSeconds = 60;
#endif

struct Call {
  const char* command;
  std::vector<std::string> options;
  const char* extension;  ///< of the file that it writes; empty for none
};

const std::vector<Call>& calls() {
  static const std::vector<Call> all{{"validate", {}, ""},
                                     {"info", {}, ""},
                                     {"simulate", {}, ""},
                                     {"simulate", {"--at", "0.4"}, ""},
                                     {"gradient", {}, ""},
                                     {"gradient", {"--method", "tangent"}, ""},
                                     {"check", {}, ""},
                                     {"edit", {"--iterations", "3", "--threads", "1"}, ".json"},
                                     {"export", {}, ".glb"},
                                     {"export", {}, ".gltf"},
                                     {"export", {"--keys", "cubic"}, ".glb"},
                                     {"export", {}, ".csv"},
                                     {"export", {}, ".svg"}};
  return all;
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// One document to be tried, one number of it, what stands in its place, and what is called.
struct Case {
  std::size_t scene = 0;
  json::json_pointer place;
  std::size_t value = 0, call = 0;
};

struct Scenes {
  std::vector<std::string> names;
  std::vector<json> documents;
};

Scenes examples() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(projectFile("examples/scenes")))
    if (entry.path().extension() == ".json" && entry.path().stem().string().starts_with(environment("CAROM_TEST_SCENES")))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Scenes scenes;
  for (const fs::path& file : files) {
    scenes.names.push_back(file.stem().string());
    scenes.documents.push_back(json::parse(std::ifstream(file)));
  }
  return scenes;
}

bool isCalled(const Call& call) {
  const std::string only = environment("CAROM_TEST_COMMANDS");
  return only.empty() || ("," + only + ",").find(std::string(",") + call.command + ",") != std::string::npos;
}

std::vector<Case> casesOf(const Scenes& scenes) {
  std::vector<Case> cases;
  for (std::size_t s = 0; s < scenes.documents.size(); ++s)
    for (const auto& place : numbersOf(scenes.documents[s]))
      for (std::size_t v = 0; v < strangeValues().size(); ++v)
        for (std::size_t c = 0; c < calls().size(); ++c)
          if (isCalled(calls()[c])) cases.push_back({s, place, v, c});
  const std::string scale = environment("CAROM_TEST_SCALE"), seed = environment("CAROM_TEST_SEED");
  if (scale == "all") return cases;
  const auto wanted = static_cast<std::size_t>(kSample * (scale.empty() ? 1 : std::stod(scale)));
  std::mt19937_64 random(seed.empty() ? 1 : std::stoull(seed));
  std::vector<Case> sample;
  std::sample(cases.begin(), cases.end(), std::back_inserter(sample), wanted, random);
  return sample;
}

/// A folder like that of the examples, so that documents find their meshes.
class Folder {
 public:
  Folder() : path_(testing::TempDir() + "carom-numbers-" + std::to_string(getpid())) {
    fs::create_directories(path_ + "/scenes");
    fs::create_directory_symlink(projectFile("examples/assets"), path_ + "/assets");
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string document() const { return path_ + "/scenes/changed.json"; }
  std::string output(const char* extension) const { return path_ + "/scenes/output" + extension; }

 private:
  std::string path_;
};

std::string readAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Takes what is written to a stream.
class Captured {
 public:
  explicit Captured(std::ostream& stream) : stream_(stream), was_(stream.rdbuf(text_.rdbuf())) {}
  ~Captured() { stream_.rdbuf(was_); }
  std::string text() const { return text_.str(); }

 private:
  std::ostream& stream_;
  std::ostringstream text_;
  std::streambuf* was_;
};

bool hasNoNumber(std::string text) {
  const auto isOfWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::ranges::transform(text, text.begin(), [](char c) { return std::tolower(static_cast<unsigned char>(c)); });
  for (const char* word : {"nan", "inf"})
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      if ((at == 0 || !isOfWord(text[at - 1])) && (at + 3 == text.size() || !isOfWord(text[at + 3]))) return true;
  return false;
}

/// Where a gradient says that it is reliable, it is made of numbers.
bool isReliableOfNulls(const json& gradient) {
  if (!gradient.contains("jacobian") || !gradient.value("reliable", false)) return false;
  for (const json& row : gradient["jacobian"])
    for (const json& entry : row)
      if (entry.is_null()) return true;
  return false;
}

std::string problemOfJson(const std::string& command, int code, const std::string& out) {
  const json answer = json::parse(out, nullptr, false);
  if (answer.is_discarded()) return "found no JSON document on standard output: " + out.substr(0, 200);
  if (command == "gradient" && code == 0 && isReliableOfNulls(answer)) return "a reliable gradient without a number";
  return "";
}

std::string problemOfFile(const std::string& path) {
  const std::string bytes = readAll(path);
  if (bytes.empty()) return "wrote no file";
  if (path.ends_with(".csv") || path.ends_with(".svg"))
    return hasNoNumber(bytes) ? "wrote a number that is none" : "";
  const bool binary = path.ends_with(".glb");
  const std::string text = binary ? bytes.substr(20, bytes.find("BIN", 20) - 24) : bytes;
  const json document = json::parse(text.substr(0, text.rfind('}') + 1), nullptr, false);
  return document.is_discarded() ? "wrote a document that cannot be read" : "";
}

struct Outcome {
  int code = 0;
  std::string out, err;
};

Outcome runWords(const std::vector<std::string>& words) {
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const Captured out(std::cout), err(std::cerr);
  const int code = cli::run(static_cast<int>(arguments.size()), arguments.data());
  return {code, out.text(), err.text()};
}

std::string describe(const Case& c, const Scenes& scenes) {
  return scenes.names[c.scene] + " " + c.place.to_string() + " = " + strangeValues()[c.value] + ", " +
         calls()[c.call].command + " " + calls()[c.call].extension;
}

std::string problemOf(const Call& call, const Folder& folder, bool json_wanted) {
  std::vector<std::string> words{"carom", call.command, folder.document()};
  words.insert(words.end(), call.options.begin(), call.options.end());
  const std::string output = folder.output(call.extension);
  const bool writes = *call.extension != '\0';
  if (writes) {
    fs::remove(output);
    words.insert(words.end(), {"-o", output});
  }
  if (json_wanted) words.push_back("--json");
  const Outcome run = runWords(words);
  const bool known = run.code == 0 || run.code == 1 || (run.code == 3 && call.command == std::string("edit")) ||
                     (run.code == 4 && call.command == std::string("check")) ||
                     (run.code == 5 && (call.command == std::string("simulate") || writes));  // the motion ended early
  if (!known) return "ended with " + std::to_string(run.code) + ": " + run.err;
  if ((run.code == 1 || run.code == 3) && run.err.find("carom: ") == std::string::npos) return "failed without a sentence";
  for (const char* raw : {"::", "out of memory", "bad_alloc", "unknown error"})
    if (run.code == 1 && run.err.find(raw) != std::string::npos) return "failed with no sentence for people: " + run.err;
  if (run.code != 1 && hasNoNumber(run.out))  // a message may name what was found
    return "printed a number that is none: " + run.out.substr(0, 500);
  if (json_wanted) {
    const std::string problem = problemOfJson(call.command, run.code, run.out);
    if (!problem.empty()) return problem;
  }
  if (writes && (run.code == 0 || run.code == 5)) return problemOfFile(output);
  return "";
}

TEST(EveryNumber, OfEveryExampleMayBeAnythingInEveryCommand) {
  const Scenes scenes = examples();
  ASSERT_FALSE(scenes.names.empty());
  const std::vector<Case> cases = casesOf(scenes);
  ASSERT_FALSE(cases.empty());
  const Folder folder;
  const auto run = [&](std::size_t i) {
    const Case& c = cases[i];
    std::ofstream(folder.document()) << changed(scenes.documents[c.scene], c.place, strangeValues()[c.value]);
    return problemOf(calls()[c.call], folder, (c.value + c.call) % 4 != 0);
  };
  double longest = 0;
  const std::vector<CaseFailure> failures = runIsolated(cases.size(), run, kSeconds, &longest);
  for (const CaseFailure& failure : failures)
    ADD_FAILURE() << describe(cases[failure.index], scenes) << ": " << failure.what;
  RecordProperty("cases", static_cast<int>(cases.size()));
  std::cout << cases.size() << " cases, " << failures.size() << " failures, the longest took " << longest << " s\n";
}

}  // namespace
}  // namespace carom::test
