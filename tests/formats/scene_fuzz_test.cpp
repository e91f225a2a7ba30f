// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "adjoint/base/errors.h"
#include "formats/documents/scene_json.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// One to four changes of bytes, words and pieces.
  std::string mutated(std::string text, const std::string& other) {
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) below(3) == 0 ? change(text, other) : nudge(text);
    return text;
  }

 private:
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  void change(std::string& text, const std::string& other) {
    static const std::vector<std::string> kWords{"null",
                                                 "true",
                                                 "-1",
                                                 "0",
                                                 "1e308",
                                                 "1e-320",
                                                 "1e400",
                                                 "NaN",
                                                 "\"x\"",
                                                 "[]",
                                                 "{}",
                                                 "[[",
                                                 "]",
                                                 "{",
                                                 "}",
                                                 ",",
                                                 "\"min\"",
                                                 "{\"impact\": 1}",
                                                 "18446744073709551615",
                                                 "-9223372036854775808",
                                                 "\"\\ud800\"",
                                                 "\"\\u0000\"",
                                                 "\xff",
                                                 "[1,2,3]",
                                                 "\"floor\"",
                                                 "\"size\"",
                                                 "\"tilt\"",
                                                 "[0,0,0,0]",
                                                 "\"compound\"",
                                                 "9007199254740993"};
    const std::size_t at = below(text.size());
    switch (below(7)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, 1 + below(12));
        break;
      case 2:
        text.insert(at, kWords[below(kWords.size())]);
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, other.substr(below(other.size()), below(80)));
        break;
      default:
        replaceToken(text, at, kWords[below(kWords.size())]);
        break;
    }
  }

  /// Another digit: the text stays a document, which may be impossible.
  void nudge(std::string& text) {
    const std::size_t at = text.find_first_of("0123456789", below(text.size()));
    if (at != std::string::npos) text[at] = static_cast<char>('0' + below(10));
  }

  /// Keeps most of the structure: only the value or word at a place changes.
  static void replaceToken(std::string& text, std::size_t at, const std::string& word) {
    const char* const kEnds = " ,:[]{}\n";
    const std::size_t begin = text.find_first_not_of(kEnds, at);
    if (begin == std::string::npos) return;
    const std::size_t end = text.find_first_of(kEnds, begin);
    text.replace(begin, end == std::string::npos ? end : end - begin, word);
  }

  std::mt19937 random_;
};

TEST(SceneFuzz, onlyFormatErrorsEscape) {
  std::vector<std::string> texts{formats_test::documentWithEverything()};
  for (const std::string& path : formats_test::exampleScenes()) texts.push_back(formats_test::textOf(path));
  const unsigned seed = 981;
  std::cout << "seed " << seed << '\n';
  Mutator mutator(seed);
  int read = 0, refused = 0;
  for (int round = 0; round < 300; ++round) {
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::string text = mutator.mutated(texts[i], texts[(i + 1) % texts.size()]);
      try {
        const Document document = parseDocument(text, "fuzz");
        ++read;
        // What is read can be written and read again.
        const std::string written = writeDocument(document);
        EXPECT_EQ(writeDocument(parseDocument(written, "again")), written) << text;
      } catch (const FormatError& error) {
        ++refused;
        EXPECT_LT(std::string(error.what()).size(), 2000u) << error.what();
      } catch (const std::exception& error) {
        ADD_FAILURE() << "round " << round << ", text " << i << ": " << error.what() << '\n' << text;
      }
    }
  }
  std::cout << read << " read, " << refused << " refused\n";
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace carom
