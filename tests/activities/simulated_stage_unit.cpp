// SPDX-License-Identifier: MIT
// Simulated learners with a wand in hand: every kind of stage ends, forces act as the protocol says, and the same seed
// gives the same bits.
#include "activities/train/simulated_stage.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "devices/haptic/wand_description.hpp"
#include "haptics/tick_record.hpp"
#include "study/felt/felt_world.hpp"
#include "study/felt/stage_session.hpp"
#include "study/felt/stage_touch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace burin::activities {
namespace {

study::Protocol thesis_study(double training_s) {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    study::Protocol protocol = study::parse_protocol(text).protocol;
    for (study::Stage& stage : protocol.stages)
        if (stage.ends_after_s) stage.ends_after_s = training_s;
    return protocol;
}

struct Went {
    EndedStage stage;
    std::vector<Vec3> forces_N, places_m;
    double largest_N = 0.0, largest_torque_Nm = 0.0;
    std::uint64_t faults = 0;
};

class SimulatedStages : public testing::Test {
protected:
    void SetUp() override {
        auto worlds = felt_worlds(protocol_);
        ASSERT_TRUE(worlds);
        worlds_ = std::move(*worlds);
        world_ = worlds_.at("tube").get();
    }
    Went go(const char* stage, std::size_t group, std::uint64_t seed = 5) {
        study::Random random(seed);
        const study::StagePlace at{1, 1, protocol_.stage(stage)};
        Went went;
        auto ended =
            simulate_stage({protocol_, at, protocol_.groups[group], worlds_, learner_, population_}, random,
                           [&](const haptics::TickRecord& record, study::OperatorAct, const study::StageSession&) {
                               went.forces_N.push_back(record.gate.given.force_device_N);
                               went.places_m.push_back(record.contact.points[0].hip_object_m);
                               went.faults += record.sample.fault != devices::DeviceFault::none ? 1 : 0;
                               went.largest_N = std::max(went.largest_N, glm::length(went.forces_N.back()));
                               went.largest_torque_Nm =
                                   std::max(went.largest_torque_Nm, glm::length(record.gate.given.torque_device_Nm));
                           });
        EXPECT_TRUE(ended) << ended.error().line();
        if (ended) went.stage = std::move(*ended);
        return went;
    }

    study::Protocol protocol_ = thesis_study(12.0);
    FeltWorlds worlds_;
    const study::FeltWorld* world_ = nullptr;
    study::LearnerPopulation population_;
    study::Learner learner_{std::log(0.03), std::log(0.15), false, 0.0};
};

TEST_F(SimulatedStages, EndAsTheProtocolSays) {
    for (const study::Stage& stage : protocol_.stages) {
        for (const std::size_t group : {0u, 1u}) {
            const Went went = go(stage.name.c_str(), group);
            EXPECT_EQ(went.stage.end.phase, study::StagePhase::done) << stage.name;
            EXPECT_NE(went.stage.end.result, study::StageResult::stopped) << stage.name;
            if (stage.ends_after_s) {
                EXPECT_NEAR(went.stage.duration_s, *stage.ends_after_s, 0.0021) << stage.name;
            }
        }
    }
}

TEST_F(SimulatedStages, PressOnWhoFeelsTheTubeAndOnNobodyElse) {
    const Went felt = go("interactive", 0), unfelt = go("interactive", 1);
    EXPECT_GT(felt.stage.record.at("contact_s").get<double>(), 0.5);
    EXPECT_GT(felt.largest_N, 0.3);
    EXPECT_LE(felt.largest_N, protocol_.force_limit_N + 1e-9);
    EXPECT_GT(felt.largest_torque_Nm, 0.005);
    // The funnels alone press on the visual group, and the hand hardly comes near them.
    EXPECT_GT(unfelt.stage.record.at("contact_s").get<double>(), 0.5);
    EXPECT_LT(unfelt.largest_N, 0.5 * felt.largest_N);
    // The wall keeps the hand in: the top point comes less far out.
    const auto out = [&](const Went& went) {
        double sum_m = 0.0;
        for (const Vec3& p : went.places_m) sum_m += glm::distance(p, study::within_tube(world_->world(), p));
        return sum_m / static_cast<double>(went.places_m.size());
    };
    EXPECT_LT(out(felt), out(unfelt));
}

TEST_F(SimulatedStages, LeadAHandThatGivesWayAlongThePath) {
    const Went led = go("led", 0), shown = go("led", 1);
    const auto& spine = world_->world().spine_m;
    double farthest_m = spine.front().x;
    for (const Vec3& p : led.places_m) farthest_m = std::max(farthest_m, p.x);
    EXPECT_GT(farthest_m, spine.back().x - 0.02);
    double off_m = 0.0;
    for (const Vec3& p : led.places_m)
        off_m = std::max(off_m, study::nearest_on(spine, p - Vec3(0, protocol_.point_offset_m, 0)).distance_m);
    EXPECT_LT(off_m, 0.03);
    EXPECT_GT(led.largest_N, 0.2);
    EXPECT_LE(led.largest_N, protocol_.force_limit_N + 1e-9);
    EXPECT_EQ(shown.largest_N, 0.0);
}

TEST_F(SimulatedStages, GiveTrialsWithDeviationAndForceOfTheModelButNoneToTheHand) {
    std::size_t valid = 0;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Went trial = go("test", 0, seed);
        if (trial.stage.end.result != study::StageResult::valid_exit) continue;
        ++valid;
        const Json& record = trial.stage.record;
        EXPECT_GT(record.at("time_s").get<double>(), 1.0);
        EXPECT_LE(trial.largest_N, protocol_.force_limit_N + 1e-9);  // of the funnels alone
        if (record.at("deviations_differ").get<int>() != 0) continue;
        EXPECT_NEAR(record.at("deviation_mm").get<double>(), record.at("proxy_deviation_mm").get<double>(), 2.0);
        EXPECT_GT(record.at("force_largest_N").get<double>(), 0.0);
    }
    EXPECT_GE(valid, 2u);
}

TEST_F(SimulatedStages, GiveTheSameBitsAgainAndOthersWithAnotherSeed) {
    const Went one = go("test", 1, 9), two = go("test", 1, 9), other = go("test", 1, 10);
    EXPECT_EQ(one.places_m, two.places_m);
    EXPECT_EQ(json_text(one.stage.record), json_text(two.stage.record));
    EXPECT_NE(one.places_m, other.places_m);
}

TEST_F(SimulatedStages, ReachNoFartherThanTheWandAndNeverTripIt) {
    const devices::WandDescription wand = study::study_wand(protocol_);
    const devices::DeviceDescription device = devices::device_of(wand);
    const Similarity world_from_device = study::world_from_wand(wand, world_->bounds());
    // The thesis' tube is given in the maker's frame.
    EXPECT_EQ(world_from_device.position_m, wand.workspace_maker_m.center());
    const Vec3 half = 0.5 * device.workspace_m + Vec3(protocol_.point_offset_m + device.resolution_m);
    population_.stray_chance = 1.0;
    const Went astray = go("test", 1);
    EXPECT_EQ(astray.stage.end.result, study::StageResult::no_attempt_left);
    for (const Vec3& p : astray.places_m)
        ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::abs(inverse(world_from_device) * p), half)));
    EXPECT_EQ(go("interactive", 0).faults, 0u);
}

// A learner waited four hours for a cap that does not hold both points, and left 1.5 GB of that.
TEST_F(SimulatedStages, AreStoppedWhereNobodyCanDoThemAndSayWhy) {
    protocol_.worlds[0].cap_depth_m = 0.001;
    for (Vec3& p : protocol_.worlds[0].spine_m) p.y += 0.8 * (p.x - protocol_.worlds[0].spine_m.front().x);
    SetUp();
    const Went went = go("test", 0);
    EXPECT_EQ(went.stage.end.result, study::StageResult::stopped);
    EXPECT_LT(went.stage.duration_s, 125.0);
    const study::Stage& stage = *protocol_.stage("test");
    EXPECT_EQ(failures_of(stage, went.stage), (Json{{study::kNeverTouched, 1u}}));
    const auto told = deviation_of({1, 6, &stage}, went.stage);
    ASSERT_TRUE(told);
    EXPECT_TRUE(told->contains("was ended by stop after 12")) << *told;
}

TEST_F(SimulatedStages, CountWhyTheirAttemptsFailed) {
    population_.stray_chance = 1.0;
    const Went astray = go("test", 1);
    ASSERT_EQ(astray.stage.end.result, study::StageResult::no_attempt_left);
    const study::Stage& stage = *protocol_.stage("test");
    const Json failures = failures_of(stage, astray.stage);
    std::size_t sum = 0;
    for (const auto& [why, times] : failures.items()) {
        EXPECT_TRUE(why == "strayed" || why == "laid down") << why;
        sum += times.get<std::size_t>();
    }
    EXPECT_EQ(sum, stage.attempts);
    population_.stray_chance = 0.0;
    EXPECT_TRUE(failures_of(stage, go("test", 1).stage).is_null());
    EXPECT_TRUE(failures_of(*protocol_.stage("interactive"), go("interactive", 1).stage).is_null());
}

}  // namespace
}  // namespace burin::activities
