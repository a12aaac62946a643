// SPDX-License-Identifier: MIT
// The bounds of a session's numbers. One list: the command line refuses what is beyond them, and so does whoever reads
// the options of a recording (session/state/session_settings.hpp). Bounds of tool and material are sculpt's.
#pragma once

#include <initializer_list>

#include "compute/rays/lattice.hpp"
#include "session/options/bounds.hpp"

namespace burin::session {

inline constexpr Bounds<int> kPictureBounds{64, 8192};  // width and height, pixels
inline constexpr Bounds<double> kPanelScaleBounds{0.5, 4.0};
inline constexpr Bounds<int> kResolutionBounds{compute::kMinResolution, compute::kMaxResolution};
inline constexpr Bounds<double> kSweepToleranceBounds{0.001, 1000.0};  // lattice cells
inline constexpr Bounds<double> kSmoothStrengthBounds{0.0, 1.0};
inline constexpr Bounds<double> kRoomBounds{0.0, 2.0};               // of the longest side
inline constexpr Bounds<double> kWeldBounds{1e-9, 1000.0};           // metres
inline constexpr Bounds<int> kUndoMemoryBounds{1, 1 << 20};          // MiB
inline constexpr std::initializer_list<int> kSampleCounts{0, 1, 4};  // a pixel; 0: the session chooses

}  // namespace burin::session
