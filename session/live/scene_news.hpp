// SPDX-License-Identifier: MIT
// What the parts of a scene report to the frames. Collected on the scene's thread after each of its updates, taken on
// the frame's; each report keeps the number of its update, so that a frame that has taken so many updates, live or in a
// replay, sees the results of these and of no other. Neither thread waits for the other's work.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "haptics/histogram.hpp"
#include "scene/scene_changes.hpp"
#include "scene/scene_service.hpp"
#include "scene/scene_thread.hpp"
#include "scene/surface_update.hpp"

namespace burin::session {

class SceneNews {
public:
    // Reports, from the newest back, that keep how parts look.
    static constexpr std::size_t kMostShapes = 256;

    // Sets whose changes are collected, before the first update; it must outlive this.
    void report_of(scene::SceneService& service) { service_ = &service; }
    // Sets whether ticks alone are worth a frame. Any thread.
    void frames_for_ticks(bool wanted) { frames_for_ticks_.store(wanted, std::memory_order_relaxed); }
    // Keeps a message for the user with the next report. The scene's thread.
    void notify(std::string message) { messages_.push_back(std::move(message)); }

    // Collects what the update that has just ended has to report; returns whether a frame has to take it soon. The
    // scene's thread.
    bool collect(const scene::SceneThread::Ended& update);
    // Returns what the first `updates` of all collected updates have reported since the last call. The frame's thread.
    struct Taken {
        std::optional<scene::SurfaceUpdate> surface;
        std::vector<scene::ObjectUpdate> objects;       // the newest last
        std::optional<scene::MaterialTable> materials;  // if it has changed
        std::vector<scene::DrawnShare> drawn;           // of other kinds than carved surfaces
        std::vector<std::string> messages;
        std::vector<scene::StepsOfPart> steps;  // the newest last
        scene::HandNews hands;                  // ticks for the activity, contacts for the recording as well
    };
    [[nodiscard]] Taken take(std::uint64_t updates);
    // Returns the durations of the updates in which the carved surface changed. Any thread.
    [[nodiscard]] const haptics::Histogram& carving_duration() const { return carving_duration_; }

private:
    struct Report {
        std::uint64_t update = 0;  // counted from 1
        Taken news;
    };
    scene::SceneService* service_ = nullptr;
    std::atomic<bool> frames_for_ticks_ = false;
    std::vector<std::string> messages_;
    haptics::Histogram carving_duration_;
    std::mutex mutex_;  // guards the members below
    std::uint64_t updates_ = 0;
    std::deque<Report> reports_;
};

}  // namespace burin::session
