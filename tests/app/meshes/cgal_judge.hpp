// SPDX-License-Identifier: MIT
// CGAL's verdict on a mesh file, read by CGAL as well: exact, and none of our code in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace burin::app {

struct CgalVerdict {
    bool is_read = false;
    bool is_manifold = false;  // and consistently oriented
    bool is_closed = false;
    std::uint64_t crossing_pairs = 0;  // counted where it is manifold
};

// Returns nothing where CGAL was not installed when this was built.
[[nodiscard]] std::optional<CgalVerdict> judge_by_cgal(const std::string& path);

}  // namespace burin::app
