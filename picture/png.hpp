// SPDX-License-Identifier: MIT
// Reads and writes PNG files, through libpng.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"

namespace burin::picture {

// Returns the bytes of a PNG file: RGB, 8 bits, marked sRGB. The same image gives the same bytes.
[[nodiscard]] Result<std::vector<std::byte>> encode_png(const Image& image);

// Reads a PNG of any kind as RGBA. Fails on what is no PNG, and on one of more than 64 million pixels.
[[nodiscard]] Result<Image> load_png(const std::filesystem::path& path);

// Writes a PNG under a temporary name beside `path`, then renames it: a failure leaves no partial file and keeps the
// previous file. The Error names the file.
[[nodiscard]] Result<void> write_png(const std::filesystem::path& path, const Image& image);

}  // namespace burin::picture
