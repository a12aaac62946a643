// SPDX-License-Identifier: MIT
#include "session/activity/activity.hpp"

#include <algorithm>

#include "base/near_name.hpp"
#include "base/text.hpp"

namespace burin::session {

Result<void> check_act(const Activity* activity, std::span<const std::string> words) {
    const std::string name = words.empty() ? "" : words.front();
    if (activity == nullptr)
        return fail("command do " + name, "is for an activity, and this session has none",
                    "start one: burin seek, burin rehab, or burin study run");
    const std::span<const Act> acts = activity->acts();
    if (const auto known = std::ranges::find(acts, name, &Act::name); known != acts.end())
        return check_words(*known, words.subspan(1), "do ");
    if (acts.empty()) return fail("command do " + name, "is no act of this activity", "it has none");
    std::vector<std::string_view> names;
    std::vector<std::string> forms;
    for (const Act& act : acts) {
        names.push_back(act.name);
        forms.push_back(text_of(act));
    }
    const std::vector<std::string_view> listed(forms.begin(), forms.end());
    return fail("command do " + name, "is no act of this activity",
                meant_by(name, names) + "There are " + joined(listed));
}

}  // namespace burin::session
