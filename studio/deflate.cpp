// SPDX-License-Identifier: MIT
#include "studio/deflate.h"

#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/crc.hpp>
#include <cstdint>

#include "adjoint/base/errors.h"

namespace carom::studio {

namespace zlib = boost::beast::zlib;

std::string deflated(std::string_view bytes, int level) {
  constexpr int kWindowBits = 15, kMemory = 9;
  zlib::deflate_stream stream;
  stream.reset(level, kWindowBits, kMemory, zlib::Strategy::normal);
  std::string out(stream.upper_bound(bytes.size()), '\0');
  zlib::z_params at;
  at.next_in = bytes.data(), at.avail_in = bytes.size();
  at.next_out = out.data(), at.avail_out = out.size();
  boost::system::error_code error;
  stream.write(at, zlib::Flush::finish, error);
  if (error != zlib::error::end_of_stream) throw InputError("bytes could not be compressed: " + error.message());
  out.resize(at.total_out);
  return out;
}

std::string gzipped(std::string_view bytes, int level) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes.data(), bytes.size());
  // deflate, no name, no time, an unknown system
  std::string file = std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10) + deflated(bytes, level);
  for (const auto number : {static_cast<std::uint32_t>(sum.checksum()), static_cast<std::uint32_t>(bytes.size())})
    for (unsigned shift = 0; shift < 32; shift += 8) file += static_cast<char>(number >> shift & 0xffu);
  return file;
}

}  // namespace carom::studio
