// SPDX-License-Identifier: MIT
#include "app/recordings/changed_settings.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "app/cli/command_line.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/sculpt_options.hpp"
#include "base/near_name.hpp"
#include "base/try.hpp"
#include "session/input/input_words.hpp"
#include "session/state/session_settings.hpp"

namespace burin::app {
namespace {

// The devices of several hands, which the command line has as several of --device.
constexpr std::string_view kHands = "--hands";
// Options that a recording always holds: one without them is read as older than the options.
constexpr std::array<std::string_view, 2> kSettled{"--units", "--tool"};
// Settings that a session chooses by itself; no command line takes them.
constexpr std::array<std::string_view, 2> kNobodySays{"--frames-world", "--first-steps"};
constexpr std::array<std::string_view, 11> kOfTheView{"--wall",    "--stereo",  "--swap-eyes",    "--edge-comfort",
                                                      "--width",   "--height",  "--panel-window", "--panel-scale",
                                                      "--samples", "--shadows", "--detail"};

// An option of every session that no recording keeps, since no tick depends on it.
struct Unrecorded {
    std::string_view name;
    void (*take)(const session::SessionSetup& from, session::SessionSetup& to);
};
constexpr std::array kUnrecorded{
    Unrecorded{"--shadows", [](const auto& from, auto& to) { to.desk.shadows = from.desk.shadows; }},
    Unrecorded{"--detail", [](const auto& from, auto& to) { to.desk.detail = from.desk.detail; }},
    Unrecorded{"--engine", [](const auto& from, auto& to) { to.carve.engine = from.carve.engine; }},
    Unrecorded{"--threads", [](const auto& from, auto& to) { to.threads = from.threads; }},
};

template <typename Names>
bool is_among(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

struct Change {
    std::string where;  // "--set friction=0.3"
    std::string name, value;
};

Result<Change> parse_change(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        return fail("--set " + text, "changes nothing", "write OPTION=VALUE, such as friction=0.3");
    return Change{"--set " + text, "--" + text.substr(0, equals), text.substr(equals + 1)};
}

// Refuses an option of the activity, such as the --points of a fingertip's patch in `burin hand`, which are not those
// of a handle.
Result<void> check_not_the_activitys(const Change& change, const std::string& settings) {
    BURIN_TRY(activity, session::activity_on(settings));
    BURIN_TRY(words, session::words_of(activity, "the recording's activity"));
    for (const std::string& word : words)
        if (word == change.name)
            return fail(change.where, "is the activity's own, and cannot be changed",
                        "record another session with burin " + words.front() + " " + change.name);
    return {};
}

std::unexpected<Error> no_such_option(const Change& change, const std::vector<std::string>& settings) {
    std::vector<std::string_view> known(settings.begin(), settings.end());
    for (const Unrecorded& one : kUnrecorded) known.push_back(one.name);
    std::erase(known, kHands);
    std::vector<std::string_view> bare;
    for (const std::string_view name : known) bare.push_back(name.substr(2));
    return fail(change.where, change.name + " is no option that a session's recording knows",
                meant_by(std::string_view(change.name).substr(2), bare) + "There are: " + joined(bare));
}

// Takes what the command line of burin sculpt takes.
Result<void> take(const Change& change, session::SessionSetup& options) {
    CommandLine line("");
    add_sculpt_options(line.program(), options);
    add_live_options(line.program(), options, kInputHelp, "");
    const auto taken = line.take(change.name + "=" + change.value);
    if (taken) return {};
    return fail(change.where, taken.error().what, "write what burin sculpt " + change.name + " takes");
}

// Each device may be an asset, as it may behind --device.
Result<void> take_hands(const Change& change, session::SessionSetup& options) {
    BURIN_TRY(words, session::words_of(change.value, change.where));
    std::vector<std::string> devices;
    for (const std::string& word : words) {
        session::SessionSetup one;
        BURIN_TRY_DO(take({change.where, "--device", word}, one));
        if (one.hands.named.empty())
            return fail(change.where, "'" + word + "' does not say whose device it is",
                        "write such as 'hands=right=simulated left=simulated-wand'");
        devices.push_back(one.hands.named.front().hand + "=" + one.hands.device);
    }
    const auto set = session::set_devices(options.hands, devices);
    return set ? set : fail(change.where, set.error().what, set.error().remedy);
}

Result<void> apply(const std::string& text, ChangedSettings& to) {
    BURIN_TRY(change, parse_change(text));
    BURIN_TRY_DO(check_not_the_activitys(change, to.settings));
    std::vector<std::string> recorded = session::setting_names();
    std::erase_if(recorded, [](const std::string& name) { return is_among(kNobodySays, name); });
    const auto unrecorded = std::ranges::find(kUnrecorded, change.name, &Unrecorded::name);
    if (!is_among(recorded, change.name) && unrecorded == kUnrecorded.end()) return no_such_option(change, recorded);
    if (change.value.empty() && is_among(kSettled, change.name))
        return fail(change.where, "names no value, and the recording needs one", "write it behind the =");
    session::SessionSetup options;
    if (change.name == kHands) {
        BURIN_TRY_DO(take_hands(change, options));
    } else if (!change.value.empty()) {
        BURIN_TRY_DO(take(change, options));
    }
    to.another_view = to.another_view || is_among(kOfTheView, change.name);
    if (unrecorded != kUnrecorded.end()) {
        unrecorded->take(options, to.options);
        return {};
    }
    BURIN_TRY(changed, session::with_setting_of(options, change.name, to.settings));
    to.settings = std::move(changed);
    if (const auto known = session::options_as_recorded(to.settings, to.options); !known)
        return fail(change.where, known.error().what, "change an option of the session to a value that it takes");
    return {};
}

}  // namespace

Result<ChangedSettings> with_changes(std::string settings, const std::vector<std::string>& changes,
                                     const session::SessionSetup& given) {
    ChangedSettings changed{std::move(settings), given, false};
    for (const std::string& change : changes) BURIN_TRY_DO(apply(change, changed));
    return changed;
}

}  // namespace burin::app
