// SPDX-License-Identifier: MIT
// Moving pictures as animated PNG, the format that browsers and this kind of text show without a player.
// Source: Animated PNG, https://www.w3.org/TR/png-3/ (chunks acTL, fcTL, fdAT). Each picture after the first holds the
// smallest rectangle that differs from the one before. No colour is lost; the same pictures give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"

namespace burin::renderer {

// Returns the smallest rectangle in which two pictures of one size differ; empty: they are equal.
[[nodiscard]] PixelRect difference(const Image& a, const Image& b);

// Takes pictures one by one and keeps the last. One thread.
class Film {
public:
    // Pictures are shown for so many milliseconds each, from 1 to 65,535, over and over.
    explicit Film(std::uint16_t each_ms) : each_ms_(each_ms) {}

    // Fails on a picture of another size than the first.
    [[nodiscard]] Result<void> add(const Image& picture);
    [[nodiscard]] std::size_t pictures() const { return pictures_; }
    // Returns the bytes of the file. Fails without a picture.
    [[nodiscard]] Result<std::vector<std::byte>> finish();

private:
    [[nodiscard]] Result<void> append_frame();

    std::uint16_t each_ms_;
    std::uint32_t frames_ = 0, numbered_ = 0;  // numbered_: chunks of the animation so far
    std::size_t pictures_ = 0;
    std::optional<Image> last_;
    PixelRect waiting_;        // what of last_ has not been written
    std::uint32_t waits_ = 0;  // for how many pictures it is shown
    std::vector<std::byte> head_, frames_bytes_;
};

}  // namespace burin::renderer
