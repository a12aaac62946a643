// SPDX-License-Identifier: MIT
// A stereo display that the tests' machines do not have: a surface and a swapchain of images in memory, in the place of
// the driver's. Images may have two layers, as a projector's behind VK_NV_display_stereo; what was shown last can be
// read. Whatever is recorded and submitted goes to the real driver, under the validation layer. One at a time; the
// functions belong to the devices that take() has been called for.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/image.hpp"
#include "renderer/output/eye_images.hpp"

namespace burin::session {

class FakeDisplay {
public:
    explicit FakeDisplay(std::uint32_t layers) : layers_(layers) { one_ = this; }
    ~FakeDisplay() { one_ = nullptr; }
    FakeDisplay(const FakeDisplay&) = delete;
    FakeDisplay& operator=(const FakeDisplay&) = delete;

    // A surface of this size on the device, which must have been opened with VK_KHR_surface.
    gpu::SurfaceHandle take(gpu::Device& device, ImageSize size) {
        size_ = size;
        device_.emplace(device.core());
        gpu::SurfaceFunctions& surface = device.core()->surface;
        surface.destroy = [](VkInstance, VkSurfaceKHR, const VkAllocationCallbacks*) {};
        surface.support = supported;
        surface.capabilities = capabilities;
        surface.formats = formats;
        VolkDeviceTable& vk = device.core()->vk;
        vk.vkCreateSwapchainKHR = create;
        vk.vkDestroySwapchainKHR = destroy;
        vk.vkGetSwapchainImagesKHR = images;
        vk.vkAcquireNextImageKHR = acquire;
        vk.vkQueuePresentKHR = present;
        return {device.core(), handle<VkSurfaceKHR>()};
    }
    // What was presented last; nothing when there are no images any more.
    [[nodiscard]] std::optional<Image> shown(std::uint32_t layer) {
        if (images_.empty() || presented_ == 0) return std::nullopt;
        auto image = renderer::read_back(*device_, images_[shown_].raw(), size_, kFormat,
                                         VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, layer);
        return image ? std::optional(std::move(*image)) : std::nullopt;
    }
    [[nodiscard]] std::uint64_t presented() const { return presented_; }
    void let_go() {
        images_.clear();
        device_.reset();
    }

private:
    static constexpr VkFormat kFormat = VK_FORMAT_B8G8R8A8_SRGB;
    static constexpr std::uint32_t kImages = 3;

    template <typename Handle>
    [[nodiscard]] Handle handle() {
        return reinterpret_cast<Handle>(this);
    }
    [[nodiscard]] const gpu::Core& core() const { return *device_->core(); }

    static VkResult supported(VkPhysicalDevice, std::uint32_t, VkSurfaceKHR, VkBool32* answer) {
        *answer = VK_TRUE;
        return VK_SUCCESS;
    }
    static VkResult capabilities(VkPhysicalDevice, VkSurfaceKHR, VkSurfaceCapabilitiesKHR* caps) {
        const VkExtent2D size{one_->size_.width, one_->size_.height};
        *caps = {.minImageCount = kImages,
                 .maxImageCount = kImages,
                 .currentExtent = size,
                 .minImageExtent = size,
                 .maxImageExtent = size,
                 .maxImageArrayLayers = one_->layers_,
                 .supportedTransforms = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR,
                 .currentTransform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR,
                 .supportedCompositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
                 .supportedUsageFlags = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
        return VK_SUCCESS;
    }
    static VkResult formats(VkPhysicalDevice, VkSurfaceKHR, std::uint32_t* count, VkSurfaceFormatKHR* found) {
        *count = 1;
        if (found != nullptr) *found = {kFormat, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR};
        return VK_SUCCESS;
    }
    static VkResult create(VkDevice, const VkSwapchainCreateInfoKHR* info, const VkAllocationCallbacks*,
                           VkSwapchainKHR* made) {
        one_->images_.clear();
        one_->presented_ = 0;
        if (info->imageArrayLayers > one_->layers_ || info->imageFormat != kFormat)
            return VK_ERROR_INITIALIZATION_FAILED;
        for (std::uint32_t i = 0; i < kImages; ++i) {
            auto image = gpu::Image::create(*one_->device_, {.width = info->imageExtent.width,
                                                             .height = info->imageExtent.height,
                                                             .layers = info->imageArrayLayers,
                                                             .format = kFormat,
                                                             .usage = info->imageUsage,
                                                             .name = "fake display"});
            if (!image) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
            one_->images_.push_back(std::move(*image));
        }
        *made = one_->handle<VkSwapchainKHR>();
        return VK_SUCCESS;
    }
    static void destroy(VkDevice, VkSwapchainKHR swapchain, const VkAllocationCallbacks*) {
        if (swapchain != VK_NULL_HANDLE && one_ != nullptr) one_->let_go();
    }
    static VkResult images(VkDevice, VkSwapchainKHR, std::uint32_t* count, VkImage* found) {
        *count = kImages;
        for (std::uint32_t i = 0; found != nullptr && i < kImages; ++i) found[i] = one_->images_[i].raw();
        return VK_SUCCESS;
    }
    static VkResult acquire(VkDevice, VkSwapchainKHR, std::uint64_t, VkSemaphore semaphore, VkFence,
                            std::uint32_t* image) {
        *image = one_->next_++ % kImages;
        auto submit = gpu::structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submit.signalSemaphoreCount = 1;
        submit.pSignalSemaphores = &semaphore;
        gpu::DeviceQueue& queue = one_->core().shared().queues.front();  // a presenter's
        const std::lock_guard lock(queue.mutex);
        return one_->core().vk.vkQueueSubmit(queue.raw, 1, &submit, VK_NULL_HANDLE);
    }
    // Under the lock of the queue.
    static VkResult present(VkQueue queue, const VkPresentInfoKHR* info) {
        const VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        auto submit = gpu::structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submit.waitSemaphoreCount = info->waitSemaphoreCount;
        submit.pWaitSemaphores = info->pWaitSemaphores;
        submit.pWaitDstStageMask = &all;
        one_->shown_ = info->pImageIndices[0];
        ++one_->presented_;
        return one_->core().vk.vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE);
    }

    static inline FakeDisplay* one_ = nullptr;  // Vulkan's functions carry no pointer of ours
    std::uint32_t layers_;
    ImageSize size_;
    std::optional<gpu::Device> device_;
    std::vector<gpu::Image> images_;
    std::uint32_t next_ = 0, shown_ = 0;
    std::uint64_t presented_ = 0;
};

}  // namespace burin::session
