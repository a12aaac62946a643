// SPDX-License-Identifier: MIT
// Activities made anew of what a recording keeps of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "activities/registry.hpp"
#include "activities/seek/seek.hpp"
#include "activities/train/recorded_visit.hpp"
#include "base/sha256.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::activities {
namespace {

const std::string& thesis_text() {
    static const std::string text{study::known_protocol("kinesthetic-path").value()};
    return text;
}

// As a session of the second day would be recorded, whose first stage is done.
std::string settings_of_day(std::size_t day) {
    static const study::Protocol protocol = study::parse_protocol(thesis_text()).protocol;
    std::vector<study::StagePlace> places;
    for (const study::StagePlace& at : study::places_of(protocol))
        if (at.day == day && at.place > 1) places.push_back(at);
    return visit_settings(sha256(thesis_text()), protocol.groups.at(1), places);
}

session::RecordedFact facts(std::map<std::string, std::string> known) {
    return [known = std::move(known)](const std::string& name) {
        const auto at = known.find(name);
        return at == known.end() ? std::string() : at->second;
    };
}

}  // namespace

TEST(ActivityRegistry, NamesEachActivityOnceAndSaysWhatItIs) {
    std::set<std::string_view> names;
    for (const ActivityKind& kind : activity_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_FALSE(kind.help.empty());
        EXPECT_NE(kind.make, nullptr);
    }
}

TEST(ActivityRegistry, MakesASearchAnewOfItsSettings) {
    const std::string settings = Seek({.targets = 3, .seed = 17}).settings();
    const auto made = activity_as_recorded(settings, facts({}));
    ASSERT_TRUE(made) << made.error().line();
    ASSERT_NE(made->activity, nullptr);
    EXPECT_EQ(made->activity->settings(), settings);
    EXPECT_EQ(made->scene, nullptr) << "its world is a file's";
}

TEST(ActivityRegistry, MakesAVisitAnewOfItsSettingsAndTheProtocolsText) {
    const std::string settings = settings_of_day(1);
    const auto made = activity_as_recorded(settings, facts({{kProtocolTextFact, thesis_text()}}));
    ASSERT_TRUE(made) << made.error().line();
    EXPECT_EQ(made->activity->settings(), settings);
    ASSERT_NE(made->scene, nullptr);
    EXPECT_EQ(made->scene->objects.front().name, "tube");
    EXPECT_EQ(made->activity->panel().title, "Study");
}

TEST(ActivityRegistry, MakesNothingOfASessionWithoutAnActivity) {
    const auto made = activity_as_recorded("", facts({}));
    ASSERT_TRUE(made);
    EXPECT_EQ(made->activity, nullptr);
}

TEST(ActivityRegistry, RefusesAVisitWhoseProtocolIsMissingOrAnotherOne) {
    const std::string settings = settings_of_day(1);
    const auto missing = activity_as_recorded(settings, facts({}));
    ASSERT_FALSE(missing);
    EXPECT_TRUE(missing.error().line().contains("does not hold the protocol")) << missing.error().line();
    const auto changed = activity_as_recorded(settings, facts({{kProtocolTextFact, thesis_text() + "# later\n"}}));
    ASSERT_FALSE(changed);
    EXPECT_TRUE(changed.error().line().contains("holds another protocol")) << changed.error().line();
}

TEST(ActivityRegistry, RefusesSettingsThatNoActivityWrites) {
    const std::string known = sha256(thesis_text()).substr(0, 12);
    for (const std::string& settings :
         {std::string("seek"), std::string("seek --targets 1"), std::string("study"), std::string("study run x"),
          "study run " + known + " group Z day 1 stages 1", "study run " + known + " group K day 1 stages 99",
          "study run " + known + " group K day 7 stages 1", "study run " + known + " group K day 1 stages 1,,2",
          "study run " + known + " group K day 1 stages 99999999999999999999", std::string(5000, 'x'),
          "study run " + known + " group K day 1 stages " + std::string(5000, '1')}) {
        const auto made = activity_as_recorded(settings, facts({{kProtocolTextFact, thesis_text()}}));
        EXPECT_FALSE(made) << settings.substr(0, 80);
    }
    const auto unknown = activity_as_recorded("juggle --balls 3", facts({}));
    ASSERT_FALSE(unknown);
    EXPECT_TRUE(unknown.error().line().contains("'juggle'")) << unknown.error().line();
    EXPECT_TRUE(unknown.error().line().contains("seek, hand, rehab, study")) << unknown.error().line();
}

}  // namespace burin::activities
