// SPDX-License-Identifier: MIT
// The points of a part share its work by need and in turns: gloves of many points are led over rough surfaces, on
// machines so slow that the work seldom suffices for all of them.
//
// In each tick each point is judged by a proxy of its own that starts where the point's did and has a third of a whole
// tick's work, for the watch may take half of what there is. A point that went less than a fifth as far as this one
// waits. All work is counted, so that the same ticks come out everywhere.
#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <numbers>

#include "bench/measure/rough_surfaces.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {
namespace {

// A part that is never read: the loop repeats the samples that it is handed.
class HandedPart final : public devices::HapticDevice {
public:
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override { return {}; }
    void write(const devices::DeviceWrench&) noexcept override {}

private:
    devices::DeviceDescription description_ = test::kStrongDevice;
};

struct GloveCase {
    std::size_t parts = 4;
    std::uint32_t points = 5;
    double pace = 1.0;
    double radius_m = 0.001;
};

struct GloveFigures {
    std::uint64_t ticks = 0, in_contact = 0, behind = 0, over_budget = 0, let_go = 0;
    std::uint32_t longest_wait = 0;  // ticks in a row in which a point was behind
    double worst_turn = 0.0;         // cost of a turn in budgets
};

// Fingers that press 1 to 2 mm deep into a ball of 100 mm and go around it.
class Glove {
public:
    Glove(const GloveCase& c, const geometry::LocalSurface& surface) : case_(c), surface_(surface), devices_(c.parts) {
        std::vector<LoopPart> all;
        for (HandedPart& device : devices_) {
            channels_.push_back(std::make_unique<HapticChannels>(64, 64));
            all.push_back({device, *channels_.back()});
        }
        loop_ = std::make_unique<HapticLoop>(all, clock_);
        waits_.assign(c.parts, std::vector<std::uint32_t>(c.points, 0));
        parameters_.sequence = 1;
        parameters_.probe.count = c.points;
        for (std::uint32_t i = 0; i < c.points; ++i) {
            const double around = 2.4 * i, out_m = 2.2 * c.radius_m * std::sqrt(i);  // a sunflower's seeds
            parameters_.probe.points[i] = {{out_m * std::cos(around), 0.0, out_m * std::sin(around)}, c.radius_m};
        }
        parameters_.clearance_ratio = 0.0;
        parameters_.max_surface_age_s = 0.0;
        parameters_.work.pace = c.pace;
        for (TouchMaterial& m : parameters_.materials) m.static_friction = m.dynamic_friction = 0.0;
    }

    GloveFigures go(int turns) {
        GloveFigures figures;
        const double budget = budget_ns(parameters_.work, 1e-3);
        for (int turn = 0; turn < turns; ++turn) {
            now_ns_ += 1'000'000;
            std::vector<PartInput> inputs;
            std::vector<ProbeState> before;
            for (std::size_t part = 0; part < case_.parts; ++part) {
                inputs.push_back({sample_of(part, 1e-3 * turn), &surface_, &parameters_});
                before.push_back(loop_->state(part).tick.probe);
            }
            loop_->repeat(inputs, now_ns_, 0);
            double spent = 0.0;
            for (std::size_t part = 0; part < case_.parts; ++part) spent += judge(part, before[part], figures);
            figures.worst_turn = std::max(figures.worst_turn, spent / budget);
            figures.over_budget += spent > budget ? 1 : 0;
        }
        return figures;
    }

private:
    [[nodiscard]] devices::DeviceSample sample_of(std::size_t part, double t) const {
        const double phase = 1.3 * static_cast<double>(part), depth_m = 0.0015 + 0.0005 * std::sin(4.0 * t + phase);
        const Quat turned = glm::angleAxis(2.0 * t + phase, glm::normalize(Vec3(1.0, 0.3, 0.5 - 0.2 * phase)));
        devices::DeviceSample sample;
        sample.time_ns = now_ns_;
        sample.orientation_device = turned;
        sample.position_device_m = turned * Vec3(0.0, 0.05 - depth_m, 0.0);
        return sample;
    }

    double judge(std::size_t part, const ProbeState& before, GloveFigures& figures) {
        TickRecord record;
        EXPECT_TRUE(channels_[part]->records.pop(record));
        for (TickRecord s; channels_[part]->ticks.pop(s);) continue;
        figures.let_go += (record.flags & kTickLetGo) != 0 ? 1 : 0;
        const ProbeState& after = loop_->state(part).tick.probe;
        for (std::uint32_t i = 0; i < case_.points; ++i) {
            const Vec3 began = before.proxies[i].position_object_m;
            const ProxyResult alone =
                move_proxy(before.proxies[i], record.contact.points[i].hip_object_m,
                           {.contact_radius_m = case_.radius_m, .shading = parameters_.shading},
                           geometry::PosedSurface(surface_), {.max_cost_ns = 0.33 * budget_ns(parameters_.work, 1e-3)});
            const double way_m = glm::length(after.proxies[i].position_object_m - began),
                         way_alone_m = glm::length(alone.next.position_object_m - began);
            const bool is_behind = way_m < 0.2 * way_alone_m && way_alone_m > 0.05 * case_.radius_m;
            std::uint32_t& waits = waits_[part][i];
            waits = is_behind ? waits + 1 : 0;
            figures.longest_wait = std::max(figures.longest_wait, waits);
            figures.behind += is_behind ? 1 : 0;
            figures.in_contact += record.contact.points[i].constraints > 0 ? 1 : 0;
            ++figures.ticks;
        }
        return cost_ns(record.contact.work);
    }

    GloveCase case_;
    const geometry::LocalSurface& surface_;
    std::vector<HandedPart> devices_;
    std::vector<std::unique_ptr<HapticChannels>> channels_;
    std::vector<std::vector<std::uint32_t>> waits_;
    SimulatedClock clock_;
    std::unique_ptr<HapticLoop> loop_;
    TickParameters parameters_;
    Nanoseconds now_ns_ = 1'000'000'000;
};

geometry::LocalSurface rough(std::size_t triangles) {
    geometry::LocalSurface surface;
    surface.sequence = 1;
    surface.radius_m = 1e3;
    surface.meshes = {{geometry::TouchMesh::create(bench::rough_ball(triangles))->snapshot(), 0}};
    return surface;
}

}  // namespace

TEST(Points, OfAGloveNoneWaitsLongerThanTwentyTicksAndNoTurnCostsMoreThanItsBudget) {
    const geometry::LocalSurface coarse = rough(20'000), fine = rough(200'000);
    for (const GloveCase& c :
         {GloveCase{4, 5, 1.0, 0.001}, GloveCase{4, 5, 3.0, 0.002}, GloveCase{1, 20, 1.0, 0.001},
          GloveCase{1, 20, 4.0, 0.002}, GloveCase{1, 20, 20.0, 0.001}, GloveCase{2, 2, 10.0, 0.004}}) {
        for (const geometry::LocalSurface* surface : {&coarse, &fine}) {
            const GloveFigures f = Glove(c, *surface).go(1000);
            const std::string name = std::to_string(c.parts) + " x " + std::to_string(c.points) + " points, pace " +
                                     std::to_string(c.pace) + (surface == &fine ? ", fine" : ", coarse");
            std::cout << name << ": in contact " << f.in_contact << " of " << f.ticks << ", behind " << f.behind
                      << ", longest wait " << f.longest_wait << ", worst turn " << f.worst_turn << " budgets, over in "
                      << f.over_budget << "; let go " << f.let_go << " times\n";
            EXPECT_GT(f.in_contact, f.ticks / 3) << name;
            EXPECT_LE(f.longest_wait, 20u) << name;
            EXPECT_LE(f.worst_turn, 1.0) << name;
        }
    }
}

}  // namespace burin::haptics
