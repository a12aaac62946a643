// SPDX-License-Identifier: MIT
#include "session/live/scene_news.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace burin::session {

bool SceneNews::collect(const scene::SceneThread::Ended& update) {
    Report report;
    if (carved_ != nullptr) report.news.surface = carved_->take_surface_update();
    if (report.news.surface && !report.news.surface->tiles.empty()) carving_duration_.add(update.took_ns);
    if (meshes_ != nullptr) report.news.objects = meshes_->take_object_updates();
    if (materials_ != nullptr && std::exchange(materials_version_, materials_->version()) != materials_->version())
        report.news.materials = *materials_;
    report.news.messages = std::exchange(messages_, {});
    if (tap_ != nullptr) report.news.hands = tap_->take();
    const bool anything =
        report.news.surface || !report.news.objects.empty() || report.news.materials || !report.news.messages.empty();
    const bool ticks = !report.news.hands.empty();
    const std::lock_guard lock(mutex_);
    report.update = ++updates_;
    if (anything || ticks) reports_.push_back(std::move(report));
    return anything || (ticks && frames_for_ticks_.load(std::memory_order_relaxed));
}

SceneNews::Taken SceneNews::take(std::uint64_t updates) {
    const std::lock_guard lock(mutex_);
    Taken taken;
    for (; !reports_.empty() && reports_.front().update <= updates; reports_.pop_front()) {
        Taken& news = reports_.front().news;
        sculpt::add(taken.surface, std::move(news.surface));
        std::ranges::move(news.objects, std::back_inserter(taken.objects));
        if (news.materials) taken.materials = news.materials;
        std::ranges::move(news.messages, std::back_inserter(taken.messages));
        taken.hands.add(std::move(news.hands));
    }
    return taken;
}

}  // namespace burin::session
