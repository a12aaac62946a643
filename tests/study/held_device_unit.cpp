// SPDX-License-Identifier: MIT
// What was held in a visit and who felt it, told by one truth wherever it is told.
#include "study/folder/held_device.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "study/folder/stage_recording.hpp"
#include "study/people/trial_rows.hpp"
#include "tests/study/lost_study.hpp"

namespace burin::study {
namespace {

const std::map<std::string, Hand> kHandOf{{"simulated", Hand::simulated_device},
                                          {"simulated-wand", Hand::simulated_device},
                                          {"mouse", Hand::simulated_device},
                                          {"spacemouse", Hand::simulated_device},
                                          {"spacemouse:emulated", Hand::simulated_device},
                                          {"recorded:r.session", Hand::recording},
                                          {"omni:emulated", Hand::emulated_device},
                                          {"omni:emulated-2", Hand::emulated_device},
                                          {"wand:emulated,wand30.toml", Hand::emulated_device},
                                          {"falcon:emulated", Hand::emulated_device},
                                          {"dhd:emulated", Hand::emulated_device},
                                          {"wand", Hand::device},
                                          {"wand:q8_usb,wand30.toml", Hand::device},
                                          {"omni", Hand::device},
                                          {"omni:Default Device", Hand::device},
                                          {"falcon", Hand::device},
                                          {"dhd:0", Hand::device},
                                          {"glove:/dev/ttyUSB0", Hand::device}};

}  // namespace

// The Quanser's driver was a simulated wand, and a mouse and an emulated Omni a person's device.
TEST(HeldDevices, AreWhatTheListOfDevicesSaysOfThem) {
    for (const auto& [name, hand] : kHandOf) {
        const auto nature = devices::nature_of_name(name);
        ASSERT_TRUE(nature) << name << ": " << nature.error().line();
        EXPECT_STREQ(name_of(hand_of(*nature)), name_of(hand)) << name;
        EXPECT_EQ(nature->felt_by_person, hand == Hand::device) << name;
        EXPECT_EQ(hand_named(name_of(hand)), hand) << name;
    }
    for (const char* without : {"mouse", "spacemouse", "spacemouse:emulated", "spacemouse-wand", "recorded:r.session"})
        EXPECT_FALSE(devices::nature_of_name(without)->has_force) << without;
    for (const char* with : {"simulated-wand", "omni:emulated", "wand", "glove:/dev/ttyUSB0"})
        EXPECT_TRUE(devices::nature_of_name(with)->has_force) << with;
}

TEST(HeldDevices, OfAnEarlierJournalAreToldAsFarAsItTellsThem) {
    EXPECT_EQ(held_by_name(kScriptedDevice).hand, Hand::script);
    EXPECT_EQ(held_by_name("simulated wand").hand, Hand::untold) << "any wand was called so";
    EXPECT_EQ(held_by_name("omni").hand, Hand::device);
    EXPECT_EQ(held_by_name("omni:emulated").hand, Hand::emulated_device);
    EXPECT_EQ(held_by_name("mouse").hand, Hand::simulated_device);
    EXPECT_EQ(held_by_name("no such device").hand, Hand::untold);
}

TEST(HeldDevices, AreToldAlikeByJournalStatusReportTableAndRecordings) {
    const Workplace place;
    make_lost_study(place, {"\"test\""});
    const std::vector<std::pair<std::string, HeldDevice>> visits{
        {"p01", {"wand:emulated,wand30.toml", Hand::emulated_device}},
        {"p02", {"simulated-wand", Hand::simulated_device}},
        {"p03", {"mouse", Hand::simulated_device}},
        {"p04", {"omni:emulated", Hand::emulated_device}}};
    {
        auto study = StudyFolder::open(place / "s", StudyAccess::write);
        ASSERT_TRUE(study);
        const StagePlace at = numbered_trials(study->protocol()).at(0).at;
        for (const auto& [id, held] : visits) {
            ASSERT_TRUE(study->begin_visit(id, held));
            const auto files = study->begin_stage(id, at, false);
            ASSERT_TRUE(files);
            ASSERT_TRUE(study->end_stage(id, at, name_of(StageResult::no_attempt_left), {}, *files,
                                         Json{{"strayed", std::size_t{3}}}));
        }
    }
    const std::string status = place.run(kLostStudy + "status s").output;
    const auto reported = place.run(kLostStudy + "report s");
    ASSERT_EQ(reported.status, 0) << reported.output;
    const std::string journal = place.read("s/journal.jsonl"), html = place.read("s/reports/001/report.html");
    const auto rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), visits.size());
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const HeldDevice& held = visits[i].second;
        const std::string hand = name_of(held.hand);
        EXPECT_EQ(rows[i].at("hand"), hand);
        EXPECT_TRUE(status.contains("with " + held.device + " (" + hand + "; felt by no person)")) << status;
        EXPECT_TRUE(
            journal.contains("\"device\":\"" + held.device + "\",\"hand\":\"" + hand + "\",\"felt_by_person\":false"))
            << journal;
        const auto facts = facts_of_hand(visits[i].first, held);
        EXPECT_EQ(facts.at(1), (std::pair<std::string, std::string>{"device", held.device}));
        EXPECT_EQ(facts.at(2), (std::pair<std::string, std::string>{"hand", hand}));
        EXPECT_EQ(facts.at(3), (std::pair<std::string, std::string>{"felt by a person", "no"}));
    }
    for (const std::string& told : {html, status}) {
        EXPECT_TRUE(told.contains("2 of 4 participants went through with a device's driver and an emulated device "
                                  "behind it: no person felt it (omni:emulated, wand:emulated,wand30.toml).") ||
                    told.contains("device&#39;s driver"))
            << told;
        EXPECT_TRUE(told.contains("no person felt it (mouse, simulated-wand)")) << told;
    }
}

TEST(HeldDevices, WithoutForceAreRefusedToAGroupThatFeels) {
    const Workplace place;
    make_lost_study(place, {"\"test\""});
    place.write("log.txt", "burin-input 1 a visit\n0.1 mouse 640 360\n0.3 close\n");
    const std::string journal = place.read("s/journal.jsonl");
    for (const char* device : {"mouse", "spacemouse"}) {
        const auto refused =
            place.run(kLostStudy + "run s --participant p02 --input log.txt --offscreen --device " + device);
        EXPECT_EQ(refused.status, 1) << refused.output;
        EXPECT_TRUE(refused.output.contains("--device " + std::string(device) +
                                            ": gives no force, and group touch feels the tube; name a device with "
                                            "force"))
            << refused.output;
    }
    EXPECT_EQ(place.read("s/journal.jsonl"), journal) << "nothing was begun";
}

}  // namespace burin::study
