// SPDX-License-Identifier: MIT
// Output to a display without any window system (gpu/direct_display.hpp). It gives no input. Stereo is requested from
// it only for images of two layers; for one layer, as in every other mode, it is opened as a plain display.
//
// A display that goes away while the session runs (unplugged, taken by a desktop) is reported and searched for again
// each second: nothing that is carved is lost with it. Main thread alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "desk/present/session_output.hpp"
#include "gpu/direct_display.hpp"

namespace burin::session {

// Source of the surface. Tests substitute another one for the display.
struct DirectDriver {
    std::vector<std::string> extensions;  // of the instance; enabled where they exist
    std::function<Result<gpu::DisplaySurface>(gpu::Device&, const gpu::DisplayChoice&)> open;
};
[[nodiscard]] DirectDriver direct_driver();

class DirectOutput final : public SessionOutput {
public:
    DirectOutput(gpu::DisplayChoice choice, DirectDriver driver);

    // Returns size zero while the display is gone, as for a minimised window.
    [[nodiscard]] ImageSize size() const override { return gone_ ? ImageSize{} : ImageSize{mode_.width, mode_.height}; }
    [[nodiscard]] double refresh_Hz() const override { return mode_.refresh_Hz > 0.0 ? mode_.refresh_Hz : 60.0; }
    void exchange_full_screen() override;
    // Reopens the images. A display that is gone is reported and is not an error; the loss of the device is one.
    [[nodiscard]] Result<void> reopen_images(gpu::Device& device, std::uint32_t layers) override;
    void look_after(gpu::Device& device) override;

private:
    static constexpr Nanoseconds kBetweenLooks_ns = 1'000'000'000;

    [[nodiscard]] Result<gpu::SurfaceHandle> make_surface(gpu::Device& device, std::uint32_t layers) override;

    gpu::DisplayChoice choice_;
    DirectDriver driver_;
    std::string name_;       // the display's own name, once known
    gpu::DisplayMode mode_;  // as requested, until it is known
    bool gone_ = false;
    std::uint32_t layers_ = 1;  // layers to restore when the display returns
    Nanoseconds looked_ns_ = 0;
    MonotonicClock clock_;
};

}  // namespace burin::session
