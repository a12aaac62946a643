// SPDX-License-Identifier: MIT
// PNG files, through libpng.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "renderer/image.hpp"

namespace burin {

// The bytes of a PNG file: RGB, 8 bits, marked sRGB. The same image gives the same bytes.
[[nodiscard]] Result<std::vector<std::byte>> encode_png(const Image& image);

// Writes a PNG under a temporary name beside `path`, then renames it: a failure leaves no partial file and keeps what was
// there. An Error names the file.
[[nodiscard]] Result<void> write_png(const std::filesystem::path& path, const Image& image);

}  // namespace burin
