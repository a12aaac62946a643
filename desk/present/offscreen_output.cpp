// SPDX-License-Identifier: MIT
#include "desk/present/offscreen_output.hpp"

#include <utility>

#include "base/try.hpp"
#include "desk/live/desk.hpp"
#include "desk/present/presenter.hpp"
#include "gpu/driver_threads.hpp"

namespace burin::session {

OffscreenOutput::OffscreenOutput(const DeskOptions& options, const SessionWall& wall)
    : options_(options), wall_(&wall) {
    for (const SessionScreen& screen : wall.screens) places_.emplace_back().size = screen.size;
}

OffscreenOutput::~OffscreenOutput() = default;

bool OffscreenOutput::has_drawn() const { return presenter_ && presenter_->has_drawn(); }

void OffscreenOutput::put(std::size_t screen, const wall::OutputPlace& place) {
    places_[screen] = place;
    if (presenter_) presenter_->put(screen, place);
}

Result<bool> OffscreenOutput::draw(Desk& desk, Nanoseconds frame_ns) {
    if (!presenter_ && !desk.session().files().wants_pictures()) return false;
    if (!presenter_) {
        if (device_ && device_->lost()) device_.reset();
        BURIN_TRY(opened, Presenter::open(options_, *wall_, direct_driver(), std::exchange(device_, std::nullopt)));
        presenter_ = std::make_unique<Presenter>(std::move(opened));
        for (std::size_t screen = 0; screen < places_.size(); ++screen) presenter_->put(screen, places_[screen]);
    }
    return presenter_->draw(desk, frame_ns);
}

Result<gpu::Device> OffscreenOutput::lane() {
    if (presenter_) return presenter_->device().lane();
    if (!device_) {
        gpu::leave_a_core_to_touch();
        BURIN_TRY(opened, gpu::Device::create());
        device_ = std::move(opened);
    }
    return device_->lane();
}

Result<void> OffscreenOutput::recover(Desk& desk, const Error& error) {
    return presenter_ ? presenter_->recover(desk, error) : Result<void>(std::unexpected(error));
}

Result<void> OffscreenOutput::fit_modes(Desk& desk) {
    return presenter_ ? presenter_->fit_modes(desk) : Result<void>{};
}

Result<std::unique_ptr<FrameOutput>> open_output(const DeskOptions& options, const SessionWall& wall,
                                                 bool asks_for_pictures) {
    if (options.offscreen && !asks_for_pictures) return std::make_unique<OffscreenOutput>(options, wall);
    BURIN_TRY(opened, Presenter::open(options, wall));
    return std::make_unique<Presenter>(std::move(opened));
}

}  // namespace burin::session
