// SPDX-License-Identifier: MIT
// Computes the ages of what recent frames show at the time they are seen, and which of them people would notice.
//
// Ages are taken at the time at which each eye is expected to see the frame (or did, where the display reports it).
// Figures:
//   head age          since the head was sampled
//   motion to photon  the same, with the tracker's own latency before and the display's after; prediction hides some
//   tool age          since the haptic tick whose tool state is drawn
//   touch before sight  since the force of that tick acted: positive, the hand feels what the eye does not see yet
//   carve age         since the newest cut on the surface drawn, of frames that show a new one
//   frame time        since the frame before was seen, where nothing was skipped between
//   draw time         of the graphics device
// Units: nanoseconds on one monotonic clock. Pure except for the ring's own memory, which is fixed. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"

namespace burin::session {

// Latencies that no clock of this machine measures; 0 where nobody has measured them.
struct LatencySettings {
    Nanoseconds tracker_ns = 0;         // from the head's motion to its sample here
    Nanoseconds display_ns = 0;         // from the vblank to light, the projector's own processing included
    Nanoseconds device_ns = 1'000'000;  // from the tick's sample until its force acts
    // Frame-sequential at 120 Hz: 8.33 ms; negative where the left eye's picture comes second.
    Nanoseconds right_eye_later_ns = 0;
};

struct FrameTimes {
    std::uint64_t frame = 0;
    std::optional<Nanoseconds> head_sampled_ns;
    std::optional<Nanoseconds> tool_sampled_ns;
    std::optional<Nanoseconds> cut_ns;  // only when this frame is the first to show that cut
    Nanoseconds seen_ns = 0;            // by the eye that sees it first
    Nanoseconds draw_ns = 0;
    bool after_pause = false;  // the frames before were skipped, since nothing had changed
};

enum class FrameFigure : std::uint8_t {
    head_age,
    motion_to_photon,
    tool_age,
    touch_before_sight,
    carve_age,
    frame_time,
    draw_time,
};
inline constexpr std::size_t kFrameFigures = 7;
[[nodiscard]] std::string_view name_of(FrameFigure figure);

inline constexpr std::size_t kLeftEye = 0, kRightEye = 1;

// A figure of one frame for each eye; none where the frame has no such figure. Frame and draw time are equal for both.
using FrameAges = std::array<std::array<std::optional<Nanoseconds>, 2>, kFrameFigures>;

// Computes a frame's ages. before: the previous frame, if any.
[[nodiscard]] FrameAges ages_of(const FrameTimes& frame, const FrameTimes* before, const LatencySettings& settings);

struct FigureSummary {
    std::size_t count = 0;  // frames that have the figure; 0: all else is 0
    Nanoseconds least_ns = 0, median_ns = 0, p95_ns = 0, p99_ns = 0, most_ns = 0;
};

// Summarises values in any order: the k-th smallest, k = ceil(share * count) (nearest rank).
[[nodiscard]] FigureSummary summarised(std::vector<Nanoseconds> values);
// Returns the larger age of the two eyes; nothing where the frame has no such figure.
[[nodiscard]] std::optional<Nanoseconds> worse_eye(const FrameAges& ages, FrameFigure figure);

// Warning about times that people notice.
struct FrameWarning {
    std::size_t limit = 0;  // index of the published limit; identifies a repeated warning
    std::string title;      // short, for a panel
    std::string line;       // the number, the limit and who measured it
};

class FrameHistory {
public:
    static constexpr std::size_t kFrames = 512;

    explicit FrameHistory(const LatencySettings& settings = {}) : settings_(settings) {}

    void add(const FrameTimes& frame) noexcept;  // no heap
    // Sets the latencies of frames to come.
    void use(const LatencySettings& settings) { settings_ = settings; }
    [[nodiscard]] std::size_t size() const { return count_ < kFrames ? static_cast<std::size_t>(count_) : kFrames; }
    // Index 0 is the oldest frame that is kept.
    [[nodiscard]] const FrameTimes& times(std::size_t i) const;
    [[nodiscard]] const FrameAges& ages(std::size_t i) const;
    // Summarise a figure over the frames, for the worse eye of each frame or for one eye.
    [[nodiscard]] FigureSummary summary(FrameFigure figure) const;
    [[nodiscard]] FigureSummary summary(FrameFigure figure, std::size_t eye) const;
    // Summarises the newest frames alone, again for the worse eye.
    [[nodiscard]] FigureSummary recent(FrameFigure figure, std::size_t frames) const;

    // Returns the warnings; empty while no limit is exceeded. Judges the value that 19 of 20 frames stay below, and not
    // before kLeastJudged frames.
    static constexpr std::size_t kLeastJudged = 20;
    [[nodiscard]] std::vector<FrameWarning> warnings() const;

private:
    struct Entry {
        FrameTimes times;
        FrameAges ages;
    };
    LatencySettings settings_;
    std::array<Entry, kFrames> ring_{};
    std::uint64_t count_ = 0;
};

}  // namespace burin::session
