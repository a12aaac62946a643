// SPDX-License-Identifier: MIT
#include "compute/rays/memory_need.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace burin::compute {
namespace {

// Bytes of a carved ray with all bookkeeping (decision 6), and of a cell that holds surface: its vertices, its quad and
// what welding, repair and export need in addition (measured: block:1,1,1 at N = 512 and 1024).
constexpr double kBytesARay = 24.0, kBytesASurfaceCell = 256.0;

std::string gigabytes(double bytes) {
    const double tenths = std::ceil(bytes / 1e8);
    return std::to_string(static_cast<long long>(tenths) / 10) + "." +
           std::to_string(static_cast<long long>(tenths) % 10) + " GB";
}

}  // namespace

std::uint64_t memory_needed(const Lattice& lattice) {
    double rays = 0.0;
    for (int axis = 0; axis < 3; ++axis) rays += static_cast<double>(lattice.rays(axis));
    // Each ray along an axis meets two faces of the box.
    return static_cast<std::uint64_t>(rays * (kBytesARay + 2.0 * kBytesASurfaceCell));
}

std::optional<std::uint64_t> memory_available() {
    std::ifstream information("/proc/meminfo");
    std::string name;
    std::uint64_t kilobytes = 0;
    std::string unit;
    while (information >> name >> kilobytes) {
        std::getline(information, unit);
        if (name == "MemAvailable:") return kilobytes * 1024;
    }
    return std::nullopt;
}

Result<void> check_memory(const Lattice& lattice, std::optional<std::uint64_t> available) {
    const std::uint64_t needed = memory_needed(lattice);
    if (!available || needed <= *available) return {};
    const int resolution = *std::ranges::max_element(lattice.cells) - 3;  // one and a half empty cells on either side
    const double fits = 0.95 * resolution * std::sqrt(static_cast<double>(*available) / static_cast<double>(needed));
    return fail("resolution " + std::to_string(resolution),
                "needs about " + gigabytes(static_cast<double>(needed)) + " of memory, and " +
                    gigabytes(static_cast<double>(*available)) + " are free",
                static_cast<int>(fits) >= kMinResolution
                    ? "choose " + std::to_string(static_cast<int>(fits)) + " or less, or free some memory"
                    : "free some memory");
}

}  // namespace burin::compute
