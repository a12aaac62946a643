// SPDX-License-Identifier: MIT
#include "record/compressed.hpp"

#include <zstd.h>

namespace burin::record {

Result<std::vector<std::byte>> compressed(std::span<const std::byte> bytes) {
    std::vector<std::byte> data(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(data.data(), data.size(), bytes.data(), bytes.size(), kCompressionLevel);
    if (ZSTD_isError(size) != 0)
        return fail("recording", std::string("a block cannot be compressed: ") + ZSTD_getErrorName(size),
                    "free some memory");
    data.resize(size);
    data.shrink_to_fit();
    return data;
}

Result<std::vector<std::byte>> decompressed(std::span<const std::byte> data, std::size_t size, const std::string& where,
                                            const std::string& remedy) {
    if (ZSTD_getFrameContentSize(data.data(), data.size()) != size)
        return fail(where, "its data do not have the size of its rows", remedy);
    std::vector<std::byte> raw(size);
    const std::size_t got = ZSTD_decompress(raw.data(), raw.size(), data.data(), data.size());
    if (ZSTD_isError(got) != 0 || got != size) return fail(where, "its data cannot be decompressed", remedy);
    return raw;
}

}  // namespace burin::record
