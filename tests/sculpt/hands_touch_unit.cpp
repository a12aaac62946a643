// SPDX-License-Identifier: MIT
// Two simulated Omnis, each with a haptic loop of its own, at one block in simulated time: each feels what the other
// does at the next publication; no edit of the other kicks or gives energy; what befalls one leaves the other as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/feel_options.hpp"
#include "sculpt/felt_tool.hpp"
#include "sculpt/sculpt_service.hpp"
#include "sculpt/workpiece.hpp"

namespace burin::sculpt {
namespace {

constexpr double kBall_m = 0.004;
constexpr Nanoseconds kMs = 1'000'000;

// A hand's places relative to where its ball would rest on the middle of the block's top.
struct Role {
    compute::Operation operation = compute::Operation::cut;
    std::vector<devices::HandPose> script;
};

std::vector<devices::HandPose> way(const std::vector<std::array<double, 5>>& rows) {
    std::vector<devices::HandPose> script;
    for (const auto& [time_s, x_mm, y_mm, z_mm, pressed] : rows)
        script.push_back({time_s, 1e-3 * Vec3(x_mm, y_mm, z_mm), Quat{1, 0, 0, 0}, pressed > 0.0 ? 1u : 0u});
    return script;
}

// Goes down beside the middle of the block, across it and up again, so far beside the middle.
Role across(compute::Operation operation, bool along_x, double from_s, double depth_mm, double beside_mm = 0.0) {
    const auto at = [&](double s, double along_mm, double z_mm, double pressed) {
        return std::array{from_s + s, along_x ? along_mm : beside_mm, along_x ? beside_mm : along_mm, z_mm, pressed};
    };
    return {operation, way({at(0.0, -12.0, 4.0, 0.0), at(0.1, -12.0, 2.0, 1.0), at(0.4, -12.0, -depth_mm, 1.0),
                            at(1.2, 12.0, -depth_mm, 1.0), at(1.5, 12.0, 4.0, 1.0), at(1.6, 12.0, 6.0, 0.0)})};
}

// Presses on the middle without its button, until the end.
Role resting(double depth_mm) {
    return {compute::Operation::cut, way({std::array{0.0, 0.0, 0.0, 4.0, 0.0}, {0.3, 0.0, 0.0, -depth_mm, 0.0}})};
}

class Bench {
public:
    explicit Bench(const std::vector<Role>& roles)
        : carving_(compute::make_cpu_engine(
                       std::move(load_workpiece({"block:0.06,0.06,0.012", 60, false}, pool_)->solid), pool_),
                   pool_),
          feel_(*parse_feel({})) {
        for (const Role& role : roles) add(role);
        for (std::size_t i = 0; i < hands_.size(); ++i)
            service_->start_at(object_from_device() + hands_[i]->omni.true_position_device_m(), i);
        EXPECT_TRUE(service_->update(0));
    }
    // Ticks all hands for a while; the service updates every 10 ms.
    void run(double duration_s) {
        for (const Nanoseconds end_ns = clock_.now_ns() + nanoseconds(duration_s); clock_.now_ns() < end_ns;) {
            clock_.sleep_until(clock_.now_ns() + kMs);
            for (const auto& hand : hands_) {
                if (!hand->stopped) hand->records.push_back(hand->loop.step());
            }
            if (clock_.now_ns() % (10 * kMs) != 0) continue;
            EXPECT_TRUE(service_->update(clock_.now_ns()).has_value());
        }
    }
    [[nodiscard]] const std::vector<haptics::TickRecord>& records(std::size_t hand) const {
        return hands_[hand]->records;
    }
    [[nodiscard]] haptics::HapticChannels& channels(std::size_t hand) { return hands_[hand]->channels; }
    [[nodiscard]] devices::SimulatedOmni& omni(std::size_t hand) { return hands_[hand]->omni; }
    void stop(std::size_t hand) { hands_[hand]->stopped = true; }
    [[nodiscard]] Sculpture& carving() { return carving_; }
    [[nodiscard]] SculptService& service() { return *service_; }
    [[nodiscard]] Nanoseconds now_ns() { return clock_.now_ns(); }

private:
    struct Hand {
        Hand(const Role& role, Clock& clock, std::size_t strokes)
            : channels(strokes, 2),
              omni(*devices::SimulatedHand::create(role.script), {}, &clock),
              loop(omni, clock, channels) {}
        haptics::HapticChannels channels;
        devices::SimulatedOmni omni;
        haptics::HapticLoop loop;
        std::vector<haptics::TickRecord> records;
        bool stopped = false;
    };
    static Vec3 object_from_device() { return {0.03, 0.03, 0.012 + kBall_m}; }

    void add(const Role& role) {
        const Tool tool{compute::BallTool{kBall_m}, role.operation};
        Hand& hand = *hands_.emplace_back(std::make_unique<Hand>(role, clock_, std::size_t{64}));
        const FeltTool felt = felt_tool(tool.shape);
        haptics::TickParameters& parameters = hand.channels.parameters.draft();
        parameters.sequence = 1;
        parameters.workspace.object_from_device.position_m = object_from_device();
        parameters.probe = felt.probe;
        parameters.tool = felt.surface;
        parameters.materials.fill(feel_.material);
        parameters.action = action_of(tool.operation);
        hand.channels.parameters.publish();
        if (!service_) {
            service_.emplace(carving_, hand.channels, tool, feel_.material.hardness_Ns_per_m3, 0.014,
                             std::size_t{1} << 26);
        } else {
            service_->add_hand(hand.channels, tool, feel_.material.hardness_Ns_per_m3);
        }
    }

    WorkerPool pool_{1};
    Sculpture carving_;
    Feel feel_;
    SimulatedClock clock_;
    std::vector<std::unique_ptr<Hand>> hands_;
    std::optional<SculptService> service_;
};

struct Measured {
    double most_step_N = 0.0;      // change of force in a tick
    double most_rise_N = 0.0;      // of its magnitude, in a tick in which another surface came
    double most_given_J = -1.0;    // beyond what the device's friction has taken, since a contact began
    int touched = 0, cutting = 0;  // ticks
    int edited = 0;                // ticks whose contact another surface has changed
};

Measured measure(const std::vector<haptics::TickRecord>& records) {
    Measured m;
    const devices::OmniModel model;
    double given_J = 0.0;
    for (std::size_t i = 2; i < records.size(); ++i) {
        const haptics::TickRecord &now = records[i], &before = records[i - 1];
        EXPECT_EQ(now.gate.cause, haptics::GateCause::none) << now.tick << ": " << text(now.gate.cause);
        const Vec3 force = now.gate.given.force_device_N, last = before.gate.given.force_device_N;
        m.most_step_N = std::max(m.most_step_N, glm::length(force - last));
        if (now.surface_sequence != before.surface_sequence)
            m.most_rise_N = std::max(m.most_rise_N, glm::length(force) - glm::length(last));
        m.touched += now.in_contact() ? 1 : 0;
        m.cutting += (now.flags & haptics::kTickCutting) != 0 ? 1 : 0;
        m.edited += now.contact.jumped ? 1 : 0;
        // What was commanded two ticks before acts up to this one's sample: a millisecond of transport.
        const Vec3 moved = now.sample.position_device_m - before.sample.position_device_m;
        const Vec3 acted = records[i - 2].gate.given.force_device_N;
        given_J += glm::dot(acted, moved) -
                   model.friction_N * (std::abs(moved.x) + std::abs(moved.y) + std::abs(moved.z)) -
                   model.damping_Ns_per_m * glm::dot(moved, moved) * 1e3;
        if (!before.in_contact() && glm::length(acted) == 0.0) given_J = 0.0;
        m.most_given_J = std::max(m.most_given_J, given_J);
    }
    return m;
}

// A step of the encoder under the largest force: what the samples leave uncertain of the work.
constexpr double kUncertain_J = 3.3 * 0.000055;
// What the gate lets a force change in a tick; and what a hand of 0.15 m/s feels of a wall of 700 N/m in a tick, of
// which a wall that rose by a millimetre at once would be seven times as much.
constexpr double kSlew_N = 1.0 + 1e-9, kNoKick_N = 0.15 * 700.0 * 0.001;

std::ostream& operator<<(std::ostream& out, const Measured& m) {
    return out << "step " << m.most_step_N << " N, rise at a publication " << m.most_rise_N << " N, given "
               << m.most_given_J << " J, touched " << m.touched << ", cutting " << m.cutting << ", edited " << m.edited;
}

}  // namespace

TEST(HandsTouch, CuttingOnePlaceAtOnceNeitherIsKickedNorGivenEnergy) {
    // Both cross the middle of the block; the second at the same time, or a little later where the first has cut.
    for (const double later_s : {0.0, 0.15}) {
        Bench bench(
            {across(compute::Operation::cut, true, 0.0, 3.0), across(compute::Operation::cut, false, later_s, 3.0)});
        bench.run(2.0);
        for (std::size_t hand = 0; hand < 2; ++hand) {
            const Measured m = measure(bench.records(hand));
            EXPECT_GT(m.cutting, 300) << hand << ": " << m;
            EXPECT_LE(m.most_step_N, kSlew_N) << hand << ": " << m;
            EXPECT_LE(m.most_rise_N, kNoKick_N) << hand << ": " << m;
            EXPECT_LE(m.most_given_J, kUncertain_J) << hand << ": " << m;
        }
        EXPECT_EQ(bench.carving().history()->undoable(), 1u);
        EXPECT_EQ(bench.service().late_samples(0) + bench.service().late_samples(1), 0u);
    }
}

TEST(HandsTouch, WhatOneRestsOnMayBeCutAwayOrRaisedByTheOther) {
    for (const compute::Operation other : {compute::Operation::cut, compute::Operation::fill}) {
        Bench bench({resting(6.0), across(other, true, 0.4, other == compute::Operation::cut ? 6.0 : 1.0)});
        bench.run(0.4);
        const double before_m = bench.records(0).back().contact.points[0].proxy_object_m.z;
        bench.run(2.0);
        const double after_m = bench.records(0).back().contact.points[0].proxy_object_m.z;
        const Measured m = measure(bench.records(0));
        if (other == compute::Operation::cut) {
            EXPECT_LT(after_m, before_m - 0.001) << m;
        } else {
            EXPECT_GT(after_m, before_m + 0.001) << m;
            EXPECT_GT(m.edited, 0) << m;
        }
        EXPECT_GT(m.touched, 2000) << m;
        EXPECT_LE(m.most_step_N, kSlew_N) << m;
        EXPECT_LE(m.most_rise_N, kNoKick_N) << m;
        EXPECT_LE(m.most_given_J, kUncertain_J) << m;
    }
}

// Side by side, far enough apart that neither feels the other.
TEST(HandsTouch, AFaultOfOneLeavesTheOtherAsItIsToTheBit) {
    const std::vector<Role> roles{across(compute::Operation::cut, true, 0.0, 3.0, -15.0),
                                  across(compute::Operation::cut, true, 0.1, 3.0, 15.0)};
    Bench well(roles);
    well.run(1.9);
    EXPECT_EQ(well.carving().history()->undoable(), 2u);
    for (const devices::InjectedFault fault :
         {devices::InjectedFault::nan_position, devices::InjectedFault::disconnected, devices::InjectedFault::frozen}) {
        Bench bench(roles);
        bench.run(0.8);
        bench.omni(1).inject(fault);
        bench.run(0.2);
        bench.omni(1).inject(devices::InjectedFault::none);
        bench.run(0.9);
        EXPECT_NE(bench.records(1)[950].gate.cause, haptics::GateCause::none);
        EXPECT_EQ(bench.records(1)[950].gate.given.force_device_N, Vec3(0.0));
        ASSERT_EQ(bench.records(0).size(), well.records(0).size());
        for (std::size_t i = 0; i < well.records(0).size(); ++i) {
            const haptics::TickRecord &one = bench.records(0)[i], &other = well.records(0)[i];
            ASSERT_EQ(one.sample.position_device_m, other.sample.position_device_m) << i;
            ASSERT_EQ(one.gate.given.force_device_N, other.gate.given.force_device_N) << i;
            ASSERT_EQ(one.flags, other.flags) << i;
        }
        // Its stroke ended before the other's, which is undone alone.
        EXPECT_EQ(bench.carving().history()->undoable(), 2u);
        for (Bench* of : {&bench, &well}) of->service().order(UndoStroke{});
        EXPECT_TRUE(bench.carving().engine().solid().same_content(well.carving().engine().solid()));
        well.service().order(RedoStroke{});
    }
}

TEST(HandsTouch, WhereOneLoopEndsTheOtherGoesOnWithoutWaitingForIt) {
    Bench bench({across(compute::Operation::cut, true, 0.0, 3.0, -15.0),
                 across(compute::Operation::cut, true, 0.1, 3.0, 15.0)});
    bench.run(0.8);
    bench.stop(1);
    bench.run(0.3);
    // The groove follows the hand again: what has been cut is as far behind as with one hand, an update and a slice.
    const double tool_x_m = bench.records(0)[bench.records(0).size() - 20].contact.cut_object_m.x;
    const Vec3 bottom(tool_x_m, 0.015, 0.012);
    const compute::Solid& solid = bench.carving().engine().solid();
    const auto cell = [&](double m, double origin_m) {
        return static_cast<int>(std::lround((m - origin_m) / solid.lattice.spacing_m));
    };
    const auto ends = solid.sets[2].ends(cell(bottom.x, solid.lattice.origin_object.x),
                                         cell(bottom.y, solid.lattice.origin_object.y));
    ASSERT_FALSE(ends.empty());
    EXPECT_LT(shared::depth_of(ends.back()) * solid.lattice.unit_m() + solid.lattice.origin_object.z, 0.0118);
    bench.run(0.8);
    EXPECT_EQ(measure(bench.records(0)).edited, 0);
    bench.service().order(UndoStroke{});  // of the second, which never let go
    EXPECT_EQ(bench.carving().history()->undoable(), 1u);
    EXPECT_EQ(bench.service().late_samples(0) + bench.service().late_samples(1), 0u);
}

}  // namespace burin::sculpt
