// SPDX-License-Identifier: MIT
// Bytes as they lie in a file: one zstd frame that states its size. Pure; any thread.
//
// Decompressing takes data from anywhere: it allocates no more than the size that the caller expects.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace burin::record {

inline constexpr int kCompressionLevel = 3;

[[nodiscard]] Result<std::vector<std::byte>> compressed(std::span<const std::byte> bytes);

// Returns the bytes of a frame that states this size. `where` and `remedy` stand in the message of a failure.
[[nodiscard]] Result<std::vector<std::byte>> decompressed(std::span<const std::byte> data, std::size_t size,
                                                          const std::string& where, const std::string& remedy);

}  // namespace burin::record
