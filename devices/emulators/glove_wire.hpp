// SPDX-License-Identifier: MIT
// The controller's end of a glove's line: what it understands of the host's bytes, and the bytes of its sets. Written
// from docs/glove.md alone and without any of the driver's code (devices/gloves/glove_frame.hpp), so that a fault in
// one of the two shows where they meet. Only the types of what is said are common. Pure; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "devices/gloves/glove_frame.hpp"

namespace burin::devices {

// A frame as it came over the line, and what it says.
struct HeardGloveFrame {
    std::vector<std::byte> bytes;
    GloveCommand command;
};

// Finds the host's frames among the bytes of a line.
class GloveControllerEar {
public:
    // Takes a byte; returns the frame that it completes.
    [[nodiscard]] std::optional<HeardGloveFrame> take(std::byte byte);

private:
    std::vector<std::byte> waiting_;
};

// Returns the frame of a set, of its version: of positions alone where it has no forces.
[[nodiscard]] std::vector<std::byte> controller_frame(const GloveSet& set);

// Returns the check of a frame's bytes before it, and the second check of a frame of version 2.
[[nodiscard]] std::byte controller_check(std::span<const std::byte> bytes);
[[nodiscard]] std::byte controller_second_check(std::span<const std::byte> bytes);

}  // namespace burin::devices
