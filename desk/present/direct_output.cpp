// SPDX-License-Identifier: MIT
#include "desk/present/direct_output.hpp"

#include "base/try.hpp"

#include <utility>

namespace burin::session {

DirectDriver direct_driver() {
    std::vector<std::string> extensions = gpu::direct_display_extensions();
    for (std::string& name : gpu::direct_display_optional_extensions()) extensions.push_back(std::move(name));
    return {std::move(extensions), gpu::create_display_surface};
}

DirectOutput::DirectOutput(gpu::DisplayChoice choice, DirectDriver driver)
    : choice_(std::move(choice)), driver_(std::move(driver)), name_(choice_.display) {
    mode_.width = choice_.width;
    mode_.height = choice_.height;
    mode_.refresh_Hz = choice_.refresh_Hz;
}

Result<gpu::SurfaceHandle> DirectOutput::make_surface(gpu::Device& device, std::uint32_t layers) {
    if (layers > 1 && choice_.stereo == DisplayStereo::none) {
        return fail("display " + name_, "it is driven as a plain one, which takes one picture at a time",
                    "say in the wall file how it separates two, such as direct = \"hdmi-3d\"");
    }
    // The previous surface must be released first, since a display has one at a time; it is, when the device is idle.
    static_cast<void>(device.wait_idle());
    gpu::DisplayChoice wanted = choice_;
    if (layers == 1) wanted.stereo = DisplayStereo::none;
    BURIN_TRY(opened, driver_.open(device, wanted));
    name_ = opened.display;
    mode_ = opened.mode;
    return std::move(opened.surface);
}

void DirectOutput::exchange_full_screen() {
    notify("display " + name_ + " is driven directly: the picture always fills it");
}

Result<void> DirectOutput::reopen_images(gpu::Device& device, std::uint32_t layers) {
    // size() must report the display's size again.
    gone_ = false;
    auto opened = open_images(device, layers);
    if (opened || device.lost()) return opened;
    layers_ = layers;
    notify("display " + name_ + " has gone: " + opened.error().what + "; it is looked for");
    gone_ = true;
    looked_ns_ = clock_.now_ns();
    return {};
}

void DirectOutput::look_after(gpu::Device& device) {
    if (!gone_ || clock_.now_ns() - looked_ns_ < kBetweenLooks_ns) return;
    gone_ = false;
    if (open_images(device, layers_)) {
        notify("display " + name_ + " is there again");
        return;
    }
    gone_ = true;
    looked_ns_ = clock_.now_ns();
}

}  // namespace burin::session
