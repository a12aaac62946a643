// SPDX-License-Identifier: MIT
#include "activities/train/recorded_visit.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_file.hpp"
#include "record/motion.hpp"

namespace burin::activities {
namespace {

constexpr std::size_t kDigestShown = 12;
// Recordings of before December 2026 lack it.
constexpr std::string_view kPlacedWord = "placed";

// Holds what a record's settings say about the visit.
struct VisitWords {
    std::string protocol_digest, group;  // the digest's beginning
    std::size_t day = 0;
    std::vector<std::size_t> places;
    bool placed = false;  // StudyDevice::placed
};

std::unexpected<Error> not_of_a_visit(const std::string& settings) {
    return fail(settings, "are no settings of burin study run", "replay it with the program that recorded it");
}

Result<VisitWords> visit_words(const std::string& settings) {
    std::array<char, 16> digest{}, placed{};
    std::array<char, 64> group{}, places{};
    std::size_t day = 0;
    if (std::sscanf(settings.c_str(), "study run %15s group %63s day %zu stages %63s %15s", digest.data(), group.data(),
                    &day, places.data(), placed.data()) < 4)
        return not_of_a_visit(settings);
    VisitWords words{digest.data(), group.data(), day, {}, placed.data() == kPlacedWord};
    std::size_t place = 0;
    for (const char c : std::string(places.data()) + ",") {
        if (c >= '0' && c <= '9' && place < 100000) {
            place = 10 * place + static_cast<std::size_t>(c - '0');
        } else if (c == ',' && place > 0) {
            words.places.push_back(std::exchange(place, 0));
        } else {
            return not_of_a_visit(settings);
        }
    }
    return words;
}

// The activity with what it refers to.
struct RepeatedVisit {
    study::Protocol protocol;
    FeltWorlds worlds;
    std::optional<StudyActivity> activity;
};

Result<study::Protocol> recorded_protocol(const std::string& wanted_digest, const session::RecordedFact& fact) {
    const std::string text = fact(kProtocolTextFact);
    if (text.empty())
        return fail("the recording", "does not hold the protocol of its study",
                    "replay the study's stages by burin study replay STUDY: each is a recording in its folder");
    if (!sha256(text).starts_with(wanted_digest))
        return fail("the recording", "holds another protocol than its settings name: it was changed",
                    "take the file as it was recorded, from a copy");
    study::ParsedProtocol parsed = study::parse_protocol(text);
    if (parsed.faults.empty()) return std::move(parsed.protocol);
    return fail("the recording", "has a protocol that this program refuses",
                "replay it with the program that recorded it");
}

}  // namespace

std::string visit_settings(const std::string& protocol_digest, const study::Group& group,
                           const std::vector<study::StagePlace>& places) {
    std::string numbers;
    for (const study::StagePlace& at : places) numbers += (numbers.empty() ? "" : ",") + std::to_string(at.place);
    return formatted("study run %s group %s day %zu stages %s ", protocol_digest.substr(0, kDigestShown).c_str(),
                     group.code.c_str(), places.front().day, numbers.c_str()) +
           std::string(kPlacedWord);
}

Result<session::MadeActivity> visit_as_recorded(const std::string& settings, const session::RecordedFact& fact) {
    BURIN_TRY(words, visit_words(settings));
    BURIN_TRY(protocol, recorded_protocol(words.protocol_digest, fact));
    const auto visit = std::make_shared<RepeatedVisit>();
    visit->protocol = std::move(protocol);
    const auto group = std::ranges::find(visit->protocol.groups, words.group, &study::Group::code);
    std::vector<study::StagePlace> places;
    for (const study::StagePlace& at : study::places_of(visit->protocol))
        if (at.day == words.day && std::ranges::find(words.places, at.place) != words.places.end())
            places.push_back(at);
    if (group == visit->protocol.groups.end() || places.size() != words.places.size()) return not_of_a_visit(settings);
    BURIN_TRY(worlds, felt_worlds(visit->protocol));
    visit->worlds = std::move(worlds);
    StudyDevice device{.placed = words.placed};
    if (const std::string text = fact(record::kWandTextFact); !text.empty()) {
        devices::WandOrProblems wand = devices::parse_wand(text, record::kWandTextFact);
        if (!wand) return std::unexpected(wand.error().front());
        device.wand = std::move(*wand);
    }
    visit->activity.emplace(visit->protocol, *group, visit->worlds, std::move(places), settings, std::move(device),
                            StageKeeper{});
    std::shared_ptr<const scene::World> scene = visit->activity->scene();
    session::Activity* activity = &*visit->activity;
    return session::MadeActivity{{visit, activity}, std::move(scene)};
}

}  // namespace burin::activities
