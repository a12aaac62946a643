// SPDX-License-Identifier: MIT
#include "desk/opening/opening_work.hpp"

#include <utility>

#include "geometry/files/closed_mesh.hpp"
#include "geometry/mesh/coarse_copy.hpp"

namespace burin::session {
namespace {

// More triangles are drawn as a coarse copy, of so many cells along the longest side.
constexpr std::size_t kMostLookedAt = 150'000;
constexpr int kLookCells = 128;

}  // namespace

void OpeningSight::show(FirstLook look) {
    {
        const std::lock_guard lock(mutex_);
        look_ = std::move(look);
    }
    wake_();
}

std::optional<FirstLook> OpeningSight::take_look() {
    const std::lock_guard lock(mutex_);
    return std::exchange(look_, std::nullopt);
}

void OpeningSight::finish() {
    finished_.store(true, std::memory_order_release);
    wake_();
}

void OpeningSight::shown() {
    {
        const std::lock_guard lock(mutex_);
        ++pictures_;
    }
    seen_.notify_all();
}

unsigned OpeningSight::pictures() {
    const std::lock_guard lock(mutex_);
    return pictures_;
}

bool OpeningSight::wait_for_pictures(unsigned count) {
    std::unique_lock lock(mutex_);
    seen_.wait(lock, [&] { return pictures_ >= count || !work_.is_wanted(); });
    return pictures_ >= count;
}

void OpeningSight::stop() {
    {
        const std::lock_guard lock(mutex_);
        work_.stop();
    }
    seen_.notify_all();
}

OpeningWork::OpeningWork(Make make, std::function<void()> wake)
    : sight_(std::move(wake)), made_(geometry::no_longer_wanted()), thread_([this, make = std::move(make)] {
          made_ = make(sight_);
          sight_.finish();
      }) {}

OpeningWork::~OpeningWork() { sight_.stop(); }

Result<std::unique_ptr<workpiece::Workpiece>> OpeningWork::take() {
    thread_.join();
    return std::move(made_);
}

Result<std::unique_ptr<workpiece::Workpiece>> make_in_sight(const CarveOptions& carve, unsigned threads,
                                                            OpeningSight& sight) {
    workpiece::LoadWatch watch{&sight.work()};
    watch.look = [&sight](const geometry::TriangleMesh& mesh) {
        auto drawn = picture::drawn_mesh(geometry::coarse_copy(mesh, kMostLookedAt, kLookCells));
        const Box bounds = drawn->bounds;
        sight.show({std::move(drawn), bounds});
    };
    return carve.make_workpiece(carve.workpiece, std::nullopt, carve.make_engine, threads, watch);
}

}  // namespace burin::session
