/// What gzip makes of bytes.
#pragma once

#include <zlib.h>

#include <string>

namespace mobbscope {
inline namespace testing {

inline std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    constexpr int kGzip = 16;
    deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, 8, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    std::string in = bytes;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.erase(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return out;
}

}  // namespace testing
}  // namespace mobbscope
