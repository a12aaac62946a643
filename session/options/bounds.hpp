// SPDX-License-Identifier: MIT
// The least and the most of a number; both belong to it. Plain data.
#pragma once

namespace burin::session {

template <typename T>
struct Bounds {
    T least, most;
};

}  // namespace burin::session
