// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/base/errors.h"

namespace carom {

/// A file or text that cannot be read or written. `where()` is the JSON pointer of the place ("/bodies/1/mass"), or
/// "line 3, column 12" if the text is not JSON, or empty for the file as a whole. `what()` is one line:
///   scene.json: /bodies/1/mass: found -2, expected a number > 0
class FormatError : public InputError {
 public:
  /// At `where` in `file`.
  FormatError(const std::string& file, const std::string& where, const std::string& message)
      : InputError(where, message), file_(file), text_(file + ": " + InputError::what()) {}

  const char* what() const noexcept override { return text_.c_str(); }  ///< file, place and message
  const std::string& file() const { return file_; }                     ///< path, as it was given

 private:
  std::string file_, text_;
};

}  // namespace carom
