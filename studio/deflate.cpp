// SPDX-License-Identifier: MIT
#include "studio/deflate.h"

#include <boost/beast/zlib/deflate_stream.hpp>

#include "adjoint/base/errors.h"

namespace carom::studio {

namespace zlib = boost::beast::zlib;

std::string deflated(std::string_view bytes) {
  constexpr int kSmallest = 9, kWindowBits = 15, kMemory = 9;
  zlib::deflate_stream stream;
  stream.reset(kSmallest, kWindowBits, kMemory, zlib::Strategy::normal);
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

}  // namespace carom::studio
