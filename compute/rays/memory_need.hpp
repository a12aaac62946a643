// SPDX-License-Identifier: MIT
// Estimate of the memory that a solid and its surface will take, made before any of it is allocated.
#pragma once

#include <cstdint>
#include <optional>

#include "compute/rays/lattice.hpp"

namespace burin::compute {

// Returns the bytes for the rays of a solid on this lattice, its surface and an exported mesh of it, for a workpiece
// about as large as the lattice. The surface's share follows from the faces of the box; measured on blocks, the
// estimate is right within a fifth.
[[nodiscard]] std::uint64_t memory_needed(const Lattice& lattice);

// Returns the bytes that the machine can allocate without swapping; nothing if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> memory_available();

// Fails when a solid on this lattice needs more than `available` bytes; the error names the need and a resolution that
// would fit.
[[nodiscard]] Result<void> check_memory(const Lattice& lattice, std::optional<std::uint64_t> available);

}  // namespace burin::compute
