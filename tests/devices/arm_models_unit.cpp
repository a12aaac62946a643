// SPDX-License-Identifier: MIT
// Which arm a maker's library says a device is, what it is described by, and that what stands in for it has the same.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <utility>

#include "devices/drivers/arm_models.hpp"
#include "devices/drivers/dhd_device.hpp"
#include "devices/emulators/emulated_dhd.hpp"
#include "devices/emulators/emulated_omni.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"
#include "tests/devices/tries.hpp"

namespace burin::devices {
namespace {

std::string own_arm() { return "emulated-model-" + std::to_string(::getpid()); }

std::vector<HandPose> arm_rests(std::uint32_t buttons = 0) { return {{0.0, Vec3(0.0), {1.0, 0.0, 0.0, 0.0}, buttons}}; }

// Runs an emulator while it lives.
template <typename Emulated>
class RunningArm {
public:
    explicit RunningArm(Emulated emulated) : emulated_(std::move(emulated)) {
        if constexpr (requires { emulated_.dies_after(kEnded_ns); }) emulated_.dies_after(kEnded_ns);
        thread_ = std::thread([this] { emulated_.run([this] { return ends_.load(); }); });
    }
    ~RunningArm() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] Emulated* operator->() { return &emulated_; }

private:
    Emulated emulated_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

DeviceDescription stood_in_for(const std::string& device) {
    MonotonicClock clock;
    HapticHost host{clock, nobodys_hand()};
    host.stands_in = true;
    return open_haptic_device(device, std::move(host)).value().parts[0].device->description();
}

void expect_alike(const DeviceDescription& a, const DeviceDescription& b) {
    EXPECT_STREQ(a.name, b.name);
    EXPECT_EQ(a.max_force_N, b.max_force_N);
    EXPECT_EQ(a.max_stiffness_N_per_m, b.max_stiffness_N_per_m);
    EXPECT_EQ(a.workspace_m, b.workspace_m);
    EXPECT_EQ(a.resolution_m, b.resolution_m);
    EXPECT_EQ(a.apparent_mass_kg, b.apparent_mass_kg);
    EXPECT_EQ(a.friction_N, b.friction_N);
    EXPECT_EQ(a.damping_Ns_per_m, b.damping_Ns_per_m);
    EXPECT_EQ(a.delay_s, b.delay_s);
}

}  // namespace

TEST(ArmModels, EachForceDimensionDeviceIsDescribedAsItself) {
    struct Row {
        int type;
        double most_N, stiffness_N_per_m;
        const char* ending;
    };
    for (const Row& row : {Row{33, 12.0, 5000.0, ""}, Row{35, 12.0, 5000.0, ""}, Row{63, 20.0, 5000.0, ",model=delta"},
                           Row{64, 20.0, 5000.0, ",model=delta"}, Row{104, 12.0, 4000.0, ",model=sigma"},
                           Row{107, 12.0, 4000.0, ",model=sigma"}, Row{60, 8.0, 3000.0, ",model=falcon"},
                           Row{109, 8.0, 3000.0, ",model=unknown"}, Row{4711, 8.0, 3000.0, ",model=unknown"}}) {
        RunningArm running(
            EmulatedDhd::create(own_arm(), {.script = arm_rests(), .silence = {}, .type = row.type}).value());
        TickedArm dhd("dhd:" + own_arm());
        ASSERT_TRUE(dhd.is_well()) << row.type;
        const DeviceDescription& found = dhd.opened().parts[0].device->description();
        EXPECT_EQ(found.max_force_N, row.most_N) << row.type;
        EXPECT_EQ(found.max_stiffness_N_per_m, row.stiffness_N_per_m) << row.type;
        const std::string given = "dhd:" + own_arm();
        EXPECT_EQ(dhd.opened().settled, *row.ending != 0 ? given + row.ending : "") << row.type;
        expect_alike(stood_in_for(given + row.ending), found);
        // It is asked for no more than it is described by, and for all of that.
        EXPECT_TRUE(dhd.ticks_until(Vec3(0.0, 80.0, 0.0), [&](const DeviceSample&) {
            return running->written_N().y > row.most_N - 1e-9;
        })) << row.type;
        EXPECT_LE(glm::length(running->written_N()), row.most_N + 1e-9) << row.type;
    }
}

TEST(ArmModels, AForceDimensionDeviceThatIsNotKnownIsToldOfAndGivesWhatAModelByHandHas) {
    const auto told = [](TickedArm& arm) {
        std::string text;
        static_cast<void>(arm.ticks_until(
            Vec3(0.0),
            [&](const DeviceSample&) {
                text += arm.messages();
                return text.contains("not known");
            },
            300));
        return text;
    };
    RunningArm running(EmulatedDhd::create(own_arm(), {.script = arm_rests(), .silence = {}, .type = 109}).value());
    {
        TickedArm dhd("dhd:" + own_arm());
        ASSERT_TRUE(dhd.is_well());
        EXPECT_TRUE(told(dhd).contains("(109)"));
    }
    TickedArm named("dhd:" + own_arm() + ",model=sigma");
    ASSERT_TRUE(named.is_well());
    EXPECT_FALSE(told(named).contains("not known"));
    EXPECT_TRUE(
        named.ticks_until(Vec3(0.0, 80.0, 0.0), [&](const DeviceSample&) { return running->written_N().y > 11.9; }));
    EXPECT_LE(glm::length(running->written_N()), 12.0 + 1e-9);
}

TEST(ArmModels, APhantomThatIsNotKnownOrWeakerThanItsModelIsToldOf) {
    struct Row {
        const char* said;
        double library_N;
        const char* told;
    };
    for (const Row& row : {Row{"an arm", 30.0, "\"an arm\""}, Row{"Touch X", 5.0, "gives 5.0 N"},
                           Row{"Touch X", 7.9, ""}, Row{"Touch", 3.3, ""}}) {
        RunningArm running(
            EmulatedOmni::create(own_arm(),
                                 {.script = arm_rests(), .silence = {}, .model = row.said, .most_N = row.library_N})
                .value());
        TickedArm omni("omni:" + own_arm());
        ASSERT_TRUE(omni.is_well()) << row.said;
        const std::string messages = omni.messages();
        EXPECT_EQ(messages.contains("is described as a PHANTOM Omni"), *row.told != 0) << messages;
        EXPECT_TRUE(messages.contains(row.told)) << messages;
    }
}

TEST(ArmModels, AGripperPressesTheFirstButton) {
    for (const int type : {35, 37, 104, 105, 108, 109}) {
        RunningArm running(
            EmulatedDhd::create(own_arm(), {.script = arm_rests(1), .silence = {}, .type = type}).value());
        TickedArm dhd("dhd:" + own_arm());
        ASSERT_TRUE(dhd.is_well());
        EXPECT_TRUE(dhd.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.buttons == 1u; })) << type;
    }
}

TEST(ArmModels, EachPhantomIsDescribedAsItselfAndNoneByMoreThanItsLibrarySays) {
    struct Row {
        const char* said;
        double library_N, most_N;
        const char* ending;
    };
    for (const Row& row :
         {Row{"PHANTOM Omni", 3.3, 3.3, ""}, Row{"Touch", 3.3, 3.3, ""}, Row{"Touch X", 7.9, 7.9, ",model=touch-x"},
          Row{"Phantom Desktop", 8.0, 7.9, ",model=touch-x"}, Row{"Touch X", 5.0, 3.3, ""},
          Row{"PHANTOM Premium 1.5", 8.5, 8.5, ",model=premium-1.5"},
          Row{"PHANTOM Premium 3.0 6DOF", 22.0, 22.0, ",model=premium-3.0"}, Row{"PHANTOM Premium 1.0", 8.5, 3.3, ""},
          Row{"an arm", 30.0, 3.3, ""}}) {
        RunningArm running(
            EmulatedOmni::create(own_arm(),
                                 {.script = arm_rests(), .silence = {}, .model = row.said, .most_N = row.library_N})
                .value());
        TickedArm omni("omni:" + own_arm());
        ASSERT_TRUE(omni.is_well()) << row.said;
        const DeviceDescription& found = omni.opened().parts[0].device->description();
        EXPECT_EQ(found.max_force_N, row.most_N) << row.said;
        const std::string given = "omni:" + own_arm();
        EXPECT_EQ(omni.opened().settled, *row.ending != 0 ? given + row.ending : "") << row.said;
        expect_alike(stood_in_for(given + row.ending), found);
    }
}

TEST(ArmModels, AModelThatIsNamedCountsAndTheDevicesOwnForceBoundsIt) {
    RunningArm running(EmulatedDhd::create(own_arm(), {.script = arm_rests(), .silence = {}, .type = 33}).value());
    const std::string named = "dhd:" + own_arm() + ",model=delta";
    TickedArm dhd(named);
    ASSERT_TRUE(dhd.is_well());
    EXPECT_EQ(dhd.opened().parts[0].device->description().max_force_N, 20.0);
    EXPECT_EQ(dhd.opened().settled, named);
    EXPECT_TRUE(
        dhd.ticks_until(Vec3(0.0, 80.0, 0.0), [&](const DeviceSample&) { return running->written_N().y > 11.9; }));
    EXPECT_LE(glm::length(running->written_N()), 12.0 + 1e-9);
    MonotonicClock clock;
    for (const std::string device : {"dhd:0,model=omicron", "omni:,model=omicron"}) {
        const auto refused = open_haptic_device(device, {clock, nobodys_hand()});
        ASSERT_FALSE(refused) << device;
        EXPECT_TRUE(refused.error().line().contains("has no model omicron")) << refused.error().line();
    }
}

TEST(ArmModels, AModelStandsBeforeTheLibrary) {
    EXPECT_EQ(with_model("", "delta"), ",model=delta");
    EXPECT_EQ(with_model("1@/opt/lib.so", "delta"), "1,model=delta@/opt/lib.so");
    for (const std::string text : {"", "1", "@lib.so", "1@/opt/a,b.so", "Touch at the left"}) {
        const ModelledText back = without_model(with_model(text, "touch-x"));
        EXPECT_EQ(back.text, text);
        EXPECT_EQ(back.model, "touch-x");
        EXPECT_EQ(without_model(text).text, text);
        EXPECT_EQ(without_model(text).model, "");
    }
}

}  // namespace burin::devices
