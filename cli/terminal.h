// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

/// What is known of the terminal, and how text is laid out in it.
namespace carom::cli {

enum class Stream { in, out, error };

bool isTerminal(Stream stream);

/// Whether text on the stream may be coloured: it is a terminal that knows colours, and NO_COLOR is not set.
bool hasColours(Stream stream);

/// Columns of the terminal on standard error; 80 where it does not say.
std::size_t terminalWidth();

enum class Look { heading, good, warning, bad };

/// The text in the colour of its look.
std::string coloured(Look look, const std::string& text);

/// Columns that a text takes: two for each wide character, none for what is put onto the one before.
std::size_t displayWidth(const std::string& text);

/// As many whole characters of a text as fit.
std::string fitted(const std::string& text, std::size_t width);

/// The text with spaces for characters that would move the cursor or start an escape sequence.
std::string printable(const std::string& text);

}  // namespace carom::cli
