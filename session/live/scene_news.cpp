// SPDX-License-Identifier: MIT
#include "session/live/scene_news.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace burin::session {

bool SceneNews::collect(const scene::SceneThread::Ended& update) {
    scene::SceneChanges changes;
    service_->take_changes(changes);
    Report report;
    for (auto& change : changes.drawn)
        if (auto* const carved = dynamic_cast<scene::SurfaceChange*>(change.get()))
            scene::add(report.news.surface, std::move(carved->update));
        else
            report.news.drawn.push_back(std::move(change));
    if (report.news.surface && !report.news.surface->tiles.empty()) carving_duration_.add(update.took_ns);
    report.news.objects = std::move(changes.objects);
    report.news.materials = std::move(changes.materials);
    report.news.messages = std::exchange(messages_, {});
    report.news.hands = std::move(changes.hands);
    report.news.steps = std::move(changes.steps);
    const bool anything = report.news.surface || !report.news.objects.empty() || report.news.materials ||
                          !report.news.drawn.empty() || !report.news.messages.empty();
    const bool ticks = report.news.hands.has_ticks();
    const std::lock_guard lock(mutex_);
    // Frames that stand still while a body moves are shown its newest shapes alone.
    if (!report.news.drawn.empty() && reports_.size() >= kMostShapes)
        reports_[reports_.size() - kMostShapes].news.drawn.clear();
    report.update = ++updates_;
    const bool tells = anything || ticks || !report.news.hands.contacts.empty() || !report.news.steps.empty();
    if (tells) reports_.push_back(std::move(report));
    return anything || (ticks && frames_for_ticks_.load(std::memory_order_relaxed));
}

SceneNews::Taken SceneNews::take(std::uint64_t updates) {
    const std::lock_guard lock(mutex_);
    Taken taken;
    for (; !reports_.empty() && reports_.front().update <= updates; reports_.pop_front()) {
        Taken& news = reports_.front().news;
        scene::add(taken.surface, std::move(news.surface));
        std::ranges::move(news.objects, std::back_inserter(taken.objects));
        if (news.materials) taken.materials = news.materials;
        std::ranges::move(news.drawn, std::back_inserter(taken.drawn));
        std::ranges::move(news.messages, std::back_inserter(taken.messages));
        std::ranges::move(news.steps, std::back_inserter(taken.steps));
        taken.hands.add(std::move(news.hands));
    }
    return taken;
}

}  // namespace burin::session
