// SPDX-License-Identifier: MIT
// Measures how parts of one device, such as a glove's fingertips, share a turn's work on detailed meshes. Each follows
// a walk of its own, pressed as in the other ticks; in simulated time, so that the figures are the same everywhere.
#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/haptics/touch_run.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {
namespace {

constexpr double kPartBall_m = 0.002;

// A point and its four neighbours, 2 mm apart.
haptics::Probe fingertip() {
    haptics::Probe probe;
    probe.count = 0;
    for (const auto& [x, z] : {std::pair{0.0, 0.0}, {0.002, 0.0}, {-0.002, 0.0}, {0.0, 0.002}, {0.0, -0.002}})
        probe.points[probe.count++] = {{x, 0.0, z}, 0.0};
    return probe;
}

struct WalkingPart {
    PressedWalk path;
    PathDevice device;
    haptics::HapticChannels channels{64, 64};
    std::uint64_t waits = 0;
};

class PartsRun {
public:
    PartsRun(const TouchedScene& scene, std::size_t count, PartsShare& figures) : scene_(scene), figures_(figures) {
        std::vector<haptics::LoopPart> all;
        for (std::size_t i = 0; i < count; ++i) {
            SurfaceWalk walk = scene.walk;
            for (std::size_t k = 0; k <= i; ++k) walk.begin_elsewhere();
            parts_.emplace_back(PressedWalk(std::move(walk), {.seed = 1 + i}));
            all.push_back({parts_.back().device, parts_.back().channels});
        }
        loop_ = std::make_unique<haptics::HapticLoop>(all, clock_);
        on_ = session_parameters(figures.points == 1 ? haptics::ball_probe(kPartBall_m) : fingertip(), true);
        off_ = on_;
        off_.enabled = false;
    }

    void take(std::uint64_t turns) {
        for (std::uint64_t turn = 0; turn < turns; ++turn) {
            clock_.sleep_until(clock_.now_ns() + loop_->period_ns());
            for (WalkingPart& part : parts_) move(part, turn);
            loop_->step();
            double cost_us = 0.0;
            for (WalkingPart& part : parts_) cost_us += count(part);
            figures_.turn_cost_us.push_back(cost_us);
        }
    }

private:
    void move(WalkingPart& part, std::uint64_t turn) {
        part.path.step();
        part.device.go_to(part.path.hip_m(), part.path.orientation(), clock_.now_ns());
        part.channels.parameters.draft() = part.path.lifted() ? off_ : on_;
        part.channels.parameters.draft().sequence = turn + 1;
        part.channels.parameters.publish();
        if (turn % TouchRun::kTicksAnUpdate != 0) return;
        fill(part.channels.surface.draft(), scene_, turn + 1, clock_.now_ns());
        part.channels.surface.publish();
    }

    double count(WalkingPart& part) {
        haptics::TickRecord record;
        if (!part.channels.records.pop(record)) return 0.0;
        for (haptics::TickRecord read; part.channels.ticks.pop(read);) continue;
        ++figures_.ticks;
        const bool held_over = (record.flags & haptics::kTickHeldOver) != 0;
        part.waits = held_over ? part.waits + 1 : 0;
        figures_.held_over += held_over ? 1 : 0;
        figures_.longest_wait = std::max(figures_.longest_wait, part.waits);
        figures_.in_contact += record.in_contact() ? 1 : 0;
        figures_.let_go += (record.flags & haptics::kTickLetGo) != 0 ? 1 : 0;
        figures_.left_behind += record.deepest().penetration_m > TouchRun::kLeftBehind_m + kPartBall_m ? 1 : 0;
        return 1e-3 * haptics::cost_ns(record.contact.work);
    }

    const TouchedScene& scene_;
    PartsShare& figures_;
    SimulatedClock clock_;
    std::deque<WalkingPart> parts_;
    std::unique_ptr<haptics::HapticLoop> loop_;
    haptics::TickParameters on_, off_;
};

}  // namespace

Result<void> measure_parts(Haptics& all, const Tell& notify) {
    return on_rough_scenes(all, notify, "parts", [&](const TouchedScene& scene) -> Result<void> {
        // The last is a glove of four fingertips.
        for (const auto& [parts, points] : {std::pair<std::size_t, std::size_t>{1, 1}, {5, 1}, {20, 1}, {4, 5}}) {
            PartsShare& share = all.parts.emplace_back();
            share.scene = scene.name;
            share.triangles = scene.snapshot->triangles();
            share.parts = parts;
            share.points = points;
            PartsRun(scene, parts, share).take(all.options.parts_turns);
        }
        return {};
    });
}

}  // namespace burin::bench
