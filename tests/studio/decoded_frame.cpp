// SPDX-License-Identifier: MIT
#include "tests/studio/decoded_frame.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

namespace carom::studio_test {
namespace {

template <class Bits>
Bits littleEndian(const std::string& bytes, std::size_t at) {
  Bits bits = 0;
  for (std::size_t i = sizeof(Bits); i-- > 0;)
    bits = static_cast<Bits>(bits << 8 | static_cast<unsigned char>(bytes.at(at + i)));
  return bits;
}

Vec3 vectorOf(const nlohmann::json& list) {
  EXPECT_EQ(list.size(), 3u);
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

const nlohmann::json& entryOf(const nlohmann::json& list, int body) {
  for (const auto& entry : list)
    if (entry.at("body") == body) return entry;
  throw std::runtime_error("body " + std::to_string(body) + " was left out");
}

}  // namespace

DecodedFrame::DecodedFrame(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "CRM1");
  const std::size_t length = littleEndian<std::uint32_t>(bytes, 4);
  EXPECT_EQ((8 + length) % 8, 0u);
  EXPECT_EQ(bytes.size() % 8, 0u);
  header = nlohmann::json::parse(bytes.substr(8, length));
  blocks_ = bytes.substr(8 + length);
}

template <class Number, class Bits>
std::vector<Number> DecodedFrame::numbers(const nlohmann::json& block, std::size_t row) const {
  EXPECT_EQ(block.size(), 2u);
  const std::size_t first = block.at(0).get<std::size_t>(), count = block.at(1).get<std::size_t>() * row;
  EXPECT_EQ(first % 8, 0u);
  EXPECT_LE(first + count * sizeof(Bits), blocks_.size());
  std::vector<Number> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(std::bit_cast<Number>(littleEndian<Bits>(blocks_, first + k * sizeof(Bits))));
  return out;
}

std::vector<double> DecodedFrame::doubles(const nlohmann::json& block, std::size_t row) const {
  return numbers<double, std::uint64_t>(block, row);
}
std::vector<float> DecodedFrame::floats(const nlohmann::json& block, std::size_t row) const {
  return numbers<float, std::uint32_t>(block, row);
}
std::vector<std::uint32_t> DecodedFrame::integers(const nlohmann::json& block, std::size_t row) const {
  return numbers<std::uint32_t, std::uint32_t>(block, row);
}

DisplayTrack DecodedFrame::track(int body) const {
  const nlohmann::json& entry = entryOf(header.at("tracks"), body);
  DisplayTrack track;
  track.center = vectorOf(entry.at("center"));
  const std::size_t stride = entry.value("stride", std::size_t{10});
  EXPECT_TRUE(stride == 10 || stride == 19);
  const std::vector<double> arcs = doubles(entry.at("arcs"), stride);
  for (auto k = arcs.begin(); k != arcs.end(); k += static_cast<long>(stride)) {
    DisplayTrack::ArcKey key{k[0], {k[1], k[2], k[3]}, {k[4], k[5], k[6]}, {k[7], k[8], k[9]}};
    if (stride == 19) {
      key.third = {k[10], k[11], k[12]};
      key.fourth = {k[13], k[14], k[15]};
      key.fifth = {k[16], k[17], k[18]};
    }
    track.arcs.push_back(key);
  }
  const std::vector<float> turns = floats(entry.at("turns"), 5);
  for (auto k = turns.begin(); k != turns.end(); k += 5) track.turns.push_back({k[0], k[1], k[2], k[3], k[4]});
  return track;
}

DisplayMesh DecodedFrame::mesh(int body) const {
  const nlohmann::json& entry = entryOf(header.at("bodies"), body);
  DisplayMesh mesh{floats(entry.at("vertices"), 3), floats(entry.at("normals"), 3),
                   integers(entry.at("triangles"), 3), {}};
  if (entry.contains("accent")) mesh.accent = integers(entry.at("accent"), 3);
  return mesh;
}

}  // namespace carom::studio_test
