// SPDX-License-Identifier: MIT
// The outputs of a session that nobody sees: screens of a size and nothing behind them. A graphics device is opened for
// the engine, where one is to carve, or with the first picture that is asked for; a session of neither needs none.
// Thread: the frame's.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "desk/present/frame_output.hpp"
#include "desk/view/session_screens.hpp"
#include "session/options/desk_options.hpp"

namespace burin::session {

class Presenter;  // desk/present/presenter.hpp

class OffscreenOutput final : public FrameOutput {
public:
    // The wall must outlive it.
    OffscreenOutput(const DeskOptions& options, const SessionWall& wall);
    ~OffscreenOutput() override;

    void look() override {}
    [[nodiscard]] std::vector<wall::OutputPlace> places() const override { return places_; }
    void put(std::size_t screen, const wall::OutputPlace& place) override;
    [[nodiscard]] std::size_t screens() const override { return places_.size(); }
    [[nodiscard]] bool shows() const override { return false; }
    [[nodiscard]] bool has_lost_display() const override { return false; }
    [[nodiscard]] std::vector<Input> inputs(double) override { return {}; }
    // Fails where there is no Vulkan driver for the first picture.
    [[nodiscard]] Result<bool> draw(Desk& desk, Nanoseconds frame_ns) override;
    [[nodiscard]] Result<void> recover(Desk& desk, const Error& error) override;
    [[nodiscard]] Result<void> fit_modes(Desk& desk) override;
    [[nodiscard]] bool has_drawn() const override;

private:
    [[nodiscard]] Result<gpu::Device> lane() override;

    DeskOptions options_;
    const SessionWall* wall_;
    std::vector<wall::OutputPlace> places_;
    std::optional<gpu::Device> device_;     // the presenter's to be, where it was opened for the engine
    std::unique_ptr<Presenter> presenter_;  // null: no picture has been asked for yet
};

// Opens the outputs of a session: with a graphics device at once where somebody sees its pictures, or where some are
// asked for already, so that a missing driver is told of before anything is done.
[[nodiscard]] Result<std::unique_ptr<FrameOutput>> open_output(const DeskOptions& options, const SessionWall& wall,
                                                               bool asks_for_pictures);

}  // namespace burin::session
