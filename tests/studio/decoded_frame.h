// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/drawing/display.h"

namespace carom::studio_test {

/// A binary frame taken apart, byte by byte as the protocol has them. Checks of what holds for every frame (its mark,
/// lengths, places of blocks) fail the running test.
class DecodedFrame {
 public:
  explicit DecodedFrame(const std::string& bytes);

  nlohmann::json header;

  /// The numbers of a block that the header names as [byte, rows].
  std::vector<double> doubles(const nlohmann::json& block, std::size_t row) const;
  std::vector<float> floats(const nlohmann::json& block, std::size_t row) const;
  std::vector<std::uint32_t> integers(const nlohmann::json& block, std::size_t row) const;

  /// Of a motion frame, by the index of the body; fails where it is left out.
  DisplayTrack track(int body) const;
  /// Of a scene frame.
  DisplayMesh mesh(int body) const;

 private:
  template <class Number, class Bits>
  std::vector<Number> numbers(const nlohmann::json& block, std::size_t row) const;

  std::string blocks_;
};

}  // namespace carom::studio_test
