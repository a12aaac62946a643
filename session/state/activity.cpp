// SPDX-License-Identifier: MIT
#include "session/state/activity.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace burin::session {

Result<void> check_act(const Activity* activity, std::span<const std::string> words) {
    const std::string name = words.empty() ? "" : words.front();
    if (activity == nullptr)
        return fail("command do " + name, "is for an activity, and this session has none",
                    "start one: burin seek, or burin study run");
    std::vector<std::string_view> names;
    for (const Act& known : activity->acts()) names.push_back(known.name);
    if (std::ranges::find(names, name) != names.end()) return {};
    if (names.empty()) return fail("command do " + name, "is no act of this activity", "it has none");
    return fail("command do " + name, "is no act of this activity",
                "did you mean " + std::string(nearest_name(name, names)) + "?");
}

}  // namespace burin::session
