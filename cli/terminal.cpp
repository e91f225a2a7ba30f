// SPDX-License-Identifier: MIT
#include "cli/terminal.h"

#include <locale.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <wchar.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace carom::cli {
namespace {

int fileOf(Stream stream) {
  constexpr int kFiles[] = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
  return kFiles[static_cast<int>(stream)];
}

/// UTF-8 while it lives, for this thread alone, whatever the locale of the process is.
class Utf8 {
 public:
  Utf8() : locale_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (locale_ != nullptr) before_ = uselocale(locale_);
  }
  ~Utf8() {
    if (locale_ == nullptr) return;
    uselocale(before_);
    freelocale(locale_);
  }
  Utf8(const Utf8&) = delete;
  Utf8& operator=(const Utf8&) = delete;

 private:
  locale_t locale_, before_ = nullptr;
};

/// Calls `take` with the bytes and the columns of each character; a byte that is none counts as one column.
template <class Take>
void forEachCharacter(const std::string& text, Take take) {
  const Utf8 utf8;
  std::mbstate_t state{};
  for (std::size_t i = 0; i < text.size();) {
    wchar_t character = 0;
    std::size_t bytes = mbrtowc(&character, text.data() + i, text.size() - i, &state);
    std::size_t columns = 1;
    if (bytes == 0 || bytes > text.size() - i) {  // the character 0, or no character
      bytes = 1;
      state = {};
    } else if (const int width = wcwidth(character); width >= 0) {
      columns = static_cast<std::size_t>(width);
    }
    take(std::string_view(text).substr(i, bytes), columns);
    i += bytes;
  }
}

}  // namespace

bool isTerminal(Stream stream) { return isatty(fileOf(stream)) == 1; }

bool hasColours(Stream stream) {
  const char* const no_colour = std::getenv("NO_COLOR");  // no-color.org: set, and not empty
  if (no_colour != nullptr && *no_colour != '\0') return false;
  const char* const kind = std::getenv("TERM");
  return isTerminal(stream) && kind != nullptr && *kind != '\0' && std::strcmp(kind, "dumb") != 0;
}

std::size_t terminalWidth() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

std::string coloured(Look look, const std::string& text) {
  constexpr const char* kCodes[] = {"1", "32", "33", "1;31"};
  return std::string("\033[") + kCodes[static_cast<int>(look)] + "m" + text + "\033[0m";
}

std::size_t displayWidth(const std::string& text) {
  std::size_t width = 0;
  forEachCharacter(text, [&](std::string_view, std::size_t columns) { width += columns; });
  return width;
}

std::string fitted(const std::string& text, std::size_t width) {
  std::string part;
  std::size_t used = 0;
  forEachCharacter(text, [&](std::string_view bytes, std::size_t columns) {
    used += columns;
    if (used <= width) part += bytes;
  });
  return part;
}

std::string printable(const std::string& text) {
  std::string out;
  forEachCharacter(text, [&](std::string_view bytes, std::size_t) {
    const auto first = static_cast<unsigned char>(bytes.front());
    // ASCII's control characters, and those of U+0080 to U+009F, which some terminals obey.
    const bool control = first < 0x20 || first == 0x7f ||
                         (bytes.size() == 2 && first == 0xc2 && static_cast<unsigned char>(bytes[1]) < 0xa0) ||
                         (bytes.size() == 1 && first >= 0x80 && first < 0xa0);
    out += control ? " " : bytes;
  });
  return out;
}

}  // namespace carom::cli
