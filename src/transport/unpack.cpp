#include "transport/unpack.h"

#include <fmt/format.h>

#ifdef WHIRL_TWIN_BZ2
#include <bzlib.h>
#endif
#ifdef WHIRL_TWIN_LZ4
#include <lz4frame.h>
#endif

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kPiece = 1 << 16;  // bytes made at a time

[[maybe_unused]] std::string tooLongText(std::size_t most) {
  return fmt::format("more than {} bytes uncompressed", most);
}

[[maybe_unused]] std::string without(const char* library) {
  return fmt::format("built without {}: run `scripts/setup`, then build again", library);
}

#ifdef WHIRL_TWIN_BZ2
std::string unpackBz2(std::vector<std::uint8_t>& packed, std::size_t most,
                      std::vector<std::uint8_t>& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    return "bz2: out of memory";
  }
  stream.next_in = reinterpret_cast<char*>(packed.data());
  stream.avail_in = static_cast<unsigned>(packed.size());
  std::string why;
  for (int status = BZ_OK; status == BZ_OK && why.empty();) {
    const std::size_t begin = out.size();
    out.resize(begin + kPiece);
    stream.next_out = reinterpret_cast<char*>(out.data() + begin);
    stream.avail_out = kPiece;
    status = BZ2_bzDecompress(&stream);
    out.resize(begin + kPiece - stream.avail_out);
    if (status != BZ_OK && status != BZ_STREAM_END) {
      why = "bz2: corrupt";
    } else if (out.size() > most) {
      why = tooLongText(most);
    } else if (status == BZ_OK && stream.avail_in == 0 && stream.avail_out > 0) {
      why = "bz2: truncated";
    }
  }
  BZ2_bzDecompressEnd(&stream);
  return why;
}
#endif

#ifdef WHIRL_TWIN_LZ4
std::string unpackLz4(const std::vector<std::uint8_t>& packed, std::size_t most,
                      std::vector<std::uint8_t>& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) {
    return "lz4: out of memory";
  }
  std::string why;
  std::size_t hint = 1, used = 0, made = kPiece;
  for (std::size_t at = 0; why.empty() && hint != 0 && used + made > 0;) {
    const std::size_t begin = out.size();
    out.resize(begin + kPiece);
    made = kPiece;
    used = packed.size() - at;
    hint = LZ4F_decompress(context, out.data() + begin, &made, packed.data() + at, &used, nullptr);
    const bool damaged = LZ4F_isError(hint) != 0;
    out.resize(begin + (damaged ? 0 : made));
    at += used;
    if (damaged) {
      why = fmt::format("lz4: corrupt ({})", LZ4F_getErrorName(hint));
    } else if (out.size() > most) {
      why = tooLongText(most);
    }
  }
  if (why.empty() && hint != 0) {
    why = "lz4: truncated";
  }
  LZ4F_freeDecompressionContext(context);
  return why;
}
#endif

}  // namespace

std::string unpack(const std::string& compression, std::vector<std::uint8_t>& packed,
                   [[maybe_unused]] std::size_t most, std::vector<std::uint8_t>& out) {
  out.clear();
  if (compression == "none") {
    out.swap(packed);
    return "";
  }
  if (compression == "bz2") {
#ifdef WHIRL_TWIN_BZ2
    return unpackBz2(packed, most, out);
#else
    return without("bz2 (libbz2-dev)");
#endif
  }
  if (compression == "lz4") {
#ifdef WHIRL_TWIN_LZ4
    return unpackLz4(packed, most, out);
#else
    return without("lz4 (liblz4-dev)");
#endif
  }
  return fmt::format("compression: must be none, bz2 or lz4, found {}", inQuotes(compression));
}

}  // namespace whirl_twin
