// SPDX-License-Identifier: MIT
#include "session/objects/world_history.hpp"

#include "scene/scene_motion.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_objects.hpp"

#include <algorithm>
#include <utility>

namespace burin::session {
namespace {

bool is_held(const scene::SceneObject& object) { return std::holds_alternative<scene::HeldMotion>(object.motion); }

}  // namespace

WorldHistory::WorldHistory(std::int64_t first, std::int64_t done, std::span<const scene::ObjectStep> steps)
    : first_(first), done_(static_cast<std::size_t>(done - first + 1)) {
    for (const scene::ObjectStep& step : steps) steps_.push_back({step, ++newest_state_});
}

scene::PartSteps WorldHistory::steps() const {
    const std::int64_t done = first_ + static_cast<std::int64_t>(done_) - 1;
    return {.first = first_, .done = done, .last = done + static_cast<std::int64_t>(redoable()), .made = made_};
}

void WorldHistory::add(Kept kept) {
    steps_.resize(done_);
    ++made_;
    kept.state = ++newest_state_;
    steps_.push_back(std::move(kept));
    if (steps_.size() > kMostSteps) {
        first_state_ = steps_.front().state;
        steps_.pop_front();
        ++first_;
    }
    done_ = steps_.size();
    rests_s_ = 0.0;
    is_open_ = true;
}

void WorldHistory::note(std::shared_ptr<const scene::SceneObject> before,
                        std::shared_ptr<const scene::SceneObject> after, scene::ObjectProperty property,
                        bool is_newest) {
    const bool goes_on = is_open_ && is_newest && rests_s_ < kGoesOn_s && done_ > 0 && done_ == steps_.size() &&
                         steps_.back().property == property && steps_.back().step.after->id == after->id;
    if (!goes_on) return add({{std::move(before), std::move(after)}, 0, property});
    steps_.back().step.after = std::move(after);
    steps_.back().state = ++newest_state_;
    rests_s_ = 0.0;
}

void WorldHistory::follow(const WorldObjects& before, const WorldObjects& after) {
    for (std::size_t i = 0; i < after.objects.size(); ++i) {
        const auto &was = before.objects[i], &is = after.objects[i];
        if (was == is) continue;
        if (is_held(*is)) {
            held_from_.try_emplace(is->id, was);
        } else if (const auto from = held_from_.find(is->id); from != held_from_.end()) {
            add({{std::move(from->second), is}});
            held_from_.erase(from);
        }
    }
}

void WorldHistory::went_back() {
    --done_;
    is_open_ = false;
}

void WorldHistory::went_forward() {
    ++done_;
    is_open_ = false;
}

}  // namespace burin::session
