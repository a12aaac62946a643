// SPDX-License-Identifier: MIT
// How much memory a solid and its surface will take, told before any of it is asked for.
#pragma once

#include <cstdint>
#include <optional>

#include "compute/lattice.hpp"

namespace burin {

// Bytes for the rays of a solid on this lattice, its surface and an exported mesh of it, for a workpiece about as large as the
// lattice. The surface's part follows from the faces of the box; measured on blocks it is right to a fifth.
[[nodiscard]] std::uint64_t memory_needed(const Lattice& lattice);

// What the machine can give without swapping, bytes; nothing when it does not tell.
[[nodiscard]] std::optional<std::uint64_t> memory_available();

// Fails, with the need and a resolution that would fit, when a solid on this lattice would not.
[[nodiscard]] Result<void> check_memory(const Lattice& lattice, std::optional<std::uint64_t> available);

}  // namespace burin
