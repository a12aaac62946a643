// SPDX-License-Identifier: MIT
#include "gpu/swapchain.hpp"

#include <algorithm>
#include <utility>

namespace burin::gpu {

namespace {

// Limit of the wait for a free image: if nobody takes an image within this time, none will be seen soon, and the caller
// handles its events meanwhile.
constexpr std::uint64_t kAcquireLimit_ns = 100'000'000;
// The width by which a surface says that the swapchain determines its size (Wayland).
constexpr std::uint32_t kAnySize = 0xffffffffu;

VkResult create_semaphore(const std::shared_ptr<Core>& core, SemaphoreHandle& into) {
    const auto info = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    VkSemaphore semaphore = VK_NULL_HANDLE;
    const VkResult r = core->vk.vkCreateSemaphore(core->device, &info, nullptr, &semaphore);
    if (r == VK_SUCCESS) into = SemaphoreHandle(core, semaphore);
    return r;
}

VkResult create_layer_view(const std::shared_ptr<Core>& core, VkImage image, VkFormat format, std::uint32_t layer,
                           ImageViewHandle& into) {
    auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layer, 1};
    VkImageView view = VK_NULL_HANDLE;
    const VkResult r = core->vk.vkCreateImageView(core->device, &info, nullptr, &view);
    if (r == VK_SUCCESS) into = ImageViewHandle(core, view);
    return r;
}

VkCompositeAlphaFlagBitsKHR opaque_or_first(VkCompositeAlphaFlagsKHR supported) {
    if ((supported & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0) return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    return static_cast<VkCompositeAlphaFlagBitsKHR>(supported & (~supported + 1u));
}

}  // namespace

const char* name_of(FrameAnswer answer) {
    switch (answer) {
        case FrameAnswer::presented: return "presented";
        case FrameAnswer::resized: return "resized";
        case FrameAnswer::minimised: return "minimised";
        case FrameAnswer::surface_lost: return "surface lost";
        case FrameAnswer::device_lost: return "device lost";
    }
    return "?";
}

Result<Swapchain> Swapchain::create(Device& device, SurfaceHandle surface, const SwapchainOptions& options) {
    Swapchain chain(device.core());
    chain.surface_ = std::move(surface);
    chain.count_vblanks_ = options.count_vblanks;
    if (!device.capabilities().swapchain) {
        return fail(device.info().name, "it cannot show pictures in windows",
                    "choose another device (burin --version lists them)");
    }
    auto done = chain.check_surface(options.layers);
    if (done) done = chain.choose_format();
    if (!done) return std::unexpected(done.error());
    chain.layers_ = options.layers;
    chain.wanted_width_ = options.width;
    chain.wanted_height_ = options.height;
    if (const VkResult r = chain.rebuild(); r != VK_SUCCESS) {
        return vulkan_failure(device.info().name, "no pictures for the window", r);
    }
    return chain;
}

Swapchain& Swapchain::operator=(Swapchain&& other) noexcept {
    if (this != &other) {
        release();
        std::destroy_at(this);
        std::construct_at(this, std::move(other));
    }
    return *this;
}

void Swapchain::release() {
    if (!core_) return;
    drop_images();
    core_->vk.vkDestroySwapchainKHR(core_->device, swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
    surface_ = {};
    core_.reset();
}

// Waits for the whole queue, since presentations cannot be waited for one by one: this happens at a resize and at the
// end.
void Swapchain::drop_images() {
    if (slots_.empty()) return;
    core_->wait_for_queue();
    slots_.clear();
    ready_.clear();
}

Result<void> Swapchain::check_surface(std::uint32_t layers) {
    VkBool32 supported = VK_FALSE;
    const VkResult asked = core_->surface.support(core_->physical, core_->queue_family, surface_.raw(), &supported);
    if (asked != VK_SUCCESS) return vulkan_failure(core_->info.name, "the window's surface cannot be asked", asked);
    if (supported != VK_TRUE) {
        return fail(core_->info.name, "it cannot show pictures on this display",
                    "choose the GPU that the display is plugged into (burin --version lists the devices)");
    }
    VkSurfaceCapabilitiesKHR caps{};
    const VkResult r = core_->surface.capabilities(core_->physical, surface_.raw(), &caps);
    if (r != VK_SUCCESS) return vulkan_failure(core_->info.name, "the window's surface cannot be asked", r);
    can_copy_ = (caps.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;
    if (caps.maxImageArrayLayers < layers) {
        return fail(core_->info.name,
                    "the display takes one picture at a time (" + std::to_string(caps.maxImageArrayLayers) +
                        " layer), not one for each eye",
                    "switch stereo on in the graphics driver, or choose another output mode, such as side_by_side");
    }
    return {};
}

// Prefers sRGB formats, with which the hardware encodes what shaders write.
Result<void> Swapchain::choose_format() {
    std::uint32_t count = 0;
    core_->surface.formats(core_->physical, surface_.raw(), &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    const VkResult r = core_->surface.formats(core_->physical, surface_.raw(), &count, formats.data());
    if (r < VK_SUCCESS) return vulkan_failure(core_->info.name, "the window's formats cannot be listed", r);
    formats.resize(count);
    for (const VkFormat wanted :
         {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        const auto found = std::ranges::find_if(formats, [wanted](const VkSurfaceFormatKHR& f) {
            return f.format == wanted && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
        });
        if (found == formats.end()) continue;
        format_ = *found;
        return {};
    }
    return fail(core_->info.name, "the display takes no pictures of 8 bits a channel",
                "set the display to 24 bits a pixel");
}

bool Swapchain::counts_vblanks() const {
    if (!count_vblanks_ || !core_->capabilities.display_control) return false;
    auto caps = structure<VkSurfaceCapabilities2EXT>(VK_STRUCTURE_TYPE_SURFACE_CAPABILITIES_2_EXT);
    const VkResult r = core_->surface.counters(core_->physical, surface_.raw(), &caps);
    return r == VK_SUCCESS && (caps.supportedSurfaceCounters & VK_SURFACE_COUNTER_VBLANK_BIT_EXT) != 0;
}

std::optional<std::uint64_t> Swapchain::vblank_count() const {
    if (swapchain_ == VK_NULL_HANDLE || !counts_vblanks()) return std::nullopt;
    std::uint64_t count = 0;
    const VkResult r =
        core_->vk.vkGetSwapchainCounterEXT(core_->device, swapchain_, VK_SURFACE_COUNTER_VBLANK_EXT, &count);
    if (r != VK_SUCCESS) return std::nullopt;
    return count;
}

std::optional<bool> Swapchain::was_shown(std::uint64_t picture) const {
    const bool of_this_chain = picture > presented_before_ && picture <= presented_;
    if (!core_->capabilities.present_wait || core_->lost() || swapchain_ == VK_NULL_HANDLE || !of_this_chain)
        return std::nullopt;
    const VkResult r = core_->vk.vkWaitForPresentKHR(core_->device, swapchain_, picture, 0);
    if (r == VK_SUCCESS || r == VK_SUBOPTIMAL_KHR) return true;
    if (r == VK_TIMEOUT) return false;
    return std::nullopt;
}

VkResult Swapchain::create_swapchain(const VkSurfaceCapabilitiesKHR& caps) {
    auto info = structure<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    auto counter = structure<VkSwapchainCounterCreateInfoEXT>(VK_STRUCTURE_TYPE_SWAPCHAIN_COUNTER_CREATE_INFO_EXT);
    counter.surfaceCounters = VK_SURFACE_COUNTER_VBLANK_BIT_EXT;
    if (counts_vblanks()) info.pNext = &counter;
    info.surface = surface_.raw();
    info.minImageCount = std::max(2u, caps.minImageCount);
    if (caps.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, caps.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = {width_, height_};
    info.imageArrayLayers = layers_;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (can_copy_) info.imageUsage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = caps.currentTransform;
    info.compositeAlpha = opaque_or_first(caps.supportedCompositeAlpha);
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    // covered pixels are kept too, so that later frames can reuse parts of the image (SwapchainFrame::age)
    info.clipped = VK_FALSE;
    info.oldSwapchain = swapchain_;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    const VkResult r = core_->vk.vkCreateSwapchainKHR(core_->device, &info, nullptr, &made);
    core_->vk.vkDestroySwapchainKHR(core_->device, swapchain_, nullptr);  // retired even if the new one failed
    swapchain_ = made;
    presented_before_ = presented_;
    return r;
}

VkResult Swapchain::rebuild() {
    drop_images();
    stale_ = false;
    VkSurfaceCapabilitiesKHR caps{};
    if (const VkResult r = core_->surface.capabilities(core_->physical, surface_.raw(), &caps); r != VK_SUCCESS) {
        return r;
    }
    const bool any_size = caps.currentExtent.width == kAnySize;
    const auto fitted = [&](std::uint32_t wanted, std::uint32_t least, std::uint32_t most) {
        return wanted == 0 ? 0 : std::clamp(wanted, least, std::max(least, most));
    };
    width_ = any_size ? fitted(wanted_width_, caps.minImageExtent.width, caps.maxImageExtent.width)
                      : caps.currentExtent.width;
    height_ = any_size ? fitted(wanted_height_, caps.minImageExtent.height, caps.maxImageExtent.height)
                       : caps.currentExtent.height;
    if (width_ == 0 || height_ == 0) return VK_SUCCESS;
    if (const VkResult r = create_swapchain(caps); r != VK_SUCCESS) return r;
    return take_images();
}

VkResult Swapchain::take_images() {
    std::uint32_t count = 0;
    VkResult r = core_->vk.vkGetSwapchainImagesKHR(core_->device, swapchain_, &count, nullptr);
    std::vector<VkImage> images(count);
    if (r == VK_SUCCESS) r = core_->vk.vkGetSwapchainImagesKHR(core_->device, swapchain_, &count, images.data());
    slots_.resize(images.size());
    for (std::size_t i = 0; i < images.size() && r == VK_SUCCESS; ++i) {
        slots_[i].image = images[i];
        for (std::uint32_t layer = 0; layer < layers_ && r == VK_SUCCESS; ++layer) {
            r = create_layer_view(core_, images[i], format_.format, layer, slots_[i].views[layer]);
        }
        if (r == VK_SUCCESS) r = create_semaphore(core_, slots_[i].drawn);
    }
    ready_.resize(images.size() + 1);
    next_ready_ = 0;
    for (std::size_t i = 0; i < ready_.size() && r == VK_SUCCESS; ++i) r = create_semaphore(core_, ready_[i].semaphore);
    return r;
}

FrameAnswer Swapchain::answer_of(VkResult result) {
    switch (result) {
        case VK_SUCCESS:
        case VK_SUBOPTIMAL_KHR: return FrameAnswer::presented;
        case VK_TIMEOUT:
        case VK_NOT_READY: return FrameAnswer::minimised;
        case VK_ERROR_OUT_OF_DATE_KHR:
        case VK_ERROR_FULL_SCREEN_EXCLUSIVE_MODE_LOST_EXT: stale_ = true; return FrameAnswer::resized;
        case VK_ERROR_DEVICE_LOST: core_->note_loss(); return FrameAnswer::device_lost;
        // Includes out of memory: all that can be tried is a new surface and a new swapchain.
        default: return FrameAnswer::surface_lost;
    }
}

FrameAnswer Swapchain::rebuilt() {
    const FrameAnswer answer = answer_of(rebuild());
    if (answer != FrameAnswer::presented) return answer;
    return width_ == 0 || height_ == 0 ? FrameAnswer::minimised : FrameAnswer::resized;
}

SwapchainFrame Swapchain::acquire(std::uint32_t window_width, std::uint32_t window_height) {
    SwapchainFrame frame;
    if (core_->lost()) {
        frame.answer = FrameAnswer::device_lost;
        return frame;
    }
    const bool changed = window_width != wanted_width_ || window_height != wanted_height_;
    wanted_width_ = window_width;
    wanted_height_ = window_height;
    if (window_width == 0 || window_height == 0) {
        stale_ = true;
        return frame;
    }
    if (changed || stale_ || slots_.empty()) {
        const bool same = !stale_ && !slots_.empty() && window_width == width_ && window_height == height_;
        if (!same) {
            frame.answer = rebuilt();
            return frame;
        }
    }
    Ready& ready = ready_[next_ready_];
    if (const auto waited = core_->wait_for(ready.used_by); !waited) {
        frame.answer = core_->lost() ? FrameAnswer::device_lost : FrameAnswer::surface_lost;
        return frame;
    }
    const VkResult r = std::exchange(core_->lose_surface_at_next_acquire, false)
                           ? VK_ERROR_SURFACE_LOST_KHR
                           : core_->vk.vkAcquireNextImageKHR(core_->device, swapchain_, kAcquireLimit_ns,
                                                             ready.semaphore.raw(), VK_NULL_HANDLE, &frame.image);
    frame.answer = answer_of(r);
    if (frame.answer != FrameAnswer::presented) return frame;
    taken_ready_ = next_ready_;
    next_ready_ = (next_ready_ + 1) % ready_.size();
    const Slot& slot = slots_[frame.image];
    frame.raw = slot.image;
    frame.views = {slot.views[0].raw(), slot.views[1].raw()};
    frame.width = width_;
    frame.height = height_;
    frame.age = slot.presented_as == 0 ? 0 : presented_ + 1 - slot.presented_as;
    frame.sync = {ready.semaphore.raw(), slot.drawn.raw()};
    return frame;
}

FrameAnswer Swapchain::present(const SwapchainFrame& frame) {
    BURIN_CHECK(frame.answer == FrameAnswer::presented && frame.image < slots_.size());
    ready_[taken_ready_].used_by = core_->submitted;
    auto info = structure<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &frame.sync.signal;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &frame.image;
    auto numbered = structure<VkPresentIdKHR>(VK_STRUCTURE_TYPE_PRESENT_ID_KHR);
    const std::uint64_t number = presented_ + 1;
    numbered.swapchainCount = 1;
    numbered.pPresentIds = &number;
    if (core_->capabilities.present_wait) info.pNext = &numbered;
    const VkResult r = core_->present(info);
    const FrameAnswer answer = answer_of(r);
    if (answer == FrameAnswer::presented) slots_[frame.image].presented_as = ++presented_;
    if (r == VK_SUBOPTIMAL_KHR) {  // some drivers report this for good: only a new size is worth new images
        VkSurfaceCapabilitiesKHR caps{};
        const VkResult asked = core_->surface.capabilities(core_->physical, surface_.raw(), &caps);
        stale_ = asked != VK_SUCCESS || (caps.currentExtent.width != kAnySize &&
                                         (caps.currentExtent.width != width_ || caps.currentExtent.height != height_));
    }
    return answer;
}

FrameAnswer Swapchain::abandon(const SwapchainFrame& frame) {
    stale_ = true;
    if (core_->lost()) return FrameAnswer::device_lost;
    // Waits for the semaphore that the window system signals, which must happen before it can be destroyed.
    Device device(core_);
    auto commands = Commands::begin(device);
    if (!commands) return FrameAnswer::surface_lost;
    const auto submitted = std::move(*commands).submit({frame.sync.wait, VK_NULL_HANDLE});
    ready_[taken_ready_].used_by = core_->submitted;
    return submitted ? FrameAnswer::resized : FrameAnswer::device_lost;
}

}  // namespace burin::gpu
