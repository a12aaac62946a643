// SPDX-License-Identifier: MIT
// A display of its own that shows a session's pictures without any window system (gpu/direct_display.hpp). It gives no input. Stereo is asked
// of it only for images of two layers; for one layer, as every other mode has it, it is opened as a plain display.
//
// A display that goes away while the session runs (unplugged, taken by a desktop) is told and looked for again each second: nothing that is
// carved is lost with it. Main thread alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/session/session_output.hpp"
#include "gpu/direct_display.hpp"

namespace burin {

// Where the surface comes from. Tests put another one in the display's place.
struct DirectDriver {
    std::vector<std::string> extensions;  // of the instance; enabled where they exist
    std::function<Result<gpu::DisplaySurface>(gpu::Device&, const gpu::DisplayChoice&)> open;
};
[[nodiscard]] DirectDriver direct_driver();

class DirectOutput final : public SessionOutput {
public:
    DirectOutput(gpu::DisplayChoice choice, DirectDriver driver);

    // None while the display is gone: as a window that is minimised.
    [[nodiscard]] ImageSize size() const override { return gone_ ? ImageSize{} : ImageSize{mode_.width, mode_.height}; }
    [[nodiscard]] double refresh_Hz() const override { return mode_.refresh_Hz > 0.0 ? mode_.refresh_Hz : 60.0; }
    void exchange_full_screen() override;
    // Where the display is gone, that is told, and no error; the device's loss is one.
    [[nodiscard]] Result<void> reopen_images(gpu::Device& device, std::uint32_t layers) override;
    void look_after(gpu::Device& device) override;

private:
    static constexpr Nanoseconds kBetweenLooks_ns = 1'000'000'000;

    [[nodiscard]] Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) override;

    gpu::DisplayChoice choice_;
    DirectDriver driver_;
    std::string name_;       // as the display calls itself, once it was there
    gpu::DisplayMode mode_;  // as asked for, until it is known
    bool gone_ = false;
    std::uint32_t layers_ = 1;  // that it is to have again
    Nanoseconds looked_ns_ = 0;
    MonotonicClock clock_;
};

}  // namespace burin
