// SPDX-License-Identifier: MIT
#include "session/state/session_options.hpp"

#include <algorithm>

namespace burin::session {
namespace {

bool is_hand_name(const std::string& name) {
    constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.size() <= 32 && name.find_first_not_of(kLetters) == std::string::npos;
}

}  // namespace

Result<NamedDevice> parse_named_device(const std::string& text) {
    const std::size_t equals = text.find('=');
    NamedDevice named{text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (equals == std::string::npos)
        return fail("--device " + text, "does not say whose device it is, and there are several hands",
                    "write NAME=DEVICE for each, such as right=" + text);
    if (!is_hand_name(named.hand))
        return fail("--device " + text, "gives a hand a name with other than letters, digits, - and _",
                    "write such as right=simulated");
    if (named.device.empty())
        return fail("--device " + text, "names no device", "write such as " + named.hand + "=simulated");
    return named;
}

std::vector<NamedDevice> devices_of(const LiveOptions& live) {
    return live.hands.empty() ? std::vector<NamedDevice>{{"", live.device}} : live.hands;
}

Result<void> set_devices(LiveOptions& live, const std::vector<std::string>& given) {
    if (given.empty()) return {};
    // A device alone may have a = in the name of its file, behind the colon.
    const auto is_named = [](const std::string& text) { return text.find('=') < text.find(':'); };
    if (given.size() == 1 && !is_named(given.front())) {
        live.device = given.front();
        return {};
    }
    if (given.size() > kMostHands)
        return fail("--device", "is given " + std::to_string(given.size()) + " times",
                    "a session has " + std::to_string(kMostHands) + " hands at most");
    std::vector<NamedDevice> hands;
    for (const std::string& text : given) {
        Result<NamedDevice> named = parse_named_device(text);
        if (!named) return std::unexpected(named.error());
        if (std::ranges::find(hands, named->hand, &NamedDevice::hand) != hands.end())
            return fail("--device " + text, "is a second device of one name", "give each hand a name of its own");
        hands.push_back(std::move(*named));
    }
    live.device = hands.front().device;
    live.hands = std::move(hands);
    return {};
}

}  // namespace burin::session
