// SPDX-License-Identifier: MIT
#include "session/activity/activity.hpp"

#include <algorithm>

#include "base/near_name.hpp"
#include "base/text.hpp"
#include "session/input/input_words.hpp"

namespace burin::session {
namespace {

// Checks how many words stand behind an act's name.
Result<void> check_arguments(const Act& act, std::span<const std::string> given) {
    const std::string_view wanted = act.arguments;
    const bool optional = wanted.starts_with('['), more = wanted.ends_with("...");
    const auto most = wanted.empty() ? std::size_t{0} : static_cast<std::size_t>(1 + std::ranges::count(wanted, ' '));
    const std::string where = "command do " + std::string(act.name);
    const std::string remedy = "write do " + std::string(act.name) + (wanted.empty() ? "" : " ") + std::string(wanted);
    if (given.size() > most && !more)
        return fail(where,
                    most == 0 ? "takes no argument, and is given " + as_word(given[0])
                              : "is given one word too many: " + as_word(given[most]),
                    remedy);
    if (given.size() < most && !optional) return fail(where, "lacks its argument", remedy);
    return {};
}

}  // namespace

Result<void> check_act(const Activity* activity, std::span<const std::string> words) {
    const std::string name = words.empty() ? "" : words.front();
    if (activity == nullptr)
        return fail("command do " + name, "is for an activity, and this session has none",
                    "start one: burin seek, burin rehab, or burin study run");
    std::vector<std::string_view> names;
    for (const Act& known : activity->acts()) names.push_back(known.name);
    if (const auto known = std::ranges::find(activity->acts(), name, &Act::name); known != activity->acts().end())
        return check_arguments(*known, words.subspan(1));
    if (names.empty()) return fail("command do " + name, "is no act of this activity", "it has none");
    return fail("command do " + name, "is no act of this activity",
                meant_by(name, names) + "There are " + joined(names));
}

}  // namespace burin::session
